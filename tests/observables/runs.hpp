#pragma once

#include <cmath>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "integrators/settle.hpp"

namespace clatter {

/// Passes what happens on to several observers, as the sweep does.
template <class... Observer>
struct Both {
  std::tuple<Observer&...> observers;

  template <class A>
  void arc(const A& arc, double begin, double length) {
    std::apply([&](auto&... o) { (o.arc(arc, begin, length), ...); }, observers);
  }
  void rest(const Rest& rest) {
    std::apply([&](auto&... o) { (o.rest(rest), ...); }, observers);
  }
  void impact(const Impact& impact) {
    std::apply([&](auto&... o) { (o.impact(impact), ...); }, observers);
  }
};

/// The observed time of a scene as an integrator finds it, under the eyes of `make(total)`'s observers; gives its
/// length.
template <class Integrator, class Make>
double observe_by(Integrator& integrator, const Scene& scene, Make&& make) {
  State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  const Observed observed = settle(integrator, state, scene);
  const double total = observed.turns * integrator.period();
  state = observed.from;
  make(total, [&](auto&... observer) {
    Both<std::remove_reference_t<decltype(observer)>...> all{{observer...}};
    const Outcome outcome = run_for(integrator, state, observed.turns, all);
    if (outcome != Outcome::completed) throw std::runtime_error("the scene was not completed");
    return state;
  });
  return total;
}

/// The same by the exact integrator.
template <class Make>
double observe(const Scene& scene, Make&& make) {
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    Exact<double, effects> integrator(scene);
    return observe_by(integrator, scene, make);
  });
}

/// x_s, R and nu of a scene of Figs. 14-23: h = 0.1, f = -1, from rest.
inline Scene paper_scene(double xs, double R, double nu) {
  Scene scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, R, R};
  scene.time.tolerance = 1e-14;
  return scene;
}

/// Free vibration with |x'| = V at x = 0 between stops at -g and g, from x = 0 with x' = -V.
inline Scene conservative_scene(double g, double V) {
  Scene scene;
  scene.stops = {-g, g, 1.0, 1.0};
  scene.start.velocity = -V;
  return scene;
}

}  // namespace clatter
