#pragma once

#include <cmath>
#include <stdexcept>

#include "motion/together.hpp"
#include "point/problem.hpp"
#include "steady/find_steady.hpp"

namespace clatter::observables {

/// The observed time of a scene as an integrator finds it, under the eyes of `make(total)`'s observers; gives its
/// length.
template <class Integrator, class Make>
double observe_by(Integrator& integrator, const point::Problem& scene, Make&& make) {
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  const steady::ObservedTime observed = find_steady(integrator, state, scene, scene.time, scene.integration);
  const double total = observed.turns * integrator.period();
  state = observed.from;
  make(total, [&](auto&... observer) {
    motion::Together all(observer...);
    const stepping::Outcome outcome = run_for(integrator, state, observed.turns, all);
    if (outcome != stepping::Outcome::completed) throw std::runtime_error("the scene was not completed");
    return state;
  });
  return total;
}

/// The same by the exact integrator.
template <class Make>
double observe(const point::Problem& scene, Make&& make) {
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    stepping::Exact<double, effects> integrator(scene, limits_of(scene));
    return observe_by(integrator, scene, make);
  });
}

/// x_s, R and nu of a scene of Figs. 14-23: h = 0.1, f = -1, from rest.
inline point::Problem paper_scene(double xs, double R, double nu) {
  point::Problem scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, R, R};
  scene.time.tolerance = 1e-14;
  return scene;
}

/// Free vibration with |x'| = V at x = 0 between stops at -g and g, from x = 0 with x' = -V.
inline point::Problem conservative_scene(double g, double V) {
  point::Problem scene;
  scene.stops = {-g, g, 1.0, 1.0};
  scene.start.velocity = -V;
  return scene;
}

}  // namespace clatter::observables
