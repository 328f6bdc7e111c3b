#include "table_options.hpp"

#include <filesystem>

#include "config/config_error.hpp"
#include "config/suggestion.hpp"
#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/free_name.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

Place place(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string option = "--where " + config::in_quotes(text);
  if (equals == std::string::npos || equals == 0) throw UsageError(option + "; expected AXIS=VALUE, e.g. nu=1.0");
  try {
    return {text.substr(0, equals),
            config::parse_reading({std::string_view(text).substr(equals + 1), {.source = option}})};
  } catch (const config::ConfigError& error) {
    throw UsageError(std::string(error.what()) + "; expected AXIS=VALUE, e.g. nu=1.0");
  }
}

}  // namespace

std::vector<Place> places_of(const Arguments& arguments) {
  std::vector<Place> places;
  for (const std::string& text : arguments.values("where")) {
    places.push_back(place(text));
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
      if (places[i].axis == places.back().axis && places[i].value.value != places.back().value.value)
        throw UsageError("--where " + storage::excerpt(text) + " beside --where " +
                         storage::excerpt(arguments.values("where")[i]) + "; an axis has one value at a point");
  }
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
    throw storage::IoError("cannot write " + storage::quoted_name(output) + ": there is a file; " +
                           storage::instead_of_replacing(output));
  return output;
}

}  // namespace clatter::app
