#include "accuracy/forecast.hpp"

#include <cmath>

#include "accuracy/timing.hpp"

namespace clatter::accuracy {
namespace {

/// The ratio of the times of two trials of one method.
double growth(const Trial& from, const Trial& to) {
  switch (to.method) {
    case TestedMethod::dopri5:
      return std::pow(from.setting / to.setting, 0.18);  // 1.5 times for each digit
    case TestedMethod::moreau:
      return from.setting / to.setting;
    default:
      return 1;
  }
}

/// The share of its time that a run takes without observables, as measured in three accuracy runs.
double silent_share(TestedMethod method) {
  if (method == TestedMethod::moreau) return 0.02;
  return method == TestedMethod::dopri5 ? 0.12 : 0.7;
}

}  // namespace

Forecast::Forecast(const std::vector<Trial>& trials, int rounds) : rounds_(rounds) {
  for (const Trial& trial : trials) rows_.push_back({trial});
}

void Forecast::ran(std::size_t row, double seconds) { rows_[row].first = seconds; }

void Forecast::measured(std::size_t row, int round, double seconds) {
  rows_[row].silent = seconds;
  rows_[row].next_round = round + 1;
}

/// Seconds of a trial's first run, extrapolated from the last one of its method that has run, but not from Moreau's
/// coarsest step, which takes hardly more than the overhead of a run. The time of transforms is known; other trials
/// take next to nothing.
std::optional<double> Forecast::foretold(std::size_t row) const {
  const Trial& trial = rows_[row].trial;
  if (trial.method == TestedMethod::harmonics_fft) return 5e-8 * trial.setting;
  const bool is_costly = trial.method == TestedMethod::dopri5 || trial.method == TestedMethod::moreau;
  for (std::size_t other = row; other-- > 0 && rows_[other].trial.method == trial.method;) {
    const bool is_coarsest = other == 0 || rows_[other - 1].trial.method != trial.method;
    if (trial.method == TestedMethod::moreau && is_coarsest) break;
    if (rows_[other].first) return *rows_[other].first * growth(rows_[other].trial, trial);
  }
  return is_costly ? std::nullopt : std::optional(0.0);
}

std::optional<double> Forecast::seconds_left() const {
  double left = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const std::optional<double> first = row.first ? row.first : foretold(i);
    if (!first) return std::nullopt;
    if (!row.first) left += *first;
    const double silent = row.silent.value_or(silent_share(row.trial.method) * *first);
    for (int round = row.next_round; round < rounds_; ++round) left += Timing::lasts(silent, round);
  }
  return left;
}

}  // namespace clatter::accuracy
