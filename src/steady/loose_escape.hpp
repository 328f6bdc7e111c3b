#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/walls.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/effects.hpp"

namespace clatter::steady {

/// Whether a loose mass is proved to leave its housing for ever through the side without a wall: no force brings it
/// back, and its displacement y keeps clear of all places at which the main mass can carry the wall that there is. Of
/// one that rubs on the housing nothing is proved.
[[nodiscard]] inline bool loose_mass_escapes(const Scene& scene, const motion::State<double>& state,
                                             const SineCosine<double>& phase) {
  const LooseMass& loose = scene.loose;
  const Oscillator& o = scene.oscillator;
  const bool is_open_above = std::isinf(loose.upper), is_open_below = std::isinf(loose.lower);
  if (state.loose.pressed || state.loose.within || (!is_open_above && !is_open_below) || has_loose_friction(loose))
    return false;
  const auto [z, w] = motion::place_in_housing(state, loose);
  const double y = state.loose.wall == Side::none ? state.loose.place : z + state.x,
               v = state.loose.wall == Side::none ? state.loose.speed : w + state.v;
  const double middle = equilibrium_of(o);
  const PhaseState main{state.x - middle, state.v, phase.sine, phase.cosine};
  constexpr double for_ever = std::numeric_limits<double>::infinity();
  const bool in_a_stop = soft_stop_beyond(scene.stops, state.x) != Side::none;  // which has stored energy
  const double far = in_a_stop                      ? for_ever
                     : has_events_of_its_own(scene) ? displacement_bound_through_impacts(o, main, for_ever)
                                                    : displacement_bound(o, main, for_ever, 0.0);
  const auto departs = [&](int sign, double wall) {  // the wall on the other side, which may be at infinity, too
    if (!(sign * loose.load >= 0) || !(sign * v > 0 || (sign * loose.load > 0 && v == 0))) return false;
    return std::isinf(wall) || sign * (y - middle - wall) > far;
  };
  return (is_open_above && departs(1, loose.lower)) || (is_open_below && departs(-1, loose.upper));
}

/// Whether a main mass without a spring that holds it (k <= 0) is proved to carry the loose one away for ever, in a
/// direction in which it has no stop. Whatever happens in the housing, the momentum P = x' + eps y' and the place
/// s = x + eps y of both grow as
///
///     Q' = load + eps g - k x + force, friction, pushes of a stop that is left behind,    s' = Q - 2 h x
///
/// with Q = P + 2 h x, where z lies between the walls, so that x follows from s but for some width. Once both rates are
/// positive for the least x, and the greatest, that s allows, they stay so, since each grows with the other.
[[nodiscard]] inline bool both_escape(const Scene& scene, const motion::State<double>& state) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const LooseMass& loose = scene.loose;
  if (!(o.stiffness <= 0) || std::isinf(loose.lower) || std::isinf(loose.upper)) return false;
  if (has_soft_wall(loose)) return false;  // beyond which z may lie anywhere
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const motion::PlaceInHousing<double> place = motion::place_in_housing(state, loose);
  const double z = place.z, w = place.w;
  const double eps = loose.ratio, both = 1 + eps, widest = std::max(std::abs(loose.lower), std::abs(loose.upper));
  const double momentum = both * state.v + eps * w, sum = both * state.x + eps * z;
  const double damper = 2 * o.damping, against = std::abs(o.forcing) + scene.friction.static_level;
  const double place_size = std::abs(sum) + eps * widest;
  const double speed_size = both * (std::abs(state.v) + std::abs(scene.start.velocity)) +
                            eps * (std::abs(w) + std::abs(loose.velocity));  // impacts leave the rounding of the first
  const double force_size = std::abs(o.load) + std::abs(eps * loose.load) - o.stiffness * place_size + against;
  const auto departs = [&](int sign, double stop, double near_wall, double far_wall) {
    if (!std::isinf(stop)) return false;
    const double least = (sign * sum - eps * far_wall) / both, most = (sign * sum - eps * near_wall) / both;
    const double growth = sign * (o.load + eps * loose.load) - o.stiffness * least - against;
    const double speed = sign * momentum + damper * (sign * state.x - most);
    const bool moves = speed > rounding * (speed_size + damper * place_size);
    if (o.damping == 0 && force_size == 0) return moves;  // nothing changes the momentum
    return growth > rounding * force_size && (o.stiffness == 0 || moves);
  };
  return departs(1, stops.upper, loose.lower, loose.upper) || departs(-1, stops.lower, -loose.upper, -loose.lower);
}

}  // namespace clatter::steady
