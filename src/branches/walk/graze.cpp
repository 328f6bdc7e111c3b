#include "branches/walk/graze.hpp"

#include <algorithm>
#include <cmath>

#include "branches/equations/flight.hpp"
#include "branches/equations/newton.hpp"
#include "branches/walk/violation.hpp"

namespace clatter::branches {
namespace {

/// Acceleration at an event, that of the free motion.
double acceleration(const SceneNumbers<double>& p, const OrbitImpact& event, double offset) {
  const LeadingForce<double> force = p.force();
  return force.amplitude * std::sin(event.phase + force.lead) + p.oscillator.load -
         2 * p.oscillator.damping * event.before - p.oscillator.stiffness * (p.position(event.side) + offset);
}

std::optional<ExactGraze> solved(const Equations& equations, const FollowedScene& near, const Graze& graze,
                                 double within, double tolerance) {
  const OrbitEquations there = equations(graze.orbit, {graze.condition});
  const Vector guess = there.unknowns_of(near, graze.orbit);
  const auto exact = solution(there, guess, tolerance);
  if (!exact || std::abs(exact->back() - guess.back()) > within) return std::nullopt;
  ExactGraze at{there.scene_at(*exact), there.orbit_at(*exact), graze.impact};
  OrbitImpact& impact = at.orbit.impacts[graze.impact];
  if (impact.event != EventKind::impact && graze.condition.kind == Condition::Kind::graze) impact.before = 0;
  return at;
}

/// Several grazes of soft stops at once as the one of a motion that repeats sooner, or is symmetric.
Graze once_of(Graze graze, double slow, bool symmetric_scene) {
  if (graze.condition.kind != Condition::Kind::graze ||
      graze.orbit.impacts[graze.impact].event != EventKind::separation)
    return graze;
  for (std::size_t i = graze.orbit.size(); i-- > 0;) {
    const std::size_t next = (i + 1) % graze.orbit.size();
    if (i == graze.impact || graze.orbit.impacts[i].event != EventKind::touch || next == graze.impact) continue;
    if (std::abs(graze.orbit.impacts[i].before) > slow) continue;
    for (const std::size_t each : {std::max(i, next), std::min(i, next)}) {
      graze.orbit.impacts.erase(graze.orbit.impacts.begin() + static_cast<std::ptrdiff_t>(each));
      graze.impact -= each < graze.impact;
    }
  }
  graze.orbit.impacts[graze.impact].before = 0;
  graze.orbit = graze.orbit.once_with_graze(graze.impact, symmetric_scene);
  const auto at = std::ranges::find_if(graze.orbit.impacts, [](const OrbitImpact& impact) {
    return impact.event == EventKind::separation && impact.before == 0;
  });
  graze.impact = static_cast<std::size_t>(at - graze.orbit.impacts.begin());
  graze.condition.impact = graze.impact;
  return graze;
}

/// An orbit with a graze as if a contact or an interruption that lasts for `advance` of the phase began and ended
/// there.
Orbit with_short(const FollowedScene& scene, const Orbit& orbit, std::size_t graze, double advance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const OrbitImpact middle = orbit.impacts[graze];
  const double relaxation = p.soft_stop(middle.side).relaxation(), time = advance / p.oscillator.frequency;
  OrbitImpact begin = middle, end = middle;
  const double a = acceleration(p, middle, -relaxation * middle.before);
  double before = time / 2;  // from the beginning to the extremum
  if (middle.event == EventKind::separation && middle.before == 0) {
    // v t + a t^2/2 + r (v + a t) = 0, the end of a contact that begins with v: the mass turns after the time -v/a
    before = time * (time / 2 + relaxation) / (time + relaxation);
    begin.event = EventKind::touch;
  } else {
    begin.event = middle.event == EventKind::separation ? EventKind::renewal : EventKind::separation;
    if (relaxation == 0 && presses(middle.event)) end.event = EventKind::touch;
  }
  begin.phase = middle.phase - p.oscillator.frequency * before, begin.before = middle.before - a * before;
  end.phase = begin.phase + advance, end.before = begin.before + a * time;
  Orbit out = orbit;
  out.impacts[graze] = end;
  return out.with(begin, graze);
}

/// An orbit with a stick on a stop as if the mass struck that first, and slipped back for `advance` of the phase.
Orbit with_rebound(const FollowedScene& scene, const Orbit& orbit, std::size_t stick, double advance) {
  const Side stop = orbit.heading_before(stick);
  const SceneNumbers<double> p = numbers_of<double>(scene);
  OrbitImpact impact{stop, orbit.impacts[stick].phase}, halt = orbit.impacts[stick];
  const double a = with_arcs(
      scene, [&]<Effects E>() { return Flights<double, E>{p}.acceleration(halt.place, halt.phase, opposite(stop)); });
  const double time = advance / p.oscillator.frequency;
  impact.before = a * time / p.restitution(stop);
  halt.phase += advance, halt.place -= a * time * time / 2;
  Orbit out = orbit;
  out.impacts[stick] = halt;
  return out.with(impact, stick);
}

/// Motion between the stops with a contact, or an interruption, that begins with event `first`.
struct Lasting {
  Orbit orbit;
  Vector at;
  std::size_t first;
};
/// That which lasts for `advance` of the phase, in place of a graze. Motion that is symmetric about another place than
/// x = 0 has two contacts at once.
std::optional<Lasting> with_lasting(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                                    std::size_t graze, double advance, double tolerance) {
  const bool rebounds = orbit.impacts[graze].event == EventKind::stick;
  Lasting lasting{
      rebounds ? with_rebound(scene, orbit, graze, advance) : with_short(scene, orbit, graze, advance), {}, graze};
  for (int contacts = 1; contacts <= 2; ++contacts) {
    const OrbitEquations there =
        equations(lasting.orbit, {{.kind = Condition::Kind::duration, .impact = lasting.first, .duration = advance}});
    auto at = solution(there, there.unknowns_of(scene, lasting.orbit), tolerance);
    if (!at) return std::nullopt;
    const auto violated = violation(there, *at);
    lasting.at = *std::move(at);
    if (!violated) return lasting;
    if (rebounds || violated->kind != Violation::Kind::passes_through || violated->turning.event == EventKind::impact)
      return std::nullopt;
    const std::size_t second = violated->impact + 1;
    const Orbit both = there.orbit_at(lasting.at).with(violated->turning, second);
    lasting.orbit = with_short(scene, both, second, advance);
    if (second <= lasting.first) lasting.first += 2;
  }
  return std::nullopt;
}

/// Whether one graze is nearer to a scene than another one, by more than rounding. All slow contacts of a motion may
/// vanish at once, or the other ones are slow there, too, and the motion without them grazes somewhere near.
bool is_nearer(const ExactGraze& one, const ExactGraze& other, const FollowedScene& scene,
               const OrbitEquations::Axis& axis) {
  constexpr double rounding = 1e-9;
  const auto off = [&](const FollowedScene& there) {
    return std::abs(value_of(there, axis.parameter) - value_of(scene, axis.parameter)) / axis.unit;
  };
  return off(one.scene) + rounding < off(other.scene);
}

}  // namespace

std::optional<ExactGraze> exact_graze(const Equations& equations, const FollowedScene& near, Graze graze, double slow,
                                      bool symmetric_scene, double within, double tolerance) {
  const auto exact = solved(equations, near, graze, within, tolerance);
  if (exact) graze.orbit = exact->orbit;
  if (!graze.orbit.meets_soft_stop()) return exact;
  const Graze once = once_of(graze, slow, symmetric_scene);
  if (exact && once.orbit.size() == graze.orbit.size()) return exact;
  auto joined = solved(equations, near, once, within, tolerance);
  if (!joined || (exact && is_nearer(*exact, *joined, near, equations(once.orbit, {}).axes().front()))) return exact;
  joined->joins = true;
  return joined;
}

std::optional<Vector> direction_into_motion(const OrbitEquations& equations, const Vector& from,
                                            const std::vector<Vector>& directions, double tolerance) {
  for (const double s : {1e-5, 1e-4, 1e-3, 1e-2})
    for (const Vector& direction : directions) {
      const auto at = corrected(equations, sum(from, s, direction), direction, tolerance);
      if (at && !violation(equations, *at)) return direction;
    }
  return std::nullopt;
}

std::optional<Opened> opened(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                             std::size_t graze, double tolerance) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const OrbitImpact& event = orbit.impacts[graze];
  const double of_stop = halts(event.event) ? 0.0 : p.soft_stop(event.side).stiffness;
  const double rate = std::max(p.oscillator.frequency, std::sqrt(std::abs(p.oscillator.stiffness) + of_stop));
  for (const double turned_by : {1e-3, 1e-2, 1e-4}) {
    const auto lasting =
        with_lasting(equations, scene, orbit, graze, p.oscillator.frequency / rate * turned_by, tolerance);
    if (!lasting) continue;
    const OrbitEquations there = equations(lasting->orbit, {});
    Vector longer(there.unknowns(), 0.0);
    longer[there.phase_of(lasting->first)] = -1;
    longer[there.phase_of((lasting->first + 1) % lasting->orbit.size())] = 1;
    if (auto along = tangent(there, lasting->at, longer)) return Opened{lasting->orbit, lasting->at, *std::move(along)};
  }
  return std::nullopt;
}

Orbit turned(Orbit orbit, std::size_t event) {
  EventKind& kind = orbit.impacts[event].event;
  kind = kind == EventKind::touch ? EventKind::renewal : EventKind::touch;
  return orbit;
}

}  // namespace clatter::branches
