#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "accuracy/run_record.hpp"
#include "motion/walls.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "point/rounded.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

/// Runs of a number type with the observables of a record. Each use compiles the integrator anew.
namespace clatter::accuracy::detail {

/// Records the events of a run and, if asked for, its observables.
template <class Number, Effects E>
class RunObserver {
 public:
  RunObserver(const point::Problem& scene, const std::optional<RecordObservables>& observables)
      : stops_(scene.stops), in_double_(scene) {
    if (observables) harmonics_.emplace(observables->harmonics, observables->base_frequency);
  }

  template <Effects Of>
  void arc(const motion::Arc<Number, Of>& arc, double begin, double length) {
    if (!harmonics_) return;
    in_double_.show(arc, [&](const auto& rounded) {
      extrema_.arc(rounded, begin, length);
      harmonics_->arc(rounded, begin, length);
    });
  }
  /// While a soft wall couples both masses.
  void arc(const motion::CoupledArc<Number>& arc, double begin, double length) {
    if (!harmonics_) return;
    const auto rounded = point::in_double(arc);
    extrema_.arc(rounded, begin, length), harmonics_->arc(rounded, begin, length);
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const motion::Event seen = event.in_housing();
    if (seen.kind == Kind::touch || seen.kind == Kind::renewal)
      events.push_back(as_impact(seen));
    else if (seen.kind != Kind::separation && seen.kind != Kind::press)
      events.push_back(seen);
    if (!harmonics_ || (event.kind == Kind::strike && !(event.time > 0))) return;
    extrema_.event(event), harmonics_->event(event);
  }

  void finish(RunRecord& record) {
    record.events = E.loose ? with_slow_impacts_summed(events) : std::move(events);
    if (!harmonics_) return;
    harmonics_->finish(record.x, record.duration);
    record.harmonics = harmonics_->displacement(), record.v_harmonics = harmonics_->velocity();
    record.x_range = extrema_.displacement(outermost(rigid_ones(stops_))), record.v_range = extrema_.velocity();
  }

  std::vector<Event> events{};

 private:
  Stops stops_;
  point::InDouble<E> in_double_;
  observables::Extrema::Observer extrema_;
  std::optional<observables::ExactHarmonics> harmonics_;
};

template <class Number>
motion::State<Number> start_of(const point::Problem& scene) {
  motion::State<Number> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  if (has_loose_mass(scene.loose)) state.loose = motion::loose_start<Number>(scene);
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
  if constexpr (E.loose) {
    const auto [z, w] = motion::place_in_housing(state, scene.loose);
    record.z = static_cast<double>(z), record.w = static_cast<double>(w);
  }
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
