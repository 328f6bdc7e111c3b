#include "answers/extremes_report.hpp"

#include <algorithm>

#include "storage/utf8.hpp"
#include "terminal/amounts.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

/// The values of one of the numbers that every point has.
std::vector<double> values_of(const std::vector<Extreme>& points, const auto& value_of) {
  std::vector<double> values;
  for (const Extreme& point : points) values.push_back(value_of(point));
  return values;
}

/// ", stop = 1", after " at" or a comma.
void append(std::string& line, const std::string& words, bool is_first) { line += (is_first ? " at " : ", ") + words; }

std::string line_of(const Extreme& point, const Extremes& extremes, const std::vector<Extreme>& points,
                    const AskedUnits& asked) {
  const Amounts amounts(extremes.result().units, values_of(points, [](const Extreme& other) { return other.value; }),
                        asked);
  std::string line = "  " + amounts.text("%.6g", point.value);
  bool is_first = true;
  for (std::size_t i = 0; i < point.axes.size(); ++i) {
    const auto& [name, value, units] = point.axes[i];
    const Amounts of_axis(units, values_of(points, [i](const Extreme& other) { return other.axes[i].value; }), asked);
    append(line, name + " = " + of_axis.text("%.10g", value), std::exchange(is_first, false));
  }
  for (const auto& [name, value, units] : point.component)
    append(line, name + " = " + formatted("%.10g", value), std::exchange(is_first, false));
  for (const auto& [name, word] : point.words) append(line, word, false);
  return line + '\n';
}

}  // namespace

std::string extremes_text(const Extremes& extremes, const std::vector<Extreme>& points, const AskedUnits& asked) {
  const results::FileSummary::Entry& result = extremes.result();
  const std::string meaning = result.name + ", " + storage::printable(result.meaning());
  if (points.empty()) return "no point has a value of " + meaning + '\n';
  const std::string each = extremes.for_axis().empty() ? "" : ", for each " + extremes.for_axis();
  std::string text = std::string(extremes.is_largest() ? "largest " : "smallest ") + meaning + each + '\n';
  for (const Extreme& point : points) text += line_of(point, extremes, points, asked);
  return text;
}

}  // namespace clatter::app
