// Multipliers along branches of motion with a loose mass.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "branches/branch.hpp"
#include "support/loose_scenes.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches::housing_multipliers_test {
namespace {

/// Their product is e^(-2hT) and R^2 of each impact. Beside one beyond 4.5e15, next to a graze, others have no digits.
TEST(HousingMultipliers, have_the_product_of_all_losses_or_none) {
  const sweep::GivenProblem damper(support::loose_scene(0.02, 0.005, 0.01, 1.0, 0.4, 0.8));
  const Branches found = follow_branches(damper, {.along = Parameter("f"), .range = {0.001, 0.02}, .generations = 1});
  std::size_t known = 0, lost = 0;
  for (const BranchPoint& point : found.points) {
    const auto at = [&](std::size_t i) { return std::complex(point.multiplier_re[i], point.multiplier_im[i]); };
    const double largest = std::abs(at(0)), span = 2 * std::numbers::pi * point.orbit.period_ratio();
    const auto impacts = static_cast<double>(point.orbit.whole().size());
    const double losses = std::exp(-2 * point.scene.oscillator.damping * span / point.scene.oscillator.frequency) *
                          std::pow(point.scene.loose.restitution_lower.R, 2 * impacts);
    if (largest < 100) {
      EXPECT_NEAR(std::abs(at(0) * at(1) * at(2) * at(3) / losses - 1.0), 0, 1e-8);
      ++known;
    }
    const double kept = point.orbit.mirrored ? std::sqrt(largest) : largest;  // that of half a period
    if (kept < 4.6e15) continue;
    EXPECT_TRUE(std::isnan(point.multiplier_re[3]) && std::isnan(point.multiplier_im[3])) << largest;
    ++lost;
  }
  EXPECT_GT(known, 100u);
  EXPECT_GT(lost, 0u);
}

}  // namespace
}  // namespace clatter::branches::housing_multipliers_test
