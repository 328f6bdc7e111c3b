#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "storage/utf8.hpp"
#include "terminal/asked_units.hpp"
#include "terminal/format.hpp"

namespace clatter::app {

/// Numbers of one unit as text, all with the same prefix: lengths that are all below 0.1 m are in mm, as in pictures,
/// unless another unit is asked for.
class Amounts {
 public:
  Amounts(const std::string& units, std::span<const double> values, const AskedUnits& asked = {})
      : unit_(storage::printable(unit_text(units))) {
    if (const auto* const other = asked.of(units)) {
      unit_ = storage::printable(other->name), scale_ = 1 / other->in_si;
      return;
    }
    constexpr double short_length = 0.1;  // m
    const auto is_short = [](double value) { return !(std::abs(value) >= short_length); };
    if (unit_ == "m" && std::ranges::all_of(values, is_short)) unit_ = "mm", scale_ = 1e3;
  }

  [[nodiscard]] std::string number(const char* format, double value) const { return formatted(format, scale_ * value); }
  [[nodiscard]] const std::string& unit() const { return unit_; }
  [[nodiscard]] std::string text(const char* format, double value) const {
    return number(format, value) + (unit_.empty() ? "" : ' ' + unit_);
  }

 private:
  std::string unit_;
  double scale_ = 1.0;
};

}  // namespace clatter::app
