#include "certificates/recorded_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "point/exact_motion.hpp"
#include "point/resting_motion.hpp"

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;

/// Whether an event begins on the same stop where another ends.
bool continues(const RecordedEvent<2>& before, const RecordedEvent<2>& event) {
  constexpr double same_time = 1e-9;
  return before.side == event.side && std::abs(event.time - before.end()) <= same_time * (1 + std::abs(event.time));
}

void add(std::vector<RecordedEvent<2>>& events, RecordedEvent<2> event) {
  const RecordedEvent<2>* const before = events.empty() ? nullptr : &events.back();
  const bool goes_on = event.lasts() && before != nullptr && continues(*before, event);
  if (event.kind == Kind::chatter && !(goes_on && before->kind != Kind::rest)) event.kind = Kind::rest;
  if (goes_on && before->kind == event.kind)
    events.back().length = event.end() - before->time;
  else
    events.push_back(std::move(event));
}

std::vector<RecordedEvent<2>> joined_events(const std::vector<motion::Event>& recorded,
                                            const std::vector<motion::Jacobian<double>>& derivatives,
                                            const Stops& stops, Growth<2>& growth) {
  std::vector<RecordedEvent<2>> events;
  double since = 0.0;
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    if (i < derivatives.size()) growth.pass(derivatives[i], std::min(1.0, recorded[i].time - since));
    since = recorded[i].time + recorded[i].length;
    const RecordedEvent<2> event{recorded[i], growth.derivative(), growth.rounding()};
    if (!(event.lasts() && is_soft(stops, event.side))) add(events, event);
  }
  return events;
}

}  // namespace

std::vector<RecordedEvent<2>> with_short_chatters(const std::vector<RecordedEvent<2>>& events, const Stops& stops) {
  constexpr double slow = 1e-3;
  std::vector<RecordedEvent<2>> list;
  for (RecordedEvent<2> event : events) {
    const auto leads_to_it = [&](const RecordedEvent<2>& one) {
      return one.kind == Kind::reversal || (one.kind == Kind::impact && one.side == event.side);
    };
    std::size_t first = list.size();
    double fastest = 0.0;
    if (event.kind == Kind::chatter && !law_of(stops, event.side).is_constant())
      while (first > 0 && leads_to_it(list[first - 1])) fastest = std::max(fastest, list[--first].speed());
    const auto is_slow = [&](const RecordedEvent<2>& one) {
      return one.kind == Kind::impact && one.speed() < slow * fastest;
    };
    const auto last = std::find_if(list.begin() + static_cast<std::ptrdiff_t>(first), list.end(), is_slow);
    if (last != list.end()) {
      list.erase(last + 1, list.end());
      event.length = event.end() - list.back().time, event.time = list.back().time;
    }
    list.push_back(event);
  }
  return list;
}

std::optional<RecordedMotion<2>> recorded(const point::Problem& problem, double turns, Side released) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_derivatives();
  motion::State<double> state = motion->start();
  if (released != Side::none) state.released = true, state.from_stop = released;
  if (motion->run_for(state, turns, recorder) != stepping::Outcome::completed) return std::nullopt;
  Growth<2> growth;
  std::vector<RecordedEvent<2>> events =
      with_short_chatters(joined_events(recorder, problem.stops, growth), problem.stops);
  growth.pass(recorder.watch.derivative(), 0.0);
  return RecordedMotion<2>{
      std::move(events), {state.x, state.v}, growth.derivative(), growth.rounding(), turns * motion->period()};
}

std::vector<RecordedEvent<2>> joined_events(const point::MotionRecorder& recorder, const Stops& stops,
                                            Growth<2>& growth) {
  return joined_events(recorder.events, recorder.derivatives, stops, growth);
}

std::optional<RecordedMotion<2>> recorded_from_release(const point::Problem& problem, Side side, double turns,
                                                       double& release) {
  const auto motion = point::released_motion(problem, side, std::llround(turns));
  if (!motion) return std::nullopt;
  release = motion->release;
  Growth<2> growth;
  RecordedMotion<2> recorded{
      .events = with_short_chatters(joined_events(motion->events, {}, problem.stops, growth), problem.stops),
      .duration = turns * period_of(problem.oscillator)};
  for (RecordedEvent<2>& event : recorded.events) event.derivative = {};  // the start is known, and no rounding grows
  recorded.end.x = side == Side::upper ? problem.stops.upper : problem.stops.lower;
  return recorded;
}

}  // namespace clatter::certificates
