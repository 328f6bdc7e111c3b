#include "accuracy/run_record.hpp"

#include <algorithm>
#include <cmath>

#include "accuracy/observed_run.hpp"
#include "point/every_effect.hpp"
#include "point/exact_motion.hpp"
#include "point/fixed_point.hpp"

namespace clatter::accuracy {
namespace {

using namespace clatter::accuracy::detail;

constexpr double same_time = 1e-9;

/// The last of some events of the mass that an event is of, or nullptr.
Event* last_of_its_mass(std::vector<Event>& events, const Event& event) {
  const auto last =
      std::find_if(events.rbegin(), events.rend(), [&](const Event& other) { return other.of_wall == event.of_wall; });
  return last != events.rend() ? &*last : nullptr;
}

}  // namespace

Event as_impact(Event contact) {
  contact.kind = Event::Kind::impact;
  return contact;
}

/// Those that a section cuts are one; a stick may follow another one.
std::vector<Event> with_rests_joined(const std::vector<Event>& events) {
  std::vector<Event> joined;
  for (const Event& event : events) {
    Event* const last = event.lasts() ? last_of_its_mass(joined, event) : nullptr;
    const bool goes_on = last != nullptr && last->kind == event.kind && last->side == event.side &&
                         std::abs(event.time - last->end()) <= same_time * (1 + std::abs(event.time));
    if (goes_on)
      last->length = event.end() - last->time;
    else
      joined.push_back(event);
  }
  return joined;
}

std::vector<Event> with_slow_impacts_summed(const std::vector<Event>& events) {
  constexpr double slow = 1e-6;
  double fastest = 0.0;
  for (const Event& event : events) fastest = std::max(fastest, event.speed());
  std::vector<Event> summed;
  for (const Event& event : events) {
    double begin = event.time;
    const auto before_it = [&] {
      const Event* const last = event.kind == Event::Kind::rest ? last_of_its_mass(summed, event) : nullptr;
      const bool is_of_its_chatter = last != nullptr && last->kind == Event::Kind::impact && last->side == event.side &&
                                     last->speed() <= slow * fastest;
      return is_of_its_chatter ? last : nullptr;
    };
    while (const Event* const impact = before_it())
      begin = impact->time, summed.erase(summed.begin() + (impact - summed.data()));
    if (begin < event.time)
      summed.push_back({.kind = Event::Kind::chatter,
                        .side = event.side,
                        .time = begin,
                        .length = event.time - begin,
                        .of_wall = event.of_wall});
    summed.push_back(event);
  }
  return summed;
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
  for (const Event& event : recorder.events) {
    const bool is_soft_contact = event.kind == Event::Kind::touch || event.kind == Event::Kind::renewal;
    if (event.kind != Event::Kind::separation) record.events.push_back(is_soft_contact ? as_impact(event) : event);
  }
  if (!has_loose_mass(scene.loose)) return record;
  const auto [z, w] = motion::place_in_housing(state, scene.loose);
  record.z = z, record.w = w;
  record.events = with_slow_impacts_summed(record.events);
  return record;
}
RunRecord reference_of(const point::Problem& scene, double duration,
                       const std::optional<RecordObservables>& observables, const std::function<bool()>& stopped) {
  return point::with_every_effect_and_mass(
      scene, [&]<Effects effects>() { return run_over<FiftyDigits, effects>(scene, duration, observables, stopped); });
}

std::optional<RunRecord> periodic_reference(const point::Problem& scene, double periods,
                                            const RecordObservables& observables,
                                            const std::function<bool()>& stopped) {
  if (periods != std::floor(periods)) return std::nullopt;
  const auto find = has_loose_mass(scene.loose) ? point::fixed_point_in_housing : point::fixed_point;
  point::Problem as_computed = scene;  // whose numbers double has rounded before a method, which is judged, begins
  as_computed.given.reset();
  const auto exact = find(as_computed, start_of<double>(scene), static_cast<std::int64_t>(periods), stopped);
  if (!exact) return std::nullopt;
  const double duration = periods * period_of(scene.oscillator);
  return point::with_every_effect_and_mass(scene, [&]<Effects effects>() {
    return run_from<FiftyDigits, effects>(scene, exact->start, FiftyDigits(periods), duration, observables, stopped);
  });
}

}  // namespace clatter::accuracy
