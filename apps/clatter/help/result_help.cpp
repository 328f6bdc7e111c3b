#include "help/result_help.hpp"

#include <algorithm>

#include "config/wrapped.hpp"
#include "steady/status.hpp"
#include "tables/result_names.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

std::string missing(const CataloguedResult& result) {
  if (result.missing_if.empty()) return {};
  return (result.type == "string" ? "empty if " : "NaN if ") + result.missing_if;
}

/// "m/s of a [machine], else none"
std::string unit_of(const CataloguedResult& result) {
  if (result.units_in_si == "1") return "none";
  if (result.units == result.units_in_si) return unit_text(result.units);
  return unit_text(result.units_in_si) + " of a [machine], else none";
}

/// The name for options, if it is shorter than that in the file.
std::string typed_as(const CataloguedResult& result) {
  const std::string typed = typed_name(result.name, result.over);
  return typed == result.name ? "" : typed + ", in options of clatter";
}

std::string frame_of(const CataloguedResult& result) {
  if (result.frame.empty()) return {};
  return result.frame == "observed" ? "that of observe.frame, if stops or base are shaken"
                                    : "relative to what is shaken, if stops or base are";
}

/// A term and its explanation in two columns; nothing without an explanation.
std::string row(std::string term, const std::string& words, std::size_t column = 14) {
  if (words.empty()) return {};
  term = "  " + term;
  term.resize(std::max(column, term.size() + 2), ' ');
  return term + config::wrapped(words, column);
}

/// What follows "the point" of a status; of another flag nothing.
std::string meaning_of(const CataloguedResult& result, std::uint8_t value) {
  if (result.name != "status") return {};
  const auto* const named =
      std::ranges::find(steady::status_names, static_cast<steady::Status>(value), &steady::StatusName::status);
  return named == steady::status_names.end() ? "" : "the point " + std::string(named->meaning);
}

std::string values_of(const CataloguedResult& result) {
  std::string text;
  for (const auto& [value, word] : result.flags) {
    const std::string term = std::to_string(value) + ' ' + word, meaning = meaning_of(result, value);
    text += meaning.empty() ? "  " + term + '\n' : row(term, meaning, 19);
  }
  return text.empty() ? "" : "Values\n" + text;
}

}  // namespace

std::string result_note(const CataloguedResult& result) {
  std::string text = missing(result);
  if (!result.observable.empty()) (text += text.empty() ? "" : "; ") += "asked for by observe." + result.observable;
  return text;
}

std::string result_reference(const CataloguedResult& result) {
  const bool differs = result.meaning != result.meaning_in_si;
  return result.name + " in files of `clatter " + std::string(result.command) + "`\n  " +
         config::wrapped(result.meaning + (differs ? "; of a [machine]: " + result.meaning_in_si : ""), 2) +
         row("type", result.type) + row("over", result.over) + row("unit", unit_of(result)) +
         row("typed as", typed_as(result)) + row("frame", frame_of(result)) + row("missing", missing(result)) +
         row("asked for by", result.observable.empty() ? "" : "observe." + result.observable, 16) + values_of(result);
}

std::string list_of_results() {
  std::string text;
  std::string_view command;
  for (const CataloguedResult& result : result_catalogue()) {
    if (result.command != command)
      text += (text.empty() ? "" : "\n") + ("Files of `clatter " + std::string(command = result.command)) + "`\n";
    text += row(result.name, result.meaning, 24);
  }
  return text + "\n`clatter help NAME` says more of one of them.\n";
}

}  // namespace clatter::app
