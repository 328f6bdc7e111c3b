#pragma once

#include <cmath>
#include <optional>

#include "motion/arc_constants.hpp"
#include "scene/stops.hpp"

namespace clatter::motion {

/// One stop: its position, its law of restitution, and the sign that points into it.
template <class Number>
struct Stop {
  Side side;
  Number position;
  Restitution<Number> law;

  [[nodiscard]] Number into(const Number& y) const { return side == Side::upper ? y : Number(-y); }
};

template <class Number, class Given = double>
[[nodiscard]] Stop<Number> stop_at(const BasicStops<Given>& stops, Side side) {
  return {side, Number(side == Side::upper ? stops.upper : stops.lower), restitution_at<Number>(stops, side)};
}

/// The force that presses a mass at rest into a stop (eq. 22), positive into it, and its rate of change.
template <class Number>
struct ContactForce {
  Number force, rate;
};

template <class Number, Effects E>
[[nodiscard]] ContactForce<Number> contact_force(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                 const SineCosine<Number>& phase) {
  if constexpr (E.forcing == Forcing::none) return {stop.into(constants.constant_force(stop.position)), Number(0)};
  const auto [s, slope] = constants.drive(phase);
  return {stop.into(constants.f * s + constants.constant_force(stop.position)),
          stop.into(constants.f * constants.nu * slope)};
}

/// Whether a stop holds a mass at rest from this instant on. Decided without the force if it can't change the answer:
/// at a tangency |f| = |k x_stop - load| its rounding would release a mass that is always pressed, or hold one that
/// never is.
template <class Number, Effects E>
[[nodiscard]] bool holds(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                         const SineCosine<Number>& phase) {
  using std::abs;
  const Number constant = stop.into(constants.constant_force(stop.position));
  if constexpr (E.forcing == Forcing::none) return constant > 0;
  if (constant <= -abs(constants.f)) return false;
  if (constant >= abs(constants.f)) return true;
  const ContactForce<Number> press = contact_force(constants, stop, phase);
  return press.force > 0 || (press.force == 0 && press.rate > 0);
}

/// Forcing phase, in turns 0 ... 1, at which f sin(theta) passes a value, on its way to a side; nothing if it never
/// does, or only touches it. Of a force in pieces within that of the phase `from`, of a sum of sines next after it.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> phase_of_force(const ArcConstants<Number, E>& constants, const Number& needed,
                                                   Side side, const Number& from) {
  using std::abs, std::atan2, std::sqrt;
  const Number& f = constants.f;
  if (constants.is_in_pieces()) return phase_of_shape(constants.shape, f, needed, side == Side::upper, from);
  if (constants.has_orders()) return phase_of_orders(constants.shape.orders, f, needed, side == Side::upper, from);
  if (E.forcing == Forcing::none || !(abs(needed) < abs(f))) return std::nullopt;
  // |cos(theta)|, over |f| so that no square vanishes
  const Number size = abs(f), along = sqrt((size - needed) / size * ((size + needed) / size));
  const Number sine = needed / size, cosine = side == Side::upper ? along : Number(-along);
  const Number turns = (f > 0 ? atan2(sine, cosine) : atan2(Number(-sine), Number(-cosine))) / (2 * pi<Number>());
  return turns < 0 ? Number(turns + 1) : turns;
}

/// Forcing phase, in turns 0 ... 1, at which a stop releases a pressed mass (eq. 26); nothing if the pressing force
/// never falls to 0, or only touches it; by the phase `from` as `phase_of_force`.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> release_phase(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                  const Number& from = Number(0)) {
  return phase_of_force(constants, Number(constants.spring(stop.position) - constants.load), opposite(stop.side), from);
}

}  // namespace clatter::motion
