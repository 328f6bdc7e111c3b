// Both in one file: most of its templates are compiled for both.

#include "point/fixed_point.hpp"
#include "point/resting_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motion/tangent_map.hpp"
#include "point/error_watch.hpp"
#include "point/every_effect.hpp"
#include "point/fifty_digit_periods.hpp"
#include "steady/repeat.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::point {
namespace {

constexpr double trusted = 1e-14;     // errors relative to the motion's size
constexpr double most_impacts = 1e5;  // each takes up to a millisecond
constexpr auto longest = static_cast<std::int64_t>(steady::RepeatFinder::longest);

stepping::Limits limits_in_fifty_digits(const Problem& problem) {
  stepping::Limits limits = limits_of(problem);
  limits.impacts = std::min(limits.impacts, most_impacts);
  return limits;
}

/// Whether a mass may come to rest on a stop.
bool can_hold(const Problem& problem, Side side) {
  const Stops& stops = problem.stops;
  const double position = side == Side::upper ? stops.upper : stops.lower,
               R = side == Side::upper ? stops.restitution_upper : stops.restitution_lower;
  return std::isfinite(position) && !is_soft(stops, side) && (R != 1 || has_friction(problem.friction));
}

template <Effects E>
RestingMotion run_from_release(const Problem& problem, Side side) {
  using Kind = RestingMotion::Kind;
  const BasicScene<FiftyDigits> scene = in_fifty_digits(problem);
  stepping::Exact<FiftyDigits, E> integrator(scene, scene.stops, limits_in_fifty_digits(problem),
                                             motion::ChatterRule<FiftyDigits>::as_in_double());
  auto state = integrator.released_from(side);
  if (!state) return {};
  RestingMotion motion{.kind = Kind::undecided};
  ErrorWatch<FiftyDigits, E> watch(problem);
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
        motion.kind = Kind::periodic;
        return motion;
      }
      returns = returns || first;
      if (!first) first = period;
      latest = period;
    }
    motion.sections.push_back(rounded(*state));
  }
  motion.kind = returns ? Kind::longer : Kind::departs;
  return motion;
}

/// Keeps the events of a motion, and watches how far rounding carries it.
template <Effects E>
class WatchedEvents {
 public:
  explicit WatchedEvents(const Scene& scene) : watch_(scene) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    watch_.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) { add(rest), watch_.rest(rest); }
  void impact(const motion::Impact& impact) { add(impact), watch_.impact(impact); }
  void touch(const motion::Touch& touch) { add(touch), watch_.touch(touch); }
  void separate(const motion::Separation& separation) { add(separation); }
  void reversal(const motion::Reversal& reversal) { add(reversal), watch_.reversal(reversal); }

  [[nodiscard]] bool is_trusted() const { return watch_.error() <= trusted; }
  /// Those since a time, which becomes 0.
  [[nodiscard]] std::vector<motion::Event> events_since(double begin) const {
    std::vector<motion::Event> events = events_;
    for (motion::Event& event : events) event.time -= begin;
    return events;
  }

 private:
  template <class Happened>
  void add(const Happened& happened) {
    events_.push_back(event_of(happened));
  }

  ErrorWatch<FiftyDigits, E> watch_;
  std::vector<motion::Event> events_{};
};

template <Effects E>
std::optional<ReleasedMotion> run_until_released(const Problem& problem, Side side, std::int64_t periods) {
  const BasicScene<FiftyDigits> scene = in_fifty_digits(problem);
  stepping::Exact<FiftyDigits, E> integrator(scene, scene.stops, limits_in_fifty_digits(problem),
                                             motion::ChatterRule<FiftyDigits>::as_in_double());
  auto state = integrator.released_from(side);
  if (!state) return std::nullopt;
  const FiftyDigits phase = state->phase_turns;
  WatchedEvents<E> watch(problem);
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

/// Computes the derivative of a motion.
class Derivative {
 public:
  explicit Derivative(const Stops& stops) : tangent_(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    tangent_.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) { tangent_.rest(rest); }
  void impact(const motion::Impact& impact) { tangent_.impact(impact); }
  void touch(const motion::Touch& touch) { tangent_.touch(touch); }
  void reversal(const motion::Reversal& reversal) { tangent_.reversal(reversal); }

  [[nodiscard]] motion::Jacobian<FiftyDigits> map() const { return tangent_.map(); }

 private:
  motion::TangentMap<FiftyDigits> tangent_;
};

template <Effects E>
std::optional<FixedPoint> find_fixed_point(const Problem& problem, const motion::State<double>& near,
                                           std::int64_t periods, const std::function<bool()>& stopped) {
  constexpr int most_iterations = 12;
  FixedPoint found;
  found.start.x = near.x, found.start.v = near.v;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Derivative derivative(problem.stops);
    const auto state = run_periods<E>(problem, found, periods, stopped, derivative);
    if (!state) return std::nullopt;
    const FiftyDigits dx = state->x - found.start.x, dv = state->v - found.start.v;
    if (abs(dx) + abs(dv) <= FiftyDigits(1e-30) * (abs(state->x) + abs(state->v))) return found;
    const motion::Jacobian<FiftyDigits> D = derivative.map();
    const FiftyDigits determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
    found.start.x += ((1 - D[3]) * dx + D[1] * dv) / determinant;
    found.start.v += (D[2] * dx + (1 - D[0]) * dv) / determinant;
  }
  return std::nullopt;
}

}  // namespace

std::optional<FixedPoint> fixed_point(const Problem& problem, const motion::State<double>& near, std::int64_t periods,
                                      const std::function<bool()>& stopped) {
  return with_every_effect(problem, [&]<Effects E>() { return find_fixed_point<E>(problem, near, periods, stopped); });
}

std::optional<ReleasedMotion> released_motion(const Problem& problem, Side side, std::int64_t periods) {
  if (!can_hold(problem, side)) return std::nullopt;
  return with_every_effect(problem, [&]<Effects E>() { return run_until_released<E>(problem, side, periods); });
}

RestingMotion resting_motion(const Problem& problem, Side side) {
  if (!can_hold(problem, side)) return {};
  return with_every_effect(problem, [&]<Effects E>() { return run_from_release<E>(problem, side); });
}

}  // namespace clatter::point
