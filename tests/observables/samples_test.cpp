#include "observables/samples/samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "math/fifty_digits.hpp"
#include "motion/arc_bounds.hpp"
#include "observables/arc_of.hpp"
#include "observables/runs.hpp"

namespace clatter::observables::samples_test {
namespace {

Samples samples_of(const point::Problem& scene, std::size_t count, bool with_end, AtImpact at_impact) {
  std::optional<Samples> samples;
  observe(scene, [&](double total, auto run) {
    samples.emplace(count, total / static_cast<double>(with_end ? count - 1 : count), at_impact, scene.stops);
    const auto end = run(*samples);
    samples->finish(end.x, end.v, total, true);
  });
  return std::move(*samples);
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
  point::Problem scene = conservative_scene(0.5, 1.0);
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

TEST(Samples, by_steps_from_an_instant_are_as_good_as_evaluated_ones) {
  constexpr std::size_t count = 300;
  constexpr double spacing = 1.0 / 64;  // so that instants are exact
  for (const double h : {0.0, 1e-9, 0.1, 0.9, 1.0, 1.5, 10.0, 1000.0})
    for (const double f : {0.0, -1.3})
      for (const double nu : {1e-3, 0.3, 1.0, 1.04, 2.7, 30.0})
        with_any_stops(Oscillator{h, f, nu, 0.2}, [&]<Effects effects>() {
          const motion::ArcConstants<double, effects.arc()> constants({h, f, nu, 0.2});
          const motion::ArcConstants<FiftyDigits, effects.arc()> exact_flow({h, f, nu, 0.2});
          const auto arc = arc_of(constants, 0.37, -1.1);
          const auto exact = arc_of(exact_flow, 0.37, -1.1);
          Samples samples(count, spacing, AtImpact::after, {});
          samples.arc(arc, 0.0, count * spacing);
          for (std::size_t i = 0; i < count; i += 7) {
            const double s = static_cast<double>(i) * spacing;
            const motion::Motion<FiftyDigits> expected = exact.at(s);
            // natural scale: the response and the free motion; the argument of a sine rounds to its ulps; evaluated
            // samples take 0.19 of (8 + argument), these 0.16
            const double scale = 0.2 + reach(constants, arc.start(), s);
            const double allowed = 0.25 * std::numeric_limits<double>::epsilon() * (8 + s * constants.rate) * scale;
            EXPECT_NEAR(samples.displacement()[i], static_cast<double>(expected.x), allowed)
                << "h = " << h << ", f = " << f << ", nu = " << nu << ", s = " << s;
            EXPECT_NEAR(samples.velocity()[i], static_cast<double>(expected.v), allowed * std::max(1.0, nu))
                << "h = " << h << ", f = " << f << ", nu = " << nu << ", s = " << s;
          }
        });
}

TEST(Samples, of_short_flights_are_evaluated_each) {
  // between stops 1e-9 apart: a step from another instant would know the place to an ulp of the response
  const motion::ArcConstants<double, Effects{Damping::light, Forcing::regular}> constants({0.1, 1.0, 1.5, 0.0});
  const motion::Arc<double, Effects{Damping::light, Forcing::regular}> arc = arc_of(constants, -5e-10, 1e-5);
  constexpr double length = 1e-4;
  Samples samples(50, length / 50, AtImpact::after, {-5e-10, 5e-10, 0.7, 0.7});
  samples.arc(arc, 0.0, length);
  for (std::size_t i = 0; i < 50; ++i) {
    const motion::Motion<double> expected = arc.at(static_cast<double>(i) * (length / 50));
    EXPECT_EQ(samples.displacement()[i], std::min(expected.x, 5e-10));
    EXPECT_EQ(samples.velocity()[i], expected.v);
  }
}

}  // namespace
}  // namespace clatter::observables::samples_test
