#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "math/wide_functions.hpp"
#include "motion/tangent_map.hpp"
#include "point/error_watch.hpp"
#include "point/every_effect.hpp"
#include "point/fifty_digit_periods.hpp"
#include "point/in_digits.hpp"
#include "point/in_fifty_digits.hpp"
#include "steady/repeat.hpp"
#include "stepping/guided.hpp"
#include "stepping/run.hpp"

// The definitions of `InDigits`, for the two files that compile them: each takes a third of a minute.

namespace clatter::point {

/// Errors relative to the motion's size up to which the events of a run are believed.
constexpr double trusted = 1e-14;
/// The same of its sections: in 31 digits they have to be so exact that, rounded to double, they are those of 50 digits
/// but once in some 10^5.
template <class Number>
constexpr double trusted_of_sections = std::numeric_limits<Number>::digits10 > 40 ? trusted : 1e-21;

/// Watches a run in more digits: its errors, and, if they are asked for, its events and its derivative. One class for
/// all runs, since each observer has the integrator compiled anew.
template <class Number, Effects E>
class WatchInDigits {
 public:
  explicit WatchInDigits(const Problem& problem) : errors(problem) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (tangent) tangent->arc(arc, begin, length);
    errors.arc(arc, begin, length);
  }
  void event(const motion::Event& event) {
    if (keeps_events) events.push_back(event);
    if (tangent) tangent->event(event);
    errors.event(event);
  }

  /// Whether rounding has left the sections what they are.
  [[nodiscard]] bool is_trusted() const { return errors.error() <= trusted_of_sections<Number>; }
  /// The events since a time, which becomes 0.
  [[nodiscard]] std::vector<motion::Event> events_since(double begin) const {
    std::vector<motion::Event> later = events;
    for (motion::Event& event : later) event.time -= begin;
    return later;
  }

  ErrorWatch<Number, E> errors;
  std::optional<motion::TangentMap<Number>> tangent{};
  bool keeps_events = false;
  std::vector<motion::Event> events{};
};

inline stepping::Limits limits_in_more_digits(const Problem& problem) {
  constexpr double most_impacts = 1e5;  // each takes up to a millisecond
  stepping::Limits limits = limits_of(problem);
  limits.impacts = std::min(limits.impacts, most_impacts);
  return limits;
}

template <class Number, Effects E>
RestingMotion run_from_release(const Problem& problem, Side side) {
  using Kind = RestingMotion::Kind;
  constexpr auto longest = static_cast<std::int64_t>(steady::RepeatFinder::longest);
  const BasicScene<Number> scene = in_digits<Number>(problem);
  stepping::Guided<Number, E> integrator(scene, scene.stops, limits_in_more_digits(problem),
                                         motion::ChatterRule<Number>::as_in_double());
  auto state = integrator.released_from(side);
  if (!state) return {};
  RestingMotion motion{.kind = Kind::undecided};
  if (problem.oscillator.shape.table != nullptr) return motion;  // in a period a stop may let it go several times
  WatchInDigits<Number, E> watch(problem);
  std::array<std::optional<std::int64_t>, 2> released_at;  // [stop]: the forcing period of its first release
  released_at[index_of(side)] = 0;
  std::int64_t latest = 0;  // forcing period of the latest release
  bool returns = false;     // after too many periods
  for (std::int64_t period = 0; period <= 2 * longest && period - latest <= longest; ++period) {
    ++motion.simulated;
    const stepping::Outcome outcome = advance_to_section(integrator, *state, 0, watch);
    if (outcome != stepping::Outcome::completed || !(watch.errors.error() <= trusted)) return motion;
    const std::array<bool, 2> releases = watch.errors.take_releases();
    for (std::size_t stop = 0; stop < 2; ++stop) {
      if (!releases[stop]) continue;
      auto& first = released_at[stop];
      if (first && period - *first <= longest) {
        motion.sections.erase(motion.sections.begin(), motion.sections.begin() + *first);
        motion.kind = watch.is_trusted() ? Kind::periodic : Kind::undecided;
        return motion;
      }
      returns = returns || first;
      if (!first) first = period;
      latest = period;
    }
    motion.sections.push_back(rounded(*state));
  }
  motion.kind = returns ? Kind::longer : Kind::departs;
  if (!watch.is_trusted()) motion.sections.clear();
  return motion;
}

template <class Number, Effects E>
std::optional<ReleasedMotion> run_until_released(const Problem& problem, Side side, std::int64_t periods) {
  const BasicScene<Number> scene = in_digits<Number>(problem);
  stepping::Guided<Number, E> integrator(scene, scene.stops, limits_in_more_digits(problem),
                                         motion::ChatterRule<Number>::as_in_double());
  auto state = integrator.released_from(side);
  if (!state) return std::nullopt;
  const Number phase = state->phase_turns;
  WatchInDigits<Number, E> watch(problem);
  watch.keeps_events = true;
  auto outcome = stepping::Outcome::completed;
  for (std::int64_t period = 0; period < periods && outcome == stepping::Outcome::completed; ++period)
    outcome = advance_to_section(integrator, *state, 0, watch);
  if (outcome == stepping::Outcome::completed) outcome = integrator.advance(*state, phase, 0, watch);
  const double release = static_cast<double>(phase) * period_of(problem.oscillator);
  const double end = static_cast<double>(periods) * period_of(problem.oscillator);
  ReleasedMotion motion{release, watch.events_since(release)};
  const bool returns = outcome == stepping::Outcome::completed && watch.is_trusted() && !motion.events.empty() &&
                       motion.events.back().kind == motion::Event::Kind::rest && motion.events.back().side == side &&
                       motion.events.back().end() >= end * (1 - 4 * epsilon<double>());
  return returns ? std::optional(std::move(motion)) : std::nullopt;
}

/// Some periods from a state on: where they end, and the derivative of that by the state.
template <class Number>
struct Round {
  motion::State<Number> end{};
  motion::Jacobian<Number> derivative{};
  bool is_trusted = true;  ///< rounding has left the sections what they are
};

/// By Newton's method with `round_of(found)`, until a step is below 1e-30 of the state; in 31 digits, which rounding
/// leaves a step of its own, until the one after a step that was small already, so that only rounding is left.
template <class Number, class RoundOf>
std::optional<BasicFixedPoint<Number>> find_fixed_point(const motion::State<double>& near, RoundOf&& round_of) {
  constexpr int most_iterations = 12;
  constexpr bool has_digits_to_spare = std::numeric_limits<Number>::digits10 > 40;
  BasicFixedPoint<Number> found;
  found.start.x = near.x, found.start.v = near.v;
  bool was_small = has_digits_to_spare;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::optional<Round<Number>> round = round_of(found);
    if (!round) return std::nullopt;
    const auto& [state, D, is_trusted] = *round;
    const Number dx = state.x - found.start.x, dv = state.v - found.start.v;
    const bool is_small =
        abs(dx) + abs(dv) <= Number(has_digits_to_spare ? 1e-30 : 1e-21) * (abs(state.x) + abs(state.v));
    if (is_small && was_small) return has_digits_to_spare || is_trusted ? std::optional(found) : std::nullopt;
    was_small = is_small || has_digits_to_spare;
    const Number determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
    found.start.x += ((1 - D[3]) * dx + D[1] * dv) / determinant;
    found.start.v += (D[2] * dx + (1 - D[0]) * dv) / determinant;
  }
  return std::nullopt;
}

/// The periods from a fixed point on, of which double guides the search for contacts.
template <class Number, Effects E>
std::optional<Round<Number>> guided_round(const Problem& problem, BasicFixedPoint<Number>& found, std::int64_t periods,
                                          const std::function<bool()>& stopped) {
  stepping::Guided<Number, E> integrator(in_digits<Number>(problem), limits_of(problem));
  WatchInDigits<Number, E> watch(problem);
  watch.tangent.emplace(problem.stops);
  const auto end = run_periods(found, periods, stopped,
                               [&](auto& state) { return advance_to_section(integrator, state, 0, watch); });
  if (!end) return std::nullopt;
  return Round<Number>{*end, watch.tangent->map(), watch.is_trusted()};
}

template <class Number>
RestingMotion InDigits<Number>::resting_motion(const Problem& problem, Side side) {
  return with_every_effect(problem, [&]<Effects E>() { return run_from_release<Number, E>(problem, side); });
}
template <class Number>
std::optional<ReleasedMotion> InDigits<Number>::released_motion(const Problem& problem, Side side,
                                                                std::int64_t periods) {
  return with_every_effect(problem, [&]<Effects E>() { return run_until_released<Number, E>(problem, side, periods); });
}
template <class Number>
std::optional<BasicFixedPoint<Number>> InDigits<Number>::fixed_point(const Problem& problem,
                                                                     const motion::State<double>& near,
                                                                     std::int64_t periods,
                                                                     const std::function<bool()>& stopped) {
  return with_every_effect(problem, [&]<Effects E>() {
    return find_fixed_point<Number>(
        near, [&](auto& found) { return guided_round<Number, E>(problem, found, periods, stopped); });
  });
}

}  // namespace clatter::point
