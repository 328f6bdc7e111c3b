#include "observables/samples.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "observables/fourier_transform.hpp"
#include "observables/runs.hpp"

namespace clatter {
namespace {

Samples samples_of(const Scene& scene, std::size_t count, bool with_end, AtImpact at_impact) {
  std::optional<Samples> samples;
  observe(scene, [&](double total, auto run) {
    samples.emplace(count, total / static_cast<double>(with_end ? count - 1 : count), at_impact, scene.stops);
    const auto end = run(*samples);
    samples->finish(end.x, end.v, total, true);
  });
  return *samples;
}

TEST(Samples, of_free_vibration_lie_on_its_arcs_both_ends_included) {
  const double V = 1.25, g = 0.749;
  Samples samples = samples_of(conservative_scene(g, V), 401, true, AtImpact::after);
  ASSERT_EQ(samples.displacement().size(), 401u);
  const double quarter = std::asin(g / V);
  for (std::size_t i = 0; i <= 100; ++i) {
    const double tau = quarter * static_cast<double>(i) / 100;
    EXPECT_NEAR(samples.displacement()[i], -V * std::sin(tau), 1e-15);
  }
  EXPECT_NEAR(samples.displacement().back(), 0.0, 4e-15);
  EXPECT_NEAR(samples.velocity().back(), -V, 4e-15);
}

TEST(Samples, on_an_impact_show_the_velocity_after_it_or_the_mean) {
  Scene scene = conservative_scene(0.5, 1.0);
  scene.start = {-0.5, std::sqrt(0.75),
                 0.0};  // just after the contact with the lower stop: samples 0, N/2 and N lie on impacts
  Samples trajectory = samples_of(scene, 5, true, AtImpact::after);
  EXPECT_NEAR(trajectory.velocity()[2], -std::sqrt(0.75), 1e-14);
  EXPECT_EQ(trajectory.displacement()[2], 0.5);
  EXPECT_NEAR(trajectory.velocity()[4], std::sqrt(0.75), 1e-14);
  Samples mean = samples_of(scene, 4, false, AtImpact::mean);
  EXPECT_NEAR(mean.velocity()[0], 0.0, 1e-14);
  EXPECT_NEAR(mean.velocity()[2], 0.0, 1e-14);
}

TEST(Samples, never_lie_outside_the_stops) {
  Samples samples = samples_of(paper_scene(0.5, 0.7, 1.0), 100000, false, AtImpact::mean);
  const auto [low, high] = std::minmax_element(samples.displacement().begin(), samples.displacement().end());
  EXPECT_GE(*low, -0.5);
  EXPECT_LE(*high, 0.5);
}

TEST(FourierTransform, finds_a_sum_of_cosines) {
  const std::size_t n = 64;
  std::vector<double> samples;
  for (std::size_t i = 0; i < n; ++i)
    samples.push_back(0.25 +
                      3 * std::cos(2 * std::numbers::pi * 5 * static_cast<double>(i) / static_cast<double>(n) + 0.7));
  const FourierTransform transform(n);
  const auto workspace = transform.workspace();
  const auto c = transform.transform(samples, *workspace);
  ASSERT_EQ(c.size(), n / 2 + 1);
  EXPECT_NEAR(c[0].real(), 0.25, 1e-15);
  EXPECT_NEAR(2 * std::abs(c[5]), 3.0, 2e-15);
  EXPECT_NEAR(std::arg(c[5]), 0.7, 1e-15);
  EXPECT_LT(std::abs(c[4]), 1e-15);
}

}  // namespace
}  // namespace clatter
