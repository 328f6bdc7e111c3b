#include "branches/curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "branches/equations/newton.hpp"
#include "branches/walk/walk.hpp"

namespace clatter::branches::curve_test {
namespace {

/// One stop at 1, force of frequency nu, motion over two forcing periods from x = 0 (VIVID, arXiv 2510.16218).
point::Problem one_stop(double f, double nu, double v) {
  point::Problem problem;
  problem.oscillator = {0.02, f, nu, 0.0};
  problem.stops.upper = 1.0, problem.stops.restitution_upper = 0.9;
  problem.start = {0.0, v, 0.0};
  return problem;
}
BranchSettings over_both(std::string curve) {
  return {.along = Parameter("f"),
          .range = {0.34, 0.42},
          .across = Parameter("nu"),
          .across_range = {0.78, 0.92},
          .curve = std::move(curve),
          .period = 2};
}

point::Problem two_stops(double nu, double xs) {
  point::Problem problem;
  problem.oscillator = {0.1, -1.0, nu, 0.0};
  problem.stops = {-xs, xs, 0.7, 0.7};
  problem.start = {2.0, 3.0, 0.0};
  return problem;
}
BranchSettings over_nu_and_stops(std::string curve) {
  return {.range = {0.5, 2.0},
          .across = Parameter("xs"),
          .across_range = {0.05, 6.0},
          .curve = std::move(curve),
          .generations = 2};
}

const SpecialPoint* of_kind(const Branches& found, SpecialKind kind) {
  const auto special = std::ranges::find(found.special, kind, &SpecialPoint::kind);
  return special == found.special.end() ? nullptr : &*special;
}

struct Place {
  double f, nu;
};
Place place_of(const SpecialPoint& special) {
  return {special.at.scene.oscillator.forcing, special.at.scene.oscillator.frequency};
}
constexpr Place resonance{0.361673852989126, 0.7998399839967992};  // VIVID

/// Folds, flips and grazes of motion with one impact in two periods meet where VIVID says.
TEST(Curve, of_folds_flips_and_grazes_meet_in_vivids_resonant_graze) {
  const Branches folds = follow_curves(one_stop(0.36, 0.799, -1.0), over_both("fold"));
  const Branches flips = follow_curves(one_stop(0.35, 0.81, -0.5), over_both("flip"));
  const Branches grazes = follow_curves(one_stop(0.36, 0.799, -1.0), over_both("graze"));
  for (const Branches* found : {&folds, &flips, &grazes}) {
    const SpecialPoint* special = of_kind(*found, SpecialKind::resonant_graze);
    ASSERT_NE(special, nullptr);
    EXPECT_NEAR(place_of(*special).f, resonance.f, 1e-12);
    EXPECT_NEAR(place_of(*special).nu, resonance.nu, 1e-12);
    EXPECT_EQ(special->at.orbit.word(), "U");
    EXPECT_EQ(special->at.orbit.period_ratio(), 2);
  }
}

/// Near the resonant graze the curves lie beside the graze of the response, whose amplitude is 1, by the square of the
/// distance.
TEST(Curve, of_folds_and_of_flips_are_quadratically_tangent_to_the_graze) {
  for (const auto& [curve, start] :
       {std::pair("fold", one_stop(0.36, 0.799, -1.0)), std::pair("flip", one_stop(0.35, 0.81, -0.5))}) {
    BranchSettings settings = over_both(curve);
    settings.largest_step = 0.001;
    const Branches found = follow_curves(start, settings);
    std::vector<double> ratios;
    for (const BranchPoint& point : found.points) {
      const Oscillator& oscillator = point.scene.oscillator;
      const double along = oscillator.frequency - resonance.nu;
      if (point.orbit.period_ratio() != 2 || point.orbit.size() != 1 || std::abs(along) > 2e-3 ||
          std::abs(along) < 2e-4)
        continue;
      const double graze =
          oscillator.forcing / steady_response(0.02, oscillator.forcing, oscillator.frequency).amplitude;
      ratios.push_back((oscillator.forcing - graze) / (along * along));
    }
    ASSERT_GT(ratios.size(), 5) << curve;
    const auto [low, high] = std::ranges::minmax(ratios);
    EXPECT_LT(high - low, 0.2 * std::abs(low)) << curve;
    EXPECT_GT(std::abs(low), 1) << curve;
  }
}

/// The amplitude of the response is the stops' distance wherever it grazes.
TEST(Curve, of_grazes_of_the_response_is_its_amplitude) {
  const Branches found = follow_curves(two_stops(1.1, 3.0), over_nu_and_stops("graze"));
  std::size_t compared = 0;
  for (const BranchPoint& point : found.points) {
    if (point.branch != 0) continue;
    const double amplitude = steady_response(0.1, 1.0, point.scene.oscillator.frequency).amplitude;
    EXPECT_NEAR(amplitude, point.scene.stops.upper, 1e-12 * amplitude);
    ++compared;
  }
  EXPECT_GT(compared, 100);
  // both ends of the branch at xs = 3 lie on one curve
  std::vector<std::size_t> curves;
  for (const SpecialPoint& special : found.special)
    if (special.kind == SpecialKind::graze && special.at.orbit.events[0].before == 0 &&
        special.at.orbit.events.size() == 1)
      curves.insert(curves.end(), special.branches.begin(), special.branches.end());
  EXPECT_EQ(curves, (std::vector<std::size_t>{0, 0}));
}

/// Folds of symmetric motion with one impact on each stop: the discriminant of the closed form vanishes.
TEST(Curve, of_folds_is_that_of_the_closed_form) {
  const Branches found = follow_curves(two_stops(1.1, 3.0), over_nu_and_stops("fold"));
  EXPECT_GT(found.points.size(), 50);
  for (const BranchPoint& point : found.points) {
    ASSERT_TRUE(point.orbit.mirrored);
    const double nu = point.scene.oscillator.frequency, h = 0.1, R = 0.7, g = point.scene.stops.upper;
    with_arcs(point.scene, [&]<Effects E>() {
      const motion::ArcConstants<double, E> constants(point.scene.oscillator);
      const auto flow = constants.propagator(M_PI / nu);
      const double d = 1 + flow.a + flow.c + std::exp(-2 * h * M_PI / nu), alpha = (1 + R) * flow.b / d;
      const double gamma = ((1 + R) * (1 + flow.a) / d - R) / nu, square = alpha * alpha + gamma * gamma;
      const double A = steady_response(h, 1.0, nu).amplitude;
      EXPECT_NEAR(alpha * alpha * g * g, square * (g * g - A * A), 1e-11 * square * g * g) << nu;
      EXPECT_NEAR(point.orbit.events[0].before * (point.orbit.events[0].side == Side::upper ? 1 : -1),
                  alpha * g / square, 1e-7 * (1 + alpha * g / square))
          << nu;
    });
  }
}

TEST(Curve, of_flips_and_lost_symmetry_has_multiplier_minus_one_all_along) {
  for (const std::string curve : {"flip", "symmetry breaking"}) {
    const Branches found = follow_curves(two_stops(1.1, 3.0), over_nu_and_stops(curve));
    EXPECT_GT(found.points.size(), 50);
    for (const BranchPoint& point : found.points) {
      const bool slow = std::ranges::any_of(point.orbit.events,
                                            [](const OrbitEvent& impact) { return std::abs(impact.before) < 1e-2; });
      if (slow) continue;  // the map's elements are large there
      const ImpactMap map = impact_map(point.scene, point.orbit);
      EXPECT_NEAR(map.trace(), -(1 + map.determinant), 1e-8) << curve;
      EXPECT_EQ(point.orbit.mirrored, curve != "flip");
    }
    for (const BranchEnd& end : found.ends) EXPECT_FALSE(end.failed) << curve << ": " << end.reason;
  }
}

/// Two folds of a branch meet in a cusp: on one side of it the branch has both, on the other neither.
TEST(Curve, of_folds_has_a_cusp_where_two_folds_of_a_branch_meet) {
  point::Problem problem;
  problem.oscillator = {0.02, 1.0, 3.2, 0.0};
  problem.stops = {-1.4665642739725373, 1.4665642739725373, 0.8, 0.8};
  problem.start = {0.0, 1.0, 0.0};
  const Branches found = follow_curves(
      problem,
      {.range = {0.3, 4.0}, .across = Parameter("xs"), .across_range = {0.02, 5.0}, .curve = "fold", .generations = 1});
  const SpecialPoint* cusp = of_kind(found, SpecialKind::cusp);
  ASSERT_NE(cusp, nullptr);
  const auto folds_near = [&](double xs) {
    const Scene scene = changed(cusp->at.scene, Parameter("xs"), xs);
    const OrbitEquations equations(scene, cusp->at.orbit, {{Parameter("nu"), 1.0}}, 1.0);
    const double nu = cusp->at.scene.oscillator.frequency;
    Vector speed(equations.unknowns(), 0.0);  // the branch crosses the cusp in the direction of its orbit
    speed[1] = 1;
    std::size_t folds = 0;
    const auto at = corrected(equations, equations.unknowns_of(scene, cusp->at.orbit), speed, 1e-12);
    if (!at) return std::size_t{99};
    for (const double sign : {-1.0, 1.0}) {
      Vector towards(equations.unknowns(), 0.0);
      towards[1] = sign;
      Walk walk(equations, {*at, tangent(equations, *at, towards).value(), 0.0}, {1e-12, 0.002});
      while (std::abs(walk.here().at.back() - nu) < 0.002 && walk.here().arclength < 0.2) {
        const auto next = walk.next();
        if (!next) return std::size_t{99};
        folds += (next->tangent.back() < 0) != (walk.here().tangent.back() < 0);
        walk.move_to(*next);
      }
    }
    return folds;
  };
  const double xs = cusp->at.scene.stops.upper;
  const std::size_t below = folds_near(xs * (1 - 1e-4)), above = folds_near(xs * (1 + 1e-4));
  EXPECT_EQ(below + above, 2);
  EXPECT_EQ(below * above, 0);
}

TEST(Curve, needs_a_point_to_begin_with) {
  EXPECT_THROW((void)follow_curves(one_stop(0.36, 0.799, -1.0), over_both("flip")), StartError);
  BranchSettings outside = over_both("fold");
  outside.across_range = {0.8, 0.9};
  EXPECT_THROW((void)follow_curves(one_stop(0.36, 0.799, -1.0), outside), StartError);
}

}  // namespace
}  // namespace clatter::branches::curve_test
