#include "branches/walk/ceasing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "branches/equations/push_of_orders.hpp"

namespace clatter::branches {
namespace {

constexpr double turn = 2 * std::numbers::pi;

template <class Number>
PushOfOrders<Number> push_of_orders(const SceneNumbers<Number>& p, Side side) {
  return {p.oscillator.forcing, p.oscillator.shape.orders, side};
}

/// The phase near another one at which the force pushes the most to a side.
double crest_near(const SceneNumbers<double>& p, Side side, double phase) {
  if (p.oscillator.shape.has_orders()) return push_of_orders(p, side).highest_crest_near(phase);
  const LeadingForce<double> force = p.force();
  const double crest = (sign_of(side) * force.amplitude > 0 ? turn : -turn) / 4 - force.lead;
  return crest + turn * std::round((phase - crest) / turn);
}
/// The most that it pushes.
template <class Number>
Number most_to(const SceneNumbers<Number>& p, Side side) {
  using std::abs;
  if (p.oscillator.shape.has_orders()) {
    const PushOfOrders<Number> push = push_of_orders(p, side);
    return push.at(Number(push.highest_crest_near(0)))[0];
  }
  return abs(p.force().amplitude);
}

/// The mass at rest where the spring is, if there is one: so that the most of the push to one side is as strong there
/// as that to the other.
Orbit at_rest(const FollowedScene& scene, Orbit orbit) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const double balance = (most_to(p, Side::lower) - most_to(p, Side::upper)) / 2;
  const Orbit slipping = orbit;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitEvent& stick = orbit.events[i];
    stick.phase = crest_near(p, slipping.heading_before(i), stick.phase);
    const Side stop = stick.held_by();
    const double k = p.oscillator.stiffness + (stop == Side::none ? 0.0 : p.soft_stop(stop).stiffness);
    if (k == 0) continue;
    stick.place = ((stop == Side::none ? 0.0 : p.standing_force(p.middle(), stop)) - balance) / k;
  }
  return orbit;
}

}  // namespace

Crest crest_after(const SceneNumbers<double>& p, const OrbitEvent& halt, Side side) {
  if (p.oscillator.shape.has_orders()) {
    const double level =
        p.friction.static_level - sign_of(side) * p.standing_force(p.middle() + halt.place, halt.held_by());
    const PushOfOrders<double> push = push_of_orders(p, side);
    const double phase = halt.phase + push.hold_to_crest(halt.phase, level);
    const auto [height, slope, bend] = push.at(phase);
    return {phase, height, -bend};
  }
  const double crest = crest_near(p, side, halt.phase), f = std::abs(p.force().amplitude);
  return {crest < halt.phase ? crest + turn : crest, f, f};
}

double fall_near(const SceneNumbers<double>& p, Side side, double phase, double level) {
  if (p.oscillator.shape.has_orders()) {
    const PushOfOrders<double> push = push_of_orders(p, side);
    const double fall = push.fall_near(phase, level);
    return std::isfinite(fall) ? fall : push.highest_crest_near(phase);
  }
  return crest_near(p, side, phase) + std::acos(std::clamp(level / std::abs(p.force().amplitude), -1.0, 1.0));
}

std::optional<ExactGraze> where_motion_ceases(const OrbitEquations& equations, FollowedScene near, const Orbit& orbit,
                                              double within) {
  constexpr int most_iterations = 20;
  const auto& [parameter, unit] = equations.axes().front();
  const double guess = value_of(near, parameter);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const SceneNumbers<Along> p = numbers_along(near, parameter);
    const Along left = p.friction.static_level - (most_to(p, Side::lower) + most_to(p, Side::upper)) / 2;
    const double step = -left.value / left.slope[0], value = value_of(near, parameter);
    if (!std::isfinite(step)) return std::nullopt;
    near = changed(near, parameter, value + step);
    if (!(std::abs(step) <= 1e-12 * unit)) continue;
    if (!(std::abs(value + step - guess) <= within * unit)) return std::nullopt;
    return ExactGraze{near, at_rest(near, orbit)};
  }
  return std::nullopt;
}

}  // namespace clatter::branches
