#include "branches/measures/soft_contacts.hpp"

#include <cmath>

#include "branches/equations/housing_flight.hpp"
#include "observables/energy/quadrature.hpp"

namespace clatter::branches {
namespace {

/// Adds a contact, by panels in which nothing turns by more than a few radians.
template <class A>
void add_contact(const A& arc, const motion::SoftStop<Along>& stop, const Along& begin, const Along& length,
                 SoftContacts& sum) {
  const auto& constants = arc.constants();
  const auto [fastest, lasting] = observables::pace_of(constants);
  const auto whole = static_cast<double>(length);
  SoftContacts part;
  observables::over_panels<20>(1.0, {fastest * whole, lasting * whole}, 2, [&](double share, double weight) {
    const Along time = share * length, phase = begin + constants.nu * time;
    const motion::Motion<Along> m = arc.at(time);
    const Along force = weight * stop.force(Along(arc.anchor() - stop.position) + m.offset, m.v);
    part.loss += weight * m.v * m.v, part.re -= force * cos(phase), part.im += force * sin(phase);
  });
  sum.loss += 2 * stop.damping * length * part.loss;
  sum.re += length * part.re, sum.im += length * part.im;
}

/// Energy of the spring of a soft stop at an event: where the force is zero, the depth is relaxation times velocity.
Along stored(const SceneNumbers<Along>& p, const motion::SoftStop<Along>& stop, const MovingEvent& event) {
  const bool is_struck = event.kind == Event::Kind::strike;
  const Along depth = is_struck ? p.middle() + event.other_place - stop.position : stop.relaxation() * event.coordinate;
  return stop.stiffness * depth * depth / 2;
}

/// Contacts on arcs of a main mass: `with_arc(i, end, function)` calls `function(arc, begin)` with that of the flight
/// after event i, from the phase `begin` to `end`.
template <class WithArc>
void add_contacts(const Moving& moving, const WithArc& with_arc, SoftContacts& sum) {
  const std::size_t count = moving.events.size();
  for (std::size_t i = 0; i < count; ++i) {
    const MovingEvent &from = moving.events[i], &to = moving.events[(i + 1) % count];
    if (from.pressed == Side::none) continue;
    const motion::SoftStop<Along> stop = moving.p.soft_stop(from.pressed);
    const Along end = i + 1 < count ? to.phase : to.phase + moving.period * moving.p.oscillator.frequency;
    with_arc(i, end, [&](const auto& arc, const Along& begin) {
      add_contact(arc, stop, begin, (end - begin) / moving.p.oscillator.frequency, sum);
    });
    // a stop that the mass outruns relaxes as far as it is touched again
    const bool leaves =
        to.kind == Event::Kind::separation || (to.kind == Event::Kind::strike && to.pressed == Side::none);
    const bool comes_back = from.kind == Event::Kind::renewal || from.kind == Event::Kind::strike;
    if (leaves) sum.loss += stored(moving.p, stop, to);
    if (comes_back && moving.events[(i + count - 1) % count].pressed == Side::none)
      sum.loss -= stored(moving.p, stop, from);
  }
}

template <Effects E>
SoftContacts contacts_of_one(const Moving& moving) {
  const Flights<Along, E> flights(moving.p);
  SoftContacts sum;
  if (moving.events.empty() && moving.pressed != Side::none)
    flights.with_response(moving.pressed, [&](const auto& arc) {
      add_contact(arc, moving.p.soft_stop(moving.pressed), Along(0), moving.period, sum);
    });
  const auto with_arc = [&](std::size_t i, const Along& end, const auto& function) {
    const MovingEvent &from = moving.events[i], &to = moving.events[(i + 1) % moving.events.size()];
    const Flight<Along> flight{from.side, from.phase, from.coordinate, to.side,     end,
                               from.kind, to.kind,    false,           from.pressed};
    flights.with_arc(flight, [&](const auto& arc) { function(arc, flights.start(flight)); });
  };
  add_contacts(moving, with_arc, sum);
  return sum;
}
/// With a loose mass.
template <Effects E>
SoftContacts contacts_of_both(const Moving& moving) {
  const HousingFlights<Along, E> flights(moving.p);
  SoftContacts sum;
  const auto with_arc = [&](std::size_t i, const Along& end, const auto& function) {
    const MovingEvent &from = moving.events[i], &to = moving.events[(i + 1) % moving.events.size()];
    flights.with_arc({from.kind, to.kind, from.side, to.side, from.phase, from.coordinate, from.other_place,
                      from.other_before, end, from.pressed},
                     [&](const auto& arc) { function(arc.main(), from.phase); });
  };
  add_contacts(moving, with_arc, sum);
  return sum;
}

}  // namespace

SoftContacts soft_contacts(const Moving& moving) {
  if (has_loose_mass(moving.scene.loose))
    return with_arcs_of_main(moving.scene, [&]<Effects E>() { return contacts_of_both<E>(moving); });
  return with_arcs(
      moving.scene, [&]<Effects E>() { return contacts_of_one<E>(moving); }, moving.stiffness_varies);
}

}  // namespace clatter::branches
