#include "accuracy_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "accuracy/accuracy_dataset.hpp"
#include "accuracy_answer.hpp"
#include "coordinates.hpp"
#include "format.hpp"

namespace clatter::app {
namespace {

struct ColumnTitle {
  const char *top, *bottom;
  std::size_t width;
};

constexpr ColumnTitle titles[] = {
    {"", "arch", 8},          {"", "setting", 9},          {"error of", "time", 10},      {"error of", "speed", 10},
    {"error of", "rest", 10}, {"error of", "extrema", 10}, {"error of", "harmonics", 11}, {"harmonics", "of v", 11},
    {"impacts", "missed", 9}, {"impacts", "doubled", 9},   {"rests", "missed", 8},        {"impacts", "taken", 9},
    {"periods", "run", 9},    {"ns per", "period", 10},    {"its", "spread", 10}};

std::string status_name(steady::Status status) {
  return std::string(
      std::ranges::find(steady::status_names, status, &std::pair<steady::Status, std::string_view>::first)->second);
}

std::string right(std::string text, std::size_t width) {
  text.insert(0, width > text.size() ? width - text.size() : 0, ' ');
  return text;
}
std::string left(std::string_view text) {
  constexpr std::size_t width = 17;
  return std::string(text) + std::string(width - std::min(width, text.size()), ' ');
}

std::string header() {
  std::string top = left(""), bottom = left("method");
  for (const ColumnTitle& title : titles)
    top += right(title.top, title.width), bottom += right(title.bottom, title.width);
  return top + '\n' + bottom + '\n';
}

/// Whether a row was meant for lanes but its scene couldn't go into them.
bool left_out(const accuracy::WorkPrecision& row, const accuracy::PointAccuracy& of_point) {
  const bool run = row.trial.method >= accuracy::TestedMethod::steady || of_point.horizon > 0;
  return row.trial.arch != lanes::InstructionSet::scalar && run && std::isnan(row.simulated_periods);
}

/// Why a row can't be compared; empty if it can.
std::string remark(const accuracy::WorkPrecision& row, const accuracy::PointAccuracy& of_point) {
  const bool steady = row.trial.method >= accuracy::TestedMethod::steady;
  if (failed(row.status) || (steady && lacks_period(row.status))) return "  " + status_name(row.status);
  return steady && of_point.steady_periods > 0 && row.observed_periods != of_point.steady_periods
             ? "  period " + formatted("%.6g", row.observed_periods)
             : "";
}

std::string row_text(const accuracy::WorkPrecision& row, const accuracy::PointAccuracy& of_point) {
  std::size_t column = 0;
  std::string text = left(accuracy::method_names[static_cast<std::size_t>(row.trial.method)]);
  const auto put = [&](const char* format, double value) {
    text += right(std::isnan(value) ? "-" : formatted(format, value), titles[column++].width);
  };
  text += right(std::string(name_of(row.trial.arch)), titles[column++].width);
  if (left_out(row, of_point)) return text + "  not in lanes: this motion is left to the scalar loop\n";
  put(row.trial.method == accuracy::TestedMethod::harmonics_fft ? "%.0f" : "%.0e", row.trial.setting);
  for (const double error :
       {row.contact_time, row.contact_speed, row.rest, row.extrema, row.harmonics, row.v_harmonics})
    put("%.1e", error);
  for (const double count : {row.missed, row.extra, row.rests_missed}) put("%.0f", count);
  put("%.0f", row.impacts), put("%.6g", row.simulated_periods), put("%.0f", row.ns_per_period),
      put("%.0f", row.ns_spread);
  return text + remark(row, of_point) + '\n';
}

/// Says which motion harmonics and repeats are of.
std::string steady_text(const accuracy::PointAccuracy& of_point) {
  if (of_point.steady_periods > 0)
    return "Harmonics and repeats are those of the steady motion, " +
           counted(of_point.steady_periods, "forcing period") + " long, in 50 digits.\n";
  return "Harmonics are those of the time compared; there is no steady forced motion to compare repeats with.\n";
}

/// "forcing period", or without a force the time that counts as one, in the user's units: "turn of 2 pi".
std::string period_text(const point::Problem& problem, bool many) {
  const std::string plural = many ? "s" : "";
  if (problem.oscillator.forcing != 0) return " forcing period" + plural;
  const double frequency = counting_frequency(problem.oscillator) / problem.units.time;
  const std::string length = frequency == 1 ? "2 pi" : formatted("%.6g", 2 * pi<double>() / frequency);
  return " turn" + plural + " of " + length + (problem.units.is_si ? " s" : "");
}

}  // namespace

std::string comparison_text(const accuracy::PointAccuracy& of_point, const point::Problem& problem) {
  const std::string events = counted(of_point.impacts, "impact") + " and " + counted(of_point.rests, "rest");
  const std::string asked = formatted("%.6g", of_point.asked) + period_text(problem, of_point.asked != 1);
  const steady::Status status = of_point.rows.front().status;
  if (failed(status)) return "not compared, since the run fails: " + status_name(status) + '.';
  if (of_point.horizon == of_point.asked)
    return "compared with 50 digits over " + asked + " from the start: " + events + '.';
  if (of_point.horizon > 0)
    return "compared with 50 digits over " + formatted("%.6g", of_point.horizon) + " of " + asked +
           " from the start: " + events + "; from there on double and 50 digits differ, as chaotic motion lets them.";
  return "not compared: double and 50 digits differ within the first of " + asked + '.';
}

std::string accuracy_text(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep, std::size_t point) {
  std::string text = accuracy_answer(of_point, sweep, point) + steady_text(of_point) + header();
  for (const accuracy::WorkPrecision& row : of_point.rows) text += row_text(row, of_point);
  return text + '\n';
}

std::string accuracy_json(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep, std::size_t point) {
  std::ostringstream out;
  for (const accuracy::WorkPrecision& row : of_point.rows) {
    const auto put = [&](const std::string& name, double value) {
      out << ", \"" << name << "\": " << json_number(value);
    };
    out << "{\"method\": "
        << json_text(std::string(accuracy::method_names[static_cast<std::size_t>(row.trial.method)]));
    put("setting", row.trial.setting);
    out << ", \"arch\": " << json_text(std::string(name_of(row.trial.arch)));
    for (const auto& [name, long_name, value] : accuracy::row_variables()) put(name, row.*value);
    out << ", \"status\": " << static_cast<int>(row.status) << ", \"point\": " << point;
    each_coordinate(sweep, point,
                    [&](const sweep::Axis& axis, double value) { put(std::string(axis.parameter.key()), value); });
    for (const auto& [name, long_name, value] : accuracy::point_variables()) put(name, of_point.*value);
    out << "}\n";
  }
  return out.str();
}

}  // namespace clatter::app
