#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "dynamics/neighbourhood.hpp"
#include "integrators/contraction.hpp"
#include "integrators/exact.hpp"
#include "integrators/repeat.hpp"
#include "integrators/run.hpp"
#include "integrators/section_watch.hpp"

namespace clatter {

/// A periodic motion of n forcing periods: its states at the sections and its derivative.
struct Orbit {
  std::size_t periods = 0;
  std::array<State<double>, RepeatFinder::longest + 1> states{};     ///< the last as computed from the first
  std::array<Map<double>, RepeatFinder::longest + 1> derivatives{};  ///< of each by the first
  std::array<Passage, RepeatFinder::longest> passages{};             ///< from each state but the last to the next

  double settling = 0.0;  ///< forcing periods until the motion that approaches it is within the tolerance of it

  [[nodiscard]] Change gap() const { return between(states[0], states[periods]); }
  [[nodiscard]] const Map<double>& derivative() const { return derivatives[periods]; }
};

/// The map of states over n forcing periods, its derivative, and Newton's method for its fixed points.
template <Effects E>
class PeriodMap {
 public:
  PeriodMap(Exact<double, E>& integrator, double tolerance)
      : integrator_(integrator), watch_(integrator.stops()), tolerance_(tolerance) {}

  /// Times that an attempt follows all periods of a motion: the approach, each iteration, the proof.
  static constexpr std::size_t most_iterations = 4, most_turns = 1 + most_iterations + 1;

  [[nodiscard]] std::size_t simulated() const { return simulated_; }  ///< forcing periods

  /// The motion over n periods from a state, under the eyes of another observer, too; nothing where it fails.
  template <class Observer>
  [[nodiscard]] std::optional<Orbit> follow(State<double> state, std::size_t periods, Observer&& also) {
    Orbit orbit{.periods = periods};
    orbit.states[0] = state, orbit.derivatives[0] = {1, 0, 0, 1};
    watch_.differentiate();
    Pair<Observer> observers{watch_, also};
    for (std::size_t i = 1; i <= periods; ++i) {
      ++simulated_;
      watch_.begin_section();
      if (advance_to_section(integrator_, state, orbit.states[0].periods, observers) != Outcome::completed)
        return std::nullopt;
      orbit.states[i] = state, orbit.derivatives[i] = watch_.derivative();
      orbit.passages[i - 1] = watch_.passage();
    }
    return orbit;
  }
  [[nodiscard]] std::optional<Orbit> follow(const State<double>& state, std::size_t periods) {
    return follow(state, periods, NoObserver{});
  }

  /// The periodic motion that a motion, once round, is settling to: found by Newton's method from where that began, on
  /// the branch that it is really on (the same stops in the same order), and proved to attract a neighbourhood in which
  /// the motion is at the end of its round.
  [[nodiscard]] std::optional<Orbit> attractor_of(const Orbit& approach) {
    State<double> start = moved(approach.states[0], newton_step(approach.derivative(), approach.gap()));
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
      if (!inside(start)) return std::nullopt;
      const std::optional<Orbit> orbit = follow(start, approach.periods);
      if (!orbit || orbit->passages != approach.passages) return std::nullopt;
      const double gap = orbit->gap().size();
      const bool found = gap <= tolerance_ * size_of(start);
      if (!found && !(gap < before / 4)) return std::nullopt;
      before = gap;
      start = moved(start, newton_step(orbit->derivative(), orbit->gap()));
      if (found) return attracting(start, *orbit, approach.states[approach.periods]);
    }
    return std::nullopt;
  }

 private:
  /// Two observers of one motion.
  template <class Observer>
  struct Pair {
    SectionWatch& one;
    Observer& other;

    template <class A>
    void arc(const A& arc, double begin, double length) {
      one.arc(arc, begin, length), other.arc(arc, begin, length);
    }
    void rest(const Rest& rest) { one.rest(rest), other.rest(rest); }
    void impact(const Impact& impact) { one.impact(impact), other.impact(impact); }
  };

  [[nodiscard]] bool inside(const State<double>& state) const {
    return state.x >= integrator_.stops().lower && state.x <= integrator_.stops().upper && std::isfinite(state.v);
  }

  [[nodiscard]] static double size_of(const State<double>& state) {
    return std::max(std::abs(state.x), std::abs(state.v));
  }

  [[nodiscard]] static State<double> moved(State<double> state, const Change& change) {
    if (change.x == 0 && change.v == 0) return state;
    state.x += change.x, state.rise += change.x, state.v += change.v, state.released = false;
    return state;
  }

  /// The periodic motion from `start`, if it is proved to attract `motion`: over the disc around it that holds
  /// `motion`, in a norm in which its derivative contracts, all motions meet the same stops in the same order, and what
  /// the derivative doesn't tell of them is less than what it takes away.
  [[nodiscard]] std::optional<Orbit> attracting(const State<double>& start, const Orbit& orbit,
                                                const State<double>& motion) {
    if (!(spectral_radius(orbit.derivative()) < 1) || !inside(start)) return std::nullopt;
    const ContractionNorm measure(orbit.derivative());
    const double rounding = 64 * epsilon<double>() * size_of(start);
    const double radius = measure.of(between(start, motion)) * (1 + 1e-9) + rounding;
    Neighbourhood neighbourhood(integrator_.stops(), measure.disc(radius), rounding);
    std::optional<Orbit> attractor = follow(start, orbit.periods, neighbourhood);
    if (!attractor || !neighbourhood.holds()) return std::nullopt;
    const double left =
        measure.of(neighbourhood.told()) + measure.of(neighbourhood.untold()) + measure.of(attractor->gap());
    if (!(left < radius)) return std::nullopt;
    const double rounds = std::log(between(start, motion).size() / (tolerance_ * size_of(start))) /
                          -std::log(spectral_radius(orbit.derivative()));
    attractor->settling = static_cast<double>(orbit.periods) * (1 + std::max(0.0, rounds));
    return attractor;
  }

  Exact<double, E>& integrator_;
  SectionWatch watch_;
  double tolerance_;
  std::size_t simulated_ = 0;
};

}  // namespace clatter
