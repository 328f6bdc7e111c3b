#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "point/problem.hpp"
#include "steady/find_steady.hpp"
#include "support/random.hpp"
#include "support/seen_arc.hpp"
#include "support/told.hpp"

namespace clatter::hard {

/// A random scene, drawn by its index alone, and the time in tau for which it is run.
struct AnyScene {
  std::uint64_t index;
  point::Problem scene;
  double duration;
};

inline double any_damping(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.15) return 0;
  if (kind < 0.20) return 1 + random.sign() * random.logarithmic(1e-14, 1e-2);
  if (kind < 0.25) return random.logarithmic(3, 50);
  return random.logarithmic(1e-3, 3);
}

inline Oscillator any_oscillator(support::Random& random) {
  const double h = any_damping(random), f = random.happens(0.1) ? 0 : random.sign() * random.logarithmic(0.05, 5);
  const double nu =
      random.happens(0.1) ? 1 + random.sign() * random.logarithmic(1e-15, 0.1) : random.logarithmic(0.1, 10);
  return {h, f, nu, random.happens(0.5) ? 0 : random.uniform(-1.5, 1.5)};
}

/// No spring or, for a time in which rounding grows by no more than 1e4, an unstable one between two stops. Points with
/// k > 0 are computed with k = 1.
inline double any_stiffness(support::Random& random, const Stops& stops, double duration) {
  const bool bounded = std::isfinite(stops.lower) && std::isfinite(stops.upper);
  if (!bounded || random.happens(0.5)) return 0;
  return -std::min(random.logarithmic(1e-3, 3), 80 / (duration * duration));
}

inline double any_restitution(support::Random& random) {
  const double kind = random.uniform(0, 1);
  return kind < 0.1 ? 0 : kind < 0.2 ? 1 : random.uniform(kind < 0.3 ? 0.9 : 0, 1);
}

/// Two unequal stops around 0 or both on one side of it, or one stop.
inline Stops any_stops(support::Random& random) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double kind = random.uniform(0, 1), sign = random.sign(), near = random.logarithmic(1e-3, 3),
               far = random.logarithmic(1e-3, 3), R_lower = any_restitution(random), R_upper = any_restitution(random);
  if (kind < 0.05) return {sign * near, none, R_lower, R_upper};
  if (kind < 0.10) return {-none, sign * near, R_lower, R_upper};
  if (kind < 0.15) return {near, near + far, R_lower, R_upper};
  if (kind < 0.20) return {-near - far, -near, R_lower, R_upper};
  return {-near, far, R_lower, R_upper};
}

/// A start between the stops, or on one of them: at rest, moving in or moving out.
inline Start any_start(support::Random& random, const Stops& stops) {
  const double low = std::isfinite(stops.lower) ? stops.lower : stops.upper - 3;
  const double high = std::isfinite(stops.upper) ? stops.upper : stops.lower + 3;
  const double x = random.uniform(low, high), v = random.sign() * random.logarithmic(1e-2, 3);
  const double phase = random.uniform(0, 2 * std::numbers::pi);
  if (!random.happens(0.15)) return {x, random.happens(0.1) ? 0 : v, phase};
  const bool upper = std::isfinite(stops.upper) && (!std::isfinite(stops.lower) || random.happens(0.5));
  return {upper ? stops.upper : stops.lower, random.happens(1.0 / 3) ? 0 : v, phase};
}

[[nodiscard]] inline AnyScene any_scene(std::uint64_t index) {
  support::Random random(20230, index);
  point::Problem scene;
  scene.oscillator = any_oscillator(random);
  scene.stops = any_stops(random);
  scene.start = any_start(random, scene.stops);
  scene.time.mode = steady::Mode::transient;
  scene.time.max_impacts = 2e3;
  scene.time.duration = scene.oscillator.forcing == 0 ? 20.0 : 3.3 * 2 * std::numbers::pi / scene.oscillator.frequency;
  support::Random other(20240, index);
  if (index % 4 == 3) scene.oscillator.stiffness = any_stiffness(other, scene.stops, scene.time.duration);
  return {index, scene, scene.time.duration};
}

/// An observer of a run from one stroboscopic section to the next; times count from the last section. Those that derive
/// have functions for the events that they ask for, as `support::Told` calls them.
struct Watcher {
  template <class A>
  void arc(const A&, double, double) {}
  void section(const motion::State<double>&) {}  ///< the end of a section, and of the run
};

[[nodiscard]] inline motion::State<double> start_of(const point::Problem& scene) {
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  return state;
}

/// A watcher of any kind.
class AnyWatcher : public support::AnyObserver {
 public:
  virtual void section(const motion::State<double>& state) = 0;
};
template <class W>
class Watching : public AnyWatcher {
 public:
  explicit Watching(W& watcher) : watcher_(watcher), told_(watcher) {}
  void arc(const support::SeenArc& arc, double begin, double length) override { told_.arc(arc, begin, length); }
  void event(const motion::Event& event) override { told_.event(event); }
  void section(const motion::State<double>& state) override { watcher_.section(state); }

 private:
  W& watcher_;
  support::Told<W> told_;
};

/// Runs a scene from its start, so many sections after the first one, for its duration; compiled once, whoever watches.
[[nodiscard]] stepping::Outcome watched(const AnyScene& any, AnyWatcher& watcher, std::int64_t sections);
template <class W>
[[nodiscard]] stepping::Outcome watch(const AnyScene& any, W& watcher, std::int64_t sections = 0) {
  Watching<W> watching(watcher);
  return watched(any, watching, sections);
}

}  // namespace clatter::hard
