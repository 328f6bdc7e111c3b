// A loose mass beside stops and friction by time stepping, on random machines: its motion tends to the exact one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stepping/moreau.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"
#include "support/random_machine.hpp"

namespace clatter::stepping::moreau_machines_test {
namespace {

/// By how much the places of both masses at the end of a run by steps are off.
double error_of(point::Problem scene, const accuracy::RunRecord& exact, double steps) {
  scene.integration.method = Method::moreau, scene.integration.step = 1 / steps;
  const auto run = support::record_by<Moreau>(scene, exact.duration);
  EXPECT_EQ(run.outcome, Outcome::completed);
  return std::max(std::abs(run.x - exact.x), std::abs(run.z - exact.z));
}

TEST(MoreauMachines, tend_to_the_exact_motion_in_proportion_to_the_step) {
  std::vector<double> coarse, fine;
  for (std::uint64_t index = 0; index < 150; ++index) {
    const point::Problem scene = support::random_machine(index);
    const accuracy::RunRecord exact = accuracy::record_of(scene, 10);
    ASSERT_EQ(exact.outcome, Outcome::completed);
    coarse.push_back(error_of(scene, exact, 1e3)), fine.push_back(error_of(scene, exact, 3e4));
    if (fine.back() > 1e-3) {  // a motion that stretches differences, as near a graze
      EXPECT_LT(error_of(scene, exact, 1e6), 0.3 * fine.back()) << index;
    }
  }
  const auto median = [](std::vector<double> errors) {
    std::ranges::nth_element(errors, errors.begin() + 75);
    return errors[75];
  };
  EXPECT_NEAR(std::log(median(coarse) / median(fine)) / std::log(30), 1, 0.1);
}

/// Where it stays, and where friction lets it slide, is known in closed form.
TEST(MoreauMachines, a_loose_mass_is_held_in_its_housing_up_to_the_static_level) {
  const double eps = 0.25, f = 0.8, nu = 0.7, level = 0.08;
  point::Problem scene = support::loose_scene(eps, 0, f, nu, 3, 0.5);
  scene.oscillator.stiffness = 0, scene.loose.place = 0.3;
  scene.loose.friction = 0.01, scene.loose.friction_static = level;
  scene.integration.method = Method::moreau, scene.integration.step = 1e-5;
  const double released = std::asin(level / eps * (1 + eps) / f) / nu, step = 2 * pi<double>() / nu * 1e-5;
  support::LooseRecorder record;
  const accuracy::RunRecord run = support::run_by<Moreau>(scene, 2, record);
  ASSERT_FALSE(record.holds.empty());
  for (const motion::Event& hold : record.holds) EXPECT_NEAR(hold.place, 0.3, 1e-15);
  EXPECT_NEAR(record.holds.back().end(), released, 2 * step);
  EXPECT_LT(run.z, 0.3);  // it falls behind
}

}  // namespace
}  // namespace clatter::stepping::moreau_machines_test
