#include "certificates/recorded_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/walls.hpp"
#include "point/exact_motion.hpp"

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;

/// A map of changes of (x, x', y, y') as one of (x, x', z, z'), with z = y - x.
Growth<4>::Map in_housing(const motion::LooseJacobian& map) {
  Growth<4>::Map changed{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto entry = [&](std::size_t column) {
        return i < 2 ? map[i][column] : map[i][column] - map[i - 2][column];
      };
      changed[4 * i + j] = j < 2 ? entry(j) + entry(j + 2) : entry(j);
    }
  return changed;
}

bool are_alike(const motion::Event& one, const motion::Event& other) {
  return one.kind == other.kind && one.side == other.side && one.of_wall == other.of_wall;
}

/// A hold that begins where friction stops the loose mass knows the motion there, and takes the place of that event.
void take_stop(std::vector<RecordedEvent<4>>& events, RecordedEvent<4>& hold, double same_time) {
  if (!hold.is_of_loose_friction() || !hold.is_stick() || events.empty()) return;
  const RecordedEvent<4>& stop = events.back();
  if (!stop.is_of_loose_friction() || stop.kind != Kind::reversal || hold.time - stop.time > same_time) return;
  hold.stop = stop.derivative, hold.rounding_at_stop = stop.rounding, hold.a_before = stop.a_before;
  events.pop_back();
}

/// The events of a record with their derivatives; a rest, a stick or a press that sections cut is one. The sum of a
/// chatter of the main mass that rounding has ended lasts no time.
std::vector<RecordedEvent<4>> events_of(const point::MotionRecorder& recorder, Growth<4>& growth) {
  constexpr double same_time = 1e-9;
  std::vector<RecordedEvent<4>> events;
  double since = 0.0;
  for (std::size_t i = 0; i < recorder.events.size(); ++i) {
    const motion::Event& event = recorder.events[i];
    growth.pass(in_housing(recorder.loose_derivatives[i]), std::min(1.0, event.end() - since));
    since = event.end();
    if (event.kind == Kind::chatter && event.length <= same_time * (1 + event.time)) continue;
    if (event.is_stick() && event.length == 0) continue;  // a strike at the start
    const bool goes_on = event.lasts() && !events.empty() && are_alike(events.back(), event) &&
                         event.time - events.back().end() <= same_time * (1 + event.time);
    RecordedEvent<4> recorded{event, growth.derivative(), growth.rounding()};
    take_stop(events, recorded, same_time * (1 + event.time));
    if (goes_on) {
      const RecordedEvent<4>& before = events.back();
      recorded.time = before.time, recorded.length = event.end() - recorded.time;
      // a stick begins the later, the more the velocity before it is off, of which it leaves nothing
      if (event.is_stick() && !event.of_wall)
        recorded.derivative = before.derivative, recorded.rounding = before.rounding;
      recorded.stop = before.stop, recorded.rounding_at_stop = before.rounding_at_stop;
      recorded.a_before = before.a_before;
      events.pop_back();
    }
    events.push_back(recorded);
  }
  return events;
}

MachineState state_of(const motion::State<double>& state, const LooseMass& loose) {
  const auto [z, w] = motion::place_in_housing(state, loose);
  return {state.x, state.v, z, w, state.loose.pressed && state.loose.place == 0 ? state.loose.wall : Side::none};
}

}  // namespace

std::vector<RecordedEvent<4>> with_chatters(std::vector<RecordedEvent<4>> events) {
  constexpr double slow = 1e-3;
  std::vector<RecordedEvent<4>> list;
  for (const RecordedEvent<4>& event : events) {
    std::size_t first = list.size();
    double fastest = 0.0;
    while (event.kind == Kind::rest && first > 0 && list[first - 1].kind == Kind::impact &&
           list[first - 1].of_wall == event.of_wall && list[first - 1].side == event.side)
      fastest = std::max(fastest, list[--first].speed());
    std::size_t last = first;
    while (last < list.size() && !(std::abs(list[last].after) < slow * fastest)) ++last;
    const bool chatters = last < list.size() && list.back().after != 0;  // else a slow impact doesn't rebound
    if (chatters) {
      list.resize(last + 1);
      RecordedEvent<4> chatter = list[last];
      chatter.kind = Kind::chatter, chatter.length = event.time - chatter.time;
      list.push_back(chatter);
    }
    list.push_back(event);
  }
  return list;
}

std::optional<RecordedMotion<4>> recorded_in_housing(const point::Problem& problem, double turns) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.loose.emplace(problem);
  recorder.keep_derivatives();
  motion::State<double> state = motion->start();
  if (motion->run_for(state, turns, recorder) != stepping::Outcome::completed) return std::nullopt;
  Growth<4> growth;
  RecordedMotion<4> found;
  found.events = with_chatters(events_of(recorder, growth));
  growth.pass(in_housing(recorder.loose->map()), 0.0);
  found.end = state_of(state, problem.loose), found.duration = turns * motion->period();
  found.derivative = growth.derivative(), found.rounding = growth.rounding();
  return found;
}

}  // namespace clatter::certificates
