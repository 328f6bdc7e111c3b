#include "table_options.hpp"

#include <filesystem>
#include <stdexcept>

#include "config/suggestion.hpp"
#include "config/value_grammar.hpp"
#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

std::pair<std::string, double> place(const std::string& text) {
  const std::size_t equals = text.find('=');
  try {
    if (equals == std::string::npos || equals == 0) throw UsageError("");
    const double value = config::parse_number({std::string_view(text).substr(equals + 1), {}});
    return {text.substr(0, equals), value};
  } catch (const std::runtime_error&) {
    throw UsageError("--where " + config::in_quotes(text) + "; expected AXIS=VALUE, e.g. nu=1.0");
  }
}

}  // namespace

std::vector<std::pair<std::string, double>> places_of(const Arguments& arguments) {
  std::vector<std::pair<std::string, double>> places;
  for (const std::string& text : arguments.values("where")) places.push_back(place(text));
  return places;
}

std::optional<std::string> text_output_of(const Arguments& arguments) {
  const std::string output = arguments.value("output").value_or("-");
  if (output == "-") return std::nullopt;
  storage::check_writable(output);
  std::error_code error;
  if (std::filesystem::equivalent(arguments.operands[0], output, error))
    throw UsageError("the output " + storage::quoted_name(output) + " is the input; name another file with -o");
  if (std::filesystem::exists(output, error) && !arguments.has("force"))
    throw storage::IoError("cannot write " + storage::quoted_name(output) +
                           ": there is a file; name another with -o, move that one away, or replace it with --force");
  return output;
}

}  // namespace clatter::app
