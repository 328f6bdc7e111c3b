#include "tables/motion_rows.hpp"

#include <algorithm>
#include <cstdint>

#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

bool is_over_motions(const results::FileSummary::Entry& entry) {
  return !entry.dimensions.empty() && entry.dimensions.back().name == ended_motions && !is_own_coordinate(entry);
}

}  // namespace

std::vector<std::string> motion_variables(const results::FileSummary& summary, const std::string& path) {
  std::vector<std::string> names;
  for (const results::FileSummary::Entry& entry : summary.variables)
    if (is_over_motions(entry)) names.push_back(entry.name);
  const bool is_numbered = find_variable(summary, "attractor") != nullptr && !names.empty();
  if (!is_numbered)
    throw ChoiceError("--motions: " + storage::quoted_name(path) +
                      " has no motions of its starts; run its configuration with --set observe.attractor=true");
  return names;
}

MotionRows::MotionRows(const results::FileSummary& summary, const std::string& path, const results::Dataset& dataset) {
  const auto refuse = [&] {
    storage::refuse_reading(path, "is damaged: 'attractor' is none of its points", "run its configuration again");
  };
  const std::vector<results::NamedLength> rows = dimensions_of_points(summary, path);
  const auto *const shares = find_variable(summary, "motion_share"), *const words =
                                                                         find_variable(summary, "motion_points");
  const auto* const numbers = results::values_of<std::int32_t>(dataset, "attractor");
  const bool is_sound = numbers != nullptr && numbers->size() == points_of(rows) && words != nullptr &&
                        words->dimensions.size() == 1 && words->dimensions[0].name == ended_motions;
  if (!is_sound) refuse();
  numbers_ = *numbers, motions_ = words->dimensions[0].length;
  std::vector<bool> is_parameter;
  for (const results::NamedLength& row : rows)
    is_parameter.push_back(shares != nullptr && std::ranges::any_of(shares->dimensions, [&](const auto& own) {
                             return are_same(own, row);
                           }));
  for (std::size_t d = 0; d < rows.size(); ++d) values_ *= is_parameter[d] ? rows[d].length : 1;
  if (shares != nullptr && points_of(shares->dimensions) != values_ * motions_) refuse();
  parameters_.resize(numbers_.size());
  std::vector<std::size_t> at(rows.size(), 0);
  for (std::size_t point = 0; point < numbers_.size(); ++point, advance(at, rows)) {
    if (numbers_[point] >= static_cast<std::int64_t>(motions_)) refuse();
    for (std::size_t d = 0; d < rows.size(); ++d)
      if (is_parameter[d]) parameters_[point] = parameters_[point] * rows[d].length + at[d];
  }
}

std::vector<std::size_t> MotionRows::motion_of_points() const {
  std::vector<std::size_t> motion(numbers_.size(), 0);
  for (std::size_t point = 0; point < motion.size(); ++point)
    if (has_motion(point)) motion[point] = static_cast<std::size_t>(numbers_[point]);
  return motion;
}

std::vector<std::size_t> MotionRows::share_of_points() const {
  std::vector<std::size_t> share = motion_of_points();
  for (std::size_t point = 0; point < share.size(); ++point) share[point] += parameters_[point] * motions_;
  return share;
}

void MotionRows::keep_first(std::vector<bool>& chosen) const {
  std::vector<bool> seen(values_ * motions_, false);
  const std::vector<std::size_t> share = share_of_points();
  for (std::size_t point = 0; point < chosen.size(); ++point) {
    chosen[point] = chosen[point] && has_motion(point) && !seen[share[point]];
    if (chosen[point]) seen[share[point]] = true;
  }
}

}  // namespace clatter::app
