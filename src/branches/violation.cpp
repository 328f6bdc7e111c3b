#include "branches/violation.hpp"

#include <cmath>

#include "branches/flight.hpp"
#include "motion/contact.hpp"

namespace clatter::branches {
namespace {

/// The instant after a contact at which the motion through the stop turns back.
template <Effects E>
double turning_time(const motion::Arc<double, E>& arc, const motion::Contact<double>& contact) {
  double s = contact.elapsed;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const motion::Motion<double> m = arc.at(s);
    // towards the stop as long as it moves there; a step no longer than a small part of a cycle
    const double most = 0.1 / arc.constants().rate, closing = sign_of(contact.side) * m.v;
    const double curvature = sign_of(contact.side) * m.a;
    const double step = curvature < 0 ? std::clamp(-closing / curvature, -most, most) : closing > 0 ? most : -most;
    s += step;
    if (std::abs(step) <= 1e-13 * (1 + s)) break;
  }
  return s;
}

template <Effects E>
std::optional<Violation> cut_short(const Scene& scene, const motion::Arc<double, E>& arc, double begin, double length,
                                   std::size_t impact, Side expected) {
  const double nu = arc.constants().nu;
  const motion::Contact<double> contact = motion::next_contact(arc, scene.stops, length);
  if (contact.side == Side::none) return std::nullopt;
  const motion::Motion<double> m = contact.motion;
  // a soft contact is found as early as its displacement's rounding over its speed
  const double late = (1e-11 + 1e-12 * (1 + std::abs(m.x)) / std::max(std::abs(m.v), 1e-12)) / nu;
  if (contact.side == expected && length - contact.elapsed <= late + 1e-9 * length) return std::nullopt;
  const double turn = turning_time(arc, contact);
  return Violation{Violation::Kind::passes_through, impact, {contact.side, begin + nu * turn, 0.0}};
}

}  // namespace

std::optional<Violation> violation(const ShakenScene& scene, const Orbit& orbit, std::optional<std::size_t> grazing) {
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (i != grazing && !(sign_of(orbit.impacts[i].side) * orbit.impacts[i].before > 0))
      return Violation{Violation::Kind::pulls, i, {}};
  return with_arcs(scene, [&]<Effects E>() -> std::optional<Violation> {
    const Flights<double, E> flights{Parameters<double>(scene)};
    const Parameters<double>& p = flights.parameters();
    if (orbit.size() == 0) {
      const motion::Arc<double, E> arc = flights.response_arc();
      for (const Side side : {Side::lower, Side::upper})  // begins beyond the stop
        if (const double sign = sign_of(side); sign * (arc.start().x - p.position(side)) > 0) {
          const Response<double> response = flights.response();
          const double turn = std::atan2(sign * response.in_phase, sign * response.quadrature) - flights.lead();
          return Violation{Violation::Kind::passes_through, 0, {side, turn, 0.0}};
        }
      return cut_short(scene, arc, 0.0, orbit.advance() / p.nu, 0, Side::none);
    }
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      OrbitImpact from = orbit.impact(i);
      const OrbitImpact to = orbit.impact(i + 1);
      if (i == grazing) from.before = 0;
      const motion::Arc<double, E> arc = flights.arc({from.side, from.phase, from.before, to.side, to.phase});
      if (auto found = cut_short(scene, arc, from.phase, (to.phase - from.phase) / p.nu, i, to.side)) return found;
    }
    return std::nullopt;
  });
}

}  // namespace clatter::branches
