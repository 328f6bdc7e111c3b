#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "accuracy/run_record.hpp"
#include "math/fifty_digits.hpp"
#include "motion/tangent_map.hpp"
#include "observables/exact_harmonics.hpp"
#include "observables/extrema_observer.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

/// Runs of a number type with the observables of a record. Each use compiles the integrator anew.
namespace clatter::accuracy::detail {

/// A motion at an instant, rounded to double.
inline motion::Motion<double> rounded(const motion::Motion<FiftyDigits>& m) {
  const auto d = [](const FiftyDigits& y) { return static_cast<double>(y); };
  return {d(m.offset), d(m.x), d(m.v), d(m.a), d(m.sine), d(m.cosine)};
}
inline const motion::Motion<double>& rounded(const motion::Motion<double>& m) { return m; }

/// Records the events of a run and, if asked for, its observables and its derivative.
template <class Number, Effects E>
class RunObserver {
 public:
  RunObserver(const point::Problem& scene, const std::optional<RecordObservables>& observables)
      : stops_(scene.stops), constants_(scene.oscillator), tangent_(scene.stops) {
    if (observables) harmonics_.emplace(observables->harmonics, observables->base_frequency);
  }

  template <Effects Of>
  void arc(const motion::Arc<Number, Of>& arc, double begin, double length) {
    if (differentiates_) tangent_.arc(arc, begin, length);
    if (!harmonics_) return;
    if constexpr (E.soft) {
      const Side side = arc.constants().stop.side;
      if (side != Side::none) {
        const auto stop = motion::soft_stop_at<double>(stops_, side);
        return see(arc, motion::ArcConstants<double, Of>::in_contact(constants_, stop), begin, length);
      }
    }
    if constexpr (Of == E.arc()) see(arc, constants_, begin, length);
  }
  void rest(const motion::Rest& rest) {
    events.push_back(event_of(rest));
    if (differentiates_) tangent_.rest(rest);
    if (harmonics_) extrema_.rest(rest), harmonics_->rest(rest);
  }
  void impact(const motion::Impact& impact) {
    events.push_back(event_of(impact));
    if (differentiates_) tangent_.impact(impact);
    if (harmonics_) extrema_.impact(impact);
  }

  /// A contact with a soft stop is an event like an impact.
  void touch(const motion::Touch& touch) {
    events.push_back({Event::Kind::impact, touch.side, touch.time, std::abs(touch.velocity), 0.0});
    if (differentiates_) tangent_.touch(touch);
  }

  void differentiate() { differentiates_ = true; }
  [[nodiscard]] motion::Jacobian<Number> derivative() const { return tangent_.map(); }

  void finish(RunRecord& record) {
    record.events = std::move(events);
    if (!harmonics_) return;
    harmonics_->finish(record.x, record.duration);
    record.harmonics = harmonics_->displacement(), record.v_harmonics = harmonics_->velocity();
    record.x_range = extrema_.displacement(rigid_ones(stops_)), record.v_range = extrema_.velocity();
  }

  std::vector<Event> events{};

 private:
  /// Shows an arc in double to the observables.
  template <Effects Of>
  void see(const motion::Arc<Number, Of>& arc, const motion::ArcConstants<double, Of>& constants, double begin,
           double length) {
    const motion::Arc<double, Of> in_double(constants, rounded(arc.start()), static_cast<double>(arc.anchor()));
    extrema_.arc(in_double, begin, length);
    harmonics_->arc(in_double, begin, length);
  }

  Stops stops_;
  motion::ArcConstants<double, E.arc()> constants_;
  motion::TangentMap<Number> tangent_;
  bool differentiates_ = false;
  observables::Extrema::Observer extrema_;
  std::optional<observables::ExactHarmonics> harmonics_;
};

template <class Number>
motion::State<Number> start_of(const point::Problem& scene) {
  motion::State<Number> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  return state;
}

/// Runs for a time given in forcing periods, unless it is stopped.
template <stepping::Integrator I, class Observer>
stepping::Outcome run_unless(const std::function<bool()>& stopped, I& integrator,
                             motion::State<typename I::Number>& state, const typename I::Number& turns,
                             Observer& observer) {
  using Number = typename I::Number;
  const auto sections = static_cast<std::int64_t>(turns);
  for (std::int64_t section = 0; section < sections; ++section) {
    if (stopped && stopped()) return stepping::Outcome::unresolved;
    const stepping::Outcome outcome = advance_to_section(integrator, state, 0, observer);
    if (outcome != stepping::Outcome::completed) return outcome;
  }
  return integrator.advance(state, Number(turns - Number(sections)), 0, observer);
}

template <class Number, Effects E>
RunRecord run_from(const point::Problem& scene, motion::State<Number> state, const Number& turns, double duration,
                   const std::optional<RecordObservables>& observables, const std::function<bool()>& stopped) {
  RunRecord record;
  record.duration = duration;
  stepping::Exact<Number, E> integrator(scene, limits_of(scene));
  RunObserver<Number, E> observer(scene, observables);
  record.outcome = run_unless(stopped, integrator, state, turns, observer);
  record.x = static_cast<double>(state.x), record.v = static_cast<double>(state.v);
  record.impacts = integrator.impacts(), record.evaluations = integrator.evaluations();
  observer.finish(record);
  return record;
}

/// From the start of a scene for a time in tau.
template <class Number, Effects E>
RunRecord run_over(const point::Problem& scene, double duration, const std::optional<RecordObservables>& observables,
                   const std::function<bool()>& stopped = {}) {
  const Number period = 2 * pi<Number>() / Number(counting_frequency(scene.oscillator));
  return run_from<Number, E>(scene, start_of<Number>(scene), Number(Number(duration) / period), duration, observables,
                             stopped);
}

}  // namespace clatter::accuracy::detail
