#include "answers/ranges_report.hpp"

#include <algorithm>

#include "storage/utf8.hpp"
#include "sweep/binomial_share.hpp"
#include "terminal/amounts.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

/// "nu = 0.5", or with both ends "0.5 ... 0.9".
std::string amount_text(const Whereabouts& at, const AskedUnits& asked) {
  return Amounts(at.units, std::vector<double>{at.value}, asked).text("%.12g", at.value);
}

std::string place_text(const std::vector<Whereabouts>& places, const AskedUnits& asked) {
  std::string text;
  for (const Whereabouts& at : places) text += (text.empty() ? "" : ", ") + at.name + " = " + amount_text(at, asked);
  return text;
}

/// "frequency = 15 Hz ... 21.25 Hz"; of axes that are linked all.
std::string extent_text(const std::vector<Whereabouts>& begin, const std::vector<Whereabouts>& end,
                        const AskedUnits& asked) {
  std::string text;
  for (std::size_t i = 0; i < begin.size(); ++i) {
    const Whereabouts &from = begin[i], &to = end[i];
    const std::vector<double> both{from.value, to.value};
    const Amounts amounts(from.units, both, asked);
    text += (i == 0 ? "" : ", ") + from.name + " = " + amounts.text("%.12g", from.value);
    if (from.value != to.value) text += " ... " + amounts.text("%.12g", to.value);
  }
  return text;
}

/// "  LU  frequency = 15 Hz ... 21.25 Hz, 26 points"
std::string range_text(const Range& range, const std::string& word, const AskedUnits& asked) {
  const std::string extent = extent_text(range.from, range.to, asked);
  return word + extent + (extent.empty() ? "" : ", ") + counted(static_cast<double>(range.points), "point") + '\n';
}

std::string met_text(const Ranges& ranges, const Met& met) {
  std::string text;
  for (const Condition& condition : ranges.choice().where)
    text += (text.empty() ? "" : " and ") + storage::printable(text_of(condition));
  text += ": " + std::to_string(met.points) + " of " + counted(static_cast<double>(met.of), "point");
  if (met.of > 0) {
    const sweep::BinomialShare share = sweep::binomial_share(met.points, met.of);
    text += ", " + formatted("%.4g", 100 * share.share) + " %";
    if (ranges.is_sample())
      text += " (95 %: " + formatted("%.4g", 100 * share.low) + " ... " + formatted("%.4g", 100 * share.high) + " %)";
  }
  if (met.without_value > 0) text += ", " + std::to_string(met.without_value) + " without a value";
  if (met.failed > 0) text += ", and " + std::to_string(met.failed) + " failed";
  if (!met.there.empty()) text += "; " + storage::printable(met.there);
  return text + '\n';
}

}  // namespace

std::string ranges_text(const Ranges& ranges, const std::vector<RangeLine>& lines, const std::optional<Met>& met,
                        const AskedUnits& asked) {
  std::string text = met ? met_text(ranges, *met) : "";
  if (const auto* const result = ranges.result())
    text += storage::printable(ranges.choice().result + ", " + result->meaning()) + '\n';
  std::size_t width = 0;
  for (const RangeLine& line : lines)
    for (const Range& range : line.ranges) width = std::max(width, range.word.size());
  for (const RangeLine& line : lines) {
    if (line.ranges.empty()) continue;
    if (!line.at.empty()) text += "at " + place_text(line.at, asked) + '\n';
    for (std::size_t i = 0; i < line.ranges.size(); ++i) {
      const auto begin = [&](std::string word) {
        word.resize(width, ' ');
        return "  " + (ranges.result() != nullptr ? word + "  " : "");
      };
      text += range_text(line.ranges[i], begin(line.ranges[i].word), asked);
      for (const Gap& gap : line.gaps)
        if (gap.after == i) text += begin("") + extent_text(gap.from, gap.to, asked) + ", " + gap.why + '\n';
    }
  }
  return text;
}

}  // namespace clatter::app
