// Motion that is its own mirror image about an equilibrium that moves along the branch.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "branches/branch.hpp"
#include "branches/special_values.hpp"
#include "support/loose_scenes.hpp"
#include "support/random.hpp"

namespace clatter::branches::moving_mirror_test {
namespace {

/// A damper on a spring that is pressed by a load; its motion loses its symmetry twice along the stiffness.
point::Problem pressed_damper(double load) {
  point::Problem scene = support::loose_scene(0.076, 0.16, 0.11, 1.4643, 0.1865, 0.227);
  scene.oscillator.load = load, scene.oscillator.stiffness = 1.65;
  scene.start.displacement = load / scene.oscillator.stiffness;
  scene.loose.velocity = -0.1;
  return scene;
}

/// Without stops on the main mass a load moves its equilibrium, and changes nothing else: all branches are those
/// without it.
void expect_same(const Branches& one, const Branches& other, Parameter along, const std::string& where) {
  ASSERT_EQ(one.points.size(), other.points.size()) << where;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const BranchPoint &a = one.points[i], &b = other.points[i];
    EXPECT_EQ(a.orbit.mirrored, b.orbit.mirrored) << where;
    EXPECT_NEAR(value_of(a.scene, along), value_of(b.scene, along), 1e-8) << where;
  }
  for (const SpecialKind kind : {SpecialKind::fold, SpecialKind::flip, SpecialKind::symmetry_breaking,
                                 SpecialKind::neimark_sacker, SpecialKind::graze}) {
    const std::vector<double> told = special_values(one, kind, along), without = special_values(other, kind, along);
    ASSERT_EQ(told.size(), without.size()) << where << ": " << name_of(kind);
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_NEAR(told[i], without[i], 1e-9) << where << name_of(kind);
  }
}

TEST(MovingMirror, loses_no_symmetry_along_the_stiffness) {
  const Parameter stiffness("stiffness");
  const Branches found = follow_branches(pressed_damper(0.05), {.along = stiffness, .range = {1.0, 2.6}});
  const std::vector<double> told = special_values(found, SpecialKind::symmetry_breaking, stiffness);
  ASSERT_EQ(told.size(), 2);
  EXPECT_NEAR(told[0], 2.0802453, 5e-8);
  EXPECT_NEAR(told[1], 2.5258477, 5e-8);
}

TEST(MovingMirror, has_the_branches_without_a_load_along_any_key) {
  for (std::uint64_t i = 0; i < 6; ++i) {
    support::Random draw(11, i);
    const double load = draw.uniform(-0.3, 0.3);
    for (const auto& [key, low, high] :
         {std::tuple(Parameter("stiffness"), 1.2, 2.6), std::tuple(Parameter("nu"), 1.3, 1.6),
          std::tuple(Parameter("loose_gap"), 0.15, 0.25), std::tuple(Parameter("h"), 0.1, 0.2)}) {
      const BranchSettings settings{.along = key, .range = {low, high}, .generations = 1};
      const Branches with = follow_branches(pressed_damper(load), settings),
                     without = follow_branches(pressed_damper(0), settings);
      expect_same(with, without, key, std::string(key.key()) + ", load " + std::to_string(load));
    }
  }
}

/// Along the load itself nothing happens but that the mirror moves.
TEST(MovingMirror, keeps_its_symmetry_along_the_load) {
  const Branches found = follow_branches(pressed_damper(0.05), {.along = Parameter("load"), .range = {-1, 1}});
  ASSERT_GT(found.points.size(), 10);
  for (const BranchPoint& point : found.points) EXPECT_TRUE(point.orbit.mirrored);
  EXPECT_TRUE(found.special.empty());
}

/// In SI a mass changes the stiffness per unit mass, and the load alike.
TEST(MovingMirror, loses_no_symmetry_along_the_mass) {
  const double m = 0.25, k = 800, rate = std::sqrt(k / m), length = 1e-3;
  const auto machine = [&](double load) {
    sweep::GivenProblem problem(pressed_damper(0));
    problem.is_si = true, problem.mass = m;
    problem.oscillator = {.forcing = 0.11 / 1.65 * k * length,
                          .frequency = 1.4643 / std::sqrt(1.65) * rate / (2 * std::numbers::pi),
                          .load = load * k * length,
                          .stiffness = k};
    problem.damper = 2 * 0.16 / std::sqrt(1.65) * m * rate;
    problem.start.displacement = load * length;
    problem.loose = {.ratio = 0.076 * m,
                     .lower = -0.1865 * length,
                     .upper = 0.1865 * length,
                     .restitution_lower = 0.227,
                     .restitution_upper = 0.227};
    problem.loose.velocity = -0.1 / std::sqrt(1.65) * length * rate;
    return problem;
  };
  const BranchSettings settings{.along = Parameter("mass"), .range = {0.15, 0.3}};
  const Branches with = follow_branches(machine(0.03), settings), without = follow_branches(machine(0), settings);
  EXPECT_EQ(special_values(with, SpecialKind::symmetry_breaking, Parameter("mass")).size(), 1);
  expect_same(with, without, Parameter("mass"), "mass");
}

/// Stops hold the mirror in their middle: it is lost as soon as the equilibrium leaves that.
TEST(MovingMirror, is_lost_beside_stops_unless_spring_and_load_change_alike) {
  point::Problem scene;
  scene.oscillator = {.damping = 0.1, .forcing = 1.0, .frequency = 1.2, .load = 0.3};
  scene.stops = {-0.2, 0.8};
  scene.start.displacement = 0.4;
  const sweep::GivenProblem own(scene);
  sweep::GivenProblem machine(scene);
  machine.is_si = true;
  for (const auto& [problem, key, keeps] :
       {std::tuple(own, Parameter("nu"), true), std::tuple(own, Parameter("R"), true),
        std::tuple(own, Parameter("stiffness"), false), std::tuple(own, Parameter("load"), false),
        std::tuple(own, Parameter("stop_upper"), false), std::tuple(machine, Parameter("mass"), true),
        std::tuple(machine, Parameter("stiffness"), false), std::tuple(machine, Parameter("frequency"), true)})
    EXPECT_EQ(keeps_symmetry(StartProblem(problem), key), keeps) << key.key();
}

}  // namespace
}  // namespace clatter::branches::moving_mirror_test
