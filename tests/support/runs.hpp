#pragma once

#include <vector>

#include "point/problem.hpp"
#include "steady/find_steady.hpp"

namespace clatter::support {

/// Records every impact, rest and contact of a run.
struct Recorder {
  std::vector<motion::Event> impacts{};
  std::vector<motion::Event> rests{};
  std::vector<motion::Event> touches{};
  std::vector<motion::Event> separations{};

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.lasts()) rests.push_back(event);
    if (event.kind == Kind::impact) impacts.push_back(event);
    if (event.kind == Kind::touch || event.kind == Kind::renewal) touches.push_back(event);
    if (event.kind == Kind::separation) separations.push_back(event);
  }
};

/// A scene with both restitutions equal.
[[nodiscard]] inline point::Problem scene_of(const Oscillator& oscillator, double lower, double upper, double R) {
  point::Problem scene;
  scene.oscillator = oscillator;
  scene.stops = {lower, upper, R, R};
  return scene;
}

/// A run from the start of the scene for a time in tau: in double with the effects that the program chooses for it, in
/// 50 digits with all.
template <class Number = double>
struct Run {
  Recorder record{};
  motion::State<Number> end{};
  stepping::Outcome outcome = stepping::Outcome::unresolved;
  double evaluations = 0.0;
};

/// From a displacement and a velocity for a time in forcing periods. Number: double or FiftyDigits.
template <class Number>
[[nodiscard]] Run<Number> run_from(const point::Problem& scene, const Number& x, const Number& v, const Number& turns);

/// Number: double or FiftyDigits.
template <class Number = double>
[[nodiscard]] Run<Number> run_scene(const point::Problem& scene, double duration);

/// The observed time of a scene, with its impacts and rests.
struct Steady {
  steady::Status status = steady::Status::unresolved;
  double length = 0.0;   ///< of the observed time, in tau
  double turns = 0.0;    ///< the same in forcing periods
  double settled = 0.0;  ///< forcing periods simulated before
  steady::FoundBy found_by = steady::FoundBy::nothing;
  motion::State<double> from{};
  Recorder record{};
};

[[nodiscard]] Steady steady_of(const point::Problem& scene);

}  // namespace clatter::support
