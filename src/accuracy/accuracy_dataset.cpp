#include "accuracy/accuracy_dataset.hpp"

#include <string>

#include "sweep/dataset_axes.hpp"
#include "sweep/result_store.hpp"

namespace clatter::accuracy {
namespace {

constexpr RowVariable all_row_variables[] = {
    {"error_contact_time", "largest error of an impact's time, in forcing periods", &WorkPrecision::contact_time},
    {"error_contact_speed", "largest error of an impact's speed, over the largest speed",
     &WorkPrecision::contact_speed},
    {"error_extrema", "error of minima and maxima, over the largest displacement and velocity",
     &WorkPrecision::extrema},
    {"error_harmonics", "error of the harmonics 1 to 3 of displacement, over the largest", &WorkPrecision::harmonics},
    {"error_harmonics_v", "error of the harmonics 1 to 3 of velocity, over the largest", &WorkPrecision::v_harmonics},
    {"error_rest", "largest error of a rest's beginning or end, in forcing periods", &WorkPrecision::rest},
    {"missed", "impacts of the reference that are missed", &WorkPrecision::missed},
    {"doubled", "impacts that the reference doesn't have", &WorkPrecision::extra},
    {"rests_missed", "rests of the reference that are missed", &WorkPrecision::rests_missed},
    {"impacts", "impacts simulated", &WorkPrecision::impacts},
    {"simulated_periods", "forcing periods simulated", &WorkPrecision::simulated_periods},
    {"observed_periods", "forcing periods observed; for periodic motion its period", &WorkPrecision::observed_periods},
    {"evaluations", "evaluations of arcs in the scalar loop; of the equation of motion by general methods",
     &WorkPrecision::evaluations},
    {"ns_per_period", "median wall time of a forcing period on one thread, in nanoseconds",
     &WorkPrecision::ns_per_period},
    {"ns_spread", "interquartile range of ns_per_period", &WorkPrecision::ns_spread},
};

constexpr PointVariable all_point_variables[] = {
    {"asked", "forcing periods to be compared: the duration of a transient, else the window", &PointAccuracy::asked},
    {"horizon", "forcing periods compared, as long as double and 50 digits agree", &PointAccuracy::horizon},
    {"reference_impacts", "impacts within the horizon", &PointAccuracy::impacts},
    {"reference_rests", "rests within the horizon", &PointAccuracy::rests},
    {"steady_periods", "period of the steady motion, in forcing periods", &PointAccuracy::steady_periods},
};

constexpr const char* missing_if = "it doesn't apply to the method or the motion, or there is nothing to compare";

/// Attributes with the meanings of the values 0, 1, ... of a variable.
std::vector<results::Attribute> flags_of(std::span<const std::string_view> names) {
  std::vector<std::pair<std::uint8_t, std::string_view>> meanings;
  for (const std::string_view name : names) meanings.emplace_back(static_cast<std::uint8_t>(meanings.size()), name);
  return sweep::flag_attributes(meanings);
}

void add_trials(results::Dataset& dataset, const std::vector<WorkPrecision>& rows) {
  std::vector<std::uint8_t> method, arch;
  std::vector<double> setting;
  for (const WorkPrecision& row : rows) {
    method.push_back(static_cast<std::uint8_t>(row.trial.method)), setting.push_back(row.trial.setting);
    arch.push_back(static_cast<std::uint8_t>(row.trial.arch));
  }
  dataset.dimensions.push_back({"row", rows.size()});
  dataset.variables.push_back({"method", {"row"}, std::move(method), "tested method", "1"});
  dataset.variables.back().attributes = flags_of(method_names);
  dataset.variables.push_back(
      {"setting", {"row"}, std::move(setting), "tolerance, step in forcing periods, or samples", "1"});
  dataset.variables.push_back({"arch", {"row"}, std::move(arch), "instruction set whose lanes run; scalar: none", "1"});
  dataset.variables.back().attributes = flags_of(lanes::instruction_set_names);
}

}  // namespace

std::span<const RowVariable> row_variables() { return all_row_variables; }
std::span<const PointVariable> point_variables() { return all_point_variables; }

results::Dataset accuracy_dataset(const sweep::Sweep& sweep, const std::vector<PointAccuracy>& points) {
  results::Dataset dataset;
  add_axes(sweep, dataset);
  collect(dataset);
  add_trials(dataset, points.front().rows);
  const std::vector<std::string> axes = axis_names(sweep);
  std::vector<std::string> over_rows = axes;
  over_rows.emplace_back("row");
  std::vector<std::uint8_t> status;
  for (const PointAccuracy& point : points)
    for (const WorkPrecision& row : point.rows) status.push_back(static_cast<std::uint8_t>(row.status));
  dataset.variables.push_back({"status", over_rows, std::move(status), "status of the run", "1"});
  dataset.variables.back().attributes = sweep::status_flags();
  for (const auto& [name, long_name, value] : all_point_variables) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const PointAccuracy& point : points) values.push_back(point.*value);
    dataset.variables.push_back({name, axes, std::move(values), long_name, "1"});
    dataset.variables.back().missing_if = missing_if;
  }
  for (const auto& [name, long_name, value] : all_row_variables) {
    std::vector<double> values;
    for (const PointAccuracy& point : points)
      for (const WorkPrecision& row : point.rows) values.push_back(row.*value);
    dataset.variables.push_back({name, over_rows, std::move(values), long_name, "1"});
    dataset.variables.back().missing_if = missing_if;
  }
  sweep::add_drawn_names(sweep.problem.is_si, dataset, has_loose_mass(sweep), false);
  name_linked_axes(sweep, dataset);
  return dataset;
}

}  // namespace clatter::accuracy
