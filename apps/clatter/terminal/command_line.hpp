#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::app {

/// A wrong command line; `what()` is one line that ends with how to fix it.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Option {
  std::string_view name;      ///< "output"
  char letter = 0;            ///< 'o', or 0
  std::string_view argument;  ///< "FILE.h5"; empty: a switch
  std::string_view help;
  bool repeatable = false;
  std::span<const std::string_view> choices{};  ///< the words that the argument may be; empty: any
};

/// The arguments of a subcommand.
struct Arguments {
  std::vector<std::string> operands;
  std::map<std::string, std::vector<std::string>, std::less<>> options;  ///< by long name; a switch has no value

  [[nodiscard]] bool has(std::string_view option) const { return options.find(option) != options.end(); }
  [[nodiscard]] std::optional<std::string> value(std::string_view option) const;
  [[nodiscard]] std::vector<std::string> values(std::string_view option) const;
};

struct Command;

/// Throws the UsageError of an option before the command.
[[noreturn]] void refuse_option(const std::string& written);

/// Parses the words after the subcommand's name. Throws UsageError, also for abbreviated options.
[[nodiscard]] Arguments parse_arguments(const Command& command, const std::vector<std::string>& words);

}  // namespace clatter::app
