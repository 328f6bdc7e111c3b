#include "sweep/impact_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "sweep/branches.hpp"
#include "sweep/point.hpp"

namespace clatter {
namespace {

constexpr std::size_t most_points = 32;
constexpr double most_impacts = 16384;  ///< of a point

/// Impacts in the observed time of a point. Where that is long they are counted in its first periods, for many periods
/// as if they went on like that.
double impacts_of(Scene scene) {
  TimePlan& time = scene.time;
  const bool is_exact = scene.integration.method == Method::exact;
  const double budget = time.max_impacts, periods = is_exact ? 64 : 4, whole = time.duration;
  scene.observe = {.impact_log = true};
  scene.integration.all_effects = false;
  time.max_impacts = std::min(budget, most_impacts);
  if (time.mode == Mode::transient) {
    time.duration = std::min(whole, periods * period_of(scene.oscillator));
  } else {
    time.max_periods = std::min(time.max_periods, static_cast<std::int64_t>(4 * periods));
  }
  Workshop workshop;
  const PointResult result = run_point(scene, workshop);
  if (time.mode == Mode::steady) return static_cast<double>(result.log.size());
  const double simulated = result.periods * period_of(scene.oscillator);
  const double impacts = failed(result.status) ? result.impacts : static_cast<double>(result.log.size());
  return simulated > 0 ? std::min(budget, impacts * whole / std::min(simulated, time.duration)) : impacts;
}

}  // namespace

double expected_impacts(const Sweep& sweep, const std::optional<Shard>& shard) {
  const Share share(sweep, shard);
  const std::size_t points = share.points(), looked_at = std::min(points, most_points);
  double impacts = 0;
  for (std::size_t i = 0; i < looked_at; ++i) {
    const std::size_t slot = (2 * i + 1) * points / (2 * looked_at);  // the middles of equal parts
    Scene scene = scene_at(sweep, share.point(slot / share.length(), slot % share.length()));
    start_from(scene, std::nullopt);
    impacts += impacts_of(scene);
  }
  return looked_at == 0 ? 0.0 : impacts * static_cast<double>(points) / static_cast<double>(looked_at);
}

}  // namespace clatter
