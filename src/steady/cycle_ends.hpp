#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "steady/contact_at_section.hpp"
#include "steady/repeat.hpp"
#include "stepping/integrator.hpp"

namespace clatter::steady {

/// The instant of the first event that a motion comes to.
class FirstEvent {
 public:
  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    if (!time_ && event.kind != motion::Event::Kind::hold) time_ = event.time;
  }

  [[nodiscard]] const std::optional<double>& time() const { return time_; }  ///< tau

 private:
  std::optional<double> time_{};
};

/// How far displacements of a motion may be off, by rounding and by the tolerance of its repeat; velocities, over
/// `pace_of` the oscillator, as much.
[[nodiscard]] inline double uncertainty_of(const Scene& scene, const motion::State<double>& at, double tolerance) {
  double size = std::abs(at.x) + std::abs(at.v) / pace_of(scene.oscillator);
  for (const double stop : {scene.stops.lower, scene.stops.upper, scene.loose.lower, scene.loose.upper})
    if (std::isfinite(stop)) size = std::max(size, std::abs(stop));
  return (64 * epsilon<double>() + tolerance) * size;
}

/// Makes one period of a motion begin and end on the same side of an event that falls on the section. Rounding may
/// find that just after the beginning and just before the end as well, or at neither, and the period would have it
/// twice, or not at all. A period that begins just before an event begins after it instead, and ends after it, too;
/// else it ends where it has begun, before or after.
template <stepping::Integrator I>
class CycleEnds {
  using State = motion::State<typename I::Number>;

 public:
  /// `uncertainty`: of displacements (`uncertainty_of`).
  CycleEnds(I& integrator, const Scene& scene, double uncertainty)
      : integrator_(integrator), scene_(scene), uncertainty_(uncertainty) {}

  /// Moves the state in which a period begins past the events that are ahead of it by no more than rounding.
  [[nodiscard]] stepping::Outcome begin(State& state) {
    stepping::NoObserver nobody;
    within_ = within(state);
    return pass(state, within_, state.periods, nobody);
  }
  /// Runs on from the end of the period through those events, if they are still ahead.
  template <class Observer>
  [[nodiscard]] stepping::Outcome end(State& state, std::int64_t origin, Observer& observer) {
    const auto phase_turns = state.phase_turns;
    const stepping::Outcome outcome = pass(state, has_passed_ ? 2 * within_ : within_ / 2, origin, observer);
    state.phase_turns = phase_turns;
    return outcome;
  }

 private:
  static constexpr int most_events = 4;  ///< at one instant

  /// The distance of the nearest stop, or of a loose mass from its nearest wall, and the speed relative to it: of the
  /// two that which is nearer in time.
  struct Approach {
    double gap, speed;
  };
  template <class Of>
  [[nodiscard]] static double nearest(double x, const Of& of) {
    return std::min(std::abs(x - of.lower), std::abs(x - of.upper));
  }
  [[nodiscard]] Approach approach(const State& state) const {
    const StopsNow stops(integrator_.stops(), scene_.oscillator.frequency, scene_.start.phase);
    const Approach lower{std::abs(state.x - stops.lower), std::abs(state.v - stops.velocity_lower)},
        upper{std::abs(state.x - stops.upper), std::abs(state.v - stops.velocity_upper)};
    const Approach main = lower.gap < upper.gap ? lower : upper;
    if (!has_loose_mass(scene_.loose)) return main;
    const auto [z, w] = motion::place_in_housing(state, scene_.loose);
    const Approach loose{nearest(z, scene_.loose), std::abs(w)};
    if (!std::isfinite(main.gap)) return loose;
    if (state.loose.pressed) return main;
    return main.gap * loose.speed < loose.gap * main.speed ? main : loose;
  }
  /// How long a state is within rounding of an event, tau. The transient left at a repeat is below its tolerance, but a
  /// contact moves by more than the state does, so as much is allowed as where a repeat is confirmed.
  [[nodiscard]] double within(const State& state) const {
    const double off = RepeatFinder::divisor_tolerances * uncertainty_;
    return std::min(same_instant * integrator_.period(), off / approach(state).speed);
  }
  /// Whether there may be an event so soon. A mass that stands, or is pressed, begins no new one.
  [[nodiscard]] bool may_meet(const State& state, double soon) const {
    const auto [gap, speed] = approach(state);
    const bool is_carried = state.loose.pressed && !std::isfinite(nearest(state.x, integrator_.stops()));
    if (speed == 0 || state.chatters || is_carried) return false;
    const bool nearly_stands = integrator_.is_rough() && speed <= 4 * uncertainty_ * pace_of(scene_.oscillator);
    return nearly_stands || state.within != Side::none || gap <= 2 * soon * speed;
  }
  template <class Observer>
  [[nodiscard]] stepping::Outcome pass(State& state, double soon, std::int64_t origin, Observer& observer) {
    for (int events = 0; events < most_events && may_meet(state, soon); ++events) {
      FirstEvent first;
      State ahead = state;
      I trial = integrator_;
      const double now = state.phase_turns, T = integrator_.period();
      stepping::Outcome outcome = trial.advance(ahead, now + soon / T, state.periods, first);
      if (outcome != stepping::Outcome::completed || !first.time()) return outcome;
      has_passed_ = true;
      outcome = integrator_.advance(state, std::max(now, *first.time() / T) + 4 * epsilon<double>(), origin, observer);
      if (outcome != stepping::Outcome::completed) return outcome;
    }
    return stepping::Outcome::completed;
  }

  I& integrator_;
  const Scene& scene_;
  double uncertainty_;
  double within_ = 0.0;      ///< tau
  bool has_passed_ = false;  ///< an event, at the beginning
};

}  // namespace clatter::steady
