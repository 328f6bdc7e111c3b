#include "support/runs.hpp"

#include "math/fifty_digits.hpp"
#include "point/exact_motion.hpp"
#include "point/reference_motion.hpp"

namespace clatter::support {

namespace {

/// A run of a motion for a time that `turns_of` gives from the length of a forcing period.
template <class Number, class Motion, class Recorder, class TurnsOf>
Run<Number> run_of(Motion& motion, Recorder& recorder, const Number& x, const Number& v, TurnsOf&& turns_of) {
  Run<Number> run;
  run.end.x = x, run.end.v = v;
  run.outcome = motion.run_for(run.end, turns_of(motion.period()), recorder);
  run.evaluations = motion.evaluations();
  for (const motion::Event& event : recorder.events) run.record.event(event);
  return run;
}
/// By the integrator that the program is compiled with, in double.
template <class TurnsOf>
Run<double> run_in(const point::Problem& scene, double x, double v, TurnsOf&& turns_of) {
  const auto motion = point::ExactMotion::of(scene);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  return run_of(*motion, recorder, x, v, turns_of);
}
template <class TurnsOf>
Run<FiftyDigits> run_in(const point::Problem& scene, const FiftyDigits& x, const FiftyDigits& v, TurnsOf&& turns_of) {
  const auto motion = point::ReferenceMotion::of(scene);
  point::ReferenceRecorder recorder;
  return run_of(*motion, recorder, x, v, turns_of);
}

}  // namespace

template <class Number>
Run<Number> run_scene(const point::Problem& scene, double duration) {
  return run_in(scene, Number(scene.start.displacement), Number(scene.start.velocity),
                [&](const Number& period) { return Number(Number(duration) / period); });
}

template <class Number>
Run<Number> run_from(const point::Problem& scene, const Number& x, const Number& v, const Number& turns) {
  return run_in(scene, x, v, [&](const Number&) { return turns; });
}

template Run<double> run_scene(const point::Problem&, double);
template Run<FiftyDigits> run_scene(const point::Problem&, double);
template Run<double> run_from(const point::Problem&, const double&, const double&, const double&);
template Run<FiftyDigits> run_from(const point::Problem&, const FiftyDigits&, const FiftyDigits&, const FiftyDigits&);

Steady steady_of(const point::Problem& scene) {
  const auto motion = point::ExactMotion::of(scene);
  const steady::ObservedTime observed = motion->find_steady();
  Steady steady{.status = observed.status,
                .length = observed.turns * motion->period(),
                .turns = observed.turns,
                .settled = observed.simulated,
                .found_by = observed.found_by,
                .from = observed.from};
  if (failed(observed.status)) return steady;
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  motion::State<double> state = observed.from;
  if (motion->run_for(state, observed.turns, recorder) != stepping::Outcome::completed)
    steady.status = steady::Status::unresolved;
  for (const motion::Event& event : recorder.events) steady.record.event(event);
  return steady;
}

}  // namespace clatter::support
