// Loss and harmonic of motion between soft stops, against runs of the simulator and differences along branches.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "branches/branch.hpp"
#include "branches/bumpers.hpp"
#include "branches/equations/newton.hpp"
#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/walk/violation.hpp"
#include "point/point.hpp"
#include "support/random.hpp"
#include "support/soft_scene.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::soft_measures_test {
namespace {

/// A run of the simulator over one period of a motion.
point::PointResult observed(const point::Problem& given, const BranchPoint& point) {
  point::Problem problem = with_scene(given, point.scene);
  const PhasePoint from = state_at_phase_zero(point.scene, point.orbit);
  problem.start = {from.x, from.v, 0.0};
  problem.time = {};
  problem.time.mode = steady::Mode::transient;
  problem.time.duration = point.orbit.period_ratio() * 2 * std::numbers::pi / problem.oscillator.frequency;
  problem.observe = {};
  problem.observe.energy = true, problem.observe.harmonics = 1;
  problem.observe.impacts = problem.observe.of_soft_stops = true;
  problem.observe.harmonics_method = observables::HarmonicsMethod::exact;
  problem.observe.base_frequency = problem.oscillator.frequency;
  point::ThreadScratch scratch;
  return run_point(problem, scratch);
}

double largest_multiplier(const BranchPoint& point) {
  return std::hypot(point.multiplier_re[0], point.multiplier_im[0]);
}

/// A branch of a random scene along its frequency, or its spring; nothing if it settles on no periodic motion.
std::optional<Branches> branches_of(point::Problem& problem, bool along_stiffness) {
  const double nu = problem.oscillator.frequency, k = problem.oscillator.stiffness;
  problem.time = {};
  problem.time.max_periods = 2000;
  BranchSettings settings{.range = {0.8 * nu, 1.25 * nu}, .max_points = 150};
  if (along_stiffness) settings.along = Parameter("stiffness"), settings.range = {0.9 * k, 1.1 * k};
  try {
    return follow_branches(problem, settings);
  } catch (const StartError&) {
    return std::nullopt;
  }
}

/// The loss is that of the simulator's ledger and the harmonic that of its arcs, neither of which knows of branches.
TEST(SoftMeasures, are_those_of_a_run_of_the_simulator) {
  std::size_t points = 0, lost = 0, contacts = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    point::Problem problem = support::soft_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    const auto found = branches_of(problem, false);
    if (!found) continue;
    for (std::size_t i = 1; i < found->points.size(); i += 5) {
      const BranchPoint& point = found->points[i];
      const auto slow = [](const OrbitEvent& impact) { return std::abs(impact.before) < 1e-5; };
      if (!point.orbit.meets_soft_stop() || std::ranges::any_of(point.orbit.events, slow)) continue;
      if (largest_multiplier(point) > 1e3) continue;
      const point::PointResult run = observed(problem, point);
      const double power = impact_power(point.scene, point.orbit), k = point.scene.oscillator.stiffness;
      EXPECT_NEAR(power, run.impact_power, 1e-10 * (1 + largest_multiplier(point))) << index << ' ' << i;
      const double nu = point.scene.oscillator.frequency;
      const OrbitEquations equations(point.scene, point.orbit, {{Parameter("nu"), 1.0}}, 1.0);
      const Vector at = equations.unknowns_of(point.scene, point.orbit);
      const Along amplitude = harmonic(moving(equations, at, Vector(at.size(), 0.0)));
      // eq. 38 divides by k - nu^2 + 2ih nu
      const double impedance = std::hypot(k - nu * nu, 2 * point.scene.oscillator.damping * nu);
      EXPECT_NEAR(amplitude.value, run.x_spectrum.amplitude[1], 1e-10 * (1 + largest_multiplier(point)) / impedance)
          << index << ' ' << i;
      ++points, lost += power > 1e-6, contacts += point.orbit.size() > 0;
    }
  }
  EXPECT_GT(points, 300);
  EXPECT_GT(lost, 200);
  EXPECT_GT(contacts, 200);
}

/// A mass that its load presses on a damped stop, and that a growing force shakes off it.
point::Problem pressed_scene(std::uint64_t index) {
  support::Random random(41, index);
  point::Problem problem;
  problem.oscillator = {random.logarithmic(0.01, 0.3), 0.02, random.uniform(0.5, 3), -random.uniform(0.2, 1)};
  problem.stops.lower = random.uniform(-0.1, 0.1);
  problem.stops.stiffness_lower = random.logarithmic(10, 1000);
  problem.stops.damping_lower = random.logarithmic(0.01, 0.8);
  problem.start.displacement = problem.stops.lower;
  return problem;
}

/// Along the force, from motion that is always pressed: the loss is that of a run, and the product of the multipliers
/// what the damper of the mass takes of an area of states, and that of the stop while a run is in contact.
TEST(SoftMeasures, of_motion_shaken_off_a_stop_are_those_of_runs) {
  std::size_t pressed = 0, shaken_off = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    const point::Problem problem = pressed_scene(index);
    Branches found;
    try {
      found = follow_branches(problem, {.along = Parameter("f"), .range = {0.01, 3.0}, .max_points = 150});
    } catch (const StartError&) {
      continue;
    }
    for (std::size_t i = 1; i < found.points.size(); i += 4) {
      const BranchPoint& point = found.points[i];
      const auto slow = [](const OrbitEvent& impact) { return std::abs(impact.before) < 1e-4; };
      if (largest_multiplier(point) > 1e2 || std::ranges::any_of(point.orbit.events, slow)) continue;
      const point::PointResult run = observed(problem, point);
      EXPECT_NEAR(impact_power(point.scene, point.orbit), run.impact_power, 1e-9 * (1 + run.impact_power))
          << index << ' ' << i;
      const double period = point.orbit.period_ratio() * 2 * std::numbers::pi / problem.oscillator.frequency;
      const Stops& stops = problem.stops;
      const double damper = stops.damping_lower * std::sqrt(stops.stiffness_lower);
      const double area = std::exp(-2 * period * (problem.oscillator.damping + damper * run.contact_fraction[0]));
      const double product =
          point.multiplier_re[0] * point.multiplier_re[1] - point.multiplier_im[0] * point.multiplier_im[1];
      // Newton's 1e-12 over the least speed, 1e-4, is the error of the time in contact, and it stands in the exponent
      EXPECT_NEAR(product, area, 1e-8 * area * (1 - std::log(area))) << index << ' ' << i;
      (point.orbit.size() == 0 ? pressed : shaken_off) += 1;
    }
  }
  EXPECT_GT(pressed, 50);
  EXPECT_GT(shaken_off, 300);
}

/// The derivative of a measure along a branch, and its difference quotient; fourth order in the distance.
struct Slope {
  double by_formula, by_difference;
};
std::optional<Slope> slope_of(Along (*measure)(const Moving&), const OrbitEquations& equations, const Vector& at,
                              const Vector& along) {
  constexpr double s = 1e-3;
  const auto value = [&](double distance) -> std::optional<double> {
    const auto point = corrected(equations, sum(at, distance, along), along, 1e-12);
    if (!point || violation(equations, *point)) return std::nullopt;
    return measure(moving(equations, *point, along)).value;
  };
  const auto a = value(-2 * s), b = value(-s), c = value(s), d = value(2 * s);
  if (!a || !b || !c || !d) return std::nullopt;
  return Slope{measure(moving(equations, at, along)).slope[0], (8 * (*c - *b) - (*d - *a)) / (12 * s)};
}

/// Along the frequency, and along the spring, of whose stiffness contacts have another derivative.
TEST(SoftMeasures, have_the_derivatives_of_their_differences_along_a_branch) {
  std::size_t compared = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    point::Problem problem = support::soft_scene(index);
    const bool along_stiffness = index % 2 == 1;
    if (problem.oscillator.forcing == 0 || (along_stiffness && !(problem.oscillator.stiffness > 0))) continue;
    const auto found = branches_of(problem, along_stiffness);
    if (!found) continue;
    const Parameter along = along_stiffness ? Parameter("stiffness") : Parameter("nu");
    for (std::size_t i = 4; i < found->points.size(); i += 12) {
      const BranchPoint& point = found->points[i];
      if (!point.orbit.meets_soft_stop() || largest_multiplier(point) > 10) continue;
      const OrbitEquations equations(point.scene, point.orbit, {{along, 1.0}}, 1.0);
      const Vector at = equations.unknowns_of(point.scene, point.orbit);
      Vector axis(at.size(), 0.0);
      axis.back() = 1;
      const auto direction = tangent(equations, at, axis);
      if (!direction) continue;
      for (Along (*measure)(const Moving&) : {impact_power, harmonic}) {
        const auto slope = slope_of(measure, equations, at, *direction);
        if (!slope) continue;
        EXPECT_NEAR(slope->by_formula, slope->by_difference, 1e-6 * (1 + std::abs(slope->by_formula)))
            << index << ' ' << i;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 150);
}

const SpecialPoint* of_kind(const Branches& found, SpecialKind kind) {
  const auto special = std::ranges::find(found.special, kind, &SpecialPoint::kind);
  return special == found.special.end() ? nullptr : &*special;
}

/// No point of the branch is above the maximum, and that nearest to it is lower by the square of its distance alone.
TEST(SoftMeasures, have_their_maxima_above_all_points_of_the_branch) {
  point::Problem problem = bumpers(70.0, 0.1);
  problem.observe.energy = true, problem.observe.harmonics = 1;
  const Branches found = follow_branches(problem, {.range = {0.85, 1.5}});
  const SpecialPoint* const power = of_kind(found, SpecialKind::impact_power);
  const SpecialPoint* const wave = of_kind(found, SpecialKind::harmonic);
  ASSERT_NE(power, nullptr);
  ASSERT_NE(wave, nullptr);
  const double most_power = impact_power(power->at.scene, power->at.orbit);
  const double most_wave = observed(problem, wave->at).x_spectrum.amplitude[1];
  double nearest_power = 0, nearest_wave = 0;
  for (const BranchPoint& point : found.points) {
    if (point.branch != power->branches.front() || !point.orbit.meets_soft_stop()) continue;
    nearest_power = std::max(nearest_power, impact_power(point.scene, point.orbit));
    nearest_wave = std::max(nearest_wave, observed(problem, point).x_spectrum.amplitude[1]);
  }
  EXPECT_LE(nearest_power, most_power * (1 + 1e-12));
  EXPECT_LE(nearest_wave, most_wave * (1 + 1e-12));
  EXPECT_GT(nearest_power, most_power * (1 - 1e-3));  // within half a step of 0.02
  EXPECT_GT(nearest_wave, most_wave * (1 - 1e-3));
}

/// A mass that is always in contact loses 2 h_s times the mean square of its velocity.
TEST(SoftMeasures, of_the_pressed_response_are_those_of_a_forced_oscillator) {
  point::Problem problem;
  problem.oscillator = {0.1, 0.2, 0.5, 5.0};
  problem.stops.upper = 0.5;
  problem.stops.stiffness_upper = 10.0, problem.stops.damping_upper = 0.2;
  problem.start = {1.0, 0.0, 0.0};
  const double h_s = 0.2 * std::sqrt(10.0), h = 0.1 + h_s, k = 11.0;
  problem.observe.energy = true, problem.observe.harmonics = 1;
  const Branches found = follow_branches(problem, {.range = {0.3, 5.0}});
  const auto amplitude = [&](double nu) { return 0.2 / std::hypot(k - nu * nu, 2 * h * nu); };
  for (const BranchPoint& point : found.points) {
    const double nu = point.scene.oscillator.frequency, speed = nu * amplitude(nu);
    EXPECT_NEAR(impact_power(point.scene, point.orbit), h_s * speed * speed, 1e-15);
  }
  const SpecialPoint *const power = of_kind(found, SpecialKind::impact_power), *const wave = of_kind(
                                                                                   found, SpecialKind::harmonic);
  ASSERT_NE(power, nullptr);
  ASSERT_NE(wave, nullptr);
  EXPECT_NEAR(power->at.scene.oscillator.frequency, std::sqrt(k), 1e-9);
  EXPECT_NEAR(wave->at.scene.oscillator.frequency, std::sqrt(k - 2 * h * h), 1e-9);
}

}  // namespace
}  // namespace clatter::branches::soft_measures_test
