#include "branches/measures/friction_harmonic.hpp"

#include <utility>

#include "branches/equations/flight.hpp"

namespace clatter::branches {
namespace {

/// A part of a motion, from one forcing phase to another, in rad.
struct Span {
  Along begin, end;
};

/// Adds a constant force.
void add_constant(const Along& force, const Span& span, const Along& nu, Harmonic& sum) {
  sum.re += force * (sin(span.end) - sin(span.begin)) / nu;
  sum.im += force * (cos(span.end) - cos(span.begin)) / nu;
}

/// Adds a force that balances f sin(phase + lead).
void add_balance(const LeadingForce<Along>& force, const Span& span, const Along& nu, Harmonic& sum) {
  const Along twice = 2 * span.end + force.lead, before = 2 * span.begin + force.lead, length = span.end - span.begin;
  const Along share = force.amplitude / (2 * nu);
  sum.re -= share * (length * sin(force.lead) - (cos(twice) - cos(before)) / 2);
  sum.im += share * (length * cos(force.lead) - (sin(twice) - sin(before)) / 2);
}

/// Adds a force that balances one of several orders: sin(j theta) and cos(j theta) times e^{-i theta} have the orders
/// j - 1 and j + 1.
void add_balance(const Along& f, const ForceOrders<Along>& orders, const Span& span, const Along& nu, Harmonic& sum) {
  const auto integrals = [&](std::size_t number) -> std::pair<Along, Along> {  // of a sine and a cosine
    if (number == 0) return {Along(0), span.end - span.begin};
    const auto order = static_cast<double>(number);
    return {(cos(order * span.begin) - cos(order * span.end)) / order,
            (sin(order * span.end) - sin(order * span.begin)) / order};
  };
  for (std::size_t j = 1; j <= ForceOrders<Along>::most; ++j) {
    const auto& [a, b] = orders.of[j - 1];
    if (is_always_zero(a) && is_always_zero(b)) continue;
    const auto [sine_below, cosine_below] = integrals(j - 1);
    const auto [sine_above, cosine_above] = integrals(j + 1);
    const Along share = f / (2 * nu);
    sum.re -= share * (a * (sine_above + sine_below) + b * (cosine_above + cosine_below));
    sum.im += share * (a * (cosine_below - cosine_above) + b * (sine_above - sine_below));
  }
}

template <Effects E>
Harmonic harmonic_of(const Moving& moving) {
  const Flights<Along, E> flights(moving.p);
  const Along& nu = moving.p.oscillator.frequency;
  Harmonic sum;
  const std::size_t count = moving.events.size();
  for (std::size_t i = 0; i < count; ++i) {
    const MovingEvent &from = moving.events[i], &to = moving.events[(i + 1) % count];
    const Along end = i + 1 < count ? to.phase : to.phase + moving.period * nu;
    const Flight<Along> flight{from.side, from.phase, from.coordinate, to.side,     end,
                               from.kind, to.kind,    false,           from.pressed};
    const Along start = flights.start(flight);
    add_constant(-sign_of(flight.heading()) * moving.p.friction.kinetic, {start, end}, nu, sum);
    if (from.kind != Event::Kind::stick) continue;
    const Along place = moving.p.middle() + from.coordinate;
    add_constant(-flights.constants().constant_force(place), {from.phase, start}, nu, sum);
    if (const BasicOscillator<Along>& o = moving.p.oscillator; o.shape.has_orders())
      add_balance(o.forcing, o.shape.orders, {from.phase, start}, nu, sum);
    else
      add_balance(moving.p.force(), {from.phase, start}, nu, sum);
  }
  return sum;
}

}  // namespace

Harmonic friction_harmonic(const Moving& moving) {
  return with_arcs(
      moving.scene, [&]<Effects E>() { return harmonic_of<E>(moving); }, moving.stiffness_varies);
}

}  // namespace clatter::branches
