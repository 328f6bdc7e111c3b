#include "tables/file_points.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "config/suggestion.hpp"
#include "scene/parameter.hpp"
#include "storage/error.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"

namespace clatter::app {
namespace {

constexpr double same = 1e-9;  ///< of the length of an axis: values that count as equal

}  // namespace

using Entry = results::FileSummary::Entry;

const Entry* find_variable(const results::FileSummary& summary, std::string_view name) {
  const auto found = std::ranges::find(summary.variables, name, &Entry::name);
  return found == summary.variables.end() ? nullptr : &*found;
}

const results::Variable& variable_of(const results::Dataset& dataset, std::string_view name) {
  return *std::ranges::find(dataset.variables, name, &results::Variable::name);
}

bool are_same(const results::NamedLength& one, const results::NamedLength& other) {
  return one.name == other.name && one.length == other.length;
}

bool holds_branches(const results::FileSummary& summary) { return find_variable(summary, "arclength") != nullptr; }

bool holds_accuracy(const results::FileSummary& summary) { return find_variable(summary, "ns_per_period") != nullptr; }

std::vector<results::NamedLength> dimensions_of_points(const results::FileSummary& summary, const std::string& path) {
  for (const auto& [name, value] : summary.attributes)
    if (name == "shard")
      throw storage::IoError(storage::quoted_name(path) + " is shard " + storage::excerpt(value) +
                             " of a sweep; join all with `clatter merge` first");
  const Entry* const of_points = find_variable(summary, holds_branches(summary) ? "arclength" : "status");
  if (of_points == nullptr) storage::refuse_reading(path, "has no status", "name a whole output of clatter");
  return of_points->dimensions;
}

std::vector<std::string> coordinates_along(const results::FileSummary& summary, const results::NamedLength& dimension) {
  std::vector<std::string> names;
  for (const Entry& entry : summary.variables) {
    if (entry.dimensions.size() != 1 || !are_same(entry.dimensions[0], dimension)) continue;
    std::string_view own = entry.name;
    if (dimension.name == special_points && own.starts_with(special_prefix)) own.remove_prefix(special_prefix.size());
    const bool is_branch = dimension.name == branch_points && own == "branch";
    if (own == dimension.name || is_branch || Parameter::of(own)) names.push_back(entry.name);
  }
  return names;
}

bool is_own_coordinate(const Entry& entry) {
  return entry.dimensions.size() == 1 && entry.dimensions[0].name == entry.name;
}

bool is_of_motions(const Entry& entry) {
  return entry.dimensions.size() == 1 && entry.dimensions[0].name == ended_motions && !is_own_coordinate(entry);
}

ComponentName::ComponentName(const std::string& name) : variable(name) {
  const std::size_t at = name.find('[');
  if (at == std::string::npos || !name.ends_with(']')) return;
  variable.resize(at), component = name.substr(at + 1, name.size() - at - 2);
}

std::string component_name(const results::Dataset& dataset, const std::string& dimension, std::size_t part) {
  const auto coordinate = std::ranges::find(dataset.variables, dimension, &results::Variable::name);
  std::string text;
  const auto size_of = [](const auto& values) { return values.size(); };
  if (coordinate == dataset.variables.end() || part >= std::visit(size_of, coordinate->values))
    return std::to_string(part);
  append_value(text, coordinate->values, part, {});
  return text;
}

std::string component_names(const results::Dataset& dataset, const std::string& result,
                            const results::NamedLength& along) {
  constexpr std::size_t most = 4;
  const auto name = [&](std::size_t part) { return result + '[' + component_name(dataset, along.name, part) + ']'; };
  if (along.length == 0) return "none";
  std::string text;
  for (std::size_t part = 0; part < std::min(along.length, most); ++part) text += (part == 0 ? "" : ", ") + name(part);
  return along.length <= most ? text : text + ", ... " + name(along.length - 1);
}

std::size_t points_of(const std::vector<results::NamedLength>& rows) {
  std::size_t points = 1;
  for (const results::NamedLength& dimension : rows) points *= dimension.length;
  return points;
}

void advance(std::vector<std::size_t>& at, const std::vector<results::NamedLength>& rows) {
  for (std::size_t d = rows.size(); d-- > 0;) {
    if (++at[d] < rows[d].length) return;
    at[d] = 0;
  }
}

std::vector<double> numbers_in(const results::ValueArray& values) {
  std::vector<double> numbers;
  std::visit(
      [&]<class T>(const std::vector<T>& of_type) {
        if constexpr (std::is_arithmetic_v<T>)
          for (const T value : of_type) numbers.push_back(static_cast<double>(value));
      },
      values);
  return numbers;
}

double number_at(const results::ValueArray& values, std::size_t index) {
  return std::visit(
      [&]<class T>(const std::vector<T>& of_type) {
        if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(of_type[index]);
        return std::nan("");
      },
      values);
}

double same_on_axis(const std::vector<double>& values, double wanted) {
  const double extent = values.empty() ? 0.0 : std::ranges::max(values) - std::ranges::min(values);
  const double length = std::isfinite(extent) ? std::max(extent, std::abs(wanted)) : std::abs(wanted);
  return std::isfinite(length) ? same * length : 0.0;
}

void refuse_value(const std::string& axis, double wanted, std::vector<double> values) {
  std::string asked, near;
  append_number(asked, wanted);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::ranges::stable_sort(values, {}, [&](double value) { return std::abs(value - wanted); });
  for (std::size_t i = 0; i < std::min<std::size_t>(2, values.size()); ++i)
    append_number(near += i == 0 ? "" : " and ", values[i]);
  throw ChoiceError("--where " + axis + '=' + asked + ": the axis has no such value; " +
                    (values.size() > 1 ? "the nearest are " : "it has only ") + near);
}

}  // namespace clatter::app
