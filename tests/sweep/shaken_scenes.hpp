#pragma once

#include <cstdint>

#include "support/random.hpp"
#include "sweep/figures.hpp"

namespace clatter::sweep {

/// A scene of the user with a shaken base or shaken stops.
inline point::Problem shaken(const Oscillator& oscillator, const Shaking& shaking, const Stops& stops = {}) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.shaking = shaking, scene.stops = stops;
  return scene;
}

inline point::PointResult run(point::Problem scene, Frame frame) {
  scene.observe.frame = frame;
  const Sweep sweep{.problem = scene};
  const point::Problem problem = problem_at(sweep, 0);
  point::ThreadScratch scratch{observables::Harmonics::scratch_for(problem.observe)};
  return run_point(problem, scratch);
}

/// A random scene with impacts, in part with chatter and rest.
inline point::Problem any_shaken(std::uint64_t index) {
  support::Random random(2511, index);
  const Oscillator oscillator{random.happens(0.2) ? 0.0 : random.logarithmic(1e-2, 0.8),
                              random.happens(0.4) ? 0.0 : random.sign() * random.logarithmic(0.1, 3),
                              random.logarithmic(0.3, 4), random.happens(0.5) ? 0.0 : random.uniform(-0.7, 0.7)};
  const double b = random.sign() * random.logarithmic(0.02, 2);
  const double R_lower = random.uniform(0, 0.9), R_upper = random.uniform(0, 0.9);
  point::Problem scene = shaken(oscillator, index % 2 == 0 ? Shaking{.stops = b} : Shaking{.base = b},
                                {-random.logarithmic(0.1, 1), random.logarithmic(0.1, 1), R_lower, R_upper});
  scene.start = {random.uniform(scene.stops.lower, scene.stops.upper), random.uniform(-1, 1), random.uniform(-7, 7)};
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 4.7 * 2 * pi<double>() / scene.oscillator.frequency;
  return scene;
}

}  // namespace clatter::sweep
