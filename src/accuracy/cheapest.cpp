#include "accuracy/cheapest.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::accuracy {
namespace {

bool is_of(const WorkPrecision& row, TestedMethod method, bool in_lanes) {
  return row.trial.method == method && (row.trial.arch != lanes::InstructionSet::scalar) == in_lanes;
}

bool misses(const WorkPrecision& row) { return row.missed > 0 || row.extra > 0 || row.rests_missed > 0; }

}  // namespace

double error_of(const WorkPrecision& row) {
  double error = point::no_value;
  if (failed(row.status) || misses(row)) return error;
  for (const double one : {row.contact_time, row.contact_speed, row.rest, row.extrema}) error = std::fmax(error, one);
  return error;
}

const WorkPrecision* cheapest(std::span<const WorkPrecision> rows, TestedMethod method, bool in_lanes, double error) {
  const WorkPrecision* best = nullptr;
  for (const WorkPrecision& row : rows)
    if (is_of(row, method, in_lanes) && error_of(row) <= error &&
        (best == nullptr || row.ns_per_period < best->ns_per_period))
      best = &row;
  return best;
}

std::optional<double> misses_from(std::span<const WorkPrecision> rows, TestedMethod method) {
  std::optional<double> finest;
  for (const WorkPrecision& row : rows)
    if (is_of(row, method, false) && misses(row))
      finest = std::min(row.trial.setting, finest.value_or(row.trial.setting));
  return finest;
}

}  // namespace clatter::accuracy
