#include "point/decided.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "point/error_watch.hpp"
#include "point/every_effect.hpp"
#include "point/exact_motion.hpp"
#include "point/fixed_point.hpp"
#include "scene/parameter.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/repeat.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::point {
namespace {

using steady::ObservedTime;
using steady::Status;

constexpr double trusted_in_double = 1e-11;  // an error relative to the motion's size
constexpr double same_motion = 1e-6;         // a distance of states relative to it

double distance(const motion::State<double>& a, const motion::State<double>& b) { return between(a, b).size(); }
double size_of(const motion::State<double>& state) { return std::max(std::abs(state.x), std::abs(state.v)); }

/// Whether two scenes are given by the same numbers, but for their starts.
bool agree(const std::optional<GivenScene>& one, const std::optional<GivenScene>& other) {
  if (!one || !other) return !one && !other;
  if (one->is_si != other->is_si) return false;
  for (const Parameter parameter : all_parameters)
    if (parameter.role() != Role::start && value_of(*one, parameter) != value_of(*other, parameter)) return false;
  return true;
}

/// The section of a motion that is nearest to a state; the end if none is near it.
auto passing(std::vector<motion::State<double>>& sections, const motion::State<double>& state) {
  const auto nearest =
      std::ranges::min_element(sections, {}, [&](const auto& section) { return distance(section, state); });
  const bool near = nearest != sections.end() && distance(*nearest, state) <= same_motion * size_of(state);
  return near ? nearest : sections.end();
}

/// The time to observe of a motion without a period that could be told.
ObservedTime over_window(Status status, const Problem& problem, ObservedTime found) {
  found.status = status, found.turns = static_cast<double>(problem.time.window);
  found.found_by = steady::FoundBy::nothing, found.settling = std::numeric_limits<double>::quiet_NaN();
  return found;
}

/// The same of one that a stop releases time and again, in one state each: it repeats once the same stop does so again.
ObservedTime with_rests(ObservedTime found) {
  static_assert(steady::RepeatFinder::longest == 64, "found_by_names tells it");
  found.found_by = steady::FoundBy::rests;
  return found;
}

/// The time to observe of a periodic motion with these states at its sections. `found.settling` holds on if the motion
/// that was found passes one of them, so that it is known which section of the run is which of the motion.
ObservedTime observed(const Problem& problem, ObservedTime found, std::vector<motion::State<double>> sections) {
  auto same = passing(sections, found.from);
  if (same == sections.end() || found.status != Status::periodic)
    found.settling = std::numeric_limits<double>::quiet_NaN(), same = sections.begin();
  const auto place = same - sections.begin();
  for (std::size_t i = 0; i < sections.size(); ++i)
    sections[i].periods = found.from.periods + static_cast<std::int64_t>(i) - place;
  const steady::BeginsBefore before(problem.oscillator.forcing);
  const auto first =
      std::ranges::min_element(sections, [&](const auto& a, const auto& b) { return before(a.x, a.v, b.x, b.v); });
  std::rotate(sections.begin(), first, sections.end());
  found.status = Status::periodic, found.turns = static_cast<double>(sections.size());
  if (found.found_by == steady::FoundBy::nothing) found.found_by = steady::FoundBy::repetition;
  found.from = sections.front(), found.sections = std::move(sections);
  return found;
}

/// Whether double tells the events of a periodic motion. It is run for two of its periods, or for one and up to a rest,
/// so that no stretch is cut; `side` becomes the stop that releases it.
bool holds_in_double(const Problem& problem, const ObservedTime& found, Side& side) {
  return with_every_effect(problem, [&]<Effects E>() {
    stepping::Exact<double, E> integrator(problem, limits_of(problem));
    ErrorWatch<double, E> watch(problem);
    motion::State<double> state = found.from;
    for (double period = 0; period < 2 * found.turns; ++period) {
      if (advance_to_section(integrator, state, state.periods, watch) != stepping::Outcome::completed) return false;
      const auto [lower, upper] = watch.take_releases();
      if (lower || upper) side = upper ? Side::upper : Side::lower;
      if ((lower || upper) && period >= found.turns) break;
    }
    return watch.error() <= trusted_in_double;
  });
}

}  // namespace

Decisions::Decisions() = default;
Decisions::~Decisions() = default;

ObservedTime Decisions::decided(const Problem& problem, ObservedTime found) {
  if (!found.doubtful) return found;
  Side side = found.rested_on;
  if (found.status == Status::periodic && holds_in_double(problem, found, side)) return found;
  if (side != Side::none) return decided_by_release(problem, std::move(found), side);
  for (const Side stop : {Side::lower, Side::upper}) {  // it may rest after double has lost it
    RestingMotion motion = resting(problem, stop);
    if (motion.kind == RestingMotion::Kind::periodic && passing(motion.sections, found.from) != motion.sections.end())
      return observed(problem, std::move(found), std::move(motion.sections));
  }
  return decided_by_fixed_point(problem, std::move(found));
}

ObservedTime Decisions::decided_by_release(const Problem& problem, ObservedTime found, Side side) {
  using Kind = RestingMotion::Kind;
  const RestingMotion& motion = resting(problem, side);
  found.simulated += motion.simulated;
  if (motion.kind == Kind::periodic) return observed(problem, std::move(found), motion.sections);
  const bool aperiodic = motion.kind == Kind::longer || (motion.kind == Kind::departs && lacks_period(found.status));
  if (aperiodic) return with_rests(over_window(Status::aperiodic, problem, std::move(found)));
  if (motion.kind != Kind::departs) return over_window(Status::undecided, problem, std::move(found));
  // if motion without a rest attracts it, that is told
  const RestingMotion& departing_motion = departing(problem, side);
  if (departing_motion.kind != Kind::departs) return over_window(Status::undecided, problem, std::move(found));
  Problem later = problem;
  const motion::State<double>& last = departing_motion.sections.back();
  later.start.displacement = last.x, later.start.velocity = last.v;
  ObservedTime next = ExactMotion::of(later)->find_steady();
  next.simulated += found.simulated;
  next.settling = std::numeric_limits<double>::quiet_NaN();
  return next.doubtful ? over_window(Status::undecided, problem, std::move(next)) : next;
}

ObservedTime Decisions::decided_by_fixed_point(const Problem& problem, ObservedTime found) {
  const steady::BeyondContact beyond_contact(problem, period_of(problem.oscillator));
  if (beyond_contact.is_beside(found.from.x, found.from.v)) return found;  // the map jumps there
  std::vector<Sections>& known = of(problem).orbits;
  found.simulated += found.turns;
  auto same = std::ranges::find_if(known, [&](Sections& orbit) {
    return static_cast<double>(orbit.size()) == found.turns && passing(orbit, found.from) != orbit.end();
  });
  if (same == known.end()) {
    Sections exact = periodic_sections(problem, found.from, static_cast<std::int64_t>(found.turns));
    if (passing(exact, found.from) == exact.end()) return over_window(Status::undecided, problem, std::move(found));
    same = known.insert(known.end(), std::move(exact));
  }
  return observed(problem, std::move(found), *same);
}

Decisions::OfScene& Decisions::of(const Problem& problem) {
  const auto same = std::ranges::find_if(scenes_, [&](const OfScene& scene) {
    return scene.oscillator == problem.oscillator && scene.stops == problem.stops &&
           scene.friction == problem.friction && scene.phase == problem.start.phase &&
           scene.most_impacts == problem.time.max_impacts && agree(scene.given, problem.given);
  });
  if (same != scenes_.end()) return *same;
  if (scenes_.size() == most_scenes) scenes_.pop_back();
  return scenes_.emplace_front(OfScene{problem.oscillator, problem.stops, problem.friction, problem.start.phase,
                                       problem.time.max_impacts, problem.given});
}

const RestingMotion& Decisions::resting(const Problem& problem, Side side) {
  auto& known = of(problem).resting[index_of(side)];
  if (!known) known = resting_motion(problem, side);
  return *known;
}

const RestingMotion& Decisions::departing(const Problem& problem, Side side) {
  RestingMotion& motion = *of(problem).resting[index_of(side)];
  if (motion.sections.empty()) motion = resting_motion_in_fifty_digits(problem, side);
  return motion;
}

}  // namespace clatter::point
