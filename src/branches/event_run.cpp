#include "branches/event_run.hpp"

#include "point/exact_motion.hpp"

namespace clatter::branches {

std::optional<Orbit> event_run(const point::Problem& problem, std::size_t periods) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  motion::State<double> state = motion->start();
  if (motion->run_for(state, static_cast<double>(periods), recorder) != stepping::Outcome::completed)
    return std::nullopt;
  Orbit orbit{{}, 2 * static_cast<int>(periods), false};
  const double nu = problem.oscillator.frequency;
  for (const motion::Event& event : recorder.events) {
    const bool rests = event.kind == EventKind::rest || event.kind == EventKind::chatter;
    orbit.impacts.push_back({event.side, nu * event.time, event.velocity, nu * event.length,
                             rests ? EventKind::impact : event.kind});  // one without speed
  }
  if (orbit.size() == 0)
    for (const Side side : {Side::lower, Side::upper}) {
      const double position = side == Side::upper ? problem.stops.upper : problem.stops.lower;
      if (is_soft(problem.stops, side) && sign_of(side) * (problem.start.displacement - position) > 0)
        orbit.pressed = side;
    }
  return orbit;
}

}  // namespace clatter::branches
