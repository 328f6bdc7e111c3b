#include "info_json.hpp"

#include "format.hpp"

namespace clatter::app {
namespace {

/// Joins members or elements by commas, each on its own line.
template <typename Range, typename Print>
std::string lines(const Range& range, const Print& print) {
  std::string text;
  for (const auto& element : range) text += (text.empty() ? "\n    " : ",\n    ") + print(element);
  return text + (text.empty() ? "" : "\n  ");
}

std::string entry_json(const results::FileSummary::Entry& entry) {
  std::string names, shape;
  for (const sweep::NamedLength& dimension : entry.dimensions) {
    names += (names.empty() ? "" : ", ") + json_text(dimension.name);
    shape += (shape.empty() ? "" : ", ") + std::to_string(dimension.length);
  }
  return "{\"name\": " + json_text(entry.name) + ", \"type\": " + json_text(entry.type) + ", \"dimensions\": [" +
         names + "], \"shape\": [" + shape + "], \"units\": " + json_text(entry.units) +
         ", \"long_name\": " + json_text(entry.long_name) +
         (entry.frame.empty() ? "" : ", \"frame\": " + json_text(entry.frame)) + '}';
}

}  // namespace

std::string json(const results::FileSummary& summary) {
  const auto attribute = [](const auto& pair) { return json_text(pair.first) + ": " + json_text(pair.second); };
  const auto count = [](const auto& pair) { return json_text(pair.first) + ": " + std::to_string(pair.second); };
  return "{\n  \"attributes\": {" + lines(summary.attributes, attribute) + "},\n  \"variables\": [" +
         lines(summary.variables, entry_json) + "],\n  \"status\": {" + lines(summary.status_counts, count) + "}\n}\n";
}

}  // namespace clatter::app
