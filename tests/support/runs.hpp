#pragma once

#include <vector>

#include "dynamics/scene.hpp"
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
[[nodiscard]] inline Scene scene_of(const Oscillator& oscillator, double lower, double upper, double R) {
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

/// Number: double or FiftyDigits.
template <class Number = double>
[[nodiscard]] Run<Number> run_scene(const Scene& scene, double duration);

/// The observed time of a scene, and what happens in it.
struct Steady {
  Status status = Status::unresolved;
  double length = 0.0;   ///< of the observed time, in tau
  double turns = 0.0;    ///< the same in forcing periods
  double settled = 0.0;  ///< forcing periods simulated before
  FoundBy found_by = FoundBy::nothing;
  State<double> from{};
  Recorder record{};
};

[[nodiscard]] Steady steady_of(const Scene& scene);

}  // namespace clatter
