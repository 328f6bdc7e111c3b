#include "accuracy/run_record.hpp"

#include <cmath>
#include <type_traits>

#include "accuracy/reference_effects.hpp"
#include "math/fifty_digits.hpp"
#include "motion/tangent_map.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::accuracy {
namespace {

/// A motion at an instant, rounded to double.
motion::Motion<double> rounded(const motion::Motion<FiftyDigits>& m) {
  const auto d = [](const FiftyDigits& y) { return static_cast<double>(y); };
  return {d(m.offset), d(m.x), d(m.v), d(m.a), d(m.sine), d(m.cosine)};
}
const motion::Motion<double>& rounded(const motion::Motion<double>& m) { return m; }

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
  observables::Extrema extrema_;
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

template <class Number>
RunRecord run_in(const point::Problem& scene, double duration, const std::optional<RecordObservables>& observables,
                 const std::function<bool()>& stopped) {
  const auto run = [&]<Effects effects>() {
    const Number period = 2 * pi<Number>() / Number(counting_frequency(scene.oscillator));
    return run_from<Number, effects>(scene, start_of<Number>(scene), Number(Number(duration) / period), duration,
                                     observables, stopped);
  };
  if constexpr (std::is_same_v<Number, FiftyDigits>) return with_every_effect(scene, run);
  return with_any_stops(scene, run);
}

/// Moves a state to the fixed point of the map over so many periods; false if that fails.
template <Effects E>
bool to_fixed_point(const point::Problem& scene, motion::State<FiftyDigits>& start, double periods,
                    const std::function<bool()>& stopped) {
  constexpr int most_iterations = 12;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    stepping::Exact<FiftyDigits, E> integrator(scene, limits_of(scene));
    RunObserver<FiftyDigits, E> observer(scene, std::nullopt);
    observer.differentiate();
    motion::State<FiftyDigits> end = start;
    if (run_unless(stopped, integrator, end, FiftyDigits(periods), observer) != stepping::Outcome::completed)
      return false;
    const FiftyDigits dx = end.x - start.x, dv = end.v - start.v;
    if (abs(dx) + abs(dv) <= FiftyDigits(1e-30) * (abs(end.x) + abs(end.v))) return true;
    const motion::Jacobian<FiftyDigits> D = observer.derivative();
    const FiftyDigits determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
    start.x += ((1 - D[3]) * dx + D[1] * dv) / determinant;
    start.v += (D[2] * dx + (1 - D[0]) * dv) / determinant;
    start.from_stop = start.within = Side::none, start.released = start.pressed = false;
  }
  return false;
}

}  // namespace

Event event_of(const motion::Impact& impact) {
  return {Event::Kind::impact, impact.side, impact.time, std::abs(impact.before), 0.0};
}
Event event_of(const motion::Rest& rest) {
  return {rest.held ? Event::Kind::rest : Event::Kind::chatter, rest.side, rest.time, 0.0, rest.length};
}

std::vector<Event> with_rests_joined(const std::vector<Event>& events) {
  std::vector<Event> joined;
  for (const Event& event : events) {
    if (event.kind == Event::Kind::rest && !joined.empty() && joined.back().kind == Event::Kind::rest)
      joined.back().length = event.end() - joined.back().time;
    else
      joined.push_back(event);
  }
  return joined;
}

RunRecord record_of(const point::Problem& scene, double duration, const std::optional<RecordObservables>& observables) {
  return run_in<double>(scene, duration, observables, {});
}
RunRecord reference_of(const point::Problem& scene, double duration,
                       const std::optional<RecordObservables>& observables, const std::function<bool()>& stopped) {
  return run_in<FiftyDigits>(scene, duration, observables, stopped);
}

std::optional<RunRecord> periodic_reference(const point::Problem& scene, double periods,
                                            const RecordObservables& observables,
                                            const std::function<bool()>& stopped) {
  if (periods != std::floor(periods)) return std::nullopt;
  return with_every_effect(scene, [&]<Effects effects>() -> std::optional<RunRecord> {
    motion::State<FiftyDigits> start = start_of<FiftyDigits>(scene);
    if (!to_fixed_point<effects>(scene, start, periods, stopped)) return std::nullopt;
    const double duration = periods * period_of(scene.oscillator);
    return run_from<FiftyDigits, effects>(scene, start, FiftyDigits(periods), duration, observables, stopped);
  });
}

}  // namespace clatter::accuracy
