#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "observables/observers.hpp"
#include "point/point.hpp"
#include "steady/cycle_ends.hpp"
#include "steady/find_steady.hpp"
#include "steady/settling_periods.hpp"

namespace clatter::point {

using Observers = observables::Observers<observables::All>;

[[nodiscard]] inline motion::State<double> start_of(const Scene& scene) {
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  if (has_loose_mass(scene.loose)) state.loose = motion::loose_start<double>(scene);
  return state;
}

/// One point on its way to a result: its motion is found, then observed, by an integrator that it brings further. The
/// result is part of it, and to be taken from it.
template <stepping::Integrator I>
class Point {
 public:
  Point(const Problem& problem, ThreadScratch& scratch, I& integrator)
      : problem_(problem),
        integrator_(integrator),
        decisions_(scratch.decisions),
        span_{.scene = problem, .fourier = &scratch.fourier} {
    integrator_.report_to(&scratch.progress);
  }

  PointResult&& run() {
    observed_ = find_steady(integrator_, start(), problem_, problem_.time, problem_.integration);
    if constexpr (I::in_closed_form)
      if (observed_.doubtful) observed_ = decisions_.decided(problem_, std::move(observed_));
    return observe();
  }

  /// The result of a motion whose observed time is known.
  PointResult&& observe(const steady::ObservedTime& observed) {
    observed_ = observed;
    return observe();
  }

  /// The observers of the motion from `observed.from` on.
  Observers begin(const steady::ObservedTime& observed) {
    observed_ = observed;
    return begin();
  }
  [[nodiscard]] const observables::ObservedSpan& span() const { return span_; }  ///< once observation has begun

  /// The result, once the observers have seen the motion up to `state`.
  PointResult&& end(Observers& observers, const motion::State<double>& state, stepping::Outcome outcome) {
    result_.observed_turns = observed_.turns;
    result_.evaluations = observers.evaluations();
    if (outcome != stepping::Outcome::completed) return broken(state, steady::status_of(outcome));
    static_cast<Start&>(result_.end) = {state.x, state.v, problem_.start.phase};
    if (const double turns = force_turns_at_end(state); turns > 0)
      result_.end.phase = std::fmod(problem_.start.phase + 2 * pi<double>() * turns, 2 * pi<double>());
    observers.finish(span_, state.x, state.v, result_);
    if (has_loose_mass(problem_.loose)) tell_loose_end(state);
    if (observers.template of<observables::Energy>() && !std::isfinite(result_.energy_residual)) {
      result_ = {};  // of its values those that are finite would look right
      return broken(state, steady::Status::not_finite);
    }
    if (problem_.observe.settling && is_driven(problem_.oscillator))
      result_.settling_periods =
          settling_periods(integrator_, start(), observed_, problem_.time, observables::Settling::settled,
                           factor_of(problem_.units, Quantity::velocity), problem_);
    const bool grazes = span_.periodic && is_driven(problem_.oscillator) && grazing_is_told(observers);
    return result_with(grazes ? steady::Status::grazing : observed_.status, observed_.turns + periods_beyond_);
  }

 private:
  [[nodiscard]] motion::State<double> start() const { return start_of(problem_); }

  PointResult&& observe() {
    if (failed(observed_.status)) return result_with(observed_.status, 0.0);
    Observers observers = begin();
    motion::State<double> state = observed_.from;
    const bool steady = observed_.found_by == steady::FoundBy::closed_form && observed_.from.within == Side::none &&
                        is_driven(problem_.oscillator) && problem_.observe.base_frequency == 0;
    if (steady) observers.response(span_, state.x);
    stepping::Outcome outcome = stepping::Outcome::completed;
    if (observers.need_flights()) {
      outcome = span_.periodic ? observe_cycle(state, observers) : observe_flights(state, observers);
    } else {
      state.periods += static_cast<std::int64_t>(observed_.turns);
    }
    if (outcome == stepping::Outcome::completed) outcome = complete_section(observers, state);
    return end(observers, state, outcome);
  }
  stepping::Outcome observe_flights(motion::State<double>& state, Observers& observers) {
    return observed_.sections.empty() ? run_for(integrator_, state, observed_.turns, observers)
                                      : run_by_sections(state, observed_.sections, observers);
  }
  /// The flights of one period, which has an event at its beginning once.
  stepping::Outcome observe_cycle(motion::State<double>& state, Observers& observers) {
    steady::CycleEnds ends(integrator_, problem_, span_.uncertainty);
    const std::int64_t origin = state.periods;
    stepping::Outcome outcome = ends.begin(state);
    if (outcome == stepping::Outcome::completed) outcome = observe_flights(state, observers);
    return outcome == stepping::Outcome::completed ? ends.end(state, origin, observers) : outcome;
  }
  Observers begin() {
    describe_span();
    return Observers(problem_.observe, span_);
  }

  /// By which part of a turn the phase of the force lies beyond that of the start once the observed time is over.
  /// Without a force periods are the mass's own, and the phase grows by nu tau all the same: the next point of a chain
  /// may have a force, or may be shaken.
  [[nodiscard]] double force_turns_at_end(const motion::State<double>& state) const {
    if (is_driven(problem_.oscillator)) return state.phase_turns;
    const double periods = static_cast<double>(observed_.from.periods) + observed_.turns;
    return part_of_turn(problem_.oscillator.frequency * integrator_.period() / (2 * pi<double>()) * periods);
  }

  /// Whether derivatives that are asked for don't exist, since the motion grazes a stop.
  [[nodiscard]] static bool grazing_is_told(Observers& observers) {
    const auto& stability = observers.template of<observables::Stability>();
    const auto& sensitivity = observers.template of<observables::Sensitivity>();
    return (stability && stability->grazes()) || (sensitivity && sensitivity->grazes());
  }

  /// Runs each forcing period of a periodic motion from its own state.
  stepping::Outcome run_by_sections(motion::State<double>& state, const std::vector<motion::State<double>>& sections,
                                    Observers& observers) {
    const std::int64_t origin = state.periods;
    for (const motion::State<double>& section : sections) {
      if (!take(section, state)) return stepping::Outcome::unresolved;
      const stepping::Outcome outcome = advance_to_section(integrator_, state, origin, observers);
      if (outcome != stepping::Outcome::completed) return outcome;
    }
    return take(sections.front(), state) ? stepping::Outcome::completed : stepping::Outcome::unresolved;
  }
  /// Replaces a state by the same one known better, unless double has already completed a chatter that goes on in more
  /// digits, or a soft stop's touch falls on the section, which one of them is before, so that it would come twice or
  /// not at all; false if they aren't the same.
  [[nodiscard]] bool take(const motion::State<double>& section, motion::State<double>& state) const {
    constexpr double same = 1e-6;
    const double size = std::max(std::abs(section.x), std::abs(section.v));
    const auto are_near = [&](const steady::SectionNumbers& a, const steady::SectionNumbers& b) {
      return std::max(std::abs(a.x - b.x), std::abs(a.v - b.v)) <= same * size;
    };
    const steady::SectionNumbers here{state.x, state.v}, there{section.x, section.v};
    if (here.v * there.v < 0 || !are_near(here, there)) {
      const steady::BeyondContact beyond_contact(problem_, integrator_.period());
      const bool on_impact = beyond_contact.is_beside(there.x, there.v);  // which one of them is before
      if (on_impact || !are_near(here, there)) return are_near(beyond_contact(here), beyond_contact(there));
    }
    if (state.chatters || state.v == 0 || state.within != section.within) return true;
    const std::int64_t periods = state.periods;
    state = section, state.periods = periods;
    return true;
  }

  /// Follows motion without a period beyond the observed time, as long as its section goes on.
  stepping::Outcome complete_section(Observers& observers, motion::State<double> state) {
    const auto& section = observers.template of<observables::Section>();
    stepping::Outcome outcome = stepping::Outcome::completed;
    observers.template go_on_with<observables::Section>();
    while (section && !section->is_complete() && lacks_period(observed_.status) &&
           outcome == stepping::Outcome::completed) {
      outcome = advance_to_section(integrator_, state, observed_.from.periods, observers);
      ++periods_beyond_;
    }
    return outcome;
  }

  void describe_span() {
    const bool forced = is_driven(problem_.oscillator);
    span_.total = observed_.turns * integrator_.period(), span_.turns = observed_.turns;
    span_.periodic = observed_.status == steady::Status::periodic || observed_.status == steady::Status::creeping;
    span_.undecided = observed_.status == steady::Status::undecided;
    span_.transient = observed_.status == steady::Status::transient;
    span_.stands_still = steady::stands_still(observed_.found_by);
    span_.uncertainty = uncertainty();
    const bool moves_with_keys = observed_.status == steady::Status::creeping;  // the place, though no run gets there
    span_.given = problem_.given && !moves_with_keys ? &*problem_.given : nullptr, span_.units = problem_.units;
    // a section under a force has the phase of the start
    const double after = forced ? 0.0 : static_cast<double>(observed_.from.periods) * integrator_.period();
    span_.theta = forcing_phase(problem_, after), span_.frame = observed_frame(problem_, after);
    span_.frame_sign = frame_sign(problem_);
    // the base frequency turns once in a transient and in a period of unforced motion, else with the force
    span_.base_turns = span_.counts_as_one_period() ? 1.0 : span_.turns;
    span_.base_frequency = span_.counts_as_one_period() || !forced ? 2 * pi<double>() * span_.base_turns / span_.total
                                                                   : problem_.oscillator.frequency;
    if (const double given = problem_.observe.base_frequency; given > 0)
      span_.base_frequency = given, span_.base_turns = given * span_.total / (2 * pi<double>());
  }

  /// How far displacements and velocities may be off: by rounding, and after a repeat by its tolerance.
  [[nodiscard]] double uncertainty() const {
    const double tolerance = observed_.found_by == steady::FoundBy::repetition ? problem_.time.tolerance : 0.0;
    return steady::uncertainty_of(problem_, observed_.from, tolerance);
  }

  /// Keeps the place of a loose mass at the end.
  void tell_loose_end(const motion::State<double>& state) {
    const auto [z, w] = motion::place_in_housing(state, problem_.loose);
    result_.end.loose_place = z, result_.end.loose_velocity = w;
    if (problem_.observe.attractor) result_.attractor_z = z, result_.attractor_w = w;
  }

  /// The result if the run, or an observable, fails at a state.
  PointResult&& broken(const motion::State<double>& state, steady::Status status) {
    return result_with(status, static_cast<double>(state.periods - observed_.from.periods) + state.phase_turns);
  }

  /// The result after so many forcing periods beyond those of the search.
  PointResult&& result_with(steady::Status status, double periods) {
    result_.status = status, result_.found_by = observed_.found_by, result_.periods = observed_.simulated + periods;
    result_.settling_estimate = observed_.settling;
    result_.impacts = integrator_.impacts();
    result_.evaluations += integrator_.evaluations();
    return std::move(result_);
  }

  const Problem& problem_;
  I& integrator_;
  Decisions& decisions_;
  steady::ObservedTime observed_{};
  observables::ObservedSpan span_;
  PointResult result_;
  double periods_beyond_ = 0.0;  ///< the observed time, for the section
};

}  // namespace clatter::point
