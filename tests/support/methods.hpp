#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "dynamics/effects.hpp"
#include "integrators/run.hpp"
#include "study/course.hpp"

namespace clatter {

/// Runs a scene from its start for a time in tau by a general method, DormandPrince or Moreau, under the eyes of an
/// observer; gives what it leaves the mass in and what it has spent.
template <template <Effects> class Method, class Observer>
Course run_by(const Scene& scene, double duration, Observer& observer) {
  return with_general_effects(scene.oscillator, [&]<Effects effects>() {
    Method<effects> integrator(scene);
    State<double> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    Course course;
    course.duration = duration;
    course.outcome = run_for(integrator, state, duration / integrator.period(), observer);
    course.x = state.x, course.v = state.v;
    course.impacts = integrator.impacts(), course.evaluations = integrator.evaluations();
    return course;
  });
}

/// Keeps the events of a run.
struct EventList {
  std::vector<Event> events{};

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const Rest& rest) { events.push_back(event_of(rest)); }
  void impact(const Impact& impact) { events.push_back(event_of(impact)); }
};

/// The run of a scene by a general method: what course_of gives of the exact one.
template <template <Effects> class Method>
Course course_by(const Scene& scene, double duration) {
  EventList list;
  Course course = run_by<Method>(scene, duration, list);
  course.events = std::move(list.events);
  return course;
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

}  // namespace clatter
