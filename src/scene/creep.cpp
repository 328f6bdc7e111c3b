#include "scene/creep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/displacement_bound.hpp"

namespace clatter {
inline namespace scene {
namespace {

/// The constant forces on a mass: load, spring, and that of a soft stop which it presses.
struct Pull {
  double balanced;   ///< the force at x = 0, if the stop is counted from there
  double stiffness;  ///< of both springs
  double damping;    ///< of the stop, 2 h_s
  Side stop;         ///< none: the mass is free

  [[nodiscard]] double at(double x) const { return balanced - stiffness * x; }
};

Pull pull_at(const Scene& scene, double x) {
  const Stops& stops = scene.stops;
  const Side stop = soft_stop_beyond(stops, x);
  const Oscillator& o = scene.oscillator;
  if (stop == Side::none) return {o.load, o.stiffness, 0.0, stop};
  const bool upper = stop == Side::upper;
  const double kappa = upper ? stops.stiffness_upper : stops.stiffness_lower;
  const double zeta = upper ? stops.damping_upper : stops.damping_lower;
  return {o.load + kappa * (upper ? stops.upper : stops.lower), o.stiffness + kappa, 2 * zeta * std::sqrt(kappa), stop};
}

/// How hard the springs may pull a mass that friction holds at every phase of the force; negative: none is held.
double held_pull(const Scene& scene) { return scene.friction.static_level - std::abs(scene.oscillator.forcing); }

/// Whether all of the way from x to an edge is between the stops, or in contact with the same soft one, whose damper
/// leaves it its push up to a speed.
bool is_open(const Scene& scene, const Pull& pull, double edge, double speed) {
  const Stops& stops = scene.stops;
  if (pull.stop == Side::none) return edge >= stops.lower && edge <= stops.upper;
  const bool upper = pull.stop == Side::upper;
  const double depth = upper ? edge - stops.upper : stops.lower - edge;
  return (upper ? stops.stiffness_upper : stops.stiffness_lower) * depth > pull.damping * speed;
}

}  // namespace

std::optional<BandEdge> creeps_to(const Scene& scene, double x, double v, const SineCosine<double>& phase) {
  const Oscillator& o = scene.oscillator;
  const Friction& friction = scene.friction;
  const double f = std::abs(o.forcing), nu = o.frequency;
  if (!(o.shape.is_sine() && has_friction(friction) && friction.static_level == friction.kinetic && f > 0 &&
        held_pull(scene) >= 0))
    return std::nullopt;
  const Pull pull = pull_at(scene, x);
  const double force = pull.at(x), left = std::abs(force) - held_pull(scene), way = force > 0 ? 1 : -1;
  if (!(pull.stiffness > 0 && left > 0 && way * v >= 0)) return std::nullopt;
  // eq. 77: of the slip at the next peak, or what is left of the present one
  const double width = pi<double>() * std::sqrt(left / (2 * f));  // in phase, from a peak on: the force falls by `left`
  if (!(5 * width <= pi<double>() && 64 * pull.stiffness * width * width < nu * nu)) return std::nullopt;
  const double cosine = way * std::copysign(phase.sine, o.forcing * phase.sine);  // of the phase from the peak on
  if (v != 0 && !(cosine >= std::cos(3 * width) && std::abs(v) <= 5 * left * width / nu)) return std::nullopt;
  const Side side = force > 0 ? Side::lower : Side::upper;
  const auto edge = edge_of_band(scene, side, x);
  if (!edge || !is_open(scene, pull, *edge, 7 * left * width / nu)) return std::nullopt;
  return BandEdge{side, *edge};
}

std::optional<double> edge_of_band(const Scene& scene, Side side, double x) {
  const Pull pull = pull_at(scene, x);
  const double held = held_pull(scene);
  if (!(pull.stiffness > 0 && held >= 0)) return std::nullopt;
  const double edge = (pull.balanced + sign_of(side) * held) / pull.stiffness;
  double inside = edge;
  for (int ulp = 0; ulp < 16 && !sticks_for_good(scene, inside); ++ulp)  // rounding has put it beyond the band
    inside = std::nextafter(inside, -sign_of(side) * std::numeric_limits<double>::infinity());
  return sticks_for_good(scene, inside) ? inside : edge;
}

Side band_edge_at(const Scene& scene, double x) {
  const Oscillator& o = scene.oscillator;
  const bool is_driven = o.forcing != 0 && o.shape.is_sine();
  if (scene.friction.static_level != scene.friction.kinetic || !is_driven) return Side::none;
  const Pull pull = pull_at(scene, x);
  const double held = held_pull(scene), force = pull.at(x);
  const double rounding = 64 * std::numeric_limits<double>::epsilon() *
                          (std::abs(pull.balanced) + std::abs(pull.stiffness * x) + scene.friction.static_level);
  if (!(pull.stiffness > 0 && std::abs(std::abs(force) - held) <= rounding)) return Side::none;
  return force > 0 && held > rounding ? Side::lower : Side::upper;
}

}  // namespace scene
}  // namespace clatter
