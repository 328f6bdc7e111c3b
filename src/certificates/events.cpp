#include "certificates/events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;

/// Whether an event begins on the same stop where another ends.
bool continues(const RecordedEvent& before, const RecordedEvent& event) {
  constexpr double same_time = 1e-9;
  return before.side == event.side && std::abs(event.time - before.end()) <= same_time * (1 + std::abs(event.time));
}

void add(std::vector<RecordedEvent>& events, RecordedEvent event) {
  const RecordedEvent* const before = events.empty() ? nullptr : &events.back();
  const bool goes_on = event.lasts() && before != nullptr && continues(*before, event);
  if (event.kind == Kind::chatter && !(goes_on && before->kind != Kind::rest)) event.kind = Kind::rest;
  if (goes_on && before->kind == event.kind)
    events.back().length = event.end() - before->time;
  else
    events.push_back(std::move(event));
}

}  // namespace

std::vector<RecordedEvent> joined_events(const point::MotionRecorder& recorder, const Stops& stops, Growth& growth) {
  std::vector<RecordedEvent> events;
  double since = 0.0;
  for (std::size_t i = 0; i < recorder.events.size(); ++i) {
    if (i < recorder.derivatives.size())
      growth.pass(recorder.derivatives[i], std::min(1.0, recorder.events[i].time - since));
    since = recorder.events[i].time + recorder.events[i].length;
    const RecordedEvent event{recorder.events[i], growth.derivative(), growth.rounding()};
    if (!(event.lasts() && is_soft(stops, event.side))) add(events, event);
  }
  return events;
}

}  // namespace clatter::certificates
