#include "branches/measures/soft_contacts.hpp"

#include <cmath>

#include "branches/equations/flight.hpp"
#include "observables/energy/quadrature.hpp"

namespace clatter::branches {
namespace {

/// Adds a contact, by panels in which nothing turns by more than a few radians.
template <class A>
void add_contact(const A& arc, const motion::SoftStop<Along>& stop, const Along& begin, const Along& length,
                 SoftContacts& sum) {
  const auto& constants = arc.constants();
  const double turns = static_cast<double>(length * constants.rate);
  SoftContacts part;
  observables::over_panels<20>(1.0, static_cast<std::size_t>(std::ceil(turns / 2)), [&](double share, double weight) {
    const Along time = share * length, phase = begin + constants.nu * time;
    const motion::Motion<Along> m = arc.at(time);
    const Along force = weight * stop.force(m.offset, m.v);
    part.loss += weight * m.v * m.v, part.re -= force * cos(phase), part.im += force * sin(phase);
  });
  sum.loss += 2 * stop.damping * length * part.loss;
  sum.re += length * part.re, sum.im += length * part.im;
}

/// Energy of the spring of a soft stop at which the force is zero: the depth is relaxation times velocity.
Along stored(const motion::SoftStop<Along>& stop, const Along& velocity) {
  const Along depth = stop.relaxation() * velocity;
  return stop.stiffness * depth * depth / 2;
}

template <Effects E>
SoftContacts contacts_of(const Moving& moving) {
  const Flights<Along, E> flights(moving.p);
  SoftContacts sum;
  const std::size_t count = moving.events.size();
  if (moving.pressed != Side::none)
    flights.with_response(moving.pressed, [&](const auto& arc, const auto&) {
      add_contact(arc, moving.p.soft_stop(moving.pressed), Along(0), moving.period, sum);
    });
  for (std::size_t i = 0; i < count; ++i) {
    const MovingEvent &from = moving.events[i], &to = moving.events[(i + 1) % count];
    if (!presses(from.kind)) continue;
    const motion::SoftStop<Along> stop = moving.p.soft_stop(from.side);
    const Along end = i + 1 < count ? to.phase : to.phase + moving.period * moving.p.oscillator.frequency;
    const Flight<Along> flight{from.side, from.phase, from.coordinate, to.side, end, from.kind, to.kind};
    flights.with_arc(flight, [&](const auto& arc) {
      add_contact(arc, stop, from.phase, (end - from.phase) / moving.p.oscillator.frequency, sum);
    });
    // a stop that the mass outruns relaxes as far as it is touched again
    if (to.kind == Event::Kind::separation) sum.loss += stored(stop, to.coordinate);
    if (from.kind == Event::Kind::renewal && !presses(moving.events[(i + count - 1) % count].kind))
      sum.loss -= stored(stop, from.coordinate);
  }
  return sum;
}

}  // namespace

SoftContacts soft_contacts(const Moving& moving) {
  return with_arcs(
      moving.scene, [&]<Effects E>() { return contacts_of<E>(moving); }, moving.stiffness_varies);
}

}  // namespace clatter::branches
