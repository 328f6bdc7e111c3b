#include "certificates/certified_in_housing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "certificates/claims.hpp"
#include "certificates/housing_bounds.hpp"

namespace clatter::certificates {

using point::PointResult;
using point::Problem;

namespace {

/// Whether both masses are held at once, or a force within rounding of 0 is waited for, which no event tells apart.
bool is_held_twice(const RecordedMotion<4>& motion) {
  const auto overlap = [&](const RecordedEvent<4>& one, const RecordedEvent<4>& other) {
    return one.lasts() && other.lasts() && other.time < one.end() - 1e-12 * motion.duration;
  };
  return std::ranges::adjacent_find(motion.events, overlap) != motion.events.end() ||
         !std::ranges::all_of(motion.events, &RecordedEvent<4>::held);
}

/// Whether friction in the housing acts in a chatter on a wall, or stops the loose mass while something holds the main
/// one.
bool is_beyond_claims(const Problem& problem, const RecordedMotion<4>& motion) {
  if (!has_loose_friction(problem.loose)) return false;
  using enum motion::Event::Kind;
  const auto stops_beside = [&](const RecordedEvent<4>& one, const RecordedEvent<4>& other) {
    return one.lasts() && !one.of_wall && other.is_of_loose_friction() && other.time <= one.end();
  };
  const auto chatters = [](const RecordedEvent<4>& one,
                           const RecordedEvent<4>& other) {  // a rebound turns, and is lost
    const bool rebounds =
        one.kind == reversal ? one.is_of_loose_friction() : one.kind == impact && one.of_wall && one.after != 0;
    return rebounds && other.of_wall && other.kind == rest;
  };
  return std::ranges::adjacent_find(motion.events, stops_beside) != motion.events.end() ||
         std::ranges::adjacent_find(motion.events, chatters) != motion.events.end() ||
         std::ranges::any_of(motion.events, [](const auto& event) { return event.kind == chatter && event.of_wall; });
}

/// The order of two events within rounding of each other isn't known.
void drop_if_at_one_instant(CertifiedPoint& point) {
  if (!point.certificate) return;
  const auto is_instant = [](const ClaimedEvent& event) {
    using enum motion::Event::Kind;
    return event.kind != rest && event.kind != chatter && event.kind != stick;
  };
  const auto meet = [&](const ClaimedEvent& one, const ClaimedEvent& other) {
    return !(one.of_wall && other.of_wall) && is_instant(one) && is_instant(other) &&
           other.time.value - one.time.value <= one.time.error + other.time.error;
  };
  if (std::ranges::adjacent_find(point.certificate->events, meet) == point.certificate->events.end()) return;
  point.without = Without::one_instant, point.certificate.reset();
}

}  // namespace

void certify_transient_in_housing(const Problem& problem, const PointResult& result, CertifiedPoint& point) {
  auto motion = recorded_in_housing(problem, problem.time.duration / period_of(problem.oscillator));
  const bool begins_still = problem.start.velocity == 0 && problem.loose.velocity == 0;
  point.without = motion && is_held_twice(*motion) ? Without::both_held : Without::rounding;
  if (has_friction(problem.friction) && has_loose_friction(problem.loose) && begins_still)
    point.without = Without::both_held;  // or one of them, by friction
  if (motion && is_beyond_claims(problem, *motion)) point.without = Without::loose_friction;
  if (!motion || point.without != Without::rounding) return;
  certify_run<HousingBounds>(problem, std::move(*motion), result, point);
  drop_if_at_one_instant(point);
}

namespace {

/// With a loose mass the certificate of a period begins in the middle of the longest press, else of the longest time
/// between two events.
double start_in_housing(const RecordedMotion<4>& motion) {
  double longest = 0.0, middle = 0.0;
  for (const RecordedEvent<4>& event : motion.events)
    if (event.is_rest() && event.of_wall && event.length > longest)
      longest = event.length, middle = event.time + event.length / 2;
  if (longest > 0) return middle;
  const auto& events = motion.events;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double next = i + 1 < events.size() ? events[i + 1].time : events[0].time + motion.duration;
    if (next - events[i].end() > longest) longest = next - events[i].end(), middle = (events[i].end() + next) / 2;
  }
  return std::fmod(middle, motion.duration);
}

Problem in_housing_from(Problem problem, const MachineState& state, double phase) {
  problem.start = {state.x, state.v, phase};
  problem.loose.place = state.z, problem.loose.velocity = state.w;
  return problem;
}

/// Newton's steps to the start of a period; nothing if it isn't one to rounding.
std::optional<MachineState> improved(const Problem& section, MachineState start, double phase, double turns) {
  constexpr double same = 1e-7;
  for (int step = 0; step < 2; ++step) {
    const auto motion = recorded_in_housing(in_housing_from(section, start, phase), turns);
    if (!motion || motion->end.pressed_by != start.pressed_by) return std::nullopt;
    const auto next = step_to_return(start, *motion);
    if (!next || !(distance(*next, start) <= same * size_of(start))) return std::nullopt;
    start = *next;
  }
  return start;
}

}  // namespace

void certify_periodic_in_housing(const Problem& problem, const PointResult& result, CertifiedPoint& point) {
  point.without = Without::rounding;
  const point::End& end = result.end;
  const MachineState from{end.displacement, end.velocity, end.loose_place, end.loose_velocity};
  const Problem section = in_housing_from(problem, from, end.phase);
  const auto whole = recorded_in_housing(section, result.observed_turns);
  if (!whole) return;
  if (is_held_twice(*whole)) {
    point.without = Without::both_held;
    return;
  }
  if (is_beyond_claims(problem, *whole)) {
    point.without = Without::loose_friction;
    return;
  }
  const auto meets_wall = [](const RecordedEvent<4>& event) { return event.of_wall && event.side != Side::none; };
  if (std::ranges::none_of(whole->events, meets_wall)) {  // wherever the loose mass stands, or moves to and fro
    point.without = Without::family;
    return;
  }
  const double begin = start_in_housing(*whole), T = period_of(problem.oscillator), time = std::fmod(begin, T);
  const auto way = recorded_in_housing(section, begin / T);
  if (!way) return;
  const double phase = end.phase + 2 * pi<double>() * time / T;
  const auto start = improved(problem, way->end, phase, result.observed_turns);
  if (!start) return;
  const Problem at_start = in_housing_from(problem, *start, phase);
  const auto motion = recorded_in_housing(at_start, result.observed_turns);
  if (!motion) return;
  certify_period<HousingBounds>(at_start, time, *motion, end.phase, result, point,
                                [&](Certificate& certificate, const HousingBounds& bounds) {
                                  certificate.pressed = start->pressed_by;
                                  certificate.period->multipliers = bounds.claimed_multipliers(*motion, result);
                                });
  drop_if_at_one_instant(point);
}

}  // namespace clatter::certificates
