#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "motion/contact_force.hpp"
#include "scene/scene.hpp"

namespace clatter::motion {

/// Duration of the infinite sequence of impacts that a rebound begins, and a bound of its error (eqs. 24 and 25).
template <class Number>
struct ChatterSum {
  Number time, bound;
};

/// Sums the flights of a chatter with pressing acceleration a > 0 at the rebound (Budd & Dux 1994; Nordmark &
/// Piiroinen 2009, carried one order further): S = T - (h + j/a) T^2/3 (eqs. 23 and 24), the error bounded by
/// (r^2 + c) T^3 (eq. 25), which leaves room for all later terms while r T is small; by eq. 88 if R depends on the
/// speed.
template <class Number, Effects E>
[[nodiscard]] ChatterSum<Number> chatter_sum(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                             const ContactForce<Number>& press, const Number& rebound) {
  using std::abs;
  const Number &a = press.force, &h = constants.h, R = stop.law.share_at_rest();
  const Number slope = press.rate / a, bend = abs(constants.f) / a * constants.nu * constants.nu * constants.sharpest();
  const Number time = 2 * (rebound / a) / (1 - R), rates = constants.natural + 2 * h + abs(slope);
  if (stop.law.is_constant())
    return {time - (h + slope) * time * time / 3, (rates * rates + bend) * time * time * time};
  const Number by_speed = stop.law.at_rest().slope * a, fast = rates + abs(by_speed);
  return {time - ((h + slope) / 3 - by_speed / (2 * (1 + R))) * time * time, (fast * fast + bend) * time * time * time};
}

/// The same under a restitution 1 - C v^p of viscoelastic bodies, by which the speeds of a chatter fall more slowly
/// than those of a series (eq. 89).
template <class Number, Effects E>
[[nodiscard]] ChatterSum<Number> viscoelastic_chatter_sum(const ArcConstants<Number, E>& constants,
                                                          const Stop<Number>& stop, const ContactForce<Number>& press,
                                                          const Number& rebound) {
  using std::abs, std::exp, std::log;
  const Number &a = press.force, &h = constants.h, &w = rebound, &p = stop.law.exponent;
  const Number taken = (1 - stop.law.R) * exp(p * log(Number(w / stop.law.reference)));  // C w^p
  const Number first = 2 * (w / a) / (taken * (1 - p)), slope = press.rate / a;
  const Number by_speed =
      (w / a) * (p + p * taken / 3 + p * (1 + p) * (2 + 3 * p) * taken * taken / (12 * (1 + 2 * p)));
  const Number rates = constants.natural + 2 * h + abs(slope), square = first * first,
               bend = abs(constants.f) / a * constants.nu * constants.nu * constants.sharpest();
  return {first - by_speed - ((1 - p) * h / 3 + (2 + p) * slope / 6) * square,
          taken * taken * taken * (w / a) + (rates * taken + (rates * rates + bend) * first) * square};
}

/// The same under friction mu < a, of which a rebound with speed w takes R ((a - mu)/(a + mu))^(1/2) to the next one:
/// S = S1 w + S2 w^2 (eq. 63), by the flights' expansions up and down and S(w, a) = flight + S(next w, next a).
template <class Number, Effects E>
[[nodiscard]] ChatterSum<Number> rubbing_chatter_sum(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                     const ContactForce<Number>& press, const Number& mu,
                                                     const Number& rebound) {
  using std::abs, std::sqrt;
  const Number &a = press.force, &j = press.rate, &h = constants.h, &w = rebound;
  const Number up = a + mu, down = a - mu, fall = 1 / sqrt(up * down);  // the times of a flight are w/up and w fall
  const Number height = -(j / (6 * up) + 2 * h / 3) / (up * up);        // of w^3 in that of the peak
  const Number fall2 =
      (height - j * fall * fall / (2 * up) - (j - 2 * h * down) * fall * fall * fall / 6) / (down * fall);
  const Number ratio = stop.law.share_at_rest() * sqrt(down / up),
               ratio2 = stop.law.share_at_rest() * (down * fall2 + j * fall / up + (j / 2 - h * down) * fall * fall);
  const Number flight = 1 / up + fall, flight2 = fall2 - (j / (2 * up) + h) / (up * up);
  const Number flight_by_a = -1 / (up * up) - a * fall * fall * fall, ratio_by_a = ratio * mu * fall * fall;
  const Number sum = flight / (1 - ratio);
  const Number sum_by_a = (flight_by_a + sum * ratio_by_a) / (1 - ratio);
  const Number sum2 = (flight2 + sum * ratio2 + sum_by_a * j * flight * ratio) / ((1 - ratio) * (1 + ratio));
  const Number time = sum * w, rates = constants.natural + 2 * h + abs(j) / down,
               bend = abs(constants.f) / down * constants.nu * constants.nu * constants.sharpest();
  return {time + sum2 * w * w, (rates * rates + bend) * time * time * time};
}

/// The displacements that motion beside a stop has, by which the rebounds of its chatter count as high: those that the
/// force makes, |f| / max(|k|, 2 h nu, nu^2); without a force those of the start, |x0 - x_stop| and the height to which
/// its speed carries the mass. Never more than the distance between the stops. It is the same wherever stop and mass
/// are, and for all starts of a forced scene, whose steady motion must not depend on them.
template <class Number = double>
[[nodiscard]] double displacements_beside(const BasicScene<Number>& given, Side side) {
  const Scene scene = with_numbers<double>(given);
  const Oscillator& o = scene.oscillator;
  const double gap = scene.stops.upper - scene.stops.lower, k = std::abs(o.stiffness);
  if (o.forcing != 0)
    return std::min(gap, std::abs(o.forcing) / std::max({k, 2 * o.damping * o.frequency, o.frequency * o.frequency}));
  const double stop = side == Side::upper ? scene.stops.upper : scene.stops.lower;
  const double away = std::abs(scene.start.displacement - stop), speed = std::abs(scene.start.velocity);
  if (speed == 0) return std::min(gap, away);
  return std::min(gap, away + std::min({speed * (speed / (2 * std::abs(constant_force(o, stop)))), speed / std::sqrt(k),
                                        speed / (2 * o.damping)}));
}

/// The share of those displacements below which a rebound is too low to be observed. In 50 digits, the reference for
/// double, it lies below all that a double can tell; beyond R = 0.99 higher, or there would be millions of impacts.
template <class Number>
[[nodiscard]] Number low_rebound(double R) {
  if constexpr (std::numeric_limits<Number>::digits10 <= std::numeric_limits<double>::digits10) return Number(1e-12);
  return Number(R > 0.99 ? 1e-30 : 1e-40);
}

/// Which chatter is summed: that of rebounds which are lower than a share of the displacements of the scene, if the sum
/// has an accuracy.
template <class Number>
struct ChatterRule {
  std::array<Number, 2> low;  ///< [stop]: the share
  Number accuracy = epsilon<Number>();

  template <class Given = double>
  [[nodiscard]] static ChatterRule of(const BasicStops<Given>& stops) {
    const auto low = [&](Side side) {
      return low_rebound<Number>(static_cast<double>(law_of(stops, side).share_at_rest()));
    };
    // by a power of the speed, the accuracy of 50 digits takes millions of impacts
    if (law_of(stops, Side::lower).is_power() || law_of(stops, Side::upper).is_power()) return as_in_double();
    return {{low(Side::lower), low(Side::upper)}};
  }
  /// As double sums it, for more digits: enough if the mass is then held, since a rest doesn't depend on its beginning.
  [[nodiscard]] static ChatterRule as_in_double() {
    return {{low_rebound<double>(0), low_rebound<double>(0)}, epsilon<double>()};
  }
};

/// The time to the end of an infinite sequence of impacts, if nothing that is observed can tell the sum from its
/// impacts: the rebound is not higher than `low`, and the bound of the sum's error (eq. 25) is below an accuracy, that
/// of a number unless it is given, of the sum, or of a time on the scale of the fastest motion.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> chatter_time(const ArcConstants<Number, E>& constants, const Stop<Number>& stop,
                                                 const ContactForce<Number>& press, const Number& rebound,
                                                 const Number& low, const Number& accuracy = epsilon<Number>()) {
  using std::max;
  if (!(press.force > 0)) return std::nullopt;
  if (2 * rebound <= press.force * epsilon<Number>() * constants.period) return Number(0);  // too short to advance time
  if (!stop.law.loses() || rebound * (rebound / press.force) > 2 * low) return std::nullopt;
  if (2 * rebound > stop.law.at_rest().end) return std::nullopt;  // faster impacts are to come than it holds for
  const ChatterSum<Number> sum = stop.law.is_power() ? viscoelastic_chatter_sum(constants, stop, press, rebound)
                                                     : chatter_sum(constants, stop, press, rebound);
  return sum.bound <= accuracy * max(sum.time, Number(1 / constants.rate)) ? std::optional<Number>(sum.time)
                                                                           : std::nullopt;
}

/// The same under friction. If the pressing force falls to the static level meanwhile, the mass may stick off the stop,
/// and nothing is summed.
template <class Number, Effects E>
[[nodiscard]] std::optional<Number> rubbing_chatter_time(const ArcConstants<Number, E>& constants,
                                                         const Stop<Number>& stop, const ContactForce<Number>& press,
                                                         const Number& kinetic, const Number& static_level,
                                                         const Number& rebound, const Number& low,
                                                         const Number& accuracy) {
  using std::abs, std::max, std::sqrt;
  if (!(press.force > static_level)) return std::nullopt;
  const Number up = press.force + kinetic, flight = rebound / up + rebound / sqrt(up * (press.force - kinetic));
  if (flight <= epsilon<Number>() * constants.period) return Number(0);  // too short to advance time
  if (rebound * (rebound / press.force) > 2 * low || !stop.law.is_constant()) return std::nullopt;
  const ChatterSum<Number> sum = rubbing_chatter_sum(constants, stop, press, kinetic, rebound);
  if (!(sum.time > 0) || !(sum.bound <= accuracy * max(sum.time, Number(1 / constants.rate)))) return std::nullopt;
  const Number falls =
      (abs(press.rate) + abs(constants.f) * constants.nu * constants.nu * constants.sharpest() * sum.time) * sum.time;
  return press.force - falls > static_level ? std::optional<Number>(sum.time) : std::nullopt;
}

}  // namespace clatter::motion
