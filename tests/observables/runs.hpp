#pragma once

#include <cmath>
#include <stdexcept>

#include "motion/together.hpp"
#include "point/exact_motion.hpp"
#include "point/problem.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::observables {

/// An observed time of a scene by an integrator, under the eyes of `make(total)`'s observers; gives its length.
template <class Integrator, class Make>
double observe_by(Integrator& integrator, const steady::ObservedTime& observed, Make&& make) {
  const double total = observed.turns * integrator.period();
  motion::State<double> state = observed.from;
  make(total, [&](auto&... observer) {
    motion::Together all(observer...);
    const stepping::Outcome outcome = run_for(integrator, state, observed.turns, all);
    if (outcome != stepping::Outcome::completed) throw std::runtime_error("the scene was not completed");
    return state;
  });
  return total;
}

/// The same of the time that the exact integrator finds, by that.
template <class Make>
double observe(const point::Problem& scene, Make&& make) {
  const steady::ObservedTime observed = point::ExactMotion::of(scene)->find_steady();
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    stepping::Exact<double, effects> integrator(scene, limits_of(scene));
    return observe_by(integrator, observed, make);
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
