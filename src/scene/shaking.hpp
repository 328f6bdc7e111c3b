#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "math/number.hpp"
#include "scene/oscillator.hpp"

namespace clatter {
inline namespace scene {

/// Stops or base that move as b sin(theta + phase), theta = nu tau plus the phase of the force at tau = 0; one of the
/// two at most is not 0.
template <class Number>
struct BasicShaking {
  Number stops{0.0};  ///< amplitude b of both stops, any finite
  Number base{0.0};   ///< amplitude b of the base, which carries the stops, any finite
  Number lead{0.0};   ///< phase of the force in the moving frame less theta, rad; 0 until that force is in place
  Number phase{0.0};  ///< by which the motion leads the force, rad
};
using Shaking = BasicShaking<double>;

template <class Number = double>
[[nodiscard]] constexpr bool is_shaken(const BasicShaking<Number>& shaking) {
  return shaking.stops != 0 || shaking.base != 0;
}

/// A force that leads another phase.
template <class Number>
struct LeadingForce {
  Number amplitude{}, lead{};
};

/// The force of two parts, one in phase and one a quarter of a turn ahead. Without the second it keeps its sign, so
/// that nothing jumps by pi where it passes 0; with derivatives of the second, too, in the same form.
template <class Number>
[[nodiscard]] LeadingForce<Number> leading_force(const Number& in_phase, const Number& quadrature) {
  using std::atan2, std::hypot;
  if (is_always_zero(quadrature)) return {in_phase, Number(0)};
  if (quadrature == Number(0)) return {in_phase, quadrature / in_phase};
  return {hypot(in_phase, quadrature), atan2(quadrature, in_phase)};
}

/// The force on the mass in the frame of what is shaken: f sin(theta) and the inertia of that frame, with moving stops
/// the spring and the damper, too, which don't move with them (eqs. 39, 40 and 61).
template <class Number>
[[nodiscard]] LeadingForce<Number> force_in_frame(const BasicOscillator<Number>& oscillator,
                                                  const BasicShaking<Number>& shaking) {
  using std::cos, std::fma, std::sin;
  const auto& [h, f, nu, load, k, shape, paces] = oscillator;
  const auto& [stops, base, lead, phase] = shaking;
  if (is_always_zero(stops) && is_always_zero(base)) return {f, Number(0)};
  if (!is_always_zero(phase)) {
    const Number P = base * nu * nu - stops * fma(Number(-nu), nu, k), Q = -2 * h * nu * stops;
    return leading_force(Number(f + P * cos(phase) - Q * sin(phase)), Number(P * sin(phase) + Q * cos(phase)));
  }
  const Number with_base = fma(Number(base * nu), nu, f);
  if (is_always_zero(stops)) return {with_base, Number(0)};
  return leading_force(Number(with_base - stops * fma(Number(-nu), nu, k)), Number(-2 * h * nu * stops));
}

/// The force on the mass in the frame of the ground: f sin(theta), and those of the spring and the damper of a base
/// that is shaken (eq. 69).
template <class Number>
[[nodiscard]] LeadingForce<Number> force_on_ground(const BasicOscillator<Number>& oscillator,
                                                   const BasicShaking<Number>& shaking) {
  using std::cos, std::sin;
  const auto& [h, f, nu, load, k, shape, paces] = oscillator;
  const Number along = k * shaking.base, across = 2 * h * nu * shaking.base, &phase = shaking.phase;
  return leading_force(Number(f + along * cos(phase) - across * sin(phase)),
                       Number(along * sin(phase) + across * cos(phase)));
}

/// An oscillator under a force that leads the one that was given.
template <class Number>
struct LeadingOscillator {
  BasicOscillator<Number> oscillator;
  Number lead;
};

/// An oscillator under its force of several orders and a part P sin(theta) + Q cos(theta).
template <class Number>
[[nodiscard]] BasicOscillator<Number> with_part(BasicOscillator<Number> oscillator, const ForceOrder<Number>& part) {
  auto& orders = oscillator.shape.orders.of;
  for (ForceOrder<Number>& order : orders)
    order = {order.in_phase * oscillator.forcing, order.quadrature * oscillator.forcing};
  orders[0] = {orders[0].in_phase + part.in_phase, orders[0].quadrature + part.quadrature};
  oscillator.forcing = oscillator.shape.orders.most_of(0);
  if (oscillator.forcing == 0) return oscillator;
  for (ForceOrder<Number>& order : orders)
    order = {order.in_phase / oscillator.forcing, order.quadrature / oscillator.forcing};
  return oscillator;
}

/// A part P sin + Q cos of a phase that leads theta by another one, which is given by its sine and cosine.
template <class Number>
[[nodiscard]] ForceOrder<Number> leading(const Number& P, const Number& Q, const SineCosine<Number>& by) {
  return {P * by.cosine - Q * by.sine, P * by.sine + Q * by.cosine};
}

/// An oscillator under the force in the frame of what is shaken. One of several orders takes what shakes it as a part
/// of its first order, and keeps its phase.
template <class Number>
[[nodiscard]] LeadingOscillator<Number> with_force_in_frame(BasicOscillator<Number> oscillator,
                                                            const BasicShaking<Number>& shaking) {
  using std::cos, std::sin;
  const auto& [h, f, nu, load, k, shape, paces] = oscillator;
  if (shape.has_orders() && !(is_always_zero(shaking.stops) && is_always_zero(shaking.base))) {
    const Number P = shaking.base * nu * nu - shaking.stops * (k - nu * nu), Q = -2 * h * nu * shaking.stops;
    return {with_part(oscillator, leading(P, Q, SineCosine<Number>{sin(shaking.phase), cos(shaking.phase)})),
            Number(0)};
  }
  const auto [amplitude, lead] = force_in_frame(oscillator, shaking);
  oscillator.forcing = amplitude;
  return {oscillator, lead};
}

/// The same in the frame of the ground.
template <class Number>
[[nodiscard]] LeadingOscillator<Number> with_force_on_ground(BasicOscillator<Number> oscillator,
                                                             const BasicShaking<Number>& shaking) {
  using std::cos, std::sin;
  const auto& [h, f, nu, load, k, shape, paces] = oscillator;
  if (shape.has_orders() && !is_always_zero(shaking.base)) {
    const Number P = k * shaking.base, Q = 2 * h * nu * shaking.base;
    return {with_part(oscillator, leading(P, Q, SineCosine<Number>{sin(shaking.phase), cos(shaking.phase)})),
            Number(0)};
  }
  const auto [amplitude, lead] = force_on_ground(oscillator, shaking);
  oscillator.forcing = amplitude;
  return {oscillator, lead};
}

/// The frame in which displacements and velocities are given: that of what is shaken, or that of the ground.
enum class Frame : std::uint8_t { relative, absolute };

inline constexpr std::array<std::string_view, 2> frame_names{"relative", "absolute"};  ///< in the order of Frame

/// The motion of stops or base during an observed time, b sin(theta + phase): absolute motion less relative motion.
class FrameMotion {
 public:
  /// From the instant at which theta is `theta` (rad); of an oscillator in the moving frame.
  FrameMotion(const Shaking& shaking, const Oscillator& oscillator, double theta)
      : b_(shaking.stops + shaking.base),
        nu_(oscillator.frequency),
        phase_(theta + shaking.phase),
        lead_{std::sin(shaking.lead - shaking.phase), std::cos(shaking.lead - shaking.phase)},
        is_forced_(oscillator.forcing != 0 && !oscillator.paces_stops) {}

  /// The same backwards: relative motion less absolute motion.
  [[nodiscard]] FrameMotion reversed() const {
    FrameMotion other = *this;
    other.b_ = -b_;
    return other;
  }

  [[nodiscard]] double amplitude() const { return std::abs(b_); }
  [[nodiscard]] double frequency() const { return nu_; }
  /// Whether a force is left in the moving frame, so that all arcs keep its phase.
  [[nodiscard]] bool is_forced() const { return is_forced_; }

  /// Sine and cosine of the phase of the motion a time tau after the beginning.
  [[nodiscard]] SineCosine<double> at(double tau) const {
    return {std::sin(nu_ * tau + phase_), std::cos(nu_ * tau + phase_)};
  }
  /// The same from sine and cosine of the phase of the force.
  [[nodiscard]] SineCosine<double> by_force(double sine, double cosine) const {
    return {sine * lead_.cosine - cosine * lead_.sine, cosine * lead_.cosine + sine * lead_.sine};
  }

  [[nodiscard]] double displacement(const SineCosine<double>& at) const { return b_ * at.sine; }
  [[nodiscard]] double velocity(const SineCosine<double>& at) const { return b_ * nu_ * at.cosine; }
  [[nodiscard]] double acceleration(const SineCosine<double>& at) const { return -b_ * nu_ * nu_ * at.sine; }
  [[nodiscard]] double jerk(const SineCosine<double>& at) const { return -b_ * nu_ * nu_ * nu_ * at.cosine; }

  /// Whether that phase passes a quarter turn (0 ... 3, of any whole turn) in a time `length` from `tau` on; at 1 and 3
  /// the displacement turns back, at 0 and 2 the velocity.
  [[nodiscard]] bool passes(int quarter, double tau, double length) const {
    const auto turns = [&](double at) { return (nu_ * at + phase_) / (2 * std::numbers::pi) - quarter / 4.0; };
    return std::floor(turns(tau + length)) > std::floor(turns(tau));
  }

 private:
  double b_, nu_, phase_;
  SineCosine<double> lead_;  ///< of the force over it
  bool is_forced_;
};

}  // namespace scene
}  // namespace clatter
