#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"

namespace clatter::app {

/// Appends the shortest digits that read back to the same double; nan, inf.
void append_number(std::string& text, double value);

/// Appends a field, in quotes if it needs them (RFC 4180, 2).
void append_text(std::string& text, std::string_view field);

/// How many values a variable has.
[[nodiscard]] std::size_t size_of(const results::Variable& variable);

/// Appends one of many values; an integer by its meaning, if it has one.
void append_value(std::string& text, const results::ValueArray& values, std::size_t index,
                  const std::vector<std::string>& meanings = {});

/// The meaning of each value of a flag, by its number; empty if the variable is none.
[[nodiscard]] std::vector<std::string> meanings_of(const results::Variable& variable);

inline constexpr std::size_t piece = 64UL * 1024;  ///< bytes passed on at once

/// Collects text, and passes it on in pieces.
class Pieces {
 public:
  explicit Pieces(const std::function<void(std::string_view)>& take) : take_(take) {}

  std::string& text() { return text_; }
  void end_line() {
    text_ += '\n';
    if (text_.size() >= piece) flush();
  }
  void flush() { take_(text_), text_.clear(); }

 private:
  const std::function<void(std::string_view)>& take_;
  std::string text_;
};

}  // namespace clatter::app
