#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "accuracy/run_record.hpp"
#include "motion/walls.hpp"
#include "scene/effects.hpp"
#include "stepping/run.hpp"

namespace clatter::support {

/// Runs a scene from its start for a time in tau by a general method, DormandPrince or Moreau, reporting to an
/// observer; returns the final state and the work.
template <template <Effects> class Method, class Observer>
accuracy::RunRecord run_by(const point::Problem& scene, double duration, Observer& observer) {
  return with_general_effects(scene, [&]<Effects effects>() {
    Method<effects> integrator(scene, scene.integration, limits_of(scene));
    motion::State<double> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    if (has_loose_mass(scene.loose)) state.loose = motion::loose_start<double>(scene);
    accuracy::RunRecord record;
    record.duration = duration;
    record.outcome = run_for(integrator, state, duration / integrator.period(), observer);
    record.x = state.x, record.v = state.v;
    if (has_loose_mass(scene.loose)) {
      const auto [z, w] = motion::place_in_housing(state, scene.loose);
      record.z = z, record.w = w;
    }
    record.impacts = integrator.impacts(), record.evaluations = integrator.evaluations();
    return record;
  });
}

/// Records the events of a run.
struct EventList {
  std::vector<accuracy::Event> events{};

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const motion::Event seen = event.in_housing();
    if (seen.kind == Kind::touch || seen.kind == Kind::renewal)
      events.push_back(accuracy::as_impact(seen));
    else if (seen.kind != Kind::separation && seen.kind != Kind::press)
      events.push_back(seen);
  }
};

/// The run of a scene by a general method, as record_of gives that of the exact one.
template <template <Effects> class Method>
accuracy::RunRecord record_by(const point::Problem& scene, double duration) {
  EventList list;
  accuracy::RunRecord record = run_by<Method>(scene, duration, list);
  record.events = has_loose_mass(scene.loose) ? accuracy::with_slow_impacts_summed(list.events) : list.events;
  return record;
}

/// The rests of a run that last longer than a time; of those that sections cut, the whole.
inline std::vector<accuracy::Event> rests_of(const accuracy::RunRecord& record, double longer_than = 0.0) {
  std::vector<accuracy::Event> rests = accuracy::with_rests_joined(record.events);
  std::erase_if(rests, [&](const accuracy::Event& event) {
    return event.kind != accuracy::Event::Kind::rest || event.length <= longer_than;
  });
  return rests;
}

/// The order of y in x: slope of the straight line through (log x, log y), by least squares.
inline double order_of(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), w = std::log(y[i]);
    n += 1, sx += u, sy += w, sxx += u * u, sxy += u * w;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace clatter::support
