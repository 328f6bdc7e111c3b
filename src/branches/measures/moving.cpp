#include "branches/measures/moving.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/links.hpp"
#include "branches/measures/friction_harmonic.hpp"
#include "branches/measures/soft_contacts.hpp"
#include "motion/walls.hpp"

namespace clatter::branches {
namespace {

/// A motion at some parameters, which don't change if p doesn't, without its events.
Moving motion_at(const FollowedScene& scene, const Orbit& orbit, const SceneNumbers<Along>& p) {
  return {.scene = scene,
          .p = p,
          .events = {},
          .period = Along(orbit.advance()) / p.oscillator.frequency,
          .pressed = orbit.pressed,
          .soft = orbit.meets_soft_stop()};
}

/// The change of the velocity of the mass, or of the main mass, in an impact.
Along jump_of_velocity(const SceneNumbers<Along>& p, Event::Kind kind, Side side, const Along& before) {
  if (kind != Event::Kind::strike) return p.law(side).jump(before);
  return motion::WallRule<Along>(p.loose).main_after(Along(0), before);
}

}  // namespace

Moving moving(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  const Orbit orbit = equations.orbit_at(point);
  const FollowedScene scene = equations.scene_at(point);
  constexpr double step = 1e-3;  // the parameter is linear in the point
  const auto vary = [&](BasicGivenScene<Along>& given) {
    for (std::size_t k = 0; k < equations.axes().size(); ++k) {
      const auto& [parameter, unit] = equations.axes()[k];
      const std::size_t unknown = equations.first_axis() + k;
      const double ahead = (point[unknown] + step * tangent[unknown]) * unit;
      Along value(point[unknown] * unit);
      value.slope[0] = (ahead - value.value) / step;
      set(given, parameter, value);
    }
  };
  Moving m = motion_at(scene, orbit, numbers_of<Along>(scene, vary));
  m.stiffness_varies = equations.stiffness_varies();
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& event = orbit.events[i];
    const std::size_t unknown = equations.phase_of(i);
    const auto moves = [&](double value, std::size_t beside, double unit) {
      Along number(value);
      number.slope[0] = tangent[unknown + beside] * unit;
      return number;
    };
    const double unit = equations.speed_unit();
    m.events.push_back({event.side,
                        moves(event.phase, 0, 1.0),
                        moves(event.coordinate(), 1, unit),
                        false,
                        event.kind,
                        {},
                        {},
                        orbit.pressed_after(i)});
    if (!has_loose_mass(scene.loose)) continue;
    m.events.back().other_place = moves(event.other.place, 2, unit);
    m.events.back().other_before = moves(event.other.before, 3, unit);
  }
  return m;
}

Moving moving_from_release(const FollowedScene& scene, const Orbit& orbit, Parameter parameter) {
  constexpr std::size_t by_begin = 0, by_before = 1, by_end = 2, by_parameter = 3;
  using Four = Dual<double, 4>;
  Moving m = motion_at(scene, orbit, numbers_along(scene, parameter));
  m.stiffness_varies = varies_stiffness(scene, parameter);
  const auto p = numbers_of<Four>(
      scene, [&](auto& given) { set(given, parameter, Four(value_of(scene, parameter), by_parameter)); });
  const auto release = [&](const OrbitEvent& rest) {  // where force + load = k x
    Along phase(rest.phase + rest.rest);
    const PhasedForce<Along> force = m.p.force_at(phase);
    const Along left = force.value + m.p.oscillator.load - m.p.oscillator.stiffness * m.p.position(rest.side);
    phase.slope[0] = -left.slope[0] / force.slope.value;
    return phase;
  };
  const auto add_events = [&]<Effects E>() {
    const Flights<Four, E> flights(p);
    OrbitEvent last = orbit.events.back();
    Along begin = release(last), before = 0;
    begin.value -= orbit.advance();
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitEvent& event = orbit.events[i];
      Along end(event.phase), speed(event.before);
      if (event.rest > 0) {
        end = release(event), speed = 0;
      } else {
        const FlightEnd<Four> flown =
            flights.fly({last.side, Four(begin.value, by_begin), Four(before.value, by_before), event.side,
                         Four(event.phase, by_end), last.kind, event.kind});
        const auto along = [&](const Four& number) {
          return number.slope[by_begin] * begin.slope[0] + number.slope[by_before] * before.slope[0] +
                 number.slope[by_parameter];
        };
        end.slope[0] = -along(flown.beyond) / flown.beyond.slope[by_end];
        speed.slope[0] = along(flown.coordinate) + flown.coordinate.slope[by_end] * end.slope[0];
        m.events.push_back({event.side, end, speed, orbit.next_is_rest(i), event.kind, {}, {}, orbit.pressed_after(i)});
      }
      begin = end, before = speed, last = event;
    }
  };
  with_arcs(scene, add_events, m.stiffness_varies);
  return m;
}

double loss_on_soft_stops(const FollowedScene& scene, const Orbit& orbit) {
  Moving m = motion_at(scene, orbit, numbers_of<Along>(scene));
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& event = orbit.events[i];
    m.events.push_back({event.side, event.phase, event.coordinate(), false, event.kind, event.other.place,
                        event.other.before, orbit.pressed_after(i)});
  }
  return soft_contacts(m).loss.value;
}

Along impact_speed(const Moving& moving) {
  const bool on_stops = has_events_of_its_own(moving.scene);
  Along fastest = 0;
  for (const MovingEvent& event : moving.events) {
    const bool is_contact = is_impact(event.kind) || event.kind == Event::Kind::touch;
    if (is_contact && !(on_stops && event.kind == Event::Kind::strike))
      fastest = std::max(fastest, abs(event.coordinate));
  }
  return fastest;
}

Along impact_power(const Moving& moving) {
  Along all = 0;
  for (const MovingEvent& event : moving.events)
    if (is_impact(event.kind)) all += lost_in_impact(moving.p, event.kind, event.side, event.coordinate, event.rests);
  if (moving.soft) all += soft_contacts(moving).loss;
  return all / moving.period * moving.p.mass;
}

Along harmonic(const Moving& moving) {
  // (k - nu^2 + 2 i h nu) X = F + (1/T) sum of (v+ - v-) e^{-i phase}, F = -i f e^{i lead}/2, and the force of soft
  // stops and of friction likewise; mirror images add the same
  const SceneNumbers<Along>& p = moving.p;
  const LeadingForce<Along> force = p.force();
  Along re = force.amplitude * sin(force.lead) / 2, im = -force.amplitude * cos(force.lead) / 2;
  if (p.oscillator.shape.has_orders()) {
    const auto& [in_phase, quadrature] = p.oscillator.shape.orders.of[0];
    re = force.amplitude * quadrature / 2, im = -force.amplitude * in_phase / 2;
  }
  for (const MovingEvent& event : moving.events) {
    if (!is_impact(event.kind)) continue;
    const Along jump = jump_of_velocity(p, event.kind, event.side, event.coordinate) / moving.period;
    re += jump * cos(event.phase), im -= jump * sin(event.phase);
  }
  if (moving.soft) {
    const SoftContacts contacts = soft_contacts(moving);
    re += contacts.re / moving.period, im += contacts.im / moving.period;
  }
  if (has_friction(moving.scene.friction)) {
    const Harmonic friction = friction_harmonic(moving);
    re += friction.re / moving.period, im += friction.im / moving.period;
  }
  const bool unit_spring = p.oscillator.stiffness == 1 && p.oscillator.stiffness.is_constant();
  const Along a = unit_spring ? (1 - p.oscillator.frequency) * (1 + p.oscillator.frequency)
                              : p.oscillator.stiffness - p.oscillator.frequency * p.oscillator.frequency,
              b = 2 * p.oscillator.damping * p.oscillator.frequency;
  if (is_shaken(moving.scene.shaking) && p.loose.ratio != 0) {  // relative to the base, less B = -i b e^{i phase}/2
    const Along square = a * a + b * b, &shift = p.shaking.phase;
    const Along x = (re * a + im * b) / square - p.shaking.base * sin(shift) / 2,
                y = (im * a - re * b) / square + p.shaking.base * cos(shift) / 2;
    return 2 * sqrt(x * x + y * y);
  }
  return 2 * sqrt(re * re + im * im) / sqrt(a * a + b * b);
}

}  // namespace clatter::branches
