#include "branches/walk/housing_violation.hpp"

#include "branches/equations/housing_flight.hpp"
#include "branches/walk/flight_end.hpp"
#include "motion/contact.hpp"

namespace clatter::branches {
namespace {

/// The turning point of the loose mass that a flight takes beyond a wall, as a strike without speed.
template <Effects E>
OrbitEvent turning_point(const HousingFlights<double, E>& flights, const motion::RelativeArc<double, E>& arc,
                         double begin, const motion::Crossing<double>& contact) {
  const Margin gap{0.0, -static_cast<double>(sign_of(contact.side)), 0.0};
  const double turn = turning_time(arc, gap, contact.elapsed);
  const motion::Motion<double> main = arc.main_at(arc.at(turn));
  return {.side = contact.side,
          .phase = begin + arc.constants().nu * turn,
          .kind = Event::Kind::strike,
          .main = {main.x - flights.parameters().middle(), main.v}};
}

}  // namespace

std::optional<Violation> housing_violation(const FollowedScene& scene, const Orbit& orbit,
                                           std::optional<std::size_t> grazing) {
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (i != grazing && !(sign_of(orbit.events[i].side) * orbit.events[i].before > 0))
      return Violation{Violation::Kind::pulls, i, {}};
  return with_arcs_of_main(scene, [&]<Effects E>() -> std::optional<Violation> {
    const HousingFlights<double, E> flights{numbers_of<double>(scene)};
    const Stops walls{.lower = scene.loose.lower, .upper = scene.loose.upper};
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      OrbitEvent from = orbit.event(i);
      const OrbitEvent to = orbit.event(i + 1);
      if (i == grazing) from.before = 0;
      const auto arc = flights.after(wall_impact(from));
      const double nu = arc.constants().nu, length = (to.phase - from.phase) / nu;
      const motion::Crossing<double> contact = motion::next_contact(arc, walls, length);
      if (contact.side == Side::none) continue;
      if (contact.side == to.side && is_at_end(contact.elapsed, length, contact.motion.x, contact.motion.v, nu))
        continue;
      return Violation{Violation::Kind::passes_through, i, turning_point(flights, arc, from.phase, contact)};
    }
    return std::nullopt;
  });
}

}  // namespace clatter::branches
