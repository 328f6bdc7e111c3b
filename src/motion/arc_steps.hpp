#pragma once

#include <algorithm>
#include <cmath>

#include "motion/arc_constants.hpp"

/// How the constants of an oscillator are made, and the coefficients of a step; included by `arc_constants.hpp`, which
/// declares them.
namespace clatter::motion {

template <class Number, Effects E>
ArcConstants<Number, E>::ArcConstants(Coefficients, const Number& damping, const Number& forcing,
                                      const Number& frequency, const Number& constant_force, const Number& stiffness,
                                      const BasicForceShape<Number>& force_shape)
    : h(damping),
      f(forcing),
      nu(frequency),
      load(constant_force),
      k(1),
      equilibrium(load),
      unbalanced(0),
      shape(force_shape),
      swing(swing_of(shape)),
      natural(1) {
  using std::abs, std::max, std::sqrt;
  if constexpr (E.stiffness) {
    set_stiffness(stiffness);
  } else {
    root = sqrt(abs((1 - h) * (1 + h)));
    fast = h + root;
    slow = 1 / fast;
    if constexpr (E.forcing == Forcing::regular) response = steady_response(h, f, nu);
    rate = max(nu, max(Number(1), Number(2 * h)));
  }
  coarse_root_ = select<Number>(h < natural / 2, natural, root);
  spare_root_ = select<Number>(h < natural / 2, Number(h * h / (natural + root)), Number(0));
  detuning = detuning_of(nu);
  if constexpr (E.stiffness && E.forcing != Forcing::none) {
    is_together_ = is_in_pieces() || (E.forcing == Forcing::secular && shape.is_sine() && is_resonant(detuning));
    if (!is_together_) response = response_to(Number(k - nu * nu), h, f, nu);
  }
  response_speed = nu * response.amplitude;
  period = 2 * pi<Number>() / nu;
  if (has_orders()) respond_to_orders();
  if (swing > 0 && is_in_pieces())
    of_swing = response_to(Number(k - swing * nu * swing * nu), h, f, Number(swing * nu));
  derivative_bounds = bounds();
}

template <class Number, Effects E>
void ArcConstants<Number, E>::set_stiffness(const Number& stiffness) {
  using std::abs, std::max, std::sqrt;
  k = stiffness;
  const bool sprung = k < 0 || k > 0;
  natural = sprung ? Number(sqrt(abs(k))) : Number(0);
  equilibrium = sprung ? Number(load / k) : Number(0);
  unbalanced = sprung ? Number(0) : load;
  balance = equilibrium;
  root = k > 0 ? Number(sqrt(abs((natural - h) * (natural + h)))) : norm(h, natural);
  if (!sprung && h > 0 && !is_always_zero(k)) root = sqrt(h * h - k);  // of k only the derivatives count
  if (E.damping == Damping::light && !(root > 0)) root = epsilon<Number>() * natural;  // h^2 < k by rounding alone
  fast = h + root;
  slow = sprung || (fast > 0 && !is_always_zero(k)) ? Number(k / fast) : Number(0);
  Number quickest = is_in_pieces() ? max(nu, Number(swing * nu)) : nu;
  if (has_orders()) quickest *= static_cast<double>(shape.orders.highest());
  rate = max(quickest, max(natural, Number(k > 0 ? 2 * h : fast)));
}

template <class Number, Effects E>
Propagator<Number> ArcConstants<Number, E>::propagator(const Number& s) const {
  using std::abs, std::cos, std::exp, std::expm1, std::sin;
  if constexpr (CarriesDerivatives<Number> && E.damping != Damping::none) {
    const Number square = (k > 0 ? (h - natural) * (h + natural) : h * h - k) * s * s;
    if (abs(square) <= Number(near_critical)) {
      Propagator<Number> free = near_critical_propagator(h, k, s, square);
      free.a_minus_one = is_short(s) ? short_a_minus_one(s) : Number(free.a - 1);
      return free;
    }
  }
  if constexpr (E.damping == Damping::none) {
    const Number half = sin(s / 2), b = 2 * half * cos(s / 2), a_minus_one = -2 * half * half;
    return {1 + a_minus_one, b, 1 + a_minus_one, b, a_minus_one};
  } else if constexpr (E.damping == Damping::light) {
    // a long arc turns by more than one angle can hold, so the digits that the difference of the two products loses are
    // added again
    const Number coarse = coarse_root_ * s, spare = spare_root_ * s;
    const Number angle = coarse - spare, lost = (coarse - angle) - spare;
    const Number sine = sin(angle / 2), cosine = cos(angle / 2);
    const Number half = sine + lost / 2 * cosine, other = cosine - lost / 2 * sine;
    const Number cosine_minus_one = -2 * half * half;
    Propagator<Number> free = light_propagator<Number>(exp(-h * s), 1 + cosine_minus_one, 2 * half * other / root, h);
    if constexpr (E.stiffness) free.d = mul_add(h + h, free.c, k * free.b);
    free.a_minus_one = s * natural <= Number(0.25)
                           ? short_a_minus_one(s)
                           : expm1(-h * s) * (1 + cosine_minus_one) + cosine_minus_one + h * free.b;
    return free;
  } else {
    const Number slow_decay = exp(-slow * s), fast_decay = exp(-fast * s), spread = 2 * root * s;
    const Number b =
        slow_decay * select<Number>(spread > 0, -expm1(-spread) / (2 * root), s);  // root = 0: critical damping
    const Number d = 2 * h * fast_decay - slow * slow * b;                         // 2 h slow - k = slow^2
    const Number a_minus_one = is_short(s) ? short_a_minus_one(s) : Number(expm1(-slow * s) + slow * b);
    return {slow_decay + slow * b, b, fast_decay - slow * b, d, a_minus_one};
  }
}

/// Whether a time is short for the oscillator of heavy damping.
template <class Number, Effects E>
bool ArcConstants<Number, E>::is_short(const Number& s) const {
  return 8 * h * s <= 1 && (!E.stiffness || 4 * natural * s <= 1);
}

/// A(s) - 1 for a time that is short for the oscillator, though perhaps not for a fast force, by the Taylor series: the
/// closed form is a difference of terms 1/s times larger.
template <class Number, Effects E>
Number ArcConstants<Number, E>::short_a_minus_one(const Number& s) const {
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 13 : 36;  // (1/4)^n / n! below rounding
  Number before = 0, last = -spring(s * s) / 2, sum = last;                   // of s^n A^(n)(0) / n!
  for (int n = 3; n < terms; ++n) {
    const Number next = -(spring(s * s * before) + 2 * h * s * (n - 1) * last) / (n * (n - 1));
    sum += next, before = last, last = next;
  }
  return sum;
}

template <class Number, Effects E>
Step<Number> ArcConstants<Number, E>::step(const Number& s) const {
  using std::exp;
  Step<Number> step{propagator(s)};
  if constexpr (E.forcing != Forcing::none) step.turn = turn(s);
  if (is_in_pieces()) {
    respond_in_piece(s, step);
  } else if (has_orders()) {
    if constexpr (E.damping != Damping::heavy)
      if (resonant > 0) respond_from_rest(s, beat_of(Number(nu * static_cast<double>(resonant)), s), step);
  } else if constexpr (E.forcing == Forcing::secular) {
    if (forms_together()) respond_from_rest(s, {nu, detuning, step.turn}, step);
  }
  if constexpr (E.damping == Damping::heavy) step.fast_decay = exp(-fast * s);
  if constexpr (E.stiffness)
    if (!is_always_zero(unbalanced)) step.pulled = pulled(s);
  return step;
}

/// Displacement a time s after rest under a unit force that no spring balances (eq. 45).
template <class Number, Effects E>
Number ArcConstants<Number, E>::pulled(const Number& s) const {
  if constexpr (CarriesDerivatives<Number>)
    if (!is_always_zero(k)) return pulled_by_no_spring(h, k, s);
  return s * s * second_divided_decay(Number(2 * h * s));
}

/// Displacements a time s after rest under a unit force, and under one that grows from 0 (eq. 91).
template <class Number, Effects E>
Ramp<Number> ArcConstants<Number, E>::ramp(const Number& s, const Propagator<Number>& free) const {
  if constexpr (E.damping != Damping::heavy)
    return natural * s <= 1 ? ramp_by_series(h, k, s) : ramp_by_spring(h, k, s, free);
  if (slow * s > 1) return ramp_by_spring(h, k, s, free);
  return 2 * root * s > 1 ? ramp_by_modes(slow, fast, root, s) : ramp_by_series(h, k, s);
}

/// Displacement and velocity a time s after rest in a piece of the force whose value, or slope by the phase, is 1.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_in_piece(const Number& s, Step<Number>& step) const {
  if (swing == 0) {
    const Ramp<Number> of = ramp(s, step.free);
    step.displacement = {of.constant, nu * of.growing};
    step.velocity = {step.free.b, nu * of.constant};
    return;
  }
  const Beat beat = beat_of(Number(swing * nu), s);
  if constexpr (E.damping == Damping::heavy)
    respond_away_from_resonance(beat, step);
  else
    respond_from_rest(s, beat, step);
  step.displacement.cosine = step.displacement.cosine / swing, step.velocity.cosine = step.velocity.cosine / swing;
}

/// Displacement and velocity a time s after rest under a unit force sin(phase): Im(e^{i phase} w(s)) with w of eq. 11,
/// which has no difference of large numbers.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_from_rest(const Number& s, const Beat& beat, Step<Number>& step) const {
  using std::cos, std::exp, std::sin;
  const auto& [frequency, off, turn] = beat;
  if (!is_resonant(off)) return respond_away_from_resonance(beat, step);
  const Number lambda = root, c = cos(frequency * s), d = sin(frequency * s);
  const auto [q_re, q_im] = divided_exponential<Number>(-h * s, -off * s);
  const Number near_re = s * (c * q_re - d * q_im), near_im = s * (c * q_im + d * q_re);  // E(mu)
  const Number decay = exp(-h * s), top_re = c - decay * cos(lambda * s), top_im = d + decay * sin(lambda * s);
  const Number sum = frequency + lambda, square = h * h + sum * sum;
  const Number far_re = (top_re * h + top_im * sum) / square, far_im = (top_im * h - top_re * sum) / square;  // E(mu*)
  const Number minus_re = near_re - far_re, minus_im = near_im - far_im, plus_re = near_re + far_re,
               plus_im = near_im + far_im;
  const Number w_re = minus_im / (2 * lambda), w_im = -minus_re / (2 * lambda);
  step.displacement = {w_re, w_im};
  step.velocity = {plus_re / 2 - h * w_re, plus_im / 2 - h * w_im};  // [mu E(mu) - mu* E(mu*)]/(2 i lambda)
}

/// The same by the steady response and the free motion that it leaves, w = (P + iQ)(e^{i nu s} - A - i nu B) with eqs.
/// 7 and 44: eq. 11 is a difference of numbers 1/lambda times larger, which is much near critical damping.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_away_from_resonance(const Beat& beat, Step<Number>& step) const {
  const Propagator<Number>& free = step.free;
  const auto& [frequency, off, turn] = beat;
  const Response<Number> unit = response_to(Number(k - frequency * frequency), h, Number(1), frequency);
  const auto times_unit = [&](const Number& re, const Number& im) -> SineCosine<Number> {
    return {unit.in_phase * re - unit.quadrature * im, unit.in_phase * im + unit.quadrature * re};
  };
  step.displacement = times_unit(turn.cosine_minus_one - free.a_minus_one, turn.sine - frequency * free.b);
  step.velocity = times_unit(k * free.b - frequency * turn.sine, frequency * (1 + turn.cosine_minus_one - free.c));
}

}  // namespace clatter::motion
