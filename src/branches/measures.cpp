#include "branches/measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "branches/soft_contacts.hpp"
#include "math/dual.hpp"

namespace clatter::branches {
namespace {

/// Calls `function(arc, length)` for each flight of an orbit in turn.
template <class Function>
void each_flight(const ShakenScene& scene, const Orbit& orbit, Function&& function) {
  with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{Parameters<double>(scene)};
    if (orbit.size() == 0)
      return flights.with_response(
          orbit.pressed, [&](const auto& arc, const auto&) { function(arc, 0.0, flights.constants().period); });
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      OrbitImpact from = orbit.impact(i);
      const OrbitImpact to = orbit.impact(i + 1);
      if (to.rest > 0) continue;  // the flights that are left of a chatter reach nowhere
      from.phase += from.rest;
      const Flight<double> flight{from.side, from.phase, from.before, to.side, to.phase, from.event, to.event};
      flights.with_arc(flight, [&](const auto& arc) {
        function(arc, from.phase, (to.phase - from.phase) / flights.constants().nu);
      });
    }
  });
}

/// The parameters of a scene that changes to another one, linearly, over `distance`.
Parameters<Along> towards(const ShakenScene& scene, const ShakenScene& other, double distance) {
  Parameters<Along> p(scene);
  const Parameters<double> here(scene), there(other);
  for (std::size_t i = 0; i < p.all.size(); ++i) {
    const double from = here.*here.all[i], to = there.*there.all[i];
    (p.*p.all[i]).slope[0] = std::isfinite(from) ? (to - from) / distance : 0.0;
  }
  return p;
}

/// Energy lost in an impact, per unit mass.
template <class Number>
Number lost(const Number& R, const Number& before, bool rests) {
  return rests ? Number(before * before / 2) : Number((1 - R) * (1 + R) * before * before / 2);
}

bool next_is_rest(const Orbit& orbit, std::size_t i) { return i + 1 < orbit.size() && orbit.impacts[i + 1].rest > 0; }

/// A motion at some parameters, which don't change if p doesn't, without its impacts.
Moving motion_at(const ShakenScene& scene, const Orbit& orbit, const Parameters<Along>& p) {
  return {.scene = scene,
          .p = p,
          .impacts = {},
          .period = Along(orbit.advance()) / p.nu,
          .pressed = orbit.pressed,
          .soft = orbit.meets_soft_stop()};
}

/// Of a motion that meets soft stops, per unit mass and repetition.
double loss_on_soft_stops(const ShakenScene& scene, const Orbit& orbit) {
  Moving m = motion_at(scene, orbit, Parameters<Along>(scene));
  for (const OrbitImpact& event : orbit.impacts)
    m.impacts.push_back({event.side, event.phase, event.before, false, event.event});
  return soft_contacts(m).loss.value;
}

}  // namespace

Moving moving(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  const Orbit orbit = equations.orbit_at(point);
  constexpr double step = 1e-3;  // the parameters are linear in the point
  const ShakenScene scene = equations.scene_at(point);
  Moving m = motion_at(scene, orbit, towards(scene, equations.scene_at(sum(point, step, tangent)), step));
  m.stiffness_varies = equations.stiffness_varies();
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    Along phase(orbit.impacts[i].phase), before(orbit.impacts[i].before);
    phase.slope[0] = tangent[2 * i], before.slope[0] = tangent[2 * i + 1] * equations.speed_unit();
    m.impacts.push_back({orbit.impacts[i].side, phase, before, false, orbit.impacts[i].event});
  }
  return m;
}

Moving moving_from_release(const ShakenScene& scene, const Orbit& orbit, sweep::Parameter parameter) {
  constexpr std::size_t by_begin = 0, by_before = 1, by_end = 2, by_parameter = 3;
  using Four = Dual<double, 4>;
  constexpr double step = 1e-3;
  Moving m =
      motion_at(scene, orbit, towards(scene, changed(scene, parameter, value_of(scene, parameter) + step), step));
  m.stiffness_varies = varies_stiffness(parameter);
  Parameters<Four> p(scene);
  for (std::size_t i = 0; i < p.all.size(); ++i) (p.*p.all[i]).slope[by_parameter] = (m.p.*m.p.all[i]).slope[0];
  // f sin(phase + lead) + load = k x at a release
  const LeadingForce<Along> force = m.p.force();
  const auto release = [&](const OrbitImpact& rest) {
    Along phase(rest.phase + rest.rest);
    const double of_force = phase.value + force.lead.value, sine = std::sin(of_force), cosine = std::cos(of_force);
    const Along needed = m.p.k * m.p.position(rest.side) - m.p.load;
    phase.slope[0] =
        (needed.slope[0] - force.amplitude.slope[0] * sine) / (force.amplitude.value * cosine) - force.lead.slope[0];
    return phase;
  };
  const auto add_impacts = [&]<Effects E>() {
    const Flights<Four, E> flights(p);
    OrbitImpact last = orbit.impacts.back();
    Along begin = release(last), before = 0;
    begin.value -= orbit.advance();
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitImpact& impact = orbit.impacts[i];
      Along end(impact.phase), speed(impact.before);
      if (impact.rest > 0) {
        end = release(impact), speed = 0;
      } else {
        const FlightEnd<Four> flown =
            flights.fly({last.side, Four(begin.value, by_begin), Four(before.value, by_before), impact.side,
                         Four(impact.phase, by_end), last.event, impact.event});
        const auto along = [&](const Four& number) {
          return number.slope[by_begin] * begin.slope[0] + number.slope[by_before] * before.slope[0] +
                 number.slope[by_parameter];
        };
        end.slope[0] = -along(flown.beyond) / flown.beyond.slope[by_end];
        speed.slope[0] = along(flown.velocity) + flown.velocity.slope[by_end] * end.slope[0];
        m.impacts.push_back({impact.side, end, speed, next_is_rest(orbit, i), impact.event});
      }
      begin = end, before = speed, last = impact;
    }
  };
  with_arcs(scene, add_impacts, m.stiffness_varies);
  return m;
}

Multipliers multipliers(const ShakenScene& scene, const Orbit& orbit) {
  if (orbit.rests()) return {{0, 0}, {0, 0}, true};
  const ImpactMap map = impact_map(scene, orbit);
  const double half = map.trace() / 2;
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - map.determinant));
  std::complex<double> first = half < 0 ? half - root : half + root;
  std::complex<double> second = first == 0.0 ? 0.0 : map.determinant / first;
  const bool stable = std::abs(first) < 1 && std::abs(second) < 1;
  if (orbit.mirrored) first *= first, second *= second;
  return {{first.real(), second.real()}, {first.imag(), second.imag()}, stable};
}

PhasePoint state_at_phase_zero(const ShakenScene& scene, const Orbit& orbit) {
  std::optional<PhasePoint> state;
  constexpr double turn = 2 * std::numbers::pi;
  const Orbit whole = orbit.whole();
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) {
    const double nu = arc.constants().nu, next = std::ceil(begin / turn) * turn;
    if (state || (next > begin + nu * length && whole.size() > 0)) return;
    const motion::Motion<double> m = arc.at(whole.size() == 0 ? 0.0 : (next - begin) / nu);
    state = {m.x, m.v};
  });
  if (state) return *state;
  for (const OrbitImpact& impact : whole.impacts)  // it rests then, or is about to
    if (std::ceil(impact.phase / turn) * turn <= impact.phase + impact.rest)
      return {Parameters<double>(scene).position(impact.side), 0.0};
  const auto rest = std::ranges::find_if(whole.impacts, [](const OrbitImpact& impact) { return impact.rest > 0; });
  return {Parameters<double>(scene).position(rest->side), 0.0};
}

observables::Extrema extrema(const ShakenScene& scene, const Orbit& orbit) {
  observables::Extrema extrema;
  const Orbit whole = orbit.whole();
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) { extrema.arc(arc, begin, length); });
  const Parameters<double> p(scene);
  for (const OrbitImpact& impact : whole.impacts) {
    if (impact.event != Event::impact) continue;  // the arcs have all
    const double x = p.position(impact.side);
    extrema.include({x, x}, {impact.before, impact.before});
  }
  return extrema;
}

double impact_speed(const Orbit& orbit) {
  double fastest = 0;
  for (const OrbitImpact& impact : orbit.impacts)
    if (impact.is_letter()) fastest = std::max(fastest, std::abs(impact.before));
  return fastest;
}

double impact_power(const ShakenScene& scene, const Orbit& orbit) {
  const Parameters<double> p(scene);
  double all = 0;
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (orbit.impacts[i].event == Event::impact)
      all += lost(p.restitution(orbit.impacts[i].side), orbit.impacts[i].before, next_is_rest(orbit, i));
  if (orbit.meets_soft_stop()) all += loss_on_soft_stops(scene, orbit);
  return all * p.nu / orbit.advance() / p.inverse_mass;
}

Along impact_speed(const Moving& moving) {
  Along fastest = 0;
  for (const auto& [side, phase, before, rests, event] : moving.impacts)
    if (event == Event::impact || event == Event::touch) fastest = std::max(fastest, abs(before));
  return fastest;
}

Along impact_power(const Moving& moving) {
  Along all = 0;
  for (const auto& [side, phase, before, rests, event] : moving.impacts)
    if (event == Event::impact) all += lost(moving.p.restitution(side), before, rests);
  if (moving.soft) all += soft_contacts(moving).loss;
  return all / moving.period / moving.p.inverse_mass;
}

Along harmonic(const Moving& moving) {
  // (k - nu^2 + 2 i h nu) X = F + (1/T) sum of (v+ - v-) e^{-i phase}, F = -i f e^{i lead}/2, and the force of soft
  // stops likewise; mirror images add the same
  const Parameters<Along>& p = moving.p;
  const LeadingForce<Along> force = p.force();
  Along re = force.amplitude * sin(force.lead) / 2, im = -force.amplitude * cos(force.lead) / 2;
  for (const auto& [side, phase, before, rests, event] : moving.impacts) {
    if (event != Event::impact) continue;
    const Along jump = -(1 + p.restitution(side)) * before / moving.period;
    re += jump * cos(phase), im -= jump * sin(phase);
  }
  if (moving.soft) {
    const SoftContacts contacts = soft_contacts(moving);
    re += contacts.re / moving.period, im += contacts.im / moving.period;
  }
  const bool unit_spring = p.k == 1 && p.k.is_constant();
  const Along a = unit_spring ? (1 - p.nu) * (1 + p.nu) : p.k - p.nu * p.nu, b = 2 * p.h * p.nu;
  return 2 * sqrt(re * re + im * im) / sqrt(a * a + b * b);
}

}  // namespace clatter::branches
