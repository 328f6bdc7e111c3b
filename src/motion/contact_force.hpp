#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/restitution.hpp"
#include "model/stops.hpp"
#include "motion/arc_constants.hpp"
#include "motion/state.hpp"

namespace clatter::motion {

/// A stop as the mass meets it: its position, its law of restitution, and the sign that points into it.
template <class Number>
struct Stop {
  Side side;
  Number position;
  Restitution<Number> law;

  [[nodiscard]] Number into(const Number& y) const { return side == Side::upper ? y : Number(-y); }
};

template <class Number>
[[nodiscard]] Stop<Number> stop_at(const Stops& stops, Side side) {
  if (side == Side::upper) return {side, Number(stops.upper), {Number(stops.restitution_upper)}};
  return {side, Number(stops.lower), {Number(stops.restitution_lower)}};
}

/// The force that presses a mass at rest into a stop, f sin(theta) + load - x_stop towards it, and the force's rate of
/// change.
template <class Number>
struct ContactForce {
  Number force, rate;
};

template <class Number, Effects E>
[[nodiscard]] ContactForce<Number> contact_force(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                 const SineCosine<Number>& phase) {
  if constexpr (E.forcing == Forcing::none) return {stop.into(constants.load - stop.position), Number(0)};
  return {stop.into(constants.f * phase.sine + (constants.load - stop.position)),
          stop.into(constants.f * constants.nu * phase.cosine)};
}

/// Whether a stop holds a mass at rest from this instant on. Where the force can't, or can't help to, change the
/// answer, its rounding has no say: at a tangency |f| = |x_stop - load| it would let go of a mass that is always
/// pressed, or hold one that never is.
template <class Number, Effects E>
[[nodiscard]] bool holds(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                         const SineCosine<Number>& phase) {
  using std::abs;
  const Number constant = stop.into(constants.load - stop.position);
  if constexpr (E.forcing == Forcing::none) return constant > 0;
  if (constant <= -abs(constants.f)) return false;
  if (constant >= abs(constants.f)) return true;
  const ContactForce<Number> press = contact_force(constants, stop, phase);
  return press.force > 0 || (press.force == 0 && press.rate > 0);
}

/// Forcing phase, in turns 0 ... 1, at which a stop lets a pressed mass go: f sin(theta) = x_stop - load with the
/// pressing force falling; nothing where the force never falls to 0, or only touches it.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> release_phase(const ArcConstants<Number, E>& constants, const Stop<Number>& stop) {
  using std::abs, std::atan2, std::sqrt;
  const Number needed = stop.position - constants.load, f = constants.f;
  if (E.forcing == Forcing::none || !(abs(needed) < abs(f))) return std::nullopt;
  // over |f|, so that no square vanishes: |cos(theta)|; the pressing force falls where into(f cos) < 0
  const Number size = abs(f), along = sqrt((size - needed) / size * ((size + needed) / size));
  const Number sine = needed / size, cosine = stop.into(-along);
  const Number turns = (f > 0 ? atan2(sine, cosine) : atan2(Number(-sine), Number(-cosine))) / (2 * pi<Number>());
  return turns < 0 ? Number(turns + 1) : turns;
}

/// An infinite sequence of impacts that a rebound begins: its duration, summed, and how far the sum may be off.
template <class Number>
struct ChatterSum {
  Number time, bound;
};

/// Sums the flights of a chatter whose pressing acceleration is a > 0 at the rebound (Budd & Dux 1994; Nordmark &
/// Piiroinen 2009, carried one order further).
///
/// A rebound at speed w flies for s = 2 q - (4/3) (h + j/a) q^2 + O(q^3), q = w/a, j = da/dt, and returns with
/// w [1 - (2/3) (2 h - j/a) q + O(q^2)]. The sum satisfies S(w, a) = s + S(R w', a + j s), so with T = 2 q/(1 - R)
///   S = T - (h + j/a) T^2/3 + (8 (1 + R^2) h^2 + (10 + 12 R + 10 R^2) h j/a + (8 + 12 R + 8 R^2) (j/a)^2
///       - 3 (1 + R)^2 a''/a - 3 (1 - R)^2) T^3/(36 (1 + R + R^2)) + ...
/// For every R the third term is below 0.27 (r^2 + c) T^3, r = 1 + 2 h + |j/a|, c = max |a''|/a. The bound takes
/// (r^2 + c) T^3: what that leaves over holds all later terms, each smaller by a factor of order r T, while r T is
/// small.
template <class Number, Effects E>
[[nodiscard]] ChatterSum<Number> chatter_sum(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                             const ContactForce<Number>& press, const Number& rebound) {
  using std::abs;
  const Number &a = press.force, &h = constants.h;
  const Number slope = press.rate / a, bend = abs(constants.f) / a * constants.nu * constants.nu;
  const Number time = 2 * (rebound / a) / (1 - stop.law.R), rates = 1 + 2 * h + abs(slope);
  return {time - (h + slope) * time * time / 3, (rates * rates + bend) * time * time * time};
}

/// What is left of an infinite sequence of impacts: the time to its end, once the bound of what its sum leaves out is
/// below the rounding of the sum, or of a time on the scale of the fastest motion.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> chatter_time(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                 const ContactForce<Number>& press, const Number& rebound) {
  using std::max;
  if (!(press.force > 0)) return std::nullopt;
  if (2 * rebound <= press.force * epsilon<Number>() * constants.period) return Number(0);  // too short to move time on
  if (!(stop.law.R < 1)) return std::nullopt;
  const ChatterSum<Number> sum = chatter_sum(constants, stop, press, rebound);
  const Number rounding = epsilon<Number>() * max(sum.time, Number(1 / constants.rate));
  return sum.bound <= rounding ? std::optional<Number>(sum.time) : std::nullopt;
}

}  // namespace clatter::motion
