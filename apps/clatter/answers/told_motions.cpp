#include "answers/told_motions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"
#include "terminal/amounts.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

constexpr std::size_t most_told = 20;

/// The largest speed of a point; NaN: the file has none.
double speed_at(const results::Dataset& dataset, std::size_t point, std::size_t points) {
  const auto* const speeds = results::values_of<double>(dataset, "impact_speed");
  double speed = std::nan("");
  if (speeds == nullptr || point >= points) return speed;
  const std::size_t width = speeds->size() / points;
  for (std::size_t part = 0; part < width; ++part) speed = std::fmax(speed, (*speeds)[point * width + part]);
  return speed;
}

}  // namespace

ToldMotions motions_of(const results::FileSummary& summary, const std::string& path) {
  ToldMotions told;
  const auto* const of_motions = find_variable(summary, "motion_points");
  if (of_motions == nullptr || holds_branches(summary)) return told;
  told.points = points_of(dimensions_of_points(summary, path));
  std::vector<std::string> names{"motion_points", "motion_period_ratio", "motion_word", "motion_example"};
  if (const auto* const speed = find_variable(summary, "impact_speed"))
    names.push_back(speed->name), told.units_of_speed = speed->units;
  for (const std::string& name : names)
    if (find_variable(summary, name) == nullptr) return {};
  const results::Dataset dataset = results::read_variables(path, names);
  const auto *const points = results::values_of<std::int64_t>(dataset, "motion_points"),
                    *const ratios = results::values_of<std::int64_t>(dataset, "motion_period_ratio"),
                    *const examples = results::values_of<std::int64_t>(dataset, "motion_example");
  const auto* const words = results::values_of<std::string>(dataset, "motion_word");
  const bool is_sound = points != nullptr && ratios != nullptr && examples != nullptr && words != nullptr &&
                        points->size() == ratios->size() && points->size() == examples->size() &&
                        points->size() == words->size();
  if (!is_sound)
    storage::refuse_reading(path, "is damaged: its motions differ in number", "run its configuration again");
  for (std::size_t i = 0; i < points->size(); ++i)
    told.motions.push_back({(*words)[i], static_cast<double>((*ratios)[i]), static_cast<std::size_t>((*points)[i]),
                            speed_at(dataset, static_cast<std::size_t>((*examples)[i]), told.points)});
  return told;
}

std::string motions_text(const ToldMotions& told, const AskedUnits& asked) {
  if (told.motions.empty()) return {};
  std::string text = "\nMotions that the starts end in\n";
  std::size_t width = 0;
  for (const ToldMotion& motion : told.motions) width = std::max(width, std::min<std::size_t>(motion.word.size(), 40));
  std::vector<std::size_t> order(told.motions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return told.motions[i].points; });
  for (std::size_t i = 0; i < std::min(order.size(), most_told); ++i) {
    const auto& [word, period, points, speed] = told.motions[order[i]];
    std::string shown = storage::excerpt(word, 40);
    shown.resize(std::max(width, shown.size()), ' ');
    text += "  " + std::to_string(order[i]) + "  " + shown + "  " +
            (period > 0 ? "period " + formatted("%.0f", period) : "aperiodic") + "  " +
            formatted("%.4g", 100 * static_cast<double>(points) / static_cast<double>(told.points)) +
            " % of the points";
    if (!std::isnan(speed))
      text += "  " + Amounts(told.units_of_speed, std::vector<double>{speed}, asked).text("%.6g", speed);
    text += '\n';
  }
  if (order.size() > most_told)
    text += "  and " + counted(static_cast<double>(order.size() - most_told), "motion") +
            " more; `clatter export --motions` lists all\n";
  return text;
}

}  // namespace clatter::app
