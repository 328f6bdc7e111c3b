#include "accuracy/run_record.hpp"

#include <algorithm>
#include <cmath>

#include "motion/walls.hpp"
#include "point/exact_motion.hpp"
#include "point/fixed_point.hpp"
#include "point/reference_motion.hpp"

namespace clatter::accuracy {
namespace {

constexpr double same_time = 1e-9;

/// The last of some events of the mass that an event is of, or nullptr.
Event* last_of_its_mass(std::vector<Event>& events, const Event& event) {
  const auto last =
      std::find_if(events.rbegin(), events.rend(), [&](const Event& other) { return other.of_wall == event.of_wall; });
  return last != events.rend() ? &*last : nullptr;
}

}  // namespace

std::vector<Event> as_compared(const std::vector<Event>& events) {
  using Kind = Event::Kind;
  std::vector<Event> compared;
  for (Event event : events) {
    if (event.kind == Kind::touch || event.kind == Kind::renewal) event.kind = Kind::impact;
    if (event.kind != Kind::separation) compared.push_back(event);
  }
  return compared;
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
  record.events = as_compared(recorder.events);
  if (!has_loose_mass(scene.loose)) return record;
  const auto [z, w] = motion::place_in_housing(state, scene.loose);
  record.z = z, record.w = w;
  record.events = with_slow_impacts_summed(record.events);
  return record;
}
namespace {

/// A run in 50 digits from a state on, for a time in forcing periods.
RunRecord reference_from(const point::Problem& scene, point::ReferenceMotion& motion, motion::State<FiftyDigits> state,
                         const FiftyDigits& turns, double duration, const std::optional<RecordObservables>& observables,
                         const std::function<bool()>& stopped) {
  point::ReferenceRecorder recorder;
  if (observables) recorder.harmonics.emplace(observables->harmonics, observables->base_frequency);
  RunRecord record;
  record.duration = duration;
  record.outcome = motion.run_for(state, turns, recorder, stopped);
  record.x = static_cast<double>(state.x), record.v = static_cast<double>(state.v);
  record.impacts = motion.impacts(), record.evaluations = motion.evaluations();
  record.events = as_compared(recorder.events);
  if (has_loose_mass(scene.loose)) {
    const auto [z, w] = motion::place_in_housing(state, scene.loose);
    record.z = static_cast<double>(z), record.w = static_cast<double>(w);
    record.events = with_slow_impacts_summed(record.events);
  }
  if (!observables) return record;
  recorder.harmonics->finish(record.x, duration);
  record.harmonics = recorder.harmonics->displacement(), record.v_harmonics = recorder.harmonics->velocity();
  record.x_range = recorder.extrema.displacement(outermost(rigid_ones(scene.stops)));
  record.v_range = recorder.extrema.velocity();
  return record;
}

/// A scene by the numbers that double computes with, rounded as they are: those that the judged methods begin with.
point::Problem as_computed(point::Problem scene) {
  scene.given.reset();
  return scene;
}

}  // namespace

RunRecord reference_of(const point::Problem& scene, double duration,
                       const std::optional<RecordObservables>& observables, const std::function<bool()>& stopped) {
  const auto motion = point::ReferenceMotion::of(as_computed(scene));
  const FiftyDigits period = 2 * pi<FiftyDigits>() / FiftyDigits(counting_frequency(scene.oscillator));
  return reference_from(scene, *motion, motion->start(), FiftyDigits(FiftyDigits(duration) / period), duration,
                        observables, stopped);
}

std::optional<RunRecord> periodic_reference(const point::Problem& scene, double periods,
                                            const RecordObservables& observables,
                                            const std::function<bool()>& stopped) {
  if (periods != std::floor(periods)) return std::nullopt;
  const auto find = has_loose_mass(scene.loose) ? point::fixed_point_in_housing : point::fixed_point;
  const point::Problem computed = as_computed(scene);
  const auto motion = point::ReferenceMotion::of(computed);
  const auto exact =
      find(computed, point::ExactMotion::of(scene)->start(), static_cast<std::int64_t>(periods), stopped);
  if (!exact) return std::nullopt;
  return reference_from(scene, *motion, exact->start, FiftyDigits(periods), periods * period_of(scene.oscillator),
                        observables, stopped);
}

}  // namespace clatter::accuracy
