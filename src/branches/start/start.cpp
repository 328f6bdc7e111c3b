#include "branches/start/start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "attractors/periodic_motion.hpp"
#include "branches/measures/measures.hpp"
#include "branches/start/resting.hpp"
#include "branches/start/start_in_housing.hpp"
#include "point/exact_motion.hpp"
#include "point/point.hpp"
#include "scene/response.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches {
namespace {

double phase_of_start(const point::Problem& problem) { return problem.start.phase - problem.shaking.lead; }

/// Whether a mass begins on a stop, or a loose one on a wall.
bool is_on_stop(const Scene& scene, const attractors::SectionState& state) {
  const auto is_on = [&](double stop, double x) {
    return std::isfinite(stop) && std::abs(x - stop) <= attractors::same_motion * std::max(1.0, std::abs(stop));
  };
  return is_on(scene.stops.lower, state.x) || is_on(scene.stops.upper, state.x) || is_on(scene.loose.lower, state.z) ||
         is_on(scene.loose.upper, state.z);
}

/// The middle of the first flight from the start on that lasts a thousandth of a forcing period or longer, in forcing
/// periods after the start. Nothing if the run fails, or flies nowhere.
std::optional<double> middle_of_flight(const point::Problem& problem, std::int64_t periods) {
  constexpr double turn = 2 * std::numbers::pi, shortest = 1e-3;
  const auto run = event_run(problem, static_cast<std::size_t>(periods));
  if (!run) return std::nullopt;
  double begin = 0;
  bool is_pressed = false;
  for (const OrbitEvent& event : run->events) {
    const double end = event.phase / turn;
    const bool is_contact = event.kind == Event::Kind::separation || is_pressed;
    if (end - begin >= shortest && !is_contact) return (begin + end) / 2;
    begin = (event.phase + event.rest) / turn;
    if (!event.is_of_wall() && !halts(event.kind)) is_pressed = presses(event.kind);
  }
  const auto last = static_cast<double>(periods);
  return begin < last ? std::optional((begin + last) / 2) : std::nullopt;
}

/// The motion near a start, of so many forcing periods: at phase 0 between the stops it is taken there. Else in the
/// middle of a flight, since an impact near the instant at which a motion is looked at may lie on both sides of it.
MotionStart near_start(const point::Problem& problem, std::int64_t periods) {
  const attractors::SectionState state{problem.start.displacement, problem.start.velocity, problem.loose.place,
                                       problem.loose.velocity};
  const double phase = phase_of_start(problem);
  if (phase == 0 && !is_on_stop(problem, state)) return {state, 0.0, periods};
  const auto middle = middle_of_flight(problem, periods);
  if (!middle) return {state, phase, periods};
  const auto there = attractors::state_after(problem, *middle);
  if (!there) throw StartError("the run from the start fails");
  return {*there, phase + *middle * 2 * std::numbers::pi, periods};
}

/// Whether rounding decides a motion between its rests: a change of the frequency by 1e-11 has other letters, or lands
/// elsewhere by more than 1e8 times as much.
bool is_decided_by_rounding(point::Problem problem, const Orbit& orbit, Side stop, std::int64_t period) {
  constexpr double change = 1e-11, most = 1e8;
  problem.oscillator.frequency *= 1 + change;
  const auto other = resting_orbit(problem, stop, period);
  if (!other || letters_of(*other) != letters_of(orbit)) return true;
  return !(std::abs(other->events.back().phase - orbit.events.back().phase) <= most * change);
}

Orbit resting_start(const point::Problem& problem, Side stop, std::int64_t period) {
  if (auto orbit = resting_orbit(problem, stop, period)) {
    if (is_decided_by_rounding(problem, *orbit, stop, period))
      throw StartError(
          "the motion at the start rests, and between its rests stretches small changes so much that rounding decides "
          "it: a run tells it by 50 digits, and no branch can follow it; begin elsewhere in the range");
    return std::move(*orbit);
  }
  if (!release_phase(problem, stop))
    throw StartError("the motion at the start rests on a stop for good; begin where the force takes it off");
  throw StartError(
      "the motion at the start rests on a stop, and a run from its release doesn't come back to rest within its "
      "period; "
      "set branch.period to several times as much");
}

/// Between soft stops, of which one may be rigid. `problem` is in the frame of what is shaken, and `given` is not.
Orbit soft_start(const point::Problem& given, const point::Problem& problem, const MotionStart& near, bool symmetric) {
  auto orbit = event_run(attractors::started(problem, near.state, near.phase), static_cast<std::size_t>(near.periods));
  if (!orbit) throw StartError("the run from the start fails");
  for (OrbitEvent& event : orbit->events) event.phase += near.phase;
  for (const OrbitEvent& event : orbit->events)
    if (event.kind == Event::Kind::impact && event.before == 0) return resting_start(given, event.side, near.periods);
  if (orbit->size() == 0 && orbit->pressed == Side::none && problem.oscillator.stiffness == 0)
    throw StartError("without a spring, motion without impacts has no place of its own; begin where it meets a stop");
  return orbit->half_if_same(1e-6, symmetric);
}

/// Throws StartError if branches can't be followed under the dry friction of a scene.
void require_friction_to_follow(const point::Problem& problem) {
  if (has_friction(problem.friction) && has_loose_mass(problem.loose))
    throw StartError(
        "branches of motion under dry friction are followed without a loose mass alone; sweep the parameter with "
        "follow instead, or leave out friction or loose_mass");
}

/// Gives each halt the side that the mass slips to from there, which is that of the next event, and the soft stop that
/// it is in.
void set_sides(const point::Problem& problem, Orbit& orbit) {
  const SceneNumbers<double> p{problem};
  const auto place = [&](const OrbitEvent& event) {
    if (halts(event.kind)) return event.place;
    const double at_stop = p.position(event.side) - p.middle();
    return event.is_contact() ? at_stop : at_stop - p.soft_stop(event.side).relaxation() * event.before;
  };
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitEvent& halt = orbit.events[i];
    if (!halts(halt.kind)) continue;
    halt.side = place(orbit.event(i + 1)) > halt.place ? Side::upper : Side::lower;
    halt.contact = motion::soft_stop_around(problem.stops, p.middle() + halt.place, 0.0).side;
  }
}

/// A run tells a stick that lasts beyond a forcing period once more from there on, at the same place. If it begins
/// within one, it ends in it, too: that is one.
void tell_sticks_once(std::vector<OrbitEvent>& events) {
  const auto goes_on = [](const OrbitEvent& before, const OrbitEvent& stick) {
    return before.kind == Event::Kind::stick && stick.kind == Event::Kind::stick && stick.place == before.place;
  };
  events.erase(std::unique(events.begin(), events.end(), goes_on), events.end());
  if (events.size() > 1 && events.front().kind == Event::Kind::stick && events.front().phase == 0)
    events.erase(events.begin());
}

/// Under dry friction.
Orbit slipping_start(const point::Problem& problem, const MotionStart& near, bool symmetric) {
  auto orbit = event_run(attractors::started(problem, near.state, near.phase), static_cast<std::size_t>(near.periods));
  if (!orbit) throw StartError("the run from the start fails");
  std::vector<OrbitEvent>& events = orbit->events;
  for (const OrbitEvent& event : events)
    if (event.kind == Event::Kind::impact && event.before == 0)
      throw StartError(
          "the motion at the start rests on a stop under dry friction, and no branch of such motion is followed; begin "
          "where it doesn't rest, or sweep the parameter with follow instead");
  tell_sticks_once(events);
  if (events.empty() || (events.size() == 1 && events[0].kind == Event::Kind::stick))
    throw StartError(
        "dry friction holds the mass at the start for good; begin where the force overcomes it, or set x0 and v0 "
        "nearer to a motion");
  for (OrbitEvent& event : events) event.phase += near.phase, event.rest = 0;
  set_sides(problem, *orbit);
  return orbit->half_if_same(1e-6, symmetric);
}

/// "stop_stiffness_lower" of a stop, or the key of both.
std::string with_side(const std::string& key, Side side) {
  return side == Side::none ? key : key + (side == Side::lower ? "_lower" : "_upper");
}

/// Throws StartError if a parameter of soft stops is to be followed and there is none, or a restitution of one.
void require_soft_stop(const FollowedScene& scene, Parameter parameter, const std::string& asked) {
  const auto of_any = [&](const auto& holds) {
    if (parameter.side() != Side::none) return holds(parameter.side());
    return holds(Side::lower) || holds(Side::upper);
  };
  const auto soft = [&](Side side) { return is_soft(scene.stops, side); };
  const bool is_of_soft = parameter.role() == Role::softness || parameter.role() == Role::stop_damping;
  if (is_of_soft && !of_any(soft))
    throw SettingError(asked + " is of a soft stop, and this one is rigid; give " +
                       (scene.given.is_si ? "machine." : "scene.") + with_side("stop_stiffness", parameter.side()));
  if ((parameter.role() == Role::restitution || parameter.role() == Role::law_of_speed) &&
      !of_any([&](Side side) { return !soft(side); }))
    throw SettingError(asked + " has no effect on a soft stop; take stop_damping or stop_R");
}

/// Throws SettingError if a parameter changes both stops, which differ.
void require_equal_stops(const FollowedScene& scene, Parameter parameter, const std::string& asked) {
  if (!parameter.is_of_both()) return;
  GivenScene given = scene.given, same = given;
  set(same, parameter, value_of(scene, parameter));
  const auto& row = parameter.row();
  if (row.place(same) == row.place(given) && row.place_of_upper(same) == row.place_of_upper(given)) return;
  if (parameter.role() == Role::position)
    throw SettingError(asked + " moves both stops, which aren't symmetric; take stop_lower or stop_upper");
  const std::string key(parameter.key());
  throw SettingError(asked + " changes both stops, which differ; take " + key + "_lower or " + key + "_upper");
}

/// Throws SettingError if a level of dry friction can't be followed: without friction the motion at the start has no
/// halts, and the static level is no less than the kinetic one.
void require_levels_of_friction(const FollowedScene& scene, Parameter parameter, const std::array<double, 2>& range,
                                const std::string& interval) {
  if (parameter.role() != Role::friction) return;
  if (!has_friction(scene.friction))
    throw SettingError("there is no dry friction at the start, so the motion there has none of its halts; give " +
                       key_in_section(scene, parameter) + " a value above 0, within " + interval);
  const Friction& given = scene.given.friction;
  if (parameter == Parameter("friction") && given.static_level != 0 && range[1] > given.static_level)
    throw SettingError(interval +
                       " reaches friction_static; end it there, or give no friction_static: it is then equal "
                       "to friction");
  if (parameter == Parameter("friction_static") && range[0] < given.kinetic)
    throw SettingError(interval + " reaches below friction; begin it there");
}

/// Throws SettingError if a branch along the stiffness is to begin without a spring: the equilibrium, from which the
/// places on a branch count, goes to infinity there.
void require_spring(const FollowedScene& scene, Parameter parameter) {
  const auto& k = numbers_along(scene, parameter).oscillator.stiffness;
  if (k == 0 && !k.is_constant())
    throw SettingError("places on a branch count from the equilibrium of the spring, and along " +
                       std::string(parameter.key()) + " that comes from infinity at 0; begin at another " +
                       key_in_section(scene, parameter));
}

}  // namespace

void require_start_in_range(const FollowedScene& scene, Parameter parameter, const std::array<double, 2>& range,
                            const std::string& key) {
  const Stops& stops = scene.stops;
  const std::string asked = "branch." + key + " = " + std::string(parameter.key()),
                    interval = key == "along" ? "branch.range" : "branch.across_range";
  if (parameter.is_loose())
    require_walls_in_range(scene, parameter, range);
  else
    require_equal_stops(scene, parameter, asked), require_soft_stop(scene, parameter, asked);
  const double at = value_of(scene, parameter), width = range[1] - range[0];
  if (!std::isfinite(at))
    throw SettingError((parameter.role() == Role::position ? "there is no stop or wall to move by branch." + key
                                                           : asked + " has no finite value at the start") +
                       "; give " + key_in_section(scene, parameter));
  if (key == "along" && !std::isfinite(width)) throw SettingError(interval + " has no end; give two finite numbers");
  if (!(at >= range[0] && at <= range[1]))
    throw SettingError("the start lies outside " + interval + "; give " + key_in_section(scene, parameter) +
                       " a value within it");
  const bool is_place = parameter.role() == Role::position && !parameter.is_of_both() && !parameter.is_loose();
  if (is_place && parameter.side() == Side::lower && range[1] >= stops.upper && std::isfinite(range[1]))
    throw SettingError(interval + " reaches the upper stop; end it below stop_upper");
  if (is_place && parameter.side() == Side::upper && range[0] <= stops.lower && std::isfinite(range[0]))
    throw SettingError(interval + " reaches the lower stop; begin it above stop_lower");
  require_spring(scene, parameter);
  require_levels_of_friction(scene, parameter, range, interval);
  GivenScene shaken = scene.given;
  set(shaken, parameter, 1.0);
  if (shaken.shaking.stops != 0 && shaken.shaking.base != 0)
    throw SettingError("stops and base can't be shaken at once; " + asked + " needs " +
                       (parameter == Parameter("stop_amplitude") ? "base_amplitude" : "stop_amplitude") + " = 0");
}

double speed_scale(const FollowedScene& scene, const Orbit& orbit) {
  const Oscillator oscillator = oscillator_in_frame(scene);
  const double nu = oscillator.frequency;
  const double response = nu * steady_response(oscillator).amplitude;
  const double free = std::isfinite(response) ? response : std::abs(oscillator.forcing);
  const double speed = std::max(impact_speed(orbit), wall_impact_speed(orbit));
  return speed > 1e-2 * free ? speed : std::max(free, 1e-12);
}

MotionStart settled(point::Problem problem) {
  problem.observe = {};
  problem.observe.attractor = true;
  problem.time.mode = steady::Mode::steady;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  if (result.status == steady::Status::escaped)
    throw StartError(
        "the mass escapes from the start, as nothing brings it back; begin between stops, or nearer to one");
  if (failed(result.status)) throw StartError("the run to the motion at the start fails");
  if (!(result.attractor_periods > 0))
    throw StartError(
        "the scene settles on no periodic motion within time.max_periods; begin elsewhere in the range, raise "
        "time.max_periods, or set branch.period and, near a periodic motion, x0 and v0");
  const auto periods = static_cast<std::int64_t>(result.attractor_periods);
  attractors::SectionState there{result.attractor_x, result.attractor_v};  // at the phase of the start
  if (has_loose_mass(problem.loose)) there.z = result.attractor_z, there.w = result.attractor_w;
  const double phase = phase_of_start(problem), turns = phase / (2 * std::numbers::pi);
  if (std::ceil(turns) == turns) return {there, 0.0, periods};
  const auto state = attractors::state_after(attractors::started(problem, there, phase), std::ceil(turns) - turns);
  if (!state) throw StartError("the run to the motion at the start fails");
  return {*state, 0.0, periods};
}

Orbit start_orbit(const StartProblem& start, std::int64_t period, bool symmetric) {
  const point::Problem given = with_scene(start, start);
  point::Problem problem = given;
  sweep::enter_shaken_frame(problem);
  const bool is_si = given.units.is_si;
  require_friction_to_follow(problem);
  if (problem.oscillator.forcing == 0)
    throw SettingError(std::string("a branch needs a force, whose periods it counts: set ") +
                       (is_si ? "machine.force" : "scene.f"));
  if (problem.oscillator.shape.is_in_pieces())
    throw SettingError(
        std::string("a branch follows motion under a sine, or several orders of one, so far: leave out ") +
        (is_si ? "machine." : "scene.") + (problem.oscillator.shape.table != nullptr ? "force_table" : "force_shape") +
        ", or follow the motion by sweep.follow");
  const MotionStart near = period == 0 ? settled(problem) : near_start(problem, period);
  if (has_loose_mass(problem.loose)) return start_in_housing(start, problem, near, symmetric);
  if (has_friction(problem.friction)) return slipping_start(problem, near, symmetric);
  if (has_soft_stop(problem.stops)) return soft_start(given, problem, near, symmetric);
  // Newton's method on the map of the periods; unless a contact appears or vanishes on the way it gets there
  const auto motion =
      attractors::periodic_motion(problem, near.state, static_cast<std::size_t>(near.periods), near.phase);
  if (!motion) throw StartError("the run from the start fails");
  const auto round =
      attractors::run_round(attractors::started(problem, motion->cycle[0], near.phase), motion->cycle.size());
  if (!round) throw StartError("the run from the start fails");
  Orbit orbit = orbit_of(*round, problem.oscillator.frequency, near.phase);
  for (const OrbitEvent& event : orbit.events)
    if (event.before == 0) return resting_start(given, event.side, near.periods);
  if (orbit.size() == 0 && problem.oscillator.stiffness == 0)
    throw StartError("without a spring, motion without impacts has no place of its own; begin where it meets a stop");
  return orbit.half_if_same(1e-6, symmetric);
}

std::optional<Orbit> event_run(const point::Problem& problem, std::size_t periods) {
  const auto motion = point::ExactMotion::of(problem);
  const double middle = SceneNumbers<double>{problem}.middle();
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  motion::State<double> state = motion->start();
  if (motion->run_for(state, static_cast<double>(periods), recorder) != stepping::Outcome::completed)
    return std::nullopt;
  Orbit orbit{{}, 2 * static_cast<int>(periods), false};
  const double nu = problem.oscillator.frequency;
  for (const motion::Event& event : recorder.events) {
    const bool rests = event.kind == Event::Kind::rest || event.kind == Event::Kind::chatter;
    orbit.events.push_back({event.side, nu * event.time, event.velocity(), event.kind, nu * event.length,
                            halts(event.kind) ? event.place - middle : 0.0});
    OrbitEvent& kept = orbit.events.back();
    if (rests) kept.kind = Event::Kind::impact;  // one without speed
    if (event.of_wall) kept.kind = Event::Kind::strike, kept.other = {event.main.place - middle, event.main.before};
  }
  if (orbit.size() == 0)
    for (const Side side : {Side::lower, Side::upper}) {
      const double position = side == Side::upper ? problem.stops.upper : problem.stops.lower;
      if (is_soft(problem.stops, side) && sign_of(side) * (problem.start.displacement - position) > 0)
        orbit.pressed = side;
    }
  return orbit;
}

}  // namespace clatter::branches
