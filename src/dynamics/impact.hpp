#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "dynamics/flow.hpp"
#include "dynamics/state.hpp"
#include "dynamics/stops.hpp"

namespace clatter {

/// A stop as the mass meets it: place, restitution, and the sign that points into it.
template <class Number>
struct Stop {
  Side side;
  Number place;
  Number restitution;

  [[nodiscard]] Number into(const Number& y) const { return side == Side::upper ? y : Number(-y); }
};

template <class Number>
[[nodiscard]] Stop<Number> stop_at(const Stops& stops, Side side) {
  if (side == Side::upper) return {side, Number(stops.upper), Number(stops.restitution_upper)};
  return {side, Number(stops.lower), Number(stops.restitution_lower)};
}

/// The force that presses a mass at rest into a stop, f sin(theta) + load - x_stop towards it, and the force's rate of
/// change.
template <class Number>
struct Pressing {
  Number force, rate;
};

template <class Number, Effects E>
[[nodiscard]] Pressing<Number> pressing(const Flow<Number, E>& flow, const Stop<Number>& stop,
                                        const SineCosine<Number>& phase) {
  if constexpr (E.forcing == Forcing::none) return {stop.into(flow.load - stop.place), Number(0)};
  return {stop.into(flow.f * phase.sine + (flow.load - stop.place)), stop.into(flow.f * flow.nu * phase.cosine)};
}

/// Whether a stop holds a mass at rest from this instant on. Where the force can't, or can't help to, change the
/// answer, its rounding has no say: at a tangency |f| = |x_stop - load| it would let go of a mass that is always
/// pressed, or hold one that never is.
template <class Number, Effects E>
[[nodiscard]] bool holds(const Flow<Number, E>& flow, const Stop<Number>& stop, const SineCosine<Number>& phase) {
  using std::abs;
  const Number constant = stop.into(flow.load - stop.place);
  if constexpr (E.forcing == Forcing::none) return constant > 0;
  if (constant >= abs(flow.f)) return true;
  if (constant <= -abs(flow.f)) return false;
  const Pressing<Number> press = pressing(flow, stop, phase);
  return press.force > 0 || (press.force == 0 && press.rate > 0);
}

/// Forcing phase, in turns 0 ... 1, at which a stop lets a pressed mass go: f sin(theta) = x_stop - load with the
/// pressing force falling; nothing where the force never falls to 0, or only touches it.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> release_phase(const Flow<Number, E>& flow, const Stop<Number>& stop) {
  using std::abs, std::atan2, std::sqrt;
  const Number needed = stop.place - flow.load, f = flow.f;
  if (E.forcing == Forcing::none || !(abs(needed) < abs(f))) return std::nullopt;
  const Number along =
      sqrt((abs(f) - needed) * (abs(f) + needed));  // |f cos(theta)|; the pressing force falls where into(f cos) < 0
  const Number f_cosine = stop.into(-along);
  const Number turns =
      (f > 0 ? atan2(needed, f_cosine) : atan2(Number(-needed), Number(-f_cosine))) / (2 * pi<Number>());
  return turns < 0 ? Number(turns + 1) : turns;
}

/// What is left of an infinite sequence of impacts: the time to its end, where it may be summed.
///
/// A rebound at speed w under the pressing acceleration a, with da/dt = j, flies for s = 2 q - (4/3) (h + j/a) q^2 +
/// O(q^3), q = w/a, and returns with w [1 - (2/3) (2 h - j/a) q + O(q^2)]. The sum of all flights satisfies S(w, a) = s
/// + S(R w', a + j s), which gives S = A q + B q^2 + O(q^3) with A = 2/(1 - R) and B below (Budd & Dux 1994; Nordmark &
/// Piiroinen 2009). S may be summed when the terms left out, of relative size (S times the rates of the motion)^2,
/// change it by less than rounding does.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> chatter_time(const Flow<Number, E>& flow, const Stop<Number>& stop,
                                                 const Pressing<Number>& press, const Number& rebound) {
  using std::abs, std::max;
  const Number &R = stop.restitution, &a = press.force, &h = flow.h;
  const Number loss = 1 - R;
  if (!(a > 0)) return std::nullopt;
  if (2 * rebound <= a * epsilon<Number>() * flow.period) return Number(0);  // a flight too short to move time on
  if (!(loss > 0)) return std::nullopt;
  const Number slope = press.rate / a, curvature = abs(flow.f) / a * flow.nu * flow.nu, q = rebound / a,
               leading = 2 * q / loss;
  const Number next =
      -(4 * (h + slope) + 4 * R / loss * (2 * h - slope) + 12 * R / loss * slope) / (3 * loss * (1 + R));
  const Number rates = 1 + 2 * h + abs(slope), left_out = leading * leading * (rates * rates + curvature);
  if (!(left_out <= max(epsilon<Number>(), Number(epsilon<Number>() / (leading * flow.rate))))) return std::nullopt;
  return leading + next * q * q;
}

}  // namespace clatter
