#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "point/observers.hpp"
#include "point/point.hpp"
#include "steady/find_steady.hpp"

namespace clatter::point {

/// One scene on its way to a result.
template <stepping::Integrator I>
class Point {
 public:
  Point(const Problem& scene, ThreadScratch& scratch, const I& integrator)
      : scene_(scene), scratch_(scratch), integrator_(integrator) {
    integrator_.report_to(&scratch.progress);
  }

  PointResult run() {
    motion::State<double> state;
    state.x = scene_.start.displacement, state.v = scene_.start.velocity;
    return observe(find_steady(integrator_, state, scene_, scene_.time, scene_.integration));
  }

  /// The result of a motion whose time to observe is known.
  PointResult observe(const steady::ObservedTime& observed) {
    if (failed(observed.status)) return result_of(observed);
    Observers observers = begin(observed);
    motion::State<double> state = observed.from;
    const bool steady = observed.found_by == steady::FoundBy::closed_form && scene_.oscillator.forcing != 0 &&
                        scene_.observe.base_frequency == 0;
    if (steady) observers.response(scene_, state.x, total_);
    stepping::Outcome outcome = stepping::Outcome::completed;
    if (observers.need_flights()) {
      outcome = run_for(integrator_, state, observed.turns, observers);
    } else {
      state.periods += static_cast<std::int64_t>(observed.turns);
    }
    return end(observers, state, outcome);
  }

  /// What is to observe the motion from `observed.from` on.
  Observers begin(const steady::ObservedTime& observed) {
    observed_ = observed;
    const bool forced = scene_.oscillator.forcing != 0;
    total_ = observed_.turns * integrator_.period();
    // the base frequency turns once in a transient and in a period of unforced motion, else with the force
    once_ = observed_.status == steady::Status::transient || (!forced && observed_.status == steady::Status::periodic);
    base_turns_ = once_ ? 1.0 : observed_.turns;
    result_.base_frequency = once_ || !forced ? 2 * pi<double>() * base_turns_ / total_ : scene_.oscillator.frequency;
    if (const double given = scene_.observe.base_frequency; given > 0)
      result_.base_frequency = given, base_turns_ = given * total_ / (2 * pi<double>());
    return Observers(scene_, observed_, total_, result_.base_frequency);
  }

  /// The result, once the observers have seen the motion up to `state`.
  PointResult end(Observers& observers, const motion::State<double>& state, stepping::Outcome outcome) {
    const bool forced = scene_.oscillator.forcing != 0;
    const auto sections = static_cast<double>(state.periods - observed_.from.periods);
    result_.observed_turns = observed_.turns;
    result_.evaluations = observers.evaluations();
    if (outcome != stepping::Outcome::completed) {
      steady::ObservedTime broken = observed_;
      broken.status = steady::status_of(outcome), broken.settled += sections + state.turns;
      result_.base_frequency = no_value;
      return result_of(broken);
    }
    result_.end = {state.x, state.v, scene_.start.phase};
    if (state.turns > 0)
      result_.end.phase = std::fmod(scene_.start.phase + 2 * pi<double>() * state.turns, 2 * pi<double>());
    observers.finish(state.x, state.v, total_, observed_.status == steady::Status::periodic,
                     !forced && observed_.found_by != steady::FoundBy::standstill);
    collect(observers, total_, base_turns_);
    if (observers.impacts) collect_impacts(*observers.impacts, total_, once_ ? 1.0 : observed_.turns);
    steady::ObservedTime complete = observed_;
    if (observers.stability && complete.status == steady::Status::periodic && forced && observers.stability->grazes())
      complete.status = steady::Status::grazing;
    complete.settled += observed_.turns;
    return result_of(complete);
  }

 private:
  PointResult result_of(const steady::ObservedTime& observed) {
    result_.status = observed.status, result_.found_by = observed.found_by, result_.periods = observed.settled;
    result_.settling_estimate = observed.settling;
    result_.impacts = integrator_.impacts();
    result_.evaluations += integrator_.evaluations();
    return std::move(result_);
  }

  void collect(Observers& observers, double total, double base_turns) {
    if (observers.extrema) {
      const auto x = observers.extrema->displacement(scene_.stops), v = observers.extrema->velocity();
      result_.x_min = x.low, result_.x_max = x.high, result_.v_min = v.low, result_.v_max = v.high;
    }
    if (observers.stability) {
      const std::complex<double> multipliers[2] = {observers.stability->first(), observers.stability->second()};
      for (std::size_t i = 0; i < 2; ++i)
        result_.multiplier_re[i] = multipliers[i].real(), result_.multiplier_im[i] = multipliers[i].imag();
      result_.lyapunov = observers.stability->lyapunov();
    }
    if (observers.log) result_.log = std::move(observers.log->impacts());
    if (observers.rests) result_.rests = std::move(observers.rests->rests());
    if (observers.trajectory) {
      result_.tau = observers.trajectory->times(total);
      result_.x = std::move(observers.trajectory->displacement()),
      result_.v = std::move(observers.trajectory->velocity());
    }
    if (observers.exact_harmonics) {
      result_.x_spectrum = observables::Spectrum::of(observers.exact_harmonics->displacement());
      result_.v_spectrum = observables::Spectrum::of(observers.exact_harmonics->velocity());
    }
    if (observers.samples) {
      const auto highest = static_cast<std::size_t>(scene_.observe.harmonics);
      const auto &x = observers.samples->displacement(), &v = observers.samples->velocity();
      const auto sums = scratch_.transform->transform({x, v}, *scratch_.workspace);
      result_.x_spectrum = sampled_spectrum(sums[0], x.size(), base_turns, highest);
      result_.v_spectrum = sampled_spectrum(sums[1], v.size(), base_turns, highest);
    }
  }

  void collect_impacts(const observables::Impacts& impacts, double total, double periods) {
    for (std::size_t i = 0; i < impacts.stops().size(); ++i) {
      const observables::Impacts::OfStop& stop = impacts.stops()[i];
      result_.impacts_per_period[i] = stop.count / periods;
      result_.v_before[i] = stop.before, result_.v_after[i] = stop.after;
      result_.rest_fraction[i] = std::min(1.0, stop.rest_time / total);
    }
    const Stops& stops = scene_.stops;
    if (stops.lower == -stops.upper) result_.velocity_ratio = impacts.first_speed() / stops.upper;
    if (observed_.status == steady::Status::aperiodic) result_.period_ratio = 0.0;
    if (observed_.status != steady::Status::periodic || observed_.found_by == steady::FoundBy::standstill ||
        !impacts.flown())
      return;
    result_.period = total;
    const bool forced = scene_.oscillator.forcing != 0;
    if (forced) result_.period_ratio = observed_.turns;
    if (!forced) result_.eigenfrequency = 2 * pi<double>() / total;
  }

  const Problem& scene_;
  ThreadScratch& scratch_;
  I integrator_;
  steady::ObservedTime observed_{};
  double total_ = 0.0;       ///< observed time in tau
  double base_turns_ = 0.0;  ///< of the base frequency in it
  bool once_ = false;        ///< the observed time as a whole makes one turn
  PointResult result_{};
};

}  // namespace clatter::point
