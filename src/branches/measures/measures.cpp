#include "branches/measures/measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "branches/equations/housing_flight.hpp"
#include "branches/equations/housing_multipliers.hpp"
#include "branches/measures/moving.hpp"
#include "observables/extremes/extrema_observer.hpp"

namespace clatter::branches {
namespace {

using attractors::SectionState;

/// Calls `function(arc, length)` for each flight of an orbit in turn.
template <class Function>
void each_flight(const FollowedScene& scene, const Orbit& orbit, Function&& function) {
  with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    if (orbit.size() == 0)
      return flights.with_response(orbit.pressed,
                                   [&](const auto& arc) { function(arc, 0.0, flights.constants().period); });
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      OrbitEvent from = orbit.event(i);
      const OrbitEvent to = orbit.event(i + 1);
      if (to.rest > 0) continue;  // the flights that are left of a chatter reach nowhere
      from.phase += from.rest;
      const Flight<double> flight{from.side, from.phase, from.coordinate(), to.side, to.phase, from.kind,
                                  to.kind,   false,      from.held_by()};
      const double start = flights.start(flight);
      flights.with_arc(flight,
                       [&](const auto& arc) { function(arc, start, (to.phase - start) / flights.constants().nu); });
    }
  });
}

/// Calls `function(arc, begin, length)` for each flight in a housing, whose motion without events is that of no
/// branch.
template <class Function>
void each_flight_in_housing(const FollowedScene& scene, const Orbit& orbit, Function&& function) {
  with_arcs_of_main(scene, [&]<Effects E>() {
    const HousingFlights<double, E> flights{numbers_of<double>(scene)};
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const FlightOfBoth<double> flight = flight_of_both(orbit, i);
      flights.with_arc(flight, [&](const auto& arc) {
        function(arc, flight.begin, (flight.end - flight.begin) / flights.constants().nu);
      });
    }
  });
}

/// The forcing phase, rad, for which a stick lasts; 0 of any other event.
double hold(const FollowedScene& scene, const OrbitEvent& event) {
  if (event.kind != Event::Kind::stick) return 0.0;
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<double, E> flights{numbers_of<double>(scene)};
    return flights.releases().hold(standing_at(event), event.side);
  });
}

/// The state of a mass that stands still from an event on.
SectionState standing(const FollowedScene& scene, const OrbitEvent& event) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  return {halts(event.kind) ? p.middle() + event.place : p.position(event.side), 0.0};
}

Multipliers multipliers_in_housing(const FollowedScene& scene, const Orbit& orbit) {
  Multipliers found;
  std::size_t i = 0;
  const std::array<std::complex<double>, 4> all = housing_multipliers(scene, orbit);
  const auto of_place = std::ranges::min_element(all, {}, [](const auto& m) { return std::abs(m - 1.0); });
  for (std::complex<double> multiplier : all) {
    const bool is_neutral = is_anywhere(scene, orbit) && &all[i] == of_place;
    found.stable = found.stable && (is_neutral || std::abs(multiplier) < 1);
    if (orbit.mirrored) multiplier *= multiplier;
    found.re[i] = multiplier.real(), found.im[i] = multiplier.imag();
    if (i > 0 && found.im[i] > 0 && found.im[i] == -found.im[i - 1]) std::swap(found.im[i - 1], found.im[i]);
    ++i;
  }
  return found;
}

/// Displacement and velocity of the main mass before an event.
std::pair<double, double> main_before(const SceneNumbers<double>& p, const OrbitEvent& event) {
  if (event.is_of_wall()) return {p.middle() + event.other.place, event.other.before};
  if (halts(event.kind)) return {p.middle() + event.place, 0.0};
  const bool is_at_stop = event.is_contact();
  return {p.position(event.side) - (is_at_stop ? 0.0 : p.soft_stop(event.side).relaxation() * event.before),
          event.before};
}

/// The state on a flight in a housing when the forcing phase is `phase`.
template <Effects E>
SectionState state_on(const motion::RelativeArc<double, E>& arc, double begin, double phase,
                      const std::optional<FrameMotion>& frame) {
  const double nu = arc.constants().nu;
  const motion::Motion<double> m = arc.at((phase - begin) / nu), main = arc.main_at(m);
  if (!frame) return {main.x, main.v, m.x, m.v};
  const SineCosine<double> theta = frame->at(phase / nu);
  return {main.x + frame->displacement(theta), main.v + frame->velocity(theta), m.x, m.v};
}

observables::Extrema::Values extrema_in_housing(const FollowedScene& scene, const Orbit& whole,
                                                const std::optional<FrameMotion>& frame) {
  // of a span that begins at phase 0 and ends with the first event, where the main mass has this state
  const OrbitEvent& first = whole.events.at(0);
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const observables::ObservedSpan span{.scene = scene, .turns = first.phase / (2 * std::numbers::pi), .frame = frame};
  observables::Extrema::Observer extrema({}, span);
  each_flight_in_housing(scene, whole, [&](const auto& arc, double begin, double length) {
    extrema.arc(motion::HousedArc{arc.main(), arc}, begin / arc.constants().nu, length);
  });
  for (const OrbitEvent& event : whole.events) {
    if (!is_impact(event.kind)) continue;  // the arcs have all others
    const double before = event.before, main = event.other.before;
    const double wall = event.side == Side::upper ? scene.loose.upper : scene.loose.lower;
    if (event.is_of_wall())
      extrema.event({.kind = event.kind, .side = event.side, .place = wall, .main = {0.0, main, main}});
    else
      extrema.event({.kind = event.kind, .before = before, .after = before, .place = p.position(event.side)});
  }
  const auto [x, v] = main_before(p, first);
  return extrema.finish(span, x, v);
}

}  // namespace

Multipliers multipliers(const FollowedScene& scene, const Orbit& orbit) {
  if (orbit.rests()) return {};
  if (has_loose_mass(scene.loose)) return multipliers_in_housing(scene, orbit);
  const ImpactMap map = impact_map(scene, orbit);
  const double half = map.trace() / 2;
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - map.determinant));
  std::complex<double> first = half < 0 ? half - root : half + root;
  std::complex<double> second = first == 0.0 ? 0.0 : map.determinant / first;
  const bool stable = std::abs(first) < 1 && std::abs(second) < 1;
  if (orbit.mirrored) first *= first, second *= second;
  return {{first.real(), second.real()}, {first.imag(), second.imag()}, stable};
}

SectionState state_at(const FollowedScene& scene, const Orbit& orbit, std::size_t i, double phase) {
  SectionState state;
  std::size_t flight = 0;
  if (has_loose_mass(scene.loose)) {
    each_flight_in_housing(scene, orbit, [&](const auto& arc, double begin, double) {
      if (flight++ == i) state = state_on(arc, begin, phase, frame_of_results(scene));
    });
    return state;
  }
  each_flight(scene, orbit, [&](const auto& arc, double begin, double) {
    if (flight++ != i) return;
    const auto m = arc.at((phase - begin) / arc.constants().nu);
    state = {m.x, m.v};
  });
  return state;
}

SectionState state_at_phase_zero(const FollowedScene& scene, const Orbit& orbit) {
  std::optional<SectionState> state;
  constexpr double turn = 2 * std::numbers::pi;
  const Orbit whole = orbit.whole();
  if (has_loose_mass(scene.loose)) {
    const auto frame = frame_of_results(scene);
    each_flight_in_housing(scene, whole, [&](const auto& arc, double begin, double length) {
      const double nu = arc.constants().nu, next = std::ceil(begin / turn) * turn;
      if (!state && next <= begin + nu * length) state = state_on(arc, begin, next, frame);
    });
    return attractors::moved_inside(scene, state.value_or(SectionState{}));  // by rounding, beside an impact
  }
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) {
    const double nu = arc.constants().nu, next = std::ceil(begin / turn) * turn;
    if (state || (next > begin + nu * length && whole.size() > 0)) return;
    const motion::Motion<double> m = arc.at(whole.size() == 0 ? 0.0 : (next - begin) / nu);
    state = {m.x, m.v};
  });
  if (state) return *state;
  for (const OrbitEvent& event : whole.events)  // it rests then, or sticks, or is about to
    if (std::ceil(event.phase / turn) * turn <= event.phase + event.rest + hold(scene, event))
      return standing(scene, event);
  const auto rest = std::ranges::find_if(
      whole.events, [](const OrbitEvent& event) { return event.rest > 0 || event.kind == Event::Kind::stick; });
  return standing(scene, *rest);
}

std::vector<SectionState> states_at_phase(const FollowedScene& scene, const Orbit& orbit, double phase) {
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<SectionState> states;
  const Orbit whole = orbit.whole();
  const auto each_instant = [phase](double begin, double length, const auto& at) {  // of the phase, rad
    for (double next = phase + std::ceil((begin - phase) / turn) * turn; next <= begin + length; next += turn) at(next);
  };
  if (has_loose_mass(scene.loose)) {
    const auto frame = frame_of_results(scene);
    each_flight_in_housing(scene, whole, [&](const auto& arc, double begin, double length) {
      each_instant(begin, arc.constants().nu * length,
                   [&](double at) { states.push_back(state_on(arc, begin, at, frame)); });
    });
    return states;
  }
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) {
    each_instant(begin, arc.constants().nu * length, [&](double at) {
      const auto m = arc.at((at - begin) / arc.constants().nu);
      states.push_back({m.x, m.v});
    });
  });
  for (const OrbitEvent& event : whole.events)
    if (const double stands = event.rest + hold(scene, event); stands > 0)
      each_instant(event.phase, stands, [&](double) { states.push_back(standing(scene, event)); });
  return states;
}

observables::Extrema::Values extrema(const FollowedScene& scene, const Orbit& orbit) {
  if (has_loose_mass(scene.loose)) return extrema_in_housing(scene, orbit.whole(), frame_of_results(scene));
  return extrema_as_computed(scene, orbit);
}

observables::Extrema::Values extrema_as_computed(const FollowedScene& scene, const Orbit& orbit) {
  const Orbit whole = orbit.whole();
  if (has_loose_mass(scene.loose)) return extrema_in_housing(scene, whole, std::nullopt);
  observables::Extrema::Observer extrema;
  bool moves = false;
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) {
    moves = moves || !(length <= 0);
    extrema.arc(arc, begin, length);
  });
  const SceneNumbers<double> p = numbers_of<double>(scene);
  if (!moves) {  // where motion ceases
    const double x = p.middle() + whole.events[0].place;
    extrema.include({x, x}, {0.0, 0.0});
  }
  for (const OrbitEvent& event : whole.events) {
    if (event.kind != Event::Kind::impact) continue;  // the arcs have all others
    const double x = p.position(event.side);
    extrema.include({x, x}, {event.before, event.before});
  }
  const auto x = extrema.displacement({}), v = extrema.velocity();
  return {x.low, x.high, v.low, v.high};
}

double impact_speed(const Orbit& orbit, const WordLetters& letters) {
  double fastest = 0;
  for (const OrbitEvent& event : orbit.events)
    if (event.is_letter() && !(letters.walls && event.is_of_wall()))
      fastest = std::max(fastest, std::abs(event.before));
  return fastest;
}

double wall_impact_speed(const Orbit& orbit) {
  double fastest = 0;
  for (const OrbitEvent& event : orbit.events)
    if (event.is_of_wall()) fastest = std::max(fastest, std::abs(event.before));
  return fastest;
}

double impact_power(const FollowedScene& scene, const Orbit& orbit) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  double all = 0;
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (is_impact(orbit.events[i].kind))
      all +=
          lost_in_impact(p, orbit.events[i].kind, orbit.events[i].side, orbit.events[i].before, orbit.next_is_rest(i));
  if (orbit.meets_soft_stop()) all += loss_on_soft_stops(scene, orbit);
  return all * p.oscillator.frequency / orbit.advance() * p.mass;
}

}  // namespace clatter::branches
