#include "certificates/recorded_motion.hpp"

#include <utility>

#include "point/exact_motion.hpp"

namespace clatter::certificates {

std::optional<RecordedMotion> recorded(const point::Problem& problem, double turns, Side released) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_derivatives();
  motion::State<double> state = motion->start();
  if (released != Side::none) state.released = true, state.from_stop = released;
  if (motion->run_for(state, turns, recorder) != stepping::Outcome::completed) return std::nullopt;
  Growth growth;
  std::vector<RecordedEvent> events = joined_events(recorder, problem.stops, growth);
  growth.pass(recorder.watch.derivative(), 0.0);
  return RecordedMotion{std::move(events), state, growth.derivative(), growth.rounding(), turns * motion->period()};
}

}  // namespace clatter::certificates
