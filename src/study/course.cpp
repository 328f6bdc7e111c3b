#include "study/course.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/tangent.hpp"
#include "integrators/exact.hpp"
#include "integrators/run.hpp"
#include "numbers/fifty_digits.hpp"

namespace clatter {
namespace {

/// A stretch of motion rounded to double.
Motion<double> rounded(const Motion<FiftyDigits>& m) {
  const auto d = [](const FiftyDigits& y) { return static_cast<double>(y); };
  return {d(m.rise), d(m.x), d(m.v), d(m.a), d(m.sine), d(m.cosine)};
}
const Motion<double>& rounded(const Motion<double>& m) { return m; }

/// Keeps the events of a run and, where asked for, its observables and its derivative.
template <class Number, Effects E>
class Witness {
 public:
  Witness(const Scene& scene, const std::optional<CourseObservables>& observables)
      : stops_(scene.stops), flow_(scene.oscillator), tangent_(scene.stops) {
    if (observables) harmonics_.emplace(observables->harmonics, observables->base_frequency);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (differentiates_) tangent_.arc(arc, begin, length);
    if (!harmonics_) return;
    const Arc<double, E.arc()> in_double(flow_, rounded(arc.start()), static_cast<double>(arc.anchor()));
    extrema_.arc(in_double, begin, length);
    harmonics_->arc(in_double, begin, length);
  }
  void rest(const Rest& rest) {
    events.push_back(event_of(rest));
    if (differentiates_) tangent_.rest(rest);
    if (harmonics_) extrema_.rest(rest), harmonics_->rest(rest);
  }
  void impact(const Impact& impact) {
    events.push_back(event_of(impact));
    if (differentiates_) tangent_.impact(impact);
    if (harmonics_) extrema_.impact(impact);
  }

  void differentiate() { differentiates_ = true; }
  [[nodiscard]] Map<Number> derivative() const { return tangent_.map(); }

  void finish(Course& course) {
    course.events = std::move(events);
    if (!harmonics_) return;
    harmonics_->finish(course.x, course.duration);
    course.harmonics = harmonics_->displacement(), course.v_harmonics = harmonics_->velocity();
    course.x_range = extrema_.displacement(stops_), course.v_range = extrema_.velocity();
  }

  std::vector<Event> events{};

 private:
  Stops stops_;
  Flow<double, E.arc()> flow_;
  Tangent<Number> tangent_;
  bool differentiates_ = false;
  Extrema extrema_;
  std::optional<ExactHarmonics> harmonics_;
};

template <class Number>
State<Number> start_of(const Scene& scene) {
  State<Number> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  return state;
}

/// Runs for a time in turns, unless it is stopped.
template <Integrator I, class Observer>
Outcome run_unless(const std::function<bool()>& stopped, I& integrator, State<typename I::Number>& state,
                   const typename I::Number& turns, Observer& observer) {
  using Number = typename I::Number;
  const auto sections = static_cast<std::int64_t>(turns);
  for (std::int64_t section = 0; section < sections; ++section) {
    if (stopped && stopped()) return Outcome::unresolved;
    const Outcome outcome = advance_to_section(integrator, state, 0, observer);
    if (outcome != Outcome::completed) return outcome;
  }
  return integrator.advance(state, Number(turns - Number(sections)), 0, observer);
}

template <class Number, Effects E>
Course run_from(const Scene& scene, State<Number> state, const Number& turns, double duration,
                const std::optional<CourseObservables>& observables, const std::function<bool()>& stopped) {
  Course course;
  course.duration = duration;
  Exact<Number, E> integrator(scene);
  Witness<Number, E> witness(scene, observables);
  course.outcome = run_unless(stopped, integrator, state, turns, witness);
  course.x = static_cast<double>(state.x), course.v = static_cast<double>(state.v);
  course.impacts = integrator.impacts(), course.evaluations = integrator.evaluations();
  witness.finish(course);
  return course;
}

template <class Number>
Course run_in(const Scene& scene, double duration, const std::optional<CourseObservables>& observables,
              const std::function<bool()>& stopped) {
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    const Number period = 2 * pi<Number>() / Number(counting_frequency(scene.oscillator));
    return run_from<Number, effects>(scene, start_of<Number>(scene), Number(Number(duration) / period), duration,
                                     observables, stopped);
  });
}

/// Moves a state to the fixed point of the map over so many periods; whether it got there.
template <Effects E>
bool to_fixed_point(const Scene& scene, State<FiftyDigits>& start, double periods,
                    const std::function<bool()>& stopped) {
  constexpr int most_iterations = 12;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Exact<FiftyDigits, E> integrator(scene);
    Witness<FiftyDigits, E> witness(scene, std::nullopt);
    witness.differentiate();
    State<FiftyDigits> end = start;
    if (run_unless(stopped, integrator, end, FiftyDigits(periods), witness) != Outcome::completed) return false;
    const FiftyDigits dx = end.x - start.x, dv = end.v - start.v;
    if (abs(dx) + abs(dv) <= FiftyDigits(1e-30) * (abs(end.x) + abs(end.v))) return true;
    const Map<FiftyDigits> D = witness.derivative();
    const FiftyDigits determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
    start.x += ((1 - D[3]) * dx + D[1] * dv) / determinant;
    start.v += (D[2] * dx + (1 - D[0]) * dv) / determinant;
    start.left = Side::none, start.released = false;
  }
  return false;
}

}  // namespace

Event event_of(const Impact& impact) {
  return {Event::Kind::impact, impact.side, impact.time, std::abs(impact.before), 0.0};
}
Event event_of(const Rest& rest) {
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

Course course_of(const Scene& scene, double duration, const std::optional<CourseObservables>& observables) {
  return run_in<double>(scene, duration, observables, {});
}
Course reference_of(const Scene& scene, double duration, const std::optional<CourseObservables>& observables,
                    const std::function<bool()>& stopped) {
  return run_in<FiftyDigits>(scene, duration, observables, stopped);
}

std::optional<Course> periodic_reference(const Scene& scene, double periods, const CourseObservables& observables,
                                         const std::function<bool()>& stopped) {
  if (periods != std::floor(periods)) return std::nullopt;
  return with_any_stops(scene.oscillator, [&]<Effects effects>() -> std::optional<Course> {
    State<FiftyDigits> start = start_of<FiftyDigits>(scene);
    if (!to_fixed_point<effects>(scene, start, periods, stopped)) return std::nullopt;
    const double duration = periods * period_of(scene.oscillator);
    return run_from<FiftyDigits, effects>(scene, start, FiftyDigits(periods), duration, observables, stopped);
  });
}

}  // namespace clatter
