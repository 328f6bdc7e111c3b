#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/commands.hpp"

namespace clatter::app {

/// Offered for the argument of an option, or for an operand.
struct Offer {
  enum class Kind { nothing, words, files, folders, settings };
  Kind kind = Kind::nothing;
  std::vector<std::string> words{};  ///< or the endings of files
};

[[nodiscard]] Offer offer_for(std::string_view argument, std::span<const std::string_view> choices = {});

/// That of the last operand, which stands for all.
[[nodiscard]] Offer operand_of(const Command& command);

/// A key after --set.
struct Setting {
  std::string name;                      ///< "scene.R"
  std::string permitted;                 ///< "0 ... 1; default: 1"
  std::string help;                      ///< its meaning
  std::vector<std::string_view> values;  ///< all that it may be, if these are words
};

[[nodiscard]] std::vector<Setting> settings();

/// "-o" and "--output", or "--output" alone.
[[nodiscard]] std::vector<std::string> written(const Option& option);

[[nodiscard]] std::vector<std::string> written(std::span<const Option> options);

[[nodiscard]] std::string replaced(std::string text, std::string_view old, std::string_view with);

/// A word for bash and zsh.
[[nodiscard]] std::string shell_quoted(const std::string& text);

template <class Words>
[[nodiscard]] std::string joined(const Words& words, std::string_view between) {
  std::string text;
  for (const auto& word : words) (text += text.empty() ? "" : between) += word;
  return text;
}

}  // namespace clatter::app
