#pragma once

#include <cmath>
#include <vector>

#include "integrators/settle.hpp"

namespace clatter {

/// Keeps every impact and rest of a run.
struct Recorder {
  std::vector<Impact> impacts{};
  std::vector<Rest> rests{};

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const Rest& rest) { rests.push_back(rest); }
  void impact(const Impact& impact) { impacts.push_back(impact); }
};

/// A scene with both restitutions equal.
inline Scene scene_of(const Oscillator& oscillator, double lower, double upper, double R) {
  Scene scene;
  scene.oscillator = oscillator;
  scene.stops = {lower, upper, R, R};
  return scene;
}

/// Everything of a run from the start of the scene for a time in tau.
template <class Number = double>
struct Run {
  Recorder record{};
  State<Number> end{};
  Outcome outcome = Outcome::unresolved;
  double evaluations = 0.0;
};

template <class Number = double>
Run<Number> run_scene(const Scene& scene, double duration) {
  return with_effects(required_effects(scene.oscillator), [&]<Effects effects>() {
    Run<Number> run;
    Exact<Number, effects> integrator(scene);
    run.end.x = scene.start.displacement, run.end.v = scene.start.velocity;
    run.outcome = run_for(integrator, run.end, Number(Number(duration) / integrator.period()), run.record);
    run.evaluations = integrator.evaluations();
    return run;
  });
}

/// The observed time of a scene, and what happens in it.
struct Steady {
  Status status = Status::unresolved;
  double length = 0.0;  ///< of the observed time, in tau
  double turns = 0.0;   ///< the same in forcing periods
  bool standstill = false;
  State<double> from{};
  Recorder record{};
};

inline Steady steady_of(const Scene& scene) {
  return with_effects(required_effects(scene.oscillator), [&]<Effects effects>() {
    Exact<double, effects> integrator(scene);
    State<double> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    const Observed<double> observed = settle(integrator, state, scene);
    Steady steady{observed.status, observed.turns * integrator.period(), observed.turns, observed.standstill,
                  observed.from};
    state = observed.from;
    if (!failed(observed.status) && run_for(integrator, state, observed.turns, steady.record) != Outcome::completed)
      steady.status = Status::unresolved;
    return steady;
  });
}

}  // namespace clatter
