#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "scene/friction.hpp"
#include "scene/loose_mass.hpp"
#include "scene/oscillator.hpp"
#include "scene/shaking.hpp"
#include "scene/stops.hpp"

namespace clatter {
inline namespace scene {

/// The state at tau = 0.
template <class Number>
struct BasicStart {
  Number displacement{0.0};  ///< x0, between the stops
  Number velocity{0.0};      ///< v0
  Number phase{0.0};         ///< forcing phase at tau = 0, rad
};
using Start = BasicStart<double>;

/// An oscillator, its stops, its start, the shaking by which displacements count, its friction, and the loose mass that
/// it carries: everything that the motion depends on.
template <class Number>
struct BasicScene {
  BasicOscillator<Number> oscillator{};
  BasicStops<Number> stops{};
  BasicStart<Number> start{};
  BasicShaking<Number> shaking{};
  BasicFriction<Number> friction{};
  BasicLooseMass<Number> loose{};
};
using Scene = BasicScene<double>;

/// The laws of restitution of a scene: of its stops, and of the walls of its loose mass.
template <class Number>
[[nodiscard]] std::array<Restitution<Number>*, 4> laws_of(BasicScene<Number>& scene) {
  return {&scene.stops.restitution_lower, &scene.stops.restitution_upper, &scene.loose.restitution_lower,
          &scene.loose.restitution_upper};
}

/// Whether no restitution depends on the speed.
[[nodiscard]] inline bool has_constant_restitution(Scene scene) {
  return std::ranges::all_of(laws_of(scene), [](const auto* law) { return law->is_constant(); });
}

/// A scene with numbers of another type, that hold those of its own.
template <class Number, class Other>
[[nodiscard]] BasicScene<Number> with_numbers(const BasicScene<Other>& scene) {
  const auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  const auto n = [](const Other& number) { return Number(number); };
  const auto law = [](const Restitution<Other>& of) { return Restitution<Number>(of); };
  const auto moves = [&](const BasicStopMotion<Other>& motion) -> BasicStopMotion<Number> {
    return {n(motion.amplitude), n(motion.phase)};
  };
  BasicScene<Number> same;
  same.oscillator = {n(oscillator.damping), n(oscillator.forcing),   n(oscillator.frequency),
                     n(oscillator.load),    n(oscillator.stiffness), with_numbers<Number>(oscillator.shape),
                     oscillator.paces_stops};
  same.stops = {n(stops.lower),
                n(stops.upper),
                law(stops.restitution_lower),
                law(stops.restitution_upper),
                n(stops.stiffness_lower),
                n(stops.stiffness_upper),
                n(stops.damping_lower),
                n(stops.damping_upper),
                moves(stops.motion_lower),
                moves(stops.motion_upper)};
  same.start = {n(start.displacement), n(start.velocity), n(start.phase)};
  same.shaking = {n(shaking.stops), n(shaking.base), n(shaking.lead), n(shaking.phase)};
  same.friction = {n(friction.kinetic), n(friction.static_level)};
  same.loose = {.ratio = n(loose.ratio),
                .lower = n(loose.lower),
                .upper = n(loose.upper),
                .restitution_lower = law(loose.restitution_lower),
                .restitution_upper = law(loose.restitution_upper),
                .stiffness_lower = n(loose.stiffness_lower),
                .stiffness_upper = n(loose.stiffness_upper),
                .damping_lower = n(loose.damping_lower),
                .damping_upper = n(loose.damping_upper),
                .load = n(loose.load),
                .place = n(loose.place),
                .velocity = n(loose.velocity),
                .friction = n(loose.friction),
                .friction_static = n(loose.friction_static)};
  return same;
}

/// The place about which the mirror image of each motion, half a forcing period later, is a motion too: the equilibrium
/// of the spring or, without spring and load, the middle between the stops. Nothing if stops or load aren't the same on
/// both sides of it, to rounding. A loose mass is mirrored about the middle of its walls; with a load of its own, or
/// walls that aren't alike, it has no mirror image; nor has a motion under a force that half a period later isn't its
/// opposite, or between stops of which one moves otherwise than the other.
[[nodiscard]] inline std::optional<double> mirror_centre(const Scene& scene) {
  const Stops& stops = scene.stops;
  const Oscillator& o = scene.oscillator;
  const LooseMass& loose = scene.loose;
  if (!is_odd_by_half(o.shape)) return std::nullopt;
  const bool is_housed = std::isfinite(loose.lower) && std::isfinite(loose.upper);
  const bool has_equal_walls = loose.restitution_lower == loose.restitution_upper &&
                               loose.stiffness_lower == loose.stiffness_upper &&
                               loose.damping_lower == loose.damping_upper;
  const bool is_mirrored = is_housed && has_equal_walls && loose.load == 0;
  if (has_loose_mass(loose) && !is_mirrored) return std::nullopt;
  const bool bounded = std::isfinite(stops.lower) && std::isfinite(stops.upper);
  if (!bounded && (std::isfinite(stops.lower) || std::isfinite(stops.upper))) return std::nullopt;
  const bool alike = stops.restitution_lower == stops.restitution_upper &&
                     stops.stiffness_lower == stops.stiffness_upper && stops.damping_lower == stops.damping_upper &&
                     (!move_by_themselves(stops) || stops.motion_lower == stops.motion_upper);
  if ((bounded && !alike) || (o.stiffness == 0 && o.load != 0)) return std::nullopt;
  const double middle = bounded ? (stops.lower + stops.upper) / 2 : equilibrium_of(o);
  if (o.stiffness == 0) return middle;
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double size = bounded ? std::max(std::abs(stops.lower), std::abs(stops.upper)) : 0;
  return std::abs(middle - equilibrium_of(o)) <= rounding * size ? std::optional(middle) : std::nullopt;
}
[[nodiscard]] inline bool is_symmetric(const Scene& scene) { return mirror_centre(scene).has_value(); }

}  // namespace scene
}  // namespace clatter
