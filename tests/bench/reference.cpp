#include "bench/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <variant>

#include "sweep/run.hpp"

namespace clatter::bench {
namespace {

template <class Number>
const std::vector<Number>& values(const sweep::RunResult& result, std::string_view name) {
  return std::get<std::vector<Number>>(
      std::ranges::find(result.dataset.variables, name, &results::Variable::name)->values);
}

std::vector<Transient> exact(sweep::Sweep sweep) {
  sweep.problem.observe.trajectory = 2;  // the start and the end
  const sweep::RunResult result = run(sweep, {.threads = 1, .arch = lanes::InstructionSet::scalar});
  const auto &low = values<double>(result, "x_min"), &high = values<double>(result, "x_max");
  const auto &x = values<double>(result, "x"), &v = values<double>(result, "v");
  std::vector<Transient> motions;
  for (std::size_t i = 0; i < low.size(); ++i) motions.push_back({low[i], high[i], x[2 * i + 1], v[2 * i + 1]});
  return motions;
}

std::vector<std::uint8_t> steady_status(sweep::Sweep sweep) {
  sweep.problem.time.mode = steady::Mode::steady;
  return values<std::uint8_t>(run(sweep, {.threads = 1, .arch = lanes::InstructionSet::scalar}), "status");
}

double difference(const Transient& one, const Transient& other) {
  return std::max({std::abs(one.x_min - other.x_min), std::abs(one.x_max - other.x_max), std::abs(one.x - other.x),
                   std::abs(one.v - other.v)});
}

constexpr double room = 1e-3;  // allowed error of a solver, over |xs|

}  // namespace

Reference::Reference(const sweep::Sweep& sweep) : whole_(sweep), beginning_(sweep), at_end_(exact(sweep)) {
  beginning_.problem.time.duration = std::min(sweep.problem.time.duration, 10 * 2 * std::numbers::pi);
  early_ = exact(beginning_);
  sweep::Sweep displaced = sweep;
  displaced.problem.start.displacement = 1e-13;
  const std::vector<Transient> moved = exact(displaced);
  const std::vector<std::uint8_t> status = steady_status(sweep);
  for (std::size_t i = 0; i < at_end_.size(); ++i)
    determined_.push_back(status[i] == static_cast<std::uint8_t>(steady::Status::periodic) &&
                          difference(moved[i], at_end_[i]) < 1e-6);
}

Verdict Reference::judge(const Solver& solver, const std::vector<Transient>& runs) const {
  Verdict verdict;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Stops& stops = whole_.problem.stops;
    const double off =
        determined_[i] ? difference(runs[i], at_end_[i]) : difference(solver(problem_at(beginning_, i)), early_[i]);
    const double deep = std::max(runs[i].x_max - stops.upper, stops.lower - runs[i].x_min);
    if (off / stops.upper <= room)
      verdict.error = std::max(verdict.error, off / stops.upper);
    else
      ++verdict.wrong;
    if (deep / stops.upper > room) ++verdict.through;
  }
  return verdict;
}

std::size_t Reference::undetermined() const { return static_cast<std::size_t>(std::ranges::count(determined_, false)); }

}  // namespace clatter::bench
