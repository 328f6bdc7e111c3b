// Branches between soft stops, against runs of the integrator and closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iostream>

#include "branches/branch.hpp"
#include "branches/event_run.hpp"
#include "branches/measures.hpp"
#include "branches/special_values.hpp"
#include "model/required_effects.hpp"
#include "motion/tangent_map.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/soft_scene.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches {
namespace {

using sweep::Parameter;

/// A run of the integrator over one period of a motion, with its derivative.
struct Round {
  PhasePoint end;
  double trace, determinant;
};

/// Passes all to the derivative of the motion.
struct Differentiating {
  motion::TangentMap<double>& map;

  template <class A>
  void arc(const A& arc, double begin, double length) {
    map.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) { map.rest(rest); }
  void impact(const motion::Impact& impact) { map.impact(impact); }
  void touch(const motion::Touch& touch) { map.touch(touch); }
};

std::optional<Round> round_of(const point::Problem& given, const BranchPoint& point) {
  point::Problem problem = with_scene(given, point.scene);
  sweep::enter_shaken_frame(problem);
  const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
  problem = attractors::started(problem, from, 0.0);
  const Effects effects = required_effects(problem);
  return with_effects(effects, [&]<Effects E>() -> std::optional<Round> {
    stepping::Exact<double, E> integrator(problem, stops_in_reach(problem.stops, effects), limits_of(problem));
    motion::State<double> state;
    state.x = from.x, state.v = from.v;
    motion::TangentMap<double> map(integrator.stops());
    Differentiating observer{map};
    if (run_for(integrator, state, point.orbit.period_ratio(), observer) != stepping::Outcome::completed)
      return std::nullopt;
    const motion::Jacobian<double> m = map.map();
    return Round{{state.x, state.v}, m[0] + m[3], m[0] * m[3] - m[1] * m[2]};
  });
}

double norm_of(const BranchPoint& point) { return std::hypot(point.multiplier_re[0], point.multiplier_im[0]); }

TEST(SoftBranch, scratch) {
  std::size_t scenes = 0, points = 0, renewals = 0, special = 0, failed = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    point::Problem problem = support::soft_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    problem.time = {};
    problem.time.max_periods = 2000;
    const double nu = problem.oscillator.frequency;
    BranchSettings settings{.along = index % 3 == 0 ? Parameter::f : Parameter::nu, .range = {0.7 * nu, 1.4 * nu}};
    const double f = problem.oscillator.forcing;
    if (index % 3 == 0) settings.range = {std::min(0.5 * f, 2 * f), std::max(0.5 * f, 2 * f)};
    settings.max_points = 1500;
    settings.generations = 1;
    Branches found;
    try {
      found = follow_branches(problem, settings);
    } catch (const StartError& error) {
      if (std::getenv("VERBOSE")) std::cout << index << " start: " << error.what() << '\n';
      continue;
    }
    ++scenes;
    special += found.special.size();
    for (const BranchEnd& end : found.ends)
      if (end.failed) {
        ++failed;
        std::cout << index << " branch " << end.branch << " at " << value_of(end.scene, settings.along) << ": " << end.reason << " zeta "
                  << problem.stops.damping_lower << ' ' << problem.stops.damping_upper << " kappa "
                  << problem.stops.stiffness_lower << ' ' << problem.stops.stiffness_upper << '\n';
      }
    for (const BranchPoint& point : found.points) {
      if (point.orbit.size() > 0 && !point.orbit.meets_soft_stop()) continue;
      const auto round = round_of(problem, point);
      if (!round) { std::cout << index << " run fails\n"; continue; }
      const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
      const double gap = std::hypot(round->end.x - from.x, round->end.v - from.v);
      bool grazes = false;
      for (const OrbitImpact& impact : point.orbit.impacts) {
        if (std::abs(impact.before) < 1e-5) grazes = true;
        if (impact.event == Event::renewal) ++renewals;
      }
      const double trace = std::real(std::complex(point.multiplier_re[0] + point.multiplier_re[1], 0.0));
      ++points;
      if (grazes) continue;
      const double scale = 1 + norm_of(point);
      if (!(gap < 1e-9 * scale)) std::cout << index << " GAP " << gap << " nu " << point.scene.oscillator.frequency << ' ' << point.orbit.word() << " mult " << norm_of(point) << '\n';
      if (!(std::abs(round->trace - trace) < 1e-7 * scale)) std::cout << index << " TRACE " << round->trace << ' ' << trace << ' ' << value_of(point.scene, settings.along) << ' ' << point.orbit.word() << '\n';
    }
  }
  std::cout << scenes << " scenes " << points << " points " << renewals << " renewals " << special << " special " << failed << " failed\n";
}

}  // namespace
}  // namespace clatter::branches
