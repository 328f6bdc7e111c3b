#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <numbers>
#include <vector>

#include "lanes/lane_view.hpp"
#include "support/deviation.hpp"
#include "support/random.hpp"
#include "sweep/two_runs.hpp"

namespace clatter::lanes {

/// Totals of a comparison of many points.
struct Totals {
  std::size_t points = 0, fit = 0, periodic = 0, sensitive = 0, chaotic = 0, slow = 0;
  double worst = 0;  ///< largest difference of those that aren't sensitive
};

inline std::ostream& operator<<(std::ostream& out, const Totals& t) {
  return out << t.points << " points, " << t.fit << " fit lanes, " << t.periodic << " periodic; largest difference "
             << t.worst << " but for " << t.sensitive << " that 1e-15 of the inputs moves by more, and " << t.chaotic
             << " that it changes visibly; " << t.slow << " took longer to settle";
}

/// How far a repeat may be from the motion that it stands for: without a spring, a mass that meets no stop any more
/// drifts to a place that only damping makes final, and either run takes a repeat within its tolerance for that.
inline double left_to_drift(const point::Problem& scene, const sweep::RunPoint& run) {
  const Oscillator& o = scene.oscillator;
  const bool drifts =
      o.stiffness == 0 && run.status() == 0 && run.of("impacts_per_period") == std::vector<double>(2, 0);
  return drifts ? -scene.time.tolerance / std::expm1(-2 * o.damping * period_of(o)) : 0;
}

/// The difference of a point's two runs, over the allowed one. Values are the same to 1e-13 of the motion's scale. A
/// motion that multiplies a change of its inputs by 1e-15 multiplies the roundings of either run, too: some ten an
/// impact, so 16 times the effect of one change is allowed. If that changes counts, or values visibly, nothing is
/// compared.
inline double beyond(const point::Problem& scene, const sweep::RunPoint& lanes, const sweep::RunPoint& scalar,
                     Totals& totals) {
  const sweep::Apart apart = compare(lanes, scalar);
  if (apart.by <= 1e-13) {
    totals.worst = std::max(totals.worst, apart.by);
    return 0;
  }
  const double own = sensitivity(scene, scalar);
  const bool chaotic = own > 1e-6, settled = scalar.status() != static_cast<int>(steady::Status::aperiodic);
  const double allowed = (settled ? 16 : 64) * own + left_to_drift(scene, scalar);
  if (chaotic || apart.by <= allowed) ++(chaotic ? totals.chaotic : totals.sensitive);
  return chaotic ? 0 : apart.by / allowed;
}

/// The number of periods that slow motion takes to settle depends on when repeats are looked for; given more of them,
/// both runs find the same motion.
inline double beyond_if_longer(point::Problem scene, InstructionSet arch, Totals& totals) {
  scene.time.max_periods *= 16;
  const sweep::Sweep sweep = sweep::sweep_of(scene, {});
  const results::Dataset lanes = run(sweep, {.threads = 1, .arch = arch}).dataset;
  const results::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
  ++totals.slow;
  return beyond(scene, {lanes, 0}, {scalar, 0}, totals);
}

inline Totals expect_alike(const sweep::Sweep& sweep, InstructionSet arch) {
  const results::Dataset lanes = run(sweep, {.threads = 1, .arch = arch}).dataset;
  const results::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
  Totals totals;
  for (std::size_t i = 0; i < size(sweep); ++i) {
    const point::Problem scene = problem_at(sweep, i);
    const sweep::RunPoint tested{lanes, i}, reference{scalar, i};
    ++totals.points, totals.fit += accepts(scene), totals.periodic += reference.status() == 0;
    double ratio = beyond(scene, tested, reference, totals);
    if (tested.status() != reference.status() && ratio > 1) ratio = beyond_if_longer(scene, arch, totals);
    EXPECT_LE(ratio, 1) << "point " << i << ", " << compare(tested, reference).what << ", status "
                        << int{tested.status()} << " against " << int{reference.status()} << "\n"
                        << support::configuration_of(scene, scene.time.duration);
  }
  std::cout << totals << '\n';
  return totals;
}

/// Every observable of lanes, for a steady motion.
inline point::Problem observed(point::Problem scene) {
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.harmonics = 5;
  scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  scene.observe.impacts = true;
  scene.observe.period = true;
  scene.time.max_periods = 300, scene.time.max_impacts = 1e5;
  return scene;
}

/// Forced motion between stops, one stop, under a load or without; a tenth has no damping, a tenth too much for lanes.
inline point::Problem random_scene(std::uint64_t index) {
  support::Random random(4711, index);
  point::Problem scene;
  const double kind = random.uniform(0, 1);
  scene.oscillator = {kind < 0.1   ? 0
                      : kind < 0.2 ? random.uniform(0.9, 2)
                                   : random.logarithmic(5e-3, 0.9),
                      random.sign() * random.logarithmic(0.1, 3), random.logarithmic(0.2, 5),
                      random.happens(0.5) ? 0 : random.uniform(-1, 1)};
  const double lower = random.logarithmic(0.05, 4), upper = random.logarithmic(0.05, 4);
  const double restitution = random.happens(0.1) ? 1 : random.uniform(0.05, 1);
  scene.stops = {-lower, upper, restitution, random.happens(0.5) ? restitution : random.uniform(0.05, 1)};
  scene.start = {random.uniform(-lower, upper), random.uniform(-1, 1), random.uniform(0, 2 * std::numbers::pi)};
  if (random.happens(0.1))
    scene.stops.lower = -std::numeric_limits<double>::infinity();
  else if (random.happens(0.1))
    scene.stops.upper = std::numeric_limits<double>::infinity();
  return scene;
}

/// So many forcing periods from the start, observed in lanes.
inline point::Problem transient(point::Problem scene, double periods) {
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.impacts = true;
  scene.observe.period = true;
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = periods * 2 * std::numbers::pi / scene.oscillator.frequency;
  scene.time.max_impacts = 1e5;
  return scene;
}

}  // namespace clatter::lanes
