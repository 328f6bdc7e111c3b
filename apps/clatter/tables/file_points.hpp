#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {

// How a file lays out its points, read from its variables alone.

/// A choice that a file doesn't offer; `what()` is one line that ends with how to fix it.
class ChoiceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The dimensions of points and special points in files of branches, and what the names of the latter's variables
/// begin with; likewise a log of impacts, and the motions that starts end in; the dimension of a trajectory.
inline constexpr std::string_view branch_points = "point", special_points = "special", special_prefix = "special_",
                                  logged_impacts = "impact", impact_prefix = "impact_", ended_motions = "motion",
                                  motion_prefix = "motion_", trajectory_samples = "sample";

/// The variable of that name; nullptr: the file has none.
[[nodiscard]] const results::FileSummary::Entry* find_variable(const results::FileSummary& summary,
                                                               std::string_view name);

[[nodiscard]] const results::Variable& variable_of(const results::Dataset& dataset, std::string_view name);

[[nodiscard]] bool are_same(const results::NamedLength& one, const results::NamedLength& other);

/// Whether `clatter branch` wrote the file, whose points belong to branches, not to a sweep.
[[nodiscard]] bool holds_branches(const results::FileSummary& summary);

/// Whether `clatter accuracy` wrote the file, which has rows of methods at each point.
[[nodiscard]] bool holds_accuracy(const results::FileSummary& summary);

/// The dimensions of the file's points: those of `status`, of branches `point`. Throws IoError for a shard, and for a
/// file without points.
[[nodiscard]] std::vector<results::NamedLength> dimensions_of_points(const results::FileSummary& summary,
                                                                     const std::string& path);

/// The variables that say where the points along a dimension lie: the axis that names it, those linked to it, a
/// direction; of branches the number of the branch and the parameters.
[[nodiscard]] std::vector<std::string> coordinates_along(const results::FileSummary& summary,
                                                         const results::NamedLength& dimension);

/// Whether a variable only numbers a dimension, as `stop` does.
[[nodiscard]] bool is_own_coordinate(const results::FileSummary::Entry& entry);

/// Whether a variable has a value for each motion that starts end in, whatever the parameters.
[[nodiscard]] bool is_of_motions(const results::FileSummary::Entry& entry);

/// The name of a result, and of which component: "v_before[-1]" is {"v_before", "-1"}.
struct ComponentName {
  std::string variable;
  std::optional<std::string> component;

  explicit ComponentName(const std::string& name);
};

/// The name of a component along a dimension: by its coordinate, else counted from 0.
[[nodiscard]] std::string component_name(const results::Dataset& dataset, const std::string& dimension,
                                         std::size_t part);

/// The components of a result, for a message: "v_before[-1], v_before[1]".
[[nodiscard]] std::string component_names(const results::Dataset& dataset, const std::string& result,
                                          const results::NamedLength& along);

/// The number of combinations of indexes.
[[nodiscard]] std::size_t points_of(const std::vector<results::NamedLength>& rows);

/// Advances indexes to the next point, the last dimension first.
void advance(std::vector<std::size_t>& at, const std::vector<results::NamedLength>& rows);

/// The values as double; none of texts.
[[nodiscard]] std::vector<double> numbers_in(const results::ValueArray& values);

/// One of a variable's values as a number; NaN of a text.
[[nodiscard]] double number_at(const results::ValueArray& values, std::size_t index);

/// How far a value of an axis may be from a wanted one to count as equal.
[[nodiscard]] double same_on_axis(const std::vector<double>& values, double wanted);

/// Throws ChoiceError: an axis has no such value; names the nearest.
[[noreturn]] void refuse_value(const std::string& axis, double wanted, std::vector<double> values);

}  // namespace clatter::app
