#pragma once

#include <cmath>

#include "motion/arc_constants.hpp"

/// How a force of any shape moves an arc; included by `arc_constants.hpp`, which declares it.
namespace clatter::motion {

template <class Number, Effects E>
SineCosine<Number> ArcConstants<Number, E>::most_of_shape(const Motion<Number>& m, const Number& span) const {
  using std::abs;
  if (!is_in_pieces()) return {Number(1), steepest()};
  if (swing == 0) return {abs(m.sine) + abs(m.cosine) * nu * span, abs(m.cosine)};
  const Number size = norm(m.sine, Number(m.cosine / swing));
  return {size, swing * size};
}

template <class Number, Effects E>
FreeMotion<Number> ArcConstants<Number, E>::response_in_piece(const Motion<Number>& m) const {
  if (swing > 0) {
    const Number sine = m.sine, cosine = m.cosine / swing;
    return {of_swing.displacement(sine, cosine), of_swing.velocity(Number(swing * nu), sine, cosine)};
  }
  const Number v = f * nu * m.cosine / k;
  return {(f * m.sine - 2 * h * v) / k, v};
}

template <class Number, Effects E>
template <std::size_t count>
DerivativeBounds<Number, count> ArcConstants<Number, E>::bounds() const {
  auto all = motion::derivative_bounds<count>(equation(), natural);
  if (!has_orders()) return all;
  all.forced = {};
  if (resonant > 0) {
    Equation of_order = equation();
    of_order.nu *= static_cast<double>(resonant);
    all.forced = motion::derivative_bounds<count>(of_order, natural).forced;
    for (Number& bound : all.forced) bound *= shape.orders.size(resonant);
  }
  return all;
}

/// The responses to orders of the force (eq. 6), of which one at most is near resonance.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_to_orders() {
  response = {}, response_speed = Number(0);
  for (std::size_t j = 1; j <= responses.size(); ++j) {
    const Number frequency = nu * static_cast<double>(j);
    if (shape.orders.is_zero(j)) continue;
    if (is_resonant(detuning_of(frequency))) {
      resonant = j, is_together_ = true;
      continue;
    }
    const Response<Number> unit = response_to(Number(k - frequency * frequency), h, f, frequency);
    responses[j - 1] = {unit.in_phase, unit.quadrature};
    Number amplitude = unit.amplitude * shape.orders.size(j);
    response.amplitude += amplitude, response_speed += frequency * amplitude;
    for (int i = 0; i < 6; ++i) amplitude *= static_cast<double>(j);
    for (Number& bound : order_bounds) bound += amplitude, amplitude *= frequency;
  }
}

/// Displacement and velocity of the steady response to all orders but one near resonance.
template <class Number, Effects E>
FreeMotion<Number> ArcConstants<Number, E>::response_of_orders(const SineCosine<Number>& phase) const {
  FreeMotion<Number> sum{Number(0), Number(0)};
  shape.orders.each(phase, [&](int j, const Number& value, const Number& slope) {
    const auto& [P, Q] = responses[static_cast<std::size_t>(j) - 1];
    sum.x += P * value + Q * slope;
    sum.v += j * nu * (P * slope - Q * value);
  });
  return sum;
}

/// By eq. 11.
template <class Number, Effects E>
FreeMotion<Number> ArcConstants<Number, E>::resonant_order_from_rest(const SineCosine<Number>& from,
                                                                     const Step<Number>& step) const {
  FreeMotion<Number> moved{Number(0), Number(0)};
  shape.orders.each(from, [&](int j, const Number& value, const Number& slope) {
    if (static_cast<std::size_t>(j) != resonant) return;
    moved.x = f * (slope * step.displacement.cosine + value * step.displacement.sine);
    moved.v = f * (slope * step.velocity.cosine + value * step.velocity.sine);
  });
  return moved;
}

}  // namespace clatter::motion
