#include "study/study_figure.hpp"

#include <string>

#include "sweep/columns.hpp"

namespace clatter {
namespace {

constexpr RowVariable all_row_variables[] = {
    {"error_contact_time", "largest error of an impact's time, in forcing periods", &Row::contact_time},
    {"error_contact_speed", "largest error of an impact's speed, over the largest speed", &Row::contact_speed},
    {"error_extrema", "error of minima and maxima, over the largest displacement and velocity", &Row::extrema},
    {"error_harmonics", "error of the harmonics 1 to 3 of displacement, over the largest", &Row::harmonics},
    {"error_harmonics_v", "error of the harmonics 1 to 3 of velocity, over the largest", &Row::v_harmonics},
    {"error_rest", "largest error of a rest's beginning or end, in forcing periods", &Row::rest},
    {"missed", "impacts of the reference that are missed", &Row::missed},
    {"doubled", "impacts that the reference doesn't have", &Row::doubled},
    {"rests_missed", "rests of the reference that are missed", &Row::rests_missed},
    {"impacts", "impacts simulated", &Row::impacts},
    {"simulated_periods", "forcing periods simulated", &Row::simulated_periods},
    {"observed_periods", "forcing periods observed, of periodic motion its period", &Row::observed_periods},
    {"evaluations", "evaluations of arcs; of the equation by general methods", &Row::evaluations},
    {"ns_per_period", "median wall time of a forcing period on one thread, in nanoseconds", &Row::ns_per_period},
    {"ns_spread", "interquartile range of ns_per_period", &Row::ns_spread},
};

constexpr PointVariable all_point_variables[] = {
    {"asked", "forcing periods to be compared: the duration of a transient, else the window", &PointStudy::asked},
    {"horizon", "forcing periods compared, as long as double and 50 digits agree", &PointStudy::horizon},
    {"reference_impacts", "impacts within the horizon", &PointStudy::impacts},
    {"reference_rests", "rests within the horizon", &PointStudy::rests},
    {"steady_periods", "period of the steady motion, in forcing periods", &PointStudy::steady_periods},
};

void add_trials(Figure& figure, const std::vector<Row>& rows) {
  std::vector<std::uint8_t> method, flags;
  std::vector<double> setting;
  for (const Row& row : rows)
    method.push_back(static_cast<std::uint8_t>(row.trial.studied)), setting.push_back(row.trial.setting);
  std::string meanings;
  for (const std::string_view name : studied_names) {
    flags.push_back(static_cast<std::uint8_t>(flags.size()));
    if (!meanings.empty()) meanings += ' ';
    meanings += name;
  }
  figure.dimensions.push_back({"row", rows.size()});
  figure.variables.push_back({"method", {"row"}, std::move(method), "what is varied", "1"});
  figure.variables.back().attributes = {{"flag_values", flags}, {"flag_meanings", meanings}};
  figure.variables.push_back(
      {"setting", {"row"}, std::move(setting), "tolerance, step in forcing periods, or samples", "1"});
}

}  // namespace

std::span<const RowVariable> row_variables() { return all_row_variables; }
std::span<const PointVariable> point_variables() { return all_point_variables; }

Figure study_figure(const Sweep& sweep, const std::vector<PointStudy>& points) {
  Figure figure;
  add_axes(sweep, figure);
  add_trials(figure, points.front().rows);
  const std::vector<std::string> axes = axis_names(sweep);
  std::vector<std::string> over_rows = axes;
  over_rows.emplace_back("row");
  std::vector<std::uint8_t> status;
  for (const PointStudy& point : points)
    for (const Row& row : point.rows) status.push_back(static_cast<std::uint8_t>(row.status));
  figure.variables.push_back({"status", over_rows, std::move(status), "what became of the run", "1"});
  figure.variables.back().attributes = status_flags();
  for (const auto& [name, long_name, value] : all_point_variables) {
    std::vector<double> values;
    for (const PointStudy& point : points) values.push_back(point.*value);
    figure.variables.push_back({name, axes, std::move(values), long_name, "1"});
  }
  for (const auto& [name, long_name, value] : all_row_variables) {
    std::vector<double> values;
    for (const PointStudy& point : points)
      for (const Row& row : point.rows) values.push_back(row.*value);
    figure.variables.push_back({name, over_rows, std::move(values), long_name, "1"});
  }
  return figure;
}

}  // namespace clatter
