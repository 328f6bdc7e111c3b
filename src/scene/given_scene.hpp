#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/collision.hpp"
#include "scene/scene.hpp"
#include "scene/units.hpp"

namespace clatter {
inline namespace scene {

/// An order of a force: amplitude sin(j theta + phase).
template <class Number>
struct GivenOrder {
  Number amplitude{0.0}, phase{0.0};
};

/// The numbers of a scene as its user gives them, in [scene], or in SI in [machine]: a mass m, its spring, damper and
/// force, m X'' + c X' + K X = F sin(2 pi frequency t + phase) + L. There K, F, L and the frequency, in Hz, are the
/// oscillator's stiffness, forcing, load and frequency, and the ratio of a loose mass is the mass itself. The damping
/// is given in one of several ways; those that aren't used stay at their neutral values. In [scene] the mass is 1.
template <class Number>
struct BasicGivenScene : BasicScene<Number> {
  Number mass{1.0};                                         ///< m, kg, > 0
  Number damper{0.0};                                       ///< c, N s/m, >= 0
  Number damping_ratio{0.0};                                ///< c/(2 (|K| m)^(1/2)), >= 0
  Number quality{std::numeric_limits<double>::infinity()};  ///< (|K| m)^(1/2)/c, > 0
  Number stop_damper_lower{0.0};                            ///< damping of the lower soft stop, N s/m, >= 0
  Number stop_damper_upper{0.0};                            ///< damping of the upper soft stop, N s/m, >= 0
  Number stop_restitution_lower{1.0};  ///< of an isolated collision with the lower soft stop, > 0, <= 1 (eq. 55)
  Number stop_restitution_upper{1.0};  ///< of an isolated collision with the upper soft stop, > 0, <= 1 (eq. 55)
  Number wall_damper_lower{0.0};       ///< damping of the lower soft wall of a loose mass, N s/m, >= 0
  Number wall_damper_upper{0.0};       ///< damping of the upper soft wall of a loose mass, N s/m, >= 0
  Number wall_restitution_lower{1.0};  ///< of an isolated collision with the lower soft wall, > 0, <= 1 (eq. 55)
  Number wall_restitution_upper{1.0};  ///< of an isolated collision with the upper soft wall, > 0, <= 1 (eq. 55)
  /// Period of the free motion that the start lies on, in place of x0 and v0 (eq. 36); NaN: these are the start.
  Number start_period{std::numeric_limits<double>::quiet_NaN()};
  Number force_factor{1.0};  ///< by which the forces of a table are multiplied, any finite
  Number mean_force{0.0};    ///< of a table of which orders are taken, in the unit of the load; also times that
  /// Orders 2 ... 8 of a force of `Waveform::orders`, in the unit of the oscillator's forcing, which is the first one.
  std::array<GivenOrder<Number>, ForceOrders<Number>::most - 1> orders{};
  bool is_si = false;  ///< given in [machine]

  BasicGivenScene() = default;
  explicit BasicGivenScene(const BasicScene<Number>& scene) : BasicScene<Number>(scene) {}
};
using GivenScene = BasicGivenScene<double>;

/// Whether a force acts.
template <class Number>
[[nodiscard]] bool is_forced(const BasicGivenScene<Number>& given) {
  return given.oscillator.forcing != 0 ||
         (given.oscillator.shape.has_orders() &&
          std::ranges::any_of(given.orders, [](const GivenOrder<Number>& order) { return order.amplitude != 0; }));
}

/// Whether a force or a shaking has a frequency.
template <class Number>
[[nodiscard]] bool has_frequency(const BasicGivenScene<Number>& given) {
  const bool is_driven = is_forced(given) || is_shaken(given.shaking) || move_by_themselves(given.stops);
  return is_driven && given.oscillator.frequency != 0;
}

/// The units in which a point of a sweep is computed: with a spring those of its natural frequency, so that k is 1 or
/// -1; without one a machine is computed in those of its force's frequency, and a scene in its own.
template <class Number>
[[nodiscard]] BasicUnits<Number> natural_units(const BasicGivenScene<Number>& given) {
  using std::abs, std::sqrt;
  BasicUnits<Number> units{.mass = given.mass, .is_si = given.is_si};
  const Number k = abs(given.oscillator.stiffness);
  if (k != 0)
    units.time = sqrt(Number(given.mass / k)), units.stiffness = k;
  else if (given.is_si && has_frequency(given))
    units.time = 1 / (2 * pi<Number>() * given.oscillator.frequency);
  if (k == 0) units.stiffness = given.mass / (units.time * units.time);
  return units;
}

namespace detail {

/// A given scene, of which the force may have been computed, in units that may be those of another one.
template <class Number, class Unit>
[[nodiscard]] BasicScene<Number> in_units(BasicScene<Number> scene, const BasicGivenScene<Number>& given,
                                          const BasicUnits<Unit>& units) {
  using std::abs, std::sqrt;
  const Unit& T = units.time;
  const Number& m = given.mass;
  const Number force = units.stiffness * (m / units.mass);  // that gives a unit of displacement to k = 1
  auto& [h, f, nu, load, k, shape, paces] = scene.oscillator;
  f = f / force, load = load / force, k = k / force;
  scene.friction.kinetic = scene.friction.kinetic / force;
  scene.friction.static_level = scene.friction.static_level / force;
  scene.loose.friction = scene.loose.friction / force;
  scene.loose.friction_static = scene.loose.friction_static / force;
  scene.loose.ratio = scene.loose.ratio / m;
  scene.loose.load = scene.loose.load * (T * T), scene.loose.velocity = scene.loose.velocity * T;
  nu = (given.is_si ? Unit(2 * pi<Unit>()) : Unit(1)) * nu * T;
  h = h * T + given.damper * T / (2 * m);
  if (!is_always_zero(given.damping_ratio)) h += given.damping_ratio * sqrt(abs(k));
  if (is_finite(given.quality)) h += sqrt(abs(k)) / (2 * given.quality);
  const auto soften = [&](Number& kappa, Number& zeta, const Number& damper, const Number& mass) {
    if (!is_finite(kappa)) return;  // c = 2 zeta (kappa mass)^(1/2); of a rigid stop nothing is left
    kappa = kappa * (T * T / m);
    if (!is_always_zero(damper)) zeta += damper * (T / (2 * m * sqrt(kappa * mass)));
  };
  auto& stops = scene.stops;
  auto& loose = scene.loose;
  for (Restitution<Number>* const law : laws_of(scene)) law->scale_speeds(T);
  const Number one(1);
  soften(stops.stiffness_lower, stops.damping_lower, given.stop_damper_lower, one);
  soften(stops.stiffness_upper, stops.damping_upper, given.stop_damper_upper, one);
  if (has_loose_mass(loose)) {
    const Number reduced = reduced_mass(loose);
    soften(loose.stiffness_lower, loose.damping_lower, given.wall_damper_lower, reduced);
    soften(loose.stiffness_upper, loose.damping_upper, given.wall_damper_upper, reduced);
  }
  scene.start.velocity = scene.start.velocity * T;
  return scene;
}

}  // namespace detail

namespace detail {

/// Makes the force of an oscillator f s, s the sum of the orders that are given, over the sum of their sizes.
template <class Number>
void add_orders(const BasicGivenScene<Number>& given, BasicOscillator<Number>& oscillator) {
  using std::abs, std::cos, std::sin;
  auto& orders = oscillator.shape.orders.of;
  Number sum = abs(oscillator.forcing);
  for (const GivenOrder<Number>& order : given.orders) sum += abs(order.amplitude);
  if (sum == 0) return;
  orders[0].in_phase = oscillator.forcing / sum;
  for (std::size_t i = 1; i < orders.size(); ++i) {
    const auto& [amplitude, phase] = given.orders[i - 1];
    orders[i] = {amplitude * cos(phase) / sum, amplitude * sin(phase) / sum};
  }
  oscillator.forcing = sum;
}

/// Adds the damping that a soft stop has by its restitution; that of 1, which is also that of a stop without one, is 0.
template <class Number>
void damp(const Number& kappa, const Number& restitution, Number& zeta) {
  if (is_finite(kappa) && !is_always_zero(Number(restitution - Number(1)))) zeta += damping_ratio_of(restitution);
}

}  // namespace detail

/// The scene that is computed, in units that may be those of another one. Each number is a formula of those that were
/// given, so derivatives by any key of [scene] or [machine] follow from numbers that carry them.
template <class Number, class Unit>
[[nodiscard]] BasicScene<Number> computed(const BasicGivenScene<Number>& given, const BasicUnits<Unit>& units) {
  using std::tan;
  const bool is_in_own_units = !given.is_si && units == BasicUnits<Unit>{};
  BasicScene<Number> scene = given;
  const bool has_given_orders = scene.oscillator.shape.has_orders() && scene.oscillator.shape.orders.is_zero();
  if (has_given_orders) detail::add_orders(given, scene.oscillator);
  if (!is_always_zero(given.mean_force)) scene.oscillator.load += given.force_factor * given.mean_force;
  if (!is_in_own_units) scene = detail::in_units(std::move(scene), given, units);
  scene.oscillator.forcing = scene.oscillator.forcing * given.force_factor;
  if (is_always_zero(scene.oscillator.forcing)) scene.oscillator.shape = {};  // there is no force
  scene.oscillator.paces_stops = move_by_themselves(scene.stops);
  const auto complete = [](const Number& kinetic, Number& static_level) {  // 0: the static level isn't given
    if (static_level < kinetic || is_always_zero(static_level)) static_level = kinetic;
  };
  complete(scene.friction.kinetic, scene.friction.static_level);
  complete(scene.loose.friction, scene.loose.friction_static);
  detail::damp(scene.stops.stiffness_lower, given.stop_restitution_lower, scene.stops.damping_lower);
  detail::damp(scene.stops.stiffness_upper, given.stop_restitution_upper, scene.stops.damping_upper);
  detail::damp(scene.loose.stiffness_lower, given.wall_restitution_lower, scene.loose.damping_lower);
  detail::damp(scene.loose.stiffness_upper, given.wall_restitution_upper, scene.loose.damping_upper);
  if (is_finite(
          given.start_period)) {  // just after the contact with the lower stop, a quarter of the period from x = 0
    scene.start.displacement = scene.stops.lower;
    scene.start.velocity = scene.stops.upper / tan(given.start_period / 4);
  }
  return scene;
}

/// The scene in its natural units, and these. A machine without a spring has the frequency 1 under a force, as has one
/// whose frequency isn't given; with it the phase goes on where there is no force.
template <class Number>
[[nodiscard]] std::pair<BasicScene<Number>, BasicUnits<Number>> computed(const BasicGivenScene<Number>& given) {
  const BasicUnits<Number> units = natural_units(given);
  BasicScene<Number> scene = computed(given, units);
  const bool is_unit = given.oscillator.stiffness == 0 && has_frequency(given);  // of the time, to rounding
  if (given.is_si && (is_unit || given.oscillator.frequency == 0)) scene.oscillator.frequency = Number(1);
  return {scene, units};
}

namespace detail {

/// The scene on a shaken base as the ground sees it (eq. 69).
template <class Number>
[[nodiscard]] BasicScene<Number> on_the_ground(BasicScene<Number> scene) {
  using std::cos, std::sin;
  const Number theta = scene.start.phase + scene.shaking.phase, &nu = scene.oscillator.frequency;
  scene.start.displacement += scene.shaking.base * sin(theta);
  scene.start.velocity += scene.shaking.base * nu * cos(theta);
  const auto [oscillator, lead] = with_force_on_ground(scene.oscillator, scene.shaking);
  scene.oscillator = oscillator, scene.shaking.lead = lead;
  scene.start.phase += lead;
  return scene;
}

}  // namespace detail

/// The scene in the frame of what is shaken, with the force there in place of the one that was given (eqs. 39 to 41).
/// Stops that move by themselves do so by the phase of that force. With a loose mass, which a moving frame would push,
/// too, it is that of the ground: the shaken base becomes a force.
template <class Number>
[[nodiscard]] BasicScene<Number> in_shaken_frame(BasicScene<Number> scene) {
  if (!is_shaken(scene.shaking) && !move_by_themselves(scene.stops)) return scene;
  if (has_loose_mass(scene.loose)) return detail::on_the_ground(std::move(scene));
  const auto [oscillator, lead] = with_force_in_frame(scene.oscillator, scene.shaking);
  scene.oscillator = oscillator, scene.shaking.lead = lead;
  scene.start.phase += lead;
  for (BasicStopMotion<Number>* const motion : {&scene.stops.motion_lower, &scene.stops.motion_upper})
    motion->phase += scene.shaking.phase - lead;
  return scene;
}

}  // namespace scene
}  // namespace clatter
