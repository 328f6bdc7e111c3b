// Curves of special points in two parameters between soft stops, against branches along one of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "branches/bumpers.hpp"
#include "branches/curve.hpp"
#include "branches/equations/flight.hpp"
#include "branches/special_values.hpp"
#include "support/soft_scene.hpp"

namespace clatter::branches::soft_curve_test {
namespace {

struct Curve {
  std::string_view name;
  SpecialKind kind;
  Parameter across;
  std::array<double, 2> range;
};

BranchSettings settings_of(const Curve& curve) {
  return {.range = {0.85, 1.5},
          .across = curve.across,
          .across_range = curve.range,
          .curve = std::string(curve.name),
          .generations = 1};
}

/// The distance of a value from the nearest of others.
double distance(const std::vector<double>& values, double value) {
  double least = std::numeric_limits<double>::infinity();
  for (const double each : values) least = std::min(least, std::abs(each - value));
  return least;
}

/// A branch along the first parameter, at the second's value of a point of the curve, has the special point there. It
/// begins with the motion that the scene settles on, and not with anything of the curve.
TEST(SoftCurve, has_the_special_points_of_branches_that_it_crosses) {
  for (const Curve& curve :
       {Curve{"fold", SpecialKind::fold, Parameter("stop_stiffness"), {40.0, 150.0}},
        Curve{"fold", SpecialKind::fold, Parameter("stop_damping"), {0.02, 0.3}},
        Curve{"flip", SpecialKind::flip, Parameter("stop_stiffness"), {60.0, 85.0}},
        Curve{"symmetry breaking", SpecialKind::symmetry_breaking, Parameter("stop_stiffness"), {50.0, 100.0}},
        Curve{"graze", SpecialKind::graze, Parameter("stop_stiffness"), {60.0, 85.0}}}) {
    const Branches found = follow_curves(bumpers(70.0, 0.1), settings_of(curve));
    std::size_t compared = 0;
    for (const double at : {0.2, 0.4, 0.6, 0.8}) {
      const auto& first = found.points.front();  // of the first curve
      std::vector<const BranchPoint*> points;
      for (const BranchPoint& point : found.points)
        if (point.branch == first.branch && point.scene.oscillator.frequency < 1.5) points.push_back(&point);
      const BranchPoint& point = *points[static_cast<std::size_t>(at * static_cast<double>(points.size()))];
      const double across = value_of(point.scene, curve.across);
      const point::Problem there = with_scene(bumpers(70.0, 0.1), changed(bumpers(70.0, 0.1), curve.across, across));
      const Branches along = follow_branches(there, {.range = {0.85, 1.5}, .generations = 1});
      const std::vector<double> values = special_values(along, curve.kind, Parameter("nu"));
      EXPECT_LT(distance(values, point.scene.oscillator.frequency), 1e-10) << curve.name << ' ' << across;
      ++compared;
    }
    EXPECT_EQ(compared, 4);
  }
}

/// Stiffer stops are more like rigid ones of equal restitution (eq. 55): the curve of folds comes to that of these as
/// kappa^(-1/2).
TEST(SoftCurve, of_folds_tends_to_the_fold_between_rigid_stops) {
  const double zeta = 0.1, root = std::sqrt(1 - zeta * zeta);
  const double R = std::exp(-2 * zeta * std::acos(zeta) / root);
  point::Problem rigid = bumpers(1.0, 0.0);
  rigid.stops = {-3.0, 3.0, R, R};
  const auto folds = special_values(follow_branches(rigid, {.range = {0.85, 1.5}}), SpecialKind::fold, Parameter("nu"));
  ASSERT_FALSE(folds.empty());
  const Branches found = follow_curves(
      bumpers(1e6, zeta), settings_of({"fold", SpecialKind::fold, Parameter("stop_stiffness"), {1e6, 1e8}}));
  std::vector<double> scaled;  // by the root of kappa
  for (const BranchPoint& point : found.points)
    if (point.branch == found.points.front().branch)
      scaled.push_back((point.scene.oscillator.frequency - folds.front()) *
                       std::sqrt(point.scene.stops.stiffness_upper));
  ASSERT_GT(scaled.size(), 10);
  for (const double each : scaled) EXPECT_NEAR(each / scaled.back(), 1.0, 1e-2);
}

/// Where the response grazes the bumpers neither their stiffness nor their damping matters.
TEST(SoftCurve, of_the_grazing_response_keeps_its_frequency) {
  for (const Parameter across : {Parameter("stop_stiffness"), Parameter("stop_damping")}) {
    const bool stiffness = across == Parameter("stop_stiffness");
    const Branches found =
        follow_curves(bumpers(200.0, 0.1), {.range = {1.0, 4.0},
                                            .across = across,
                                            .across_range = {stiffness ? 100.0 : 0.0, stiffness ? 400.0 : 1.0},
                                            .curve = "graze"});
    ASSERT_GT(found.points.size(), 40);
    for (const BranchPoint& point : found.points)
      EXPECT_NEAR(steady_response(0.1, 1.0, point.scene.oscillator.frequency).amplitude, 3.0, 1e-12);
  }
}

/// Speed of the slowest event, or least rate of the force of a soft stop over its stiffness where that is zero.
double least_rate(const BranchPoint& point) {
  const SceneNumbers<double> p = numbers_of<double>(point.scene);
  double least = std::numeric_limits<double>::infinity();
  for (const OrbitEvent& impact : point.orbit.events) {
    const auto& [side, phase, before, kind, rest, place, other, contact] = impact;
    least = std::min(least, std::abs(before));
    if (kind != Event::Kind::separation && kind != Event::Kind::renewal) continue;
    const double relaxation = p.soft_stop(side).relaxation(), x = p.position(side) - relaxation * before;
    const auto& [h, f, nu, load, k, shape, paces] = p.oscillator;
    const double a = f * std::sin(phase) + load - 2 * h * before - k * x;
    least = std::min(least, std::abs(before + relaxation * a));
  }
  return least;
}

/// Along curves of random scenes the multiplier is that of the special point, or an event grazes, and few curves end
/// without a reason of physics.
TEST(SoftCurve, of_random_scenes_keeps_its_equation) {
  std::size_t curves = 0, points = 0, failed = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    point::Problem problem = support::soft_scene(index);
    if (problem.oscillator.forcing == 0) continue;
    problem.time = {};
    problem.time.max_periods = 1000;
    const double nu = problem.oscillator.frequency, kappa = problem.stops.stiffness_lower;
    for (const std::string_view name : {"fold", "flip", "graze"}) {
      Branches found;
      try {
        found = follow_curves(problem, {.range = {0.8 * nu, 1.25 * nu},
                                        .across = Parameter("stop_stiffness_lower"),
                                        .across_range = {0.7 * kappa, 1.4 * kappa},
                                        .curve = std::string(name),
                                        .max_points = 300});
      } catch (const StartError&) {
        continue;
      }
      for (const BranchPoint& point : found.points) {
        const double multiplier = name == "fold" ? 1.0 : -1.0;
        if (name == "graze") {
          EXPECT_LT(least_rate(point), 1e-8) << index;
        } else {
          EXPECT_LT(std::min(std::hypot(point.multiplier_re[0] - multiplier, point.multiplier_im[0]),
                             std::hypot(point.multiplier_re[1] - multiplier, point.multiplier_im[1])),
                    1e-6)
              << index << ' ' << name;
        }
        ++points;
      }
      for (const BranchEnd& end : found.ends) {
        curves += end.of_curve;
        failed += end.of_curve && end.failed && end.reason != max_points_spent;
      }
    }
  }
  EXPECT_GT(points, 2000);
  EXPECT_GT(curves, 40);
  EXPECT_LT(failed, curves / 10);
}

}  // namespace
}  // namespace clatter::branches::soft_curve_test
