#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/wide_functions.hpp"
#include "motion/tangent_map.hpp"
#include "motion/together.hpp"
#include "point/error_watch.hpp"
#include "point/every_effect.hpp"
#include "point/fifty_digit_periods.hpp"
#include "point/in_digits.hpp"
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

/// Whether rounding has left a run's sections what they are.
template <class Number, Effects E>
bool is_trusted(const ErrorWatch<Number, E>& watch) {
  return watch.error() <= trusted_of_sections<Number>;
}

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
  ErrorWatch<Number, E> watch(problem);
  std::array<std::optional<std::int64_t>, 2> released_at;  // [stop]: the forcing period of its first release
  released_at[index_of(side)] = 0;
  std::int64_t latest = 0;  // forcing period of the latest release
  bool returns = false;     // after too many periods
  for (std::int64_t period = 0; period <= 2 * longest && period - latest <= longest; ++period) {
    ++motion.simulated;
    const stepping::Outcome outcome = advance_to_section(integrator, *state, 0, watch);
    if (outcome != stepping::Outcome::completed || !(watch.error() <= trusted)) return motion;
    const std::array<bool, 2> releases = watch.take_releases();
    for (std::size_t stop = 0; stop < 2; ++stop) {
      if (!releases[stop]) continue;
      auto& first = released_at[stop];
      if (first && period - *first <= longest) {
        motion.sections.erase(motion.sections.begin(), motion.sections.begin() + *first);
        motion.kind = watch.error() <= trusted_of_sections<Number> ? Kind::periodic : Kind::undecided;
        return motion;
      }
      returns = returns || first;
      if (!first) first = period;
      latest = period;
    }
    motion.sections.push_back(rounded(*state));
  }
  motion.kind = returns ? Kind::longer : Kind::departs;
  if (!(watch.error() <= trusted_of_sections<Number>)) motion.sections.clear();
  return motion;
}

/// Keeps the events of a motion.
class EventKeeper {
 public:
  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) { events_.push_back(event); }

  /// Those since a time, which becomes 0.
  [[nodiscard]] std::vector<motion::Event> events_since(double begin) const {
    std::vector<motion::Event> events = events_;
    for (motion::Event& event : events) event.time -= begin;
    return events;
  }

 private:
  std::vector<motion::Event> events_{};
};

template <class Number, Effects E>
std::optional<ReleasedMotion> run_until_released(const Problem& problem, Side side, std::int64_t periods) {
  const BasicScene<Number> scene = in_digits<Number>(problem);
  stepping::Guided<Number, E> integrator(scene, scene.stops, limits_in_more_digits(problem),
                                         motion::ChatterRule<Number>::as_in_double());
  auto state = integrator.released_from(side);
  if (!state) return std::nullopt;
  const Number phase = state->phase_turns;
  EventKeeper kept;
  ErrorWatch<Number, E> watch(problem);
  motion::Together observers(kept, watch);
  auto outcome = stepping::Outcome::completed;
  for (std::int64_t period = 0; period < periods && outcome == stepping::Outcome::completed; ++period)
    outcome = advance_to_section(integrator, *state, 0, observers);
  if (outcome == stepping::Outcome::completed) outcome = integrator.advance(*state, phase, 0, observers);
  const double release = static_cast<double>(phase) * period_of(problem.oscillator);
  const double end = static_cast<double>(periods) * period_of(problem.oscillator);
  ReleasedMotion motion{release, kept.events_since(release)};
  const bool returns = outcome == stepping::Outcome::completed && is_trusted(watch) && !motion.events.empty() &&
                       motion.events.back().kind == motion::Event::Kind::rest && motion.events.back().side == side &&
                       motion.events.back().end() >= end * (1 - 4 * epsilon<double>());
  return returns ? std::optional(std::move(motion)) : std::nullopt;
}

/// By Newton's method, until a step is below 1e-30 of the state; in 31 digits, which rounding leaves a step of its own,
/// until the one after a step that was small already, so that only rounding is left.
template <class Integrator>
std::optional<BasicFixedPoint<typename Integrator::Number>> find_fixed_point(const Problem& problem,
                                                                             const motion::State<double>& near,
                                                                             std::int64_t periods,
                                                                             const std::function<bool()>& stopped) {
  using Number = typename Integrator::Number;
  constexpr int most_iterations = 12;
  constexpr bool has_digits_to_spare = std::numeric_limits<Number>::digits10 > 40;
  BasicFixedPoint<Number> found;
  found.start.x = near.x, found.start.v = near.v;
  bool was_small = has_digits_to_spare;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    motion::TangentMap<Number> tangent(problem.stops);
    ErrorWatch<Number, Integrator::effects> watch(problem);
    motion::Together observers(tangent, watch);
    const auto state = run_periods<Integrator>(problem, found, periods, stopped, observers);
    if (!state) return std::nullopt;
    const Number dx = state->x - found.start.x, dv = state->v - found.start.v;
    const bool is_small =
        abs(dx) + abs(dv) <= Number(has_digits_to_spare ? 1e-30 : 1e-21) * (abs(state->x) + abs(state->v));
    if (is_small && was_small) return has_digits_to_spare || is_trusted(watch) ? std::optional(found) : std::nullopt;
    was_small = is_small || has_digits_to_spare;
    const motion::Jacobian<Number> D = tangent.map();
    const Number determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
    found.start.x += ((1 - D[3]) * dx + D[1] * dv) / determinant;
    found.start.v += (D[2] * dx + (1 - D[0]) * dv) / determinant;
  }
  return std::nullopt;
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
    return find_fixed_point<stepping::Guided<Number, E>>(problem, near, periods, stopped);
  });
}

}  // namespace clatter::point
