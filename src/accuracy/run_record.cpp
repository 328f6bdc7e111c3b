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

}  // namespace

Event as_impact(Event contact) {
  contact.kind = Event::Kind::impact;
  return contact;
}

/// Those that a section cuts are one; a stick may follow another one.
std::vector<Event> with_rests_joined(const std::vector<Event>& events) {
  std::vector<Event> joined;
  for (const Event& event : events) {
    const bool goes_on = event.lasts() && !joined.empty() && joined.back().kind == event.kind &&
                         joined.back().side == event.side &&
                         std::abs(event.time - joined.back().end()) <= same_time * (1 + std::abs(event.time));
    if (goes_on)
      joined.back().length = event.end() - joined.back().time;
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
    const auto is_of_its_chatter = [&](const Event& impact) {
      return impact.kind == Event::Kind::impact && impact.side == event.side && impact.speed() <= slow * fastest;
    };
    double begin = event.time;
    while (event.kind == Event::Kind::rest && !summed.empty() && is_of_its_chatter(summed.back()))
      begin = summed.back().time, summed.pop_back();
    if (begin < event.time) summed.push_back({Event::Kind::chatter, event.side, begin, 0.0, event.time - begin});
    summed.push_back(event);
  }
  return summed;
}

RunRecord record_of(const point::Problem& scene, double duration) {
  if (has_loose_mass(scene.loose))
    return point::with_every_effect_and_mass(
        scene, [&]<Effects effects>() { return run_over<double, effects>(scene, duration, std::nullopt); });
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
