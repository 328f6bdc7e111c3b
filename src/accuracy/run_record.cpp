#include "accuracy/run_record.hpp"

#include <cmath>

#include "accuracy/observed_run.hpp"
#include "point/every_effect.hpp"
#include "point/exact_motion.hpp"
#include "point/fixed_point.hpp"

namespace clatter::accuracy {
namespace {

using namespace clatter::accuracy::detail;

Event event_of(const point::MotionEvent& event) {
  using Kind = point::MotionEvent::Kind;
  const Event::Kind kind = event.kind == Kind::rest      ? Event::Kind::rest
                           : event.kind == Kind::chatter ? Event::Kind::chatter
                                                         : Event::Kind::impact;
  return {kind, event.side, event.time, std::abs(event.velocity), event.length};
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
    const bool goes_on = event.kind != Event::Kind::impact && !joined.empty() && joined.back().kind == event.kind &&
                         joined.back().side == event.side;
    if (goes_on)
      joined.back().length = event.end() - joined.back().time;
    else
      joined.push_back(event);
  }
  return joined;
}

RunRecord record_of(const point::Problem& scene, double duration) {
  const auto motion = point::ExactMotion::of(scene);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  motion::State<double> state = motion->start();
  RunRecord record;
  record.duration = duration;
  record.outcome = motion->run_for(state, duration / motion->period(), recorder);
  record.x = state.x, record.v = state.v;
  record.impacts = motion->impacts(), record.evaluations = motion->evaluations();
  for (const point::MotionEvent& event : recorder.events)  // each contact with a soft stop is an event, like an impact
    if (event.kind != point::MotionEvent::Kind::separation) record.events.push_back(event_of(event));
  return record;
}
RunRecord reference_of(const point::Problem& scene, double duration,
                       const std::optional<RecordObservables>& observables, const std::function<bool()>& stopped) {
  return point::with_every_effect(
      scene, [&]<Effects effects>() { return run_over<FiftyDigits, effects>(scene, duration, observables, stopped); });
}

std::optional<RunRecord> periodic_reference(const point::Problem& scene, double periods,
                                            const RecordObservables& observables,
                                            const std::function<bool()>& stopped) {
  if (periods != std::floor(periods)) return std::nullopt;
  const auto exact = point::fixed_point(scene, start_of<double>(scene), static_cast<std::int64_t>(periods), stopped);
  if (!exact) return std::nullopt;
  const double duration = periods * period_of(scene.oscillator);
  return point::with_every_effect(scene, [&]<Effects effects>() {
    return run_from<FiftyDigits, effects>(scene, exact->start, FiftyDigits(periods), duration, observables, stopped);
  });
}

}  // namespace clatter::accuracy
