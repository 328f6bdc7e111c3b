#include "tables/point_rows.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

using results::Variable;

std::size_t size_of(const results::ValueArray& values) {
  return std::visit([](const auto& of_type) { return of_type.size(); }, values);
}

bool is_over(const Variable& variable, std::string_view dimension) {
  return variable.dimensions.size() == 1 && variable.dimensions[0] == dimension;
}

/// The values of some points alone.
results::ValueArray values_of(const PointRows& rows, const Variable& variable, const std::vector<std::size_t>& points) {
  return std::visit(
      [&]<class T>(const std::vector<T>& values) -> results::ValueArray {
        std::vector<T> kept;
        for (const std::size_t point : points) {
          const auto [first, count] = rows.row(variable, point);
          const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
          kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        }
        return kept;
      },
      variable.values);
}

}  // namespace

PointRows::PointRows(results::Dataset dataset, std::vector<std::string> dimensions, std::size_t points)
    : dataset_(std::move(dataset)), dimensions_(std::move(dimensions)), points_(points) {
  const auto* const counts = results::values_of<std::int64_t>(dataset_, "impact_count");
  if (counts == nullptr) return;
  logged_.push_back(0);
  for (const std::int64_t count : *counts)
    logged_.push_back(logged_.back() + static_cast<std::size_t>(std::max<std::int64_t>(count, 0)));
}

PointRows PointRows::chosen(const std::vector<std::vector<std::string>>& groups, std::vector<std::string> dimensions,
                            std::size_t points, const std::vector<std::size_t>& chosen,
                            const std::function<results::Dataset(const std::vector<std::string>&)>& read) {
  std::vector<std::string> lengths;  // without which no row is found
  for (const char* const name : {"impact_count", "attractor"})
    for (const std::vector<std::string>& names : groups)
      if (std::ranges::find(names, name) != names.end()) lengths.emplace_back(name);
  const PointRows all(lengths.empty() ? results::Dataset{} : read(lengths), dimensions, points);
  results::Dataset dataset;
  for (const std::vector<std::string>& names : groups) {
    results::Dataset group = read(names);
    for (Variable& variable : group.variables) {
      if (!all.has_rows(variable)) continue;
      if (!is_over(variable, ended_motions)) variable.values = values_of(all, variable, chosen);
      dataset.variables.push_back(std::move(variable));
    }
  }
  return {std::move(dataset), std::move(dimensions), chosen.size()};
}

const Variable* PointRows::find(std::string_view name) const {
  const auto found = std::ranges::find(dataset_.variables, name, &Variable::name);
  return found != dataset_.variables.end() ? &*found : nullptr;
}

bool PointRows::has_rows(const Variable& variable) const {
  if (is_over(variable, variable.name)) return false;  // a coordinate
  if (is_over(variable, logged_impacts) || is_over(variable, ended_motions)) return true;
  const std::vector<std::string>& along = variable.dimensions;
  return along.size() >= dimensions_.size() && std::equal(dimensions_.begin(), dimensions_.end(), along.begin());
}

PointRows::Row PointRows::row(const Variable& variable, std::size_t point) const {
  const std::size_t size = size_of(variable.values);
  Row row{point * (size / points_), size / points_};
  if (is_over(variable, logged_impacts))
    row = point + 1 < logged_.size() ? Row{logged_[point], logged_[point + 1] - logged_[point]} : Row{};
  if (is_over(variable, ended_motions)) {
    const auto* const numbers = results::values_of<std::int32_t>(dataset_, "attractor");
    const bool ends_in_one = numbers != nullptr && point < numbers->size() && (*numbers)[point] >= 0;
    row = ends_in_one ? Row{static_cast<std::size_t>((*numbers)[point]), 1} : Row{};
  }
  return row.first <= size && row.count <= size - row.first ? row : Row{};
}

}  // namespace clatter::app
