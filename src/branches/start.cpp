#include "branches/start.hpp"

#include <cmath>
#include <string>

#include "attractors/periodic_motion.hpp"
#include "branches/resting.hpp"
#include "point/point.hpp"

namespace clatter::branches {
namespace {

/// The state at forcing phase 0 that a problem settles on, and its period.
std::pair<PhasePoint, std::int64_t> settled(point::Problem problem) {
  problem.observe = {};
  problem.observe.attractor = true;
  problem.time.mode = steady::Mode::steady;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  if (failed(result.status)) throw StartError("the run to the motion at the start fails");
  if (!(result.attractor_periods > 0))
    throw StartError(
        "the scene settles on no periodic motion within time.max_periods; begin elsewhere in the range, raise "
        "time.max_periods, or set branch.period and, near a periodic motion, x0 and v0");
  return {{result.attractor_x, result.attractor_v}, static_cast<std::int64_t>(result.attractor_periods)};
}

Orbit resting_start(const point::Problem& problem, Side stop, std::int64_t period) {
  if (auto orbit = resting_orbit(problem, stop, period)) return std::move(*orbit);
  throw StartError("the motion at the start rests on a stop for good; begin where the force takes it off");
}

}  // namespace

Orbit start_orbit(const point::Problem& problem, std::int64_t period, bool symmetric) {
  if (problem.oscillator.forcing == 0) throw StartError("a branch needs a force, whose periods it counts: set scene.f");
  PhasePoint state{problem.start.displacement, problem.start.velocity};
  if (period == 0) {
    std::tie(state, period) = settled(problem);
  } else if (problem.start.phase != 0) {
    throw StartError("with branch.period, x0 and v0 stand at forcing phase 0: leave out scene.phase");
  }
  // Newton's method on the map of the periods; unless a contact appears or vanishes on the way it gets there
  const auto motion = attractors::periodic_motion(problem, state, static_cast<std::size_t>(period));
  if (!motion) throw StartError("the run from the start fails");
  const auto round = attractors::run_round(attractors::started(problem, motion->cycle[0], 0.0), motion->cycle.size());
  if (!round) throw StartError("the run from the start fails");
  Orbit orbit = orbit_of(*round, problem.oscillator.frequency);
  for (const OrbitImpact& impact : orbit.impacts)
    if (impact.before == 0) return resting_start(problem, impact.side, period);
  return orbit.half_if_same(1e-6, symmetric);
}

}  // namespace clatter::branches
