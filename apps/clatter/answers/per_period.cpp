#include "answers/per_period.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

#include "outputs/output_summary.hpp"
#include "steady/status.hpp"
#include "storage/input_file.hpp"
#include "sweep/sweep.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

constexpr std::array<std::string_view, 5> totals{"work_in", "loss_damping", "loss_friction", "loss_impact", "impulse"};
constexpr std::string_view in_time = "in the observed time", per_period = "per forcing period";
constexpr double whole_to = 1e-6;  ///< how close to a whole number, over that, the observed forcing periods have to be

bool is_total(std::string_view name) { return std::ranges::find(totals, name) != totals.end(); }

/// What tells for how long each point was observed.
struct Told {
  std::vector<std::uint8_t> status;
  std::vector<double> period_ratio, loss_impact, impulse, impact_power;  ///< empty: the file has none
};

Told told_by(const results::FileSummary& summary, const std::string& path) {
  std::vector<std::string> names{"status"};
  for (const char* const name : {"period_ratio", "loss_impact", "impulse", "impact_power"})
    if (find_variable(summary, name) != nullptr) names.emplace_back(name);
  const results::Dataset dataset = results::read_variables(path, names);
  const auto numbers = [&](std::string_view name) {
    const auto* const values = results::values_of<double>(dataset, name);
    return values == nullptr ? std::vector<double>{} : *values;
  };
  const auto* const status = results::values_of<std::uint8_t>(dataset, "status");
  return {status == nullptr ? std::vector<std::uint8_t>{} : *status, numbers("period_ratio"), numbers("loss_impact"),
          numbers("impulse"), numbers("impact_power")};
}

/// The sum of the components of a point that have a value.
double sum_at(const std::vector<double>& values, std::size_t point, std::size_t points) {
  const std::size_t width = values.size() / points;
  double sum = 0;
  for (std::size_t part = 0; part < width; ++part)
    if (const double value = values[point * width + part]; !std::isnan(value)) sum += value;
  return sum;
}

/// The forcing periods of periodic motion: its losses in impacts over their mean power, in forcing periods. Motion that
/// presses no stop repeats with the force. NaN: unknown.
double periods_by_losses(const Told& told, const point::Problem& problem, std::size_t point) {
  const std::size_t points = told.status.size();
  if (told.loss_impact.empty() || told.impulse.empty() || told.impact_power.size() != points) return std::nan("");
  if (sum_at(told.impulse, point, points) == 0) return 1;
  const double period = 2 * pi<double>() / problem.oscillator.frequency * factor_of(problem.units, Quantity::time);
  const double periods = sum_at(told.loss_impact, point, points) / told.impact_power[point] / period;
  const double whole = std::round(periods);
  return whole >= 1 && std::abs(periods - whole) <= whole_to * whole ? whole : std::nan("");
}

double periods_at(const Told& told, const point::Problem& problem, std::size_t point) {
  const auto status = static_cast<steady::Status>(told.status[point]);
  if (failed(status)) return 1;  // it has no values
  if (lacks_period(status)) return static_cast<double>(problem.time.window);
  const double ratio = told.period_ratio.size() == told.status.size() ? told.period_ratio[point] : 0;
  return ratio > 0 ? ratio : periods_by_losses(told, problem, point);
}

/// The forcing periods for which each point of a sweep was observed; empty if that isn't known of all, or nothing
/// drives the mass.
std::vector<double> observed_periods(const results::FileSummary& summary, const std::string& path) {
  static_cast<void>(dimensions_of_points(summary, path));  // a shard has none
  const sweep::Sweep sweep = outputs::config_of_output(summary, path).sweep;
  if (sweep.dimensions.empty() || sweep.problem.time.mode == steady::Mode::transient) return {};
  const Told told = told_by(summary, path);
  if (told.status.size() != size(sweep))
    storage::refuse_reading(path, "is damaged: its points aren't those of its configuration",
                            "run its configuration again");
  std::vector<double> periods;
  bool is_driven = false;
  for (std::size_t point = 0; point < told.status.size(); ++point) {
    const point::Problem problem = problem_at(sweep, point);
    is_driven = is_driven || clatter::is_driven(problem.oscillator) || is_shaken(problem.shaking);
    periods.push_back(periods_at(told, problem, point));
    if (std::isnan(periods.back())) return {};
  }
  return is_driven ? periods : std::vector<double>{};
}

}  // namespace

Compared::Compared(results::FileSummary summary, std::string path)
    : summary_(std::move(summary)), path_(std::move(path)) {
  const bool has_totals =
      std::ranges::any_of(summary_.variables, [](const auto& entry) { return is_total(entry.name); });
  if (!has_totals || holds_branches(summary_) || holds_accuracy(summary_)) return;
  periods_ = observed_periods(summary_, path_);
  for (results::FileSummary::Entry& entry : summary_.variables)
    if (const std::size_t at = entry.long_name.find(in_time); !per(entry.name).empty() && at != std::string::npos)
      entry.long_name.replace(at, in_time.size(), per_period);
}

std::string Compared::per(const std::string& name) const {
  return periods_.empty() || !is_total(name) ? std::string{} : std::string(per_period);
}

results::Dataset Compared::read(const std::vector<std::string>& names) const {
  results::Dataset dataset = results::read_variables(path_, names);
  for (results::Variable& variable : dataset.variables) {
    auto* const values = std::get_if<std::vector<double>>(&variable.values);
    if (values == nullptr || per(variable.name).empty()) continue;
    const std::size_t width = values->size() / periods_.size();
    for (std::size_t i = 0; width > 0 && i < width * periods_.size(); ++i) (*values)[i] /= periods_[i / width];
  }
  return dataset;
}

}  // namespace clatter::app
