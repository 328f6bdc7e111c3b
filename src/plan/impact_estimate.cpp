#include "plan/impact_estimate.hpp"

#include <algorithm>

#include "point/point.hpp"
#include "sweep/chains.hpp"

namespace clatter::plan {
namespace {

/// The extent of the runs for the estimate: some milliseconds, by general methods a good part of a second.
struct Trial {
  std::size_t points = 32;
  double impacts = 16384;         ///< of a point
  double periods = 64;            ///< of a transient
  std::int64_t to_settle = 2048;  ///< periods until motion counts as aperiodic
  std::int64_t window = 16;       ///< periods of aperiodic motion
};

Trial trial_of(const stepping::Integration& integration) {
  if (integration.method == stepping::Method::exact) return {};
  return {.points = 4, .periods = 4, .to_settle = 16, .window = 4};
}

/// Impacts in the time of a transient, extrapolated from its first periods.
double impacts_of_transient(point::Problem scene, const Trial& trial) {
  steady::TimeSettings& time = scene.time;
  const double budget = time.max_impacts, whole = time.duration, period = period_of(scene.oscillator);
  time.max_impacts = std::min(budget, trial.impacts), time.duration = std::min(whole, trial.periods * period);
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  const double simulated = std::min(result.periods * period, time.duration);
  const double impacts = failed(result.status) ? result.impacts : static_cast<double>(result.log.size());
  return simulated > 0 ? std::min(budget, impacts * whole / simulated) : impacts;
}

/// Impacts in a period of the motion that the point settles to; in the window if it doesn't settle.
double impacts_of_steady_motion(point::Problem scene, const Trial& trial) {
  steady::TimeSettings& time = scene.time;
  const auto window = static_cast<double>(time.window);
  time.max_impacts = std::min(time.max_impacts, trial.impacts);
  time.max_periods = std::min(time.max_periods, trial.to_settle), time.window = std::min(time.window, trial.window);
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  const auto impacts = static_cast<double>(result.log.size());
  return lacks_period(result.status) ? impacts * window / static_cast<double>(time.window) : impacts;
}

}  // namespace

double expected_impacts(const sweep::Sweep& sweep, const std::optional<sweep::Shard>& shard) {
  const Trial trial = trial_of(sweep.problem.integration);
  const sweep::Share share(sweep, shard);
  const std::size_t points = share.points(), examined = std::min(points, trial.points);
  double impacts = 0;
  for (std::size_t i = 0; i < examined; ++i) {
    const std::size_t local_index = (2 * i + 1) * points / (2 * examined);  // the middles of equal parts
    point::Problem scene = problem_at(sweep, share.point(local_index / share.length(), local_index % share.length()));
    sweep::start_from(scene, std::nullopt, {});
    scene.observe = {}, scene.observe.impact_log = true, scene.integration.all_effects = false;
    impacts += scene.time.mode == steady::Mode::transient ? impacts_of_transient(scene, trial)
                                                          : impacts_of_steady_motion(scene, trial);
  }
  return examined == 0 ? 0.0 : impacts * static_cast<double>(points) / static_cast<double>(examined);
}

}  // namespace clatter::plan
