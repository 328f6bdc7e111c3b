#include "branches/measures/friction_harmonic.hpp"

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
