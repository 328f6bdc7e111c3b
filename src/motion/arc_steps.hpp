#pragma once

#include <cmath>

#include "motion/arc_constants.hpp"

/// The coefficients of a step of an arc; included by `arc_constants.hpp`, which declares them.
namespace clatter::motion {

template <class Number, Effects E>
Step<Number> ArcConstants<Number, E>::step(const Number& s) const {
  using std::exp;
  Step<Number> step{propagator(s)};
  if constexpr (E.forcing != Forcing::none) step.turn = turn(s);
  if (is_in_pieces())
    respond_in_piece(s, step);
  else if constexpr (E.forcing == Forcing::secular)
    respond_from_rest(s, {nu, detuning, step.turn}, step);
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
  const Number frequency = swing * nu;
  const Beat beat{frequency, (frequency - natural) + h * h / (natural + root), turn_by(Number(frequency * s))};
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
  const Number least = secular_distance * natural;  // sets of all effects serve scenes away from resonance, too
  if (!(h * h + off * off < least * least)) return respond_away_from_resonance(beat, step);
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
