#include "runs/accuracy_report.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "accuracy/accuracy_dataset.hpp"
#include "accuracy/cheapest.hpp"
#include "config/wrapped.hpp"
#include "terminal/format.hpp"

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
  return std::string(std::ranges::find(steady::status_names, status, &steady::StatusName::status)->name);
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
  if (is_driven(problem.oscillator)) return " forcing period" + plural;
  const double frequency = counting_frequency(problem.oscillator) / problem.units.time;
  const std::string length = frequency == 1 ? "2 pi" : formatted("%.6g", 2 * pi<double>() / frequency);
  return " turn" + plural + " of " + length + (problem.units.is_si ? " s" : "");
}

using accuracy::TestedMethod;
using accuracy::WorkPrecision;
using Rows = std::span<const WorkPrecision>;

/// A method of the table: exact, exact in lanes, or a general one with its settings.
struct Family {
  TestedMethod method;
  bool in_lanes;
  std::string_view title;    ///< of its columns
  std::string_view name;     ///< in a sentence
  std::string_view column;   ///< title of its settings; empty: it has none
  std::string_view setting;  ///< in a sentence, before the number
  std::string_view unit;     ///< after it
};
constexpr Family families[] = {{TestedMethod::exact, false, "exact", "exact", "", "", ""},
                               {TestedMethod::exact, true, "in lanes", "exact in lanes", "", "", ""},
                               {TestedMethod::dopri5, false, "dopri5", "Dormand-Prince", "tol", "tolerances", ""},
                               {TestedMethod::moreau, false, "moreau", "Moreau", "step", "steps", " of a period"}};
constexpr double levels[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
constexpr double usual_level = 1e-6;  ///< at which the sentence compares the methods

const WorkPrecision* cheapest(Rows rows, const Family& family, double error) {
  return accuracy::cheapest(rows, family.method, family.in_lanes, error);
}

/// The cheapest row of all methods for an error; null if none reaches it.
const WorkPrecision* cheapest(Rows rows, double error) {
  const WorkPrecision* best = nullptr;
  for (const Family& family : families)
    if (const WorkPrecision* const row = cheapest(rows, family, error))
      if (best == nullptr || row->ns_per_period < best->ns_per_period) best = row;
  return best;
}

/// "80 ns", "2.27 us", "5.48 ms", "1.2 s".
std::string time_text(double ns) {
  if (ns < 999.5) return formatted("%.0f ns", ns);
  if (ns < 999.5e3) return formatted("%.3g us", ns / 1e3);
  return ns < 999.5e6 ? formatted("%.3g ms", ns / 1e6) : formatted("%.3g s", ns / 1e9);
}

/// A ratio in at most six characters, so that columns keep apart: 1, 1.3, 28, 68531, 2e+06.
std::string times_text(double ratio) {
  return formatted(ratio < 9.95 ? "%.2g" : ratio < 999999.5 ? "%.0f" : "%.0e", ratio);
}

constexpr std::size_t setting_width = 7, time_width = 8, times_width = 7;
std::size_t width_of(const Family& family) {
  return (family.column.empty() ? 0 : setting_width) + time_width + times_width;
}

std::string cells(const WorkPrecision* row, const Family& family, double least) {
  if (row == nullptr) return right("-", width_of(family));
  const std::string setting = family.column.empty() ? "" : right(formatted("%.0e", row->trial.setting), setting_width);
  return setting + right(time_text(row->ns_per_period), time_width) +
         right(times_text(row->ns_per_period / least), times_width);
}

std::string table(Rows rows) {
  std::string top = right("", 6), bottom = right("error", 6);
  for (const Family& family : families) {
    top += right(std::string(family.title), width_of(family));
    bottom += family.column.empty() ? "" : right(std::string(family.column), setting_width);
    bottom += right("time", time_width) + right("times", times_width);
  }
  std::string text = top + '\n' + bottom + '\n';
  for (const double level : levels) {
    const WorkPrecision* const least = cheapest(rows, level);
    text += right(formatted("%.0e", level), 6);
    for (const Family& family : families)
      text += cells(cheapest(rows, family, level), family, least == nullptr ? 1.0 : least->ns_per_period);
    text += '\n';
  }
  return text;
}

/// The most accurate row of the exact method, in lanes if they ran it.
const WorkPrecision* exact_row(Rows rows) {
  for (const bool in_lanes : {true, false})
    if (const auto* const row = accuracy::cheapest(rows, TestedMethod::exact, in_lanes, HUGE_VAL)) return row;
  return nullptr;
}

/// How a general method compares with a row of the exact one.
std::string comparison(Rows rows, const Family& family, const WorkPrecision& exact) {
  const std::string name(family.name), level = formatted("%.0e", usual_level);
  if (const WorkPrecision* const row = cheapest(rows, family, usual_level))
    return name + " takes " + times_text(row->ns_per_period / exact.ns_per_period) + " times as long for " + level;
  double best = HUGE_VAL;
  for (const WorkPrecision& row : rows)
    if (row.trial.method == family.method) best = std::fmin(best, accuracy::error_of(row));
  return name + (std::isfinite(best) ? " gets to " + formatted("%.1e", best) + ", not to " + level
                                     : " doesn't get there: it finds other impacts");
}

std::string sentence(Rows rows) {
  const WorkPrecision* const exact = exact_row(rows);
  if (exact == nullptr) return "The exact method has no error to tell.";
  const bool in_lanes = exact->trial.arch != lanes::InstructionSet::scalar;
  std::string text =
      std::string(in_lanes ? "exact in lanes (" + std::string(name_of(exact->trial.arch)) + ')' : "exact") + ": " +
      formatted("%.0e", accuracy::error_of(*exact)) + " at " + time_text(exact->ns_per_period) + " a period";
  const auto was_tried = [&](const Family& family) {
    return std::ranges::any_of(rows, [&](const WorkPrecision& row) { return row.trial.method == family.method; });
  };
  for (const Family& family : families)
    if (!family.column.empty() && was_tried(family)) text += "; " + comparison(rows, family, *exact);
  return text + '.';
}

/// From which settings on methods miss or invent impacts or rests.
std::string misses(Rows rows, const accuracy::PointAccuracy& of_point) {
  if (of_point.impacts + of_point.rests == 0) return "There are no impacts to miss.";
  std::string text;
  for (const Family& family : families) {
    const auto from = accuracy::misses_from(rows, family.method);
    if (family.in_lanes || !from) continue;
    text += (text.empty() ? "by " : ", by ") + std::string(family.name);
    if (!family.column.empty())
      text +=
          " at " + std::string(family.setting) + " from " + formatted("%.0e", *from) + std::string(family.unit) + " up";
  }
  return text.empty() ? "No method misses or invents an impact." : "Impacts are missed or invented " + text + '.';
}

}  // namespace

std::string comparison_text(const accuracy::PointAccuracy& of_point, const point::Problem& problem) {
  const std::string events = counted(of_point.impacts, "impact") + " and " + counted(of_point.rests, "rest") +
                             (has_friction(problem.friction) ? ", sticks included" : "");
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

std::string accuracy_answer(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep, std::size_t point) {
  std::string text = coordinates_text(sweep, point);
  if (!text.empty()) text = config::wrapped(text, 0);
  text += config::wrapped(comparison_text(of_point, problem_at(sweep, point)), 0);
  if (!(of_point.horizon > 0)) return text + '\n';
  const Rows rows(of_point.rows);
  return text + table(rows) + config::wrapped(sentence(rows), 0) + config::wrapped(misses(rows, of_point), 0) + '\n';
}

}  // namespace clatter::app
