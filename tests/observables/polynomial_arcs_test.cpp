// Observables of motion that a general method gives by polynomials, step by step.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <optional>

#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "observables/runs.hpp"
#include "observables/samples/samples.hpp"
#include "observables/stability/stability_observer.hpp"
#include "steady/find_steady.hpp"
#include "stepping/dormand_prince.hpp"
#include "support/methods.hpp"
#include "support/random.hpp"

namespace clatter::observables::polynomial_arcs_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();
constexpr Effects effects = general_effects({.damping = 0.1}).arc();
constexpr Stops no_stops{};
using Complex = std::complex<double>;

/// Its arcs have no equation that matters here.
const motion::ArcConstants<double, effects> constants({0.1, 1.0, 1.3, 0.0});

/// Coefficients in u, to degree 6, as a Bernstein polynomial.
Bernstein<double> by_powers(const std::array<double, 7>& a) {
  Bernstein<double> c{};
  for (std::size_t j = 0; j < c.size(); ++j) {
    double share = 1;  // of u^k: (j choose k) / (6 choose k)
    for (std::size_t k = 0; k <= j; ++k) {
      c[j] += share * a[k];
      if (k < 6) share *= static_cast<double>(j - k) / static_cast<double>(6 - k);
    }
  }
  return c;
}

Bernstein<double> any_polynomial(support::Random& random) {
  Bernstein<double> c;
  for (double& coefficient : c) coefficient = random.uniform(-1, 1);
  return c;
}

TEST(PolynomialArcs, extrema_inside_a_step_are_found_to_rounding) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    support::Random random(41, i);
    const double u = random.uniform(0.05, 0.95), top = random.uniform(-3, 3), bend = random.logarithmic(1e-6, 10);
    const double anchor = random.uniform(-2, 2), length = random.logarithmic(1e-3, 2);
    // rise: top - bend (u - u0)^2, velocity: the same turned over
    const auto offset = by_powers({top - bend * u * u, 2 * bend * u, -bend}),
               velocity = by_powers({bend * u * u - top, -2 * bend * u, bend});
    const motion::PolynomialArc<effects> arc(constants, anchor, 0.0, length, offset, velocity);
    Extrema::Observer extrema;
    extrema.arc(arc, 0.0, length);
    // a coefficient's rounding, and what is left undecided
    const double allowed = 8 * ulp * (std::abs(top) + std::abs(anchor) + bend);
    EXPECT_NEAR(extrema.displacement(no_stops).high, anchor + top, allowed) << i;
    EXPECT_NEAR(extrema.velocity().low, -top, allowed) << i;
    EXPECT_NEAR(extrema.displacement(no_stops).low, anchor + top - bend * std::max(u * u, (1 - u) * (1 - u)), allowed)
        << i;
  }
}

TEST(PolynomialArcs, extrema_after_the_end_of_a_cut_step_do_not_count) {
  // rise 1 - (u - 3/4)^2, cut at 1/2 and at 7/8
  const auto offset = by_powers({7.0 / 16, 1.5, -1});
  const motion::PolynomialArc<effects> arc(constants, 0.0, 0.0, 2.0, offset, by_powers({0, 1}));
  Extrema::Observer before, behind;
  before.arc(arc, 0.0, 1.0);
  behind.arc(arc, 0.0, 1.75);
  EXPECT_NEAR(before.displacement(no_stops).high, 15.0 / 16, 4 * ulp);
  EXPECT_NEAR(before.velocity().high, 0.5, 4 * ulp);
  EXPECT_NEAR(behind.displacement(no_stops).high, 1.0, 4 * ulp);
  EXPECT_NEAR(behind.velocity().high, 0.875, 4 * ulp);
}

TEST(PolynomialArcs, extrema_of_any_polynomial_are_never_passed_and_always_reached) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    support::Random random(42, i);
    const motion::PolynomialArc<effects> arc(constants, 0.0, 0.0, 1.0, any_polynomial(random), any_polynomial(random));
    const double length = random.uniform(0.1, 1);
    Extrema::Observer extrema;
    extrema.arc(arc, 0.0, length);
    Range x, v;
    constexpr int count = 2000;
    for (int k = 0; k <= count; ++k) x.include(arc.at(length * k / count).x), v.include(arc.at(length * k / count).v);
    const double missed = 30.0 * 4 / (8.0 * count * count);  // |y''| <= 6*5 times a second difference, of up to 4
    for (const auto& [found, scan] : {std::pair(extrema.displacement(no_stops), x), std::pair(extrema.velocity(), v)}) {
      EXPECT_GE(found.high, scan.high - 8 * ulp) << i;
      EXPECT_LE(found.high, scan.high + missed) << i;
      EXPECT_LE(found.low, scan.low + 8 * ulp) << i;
      EXPECT_GE(found.low, scan.low - missed) << i;
    }
    EXPECT_EQ(extrema.evaluations(), 1);
  }
}

/// The integral of y(s) e^{-i w (begin + s)} over an arc, by 30 points on each of 64 panels.
template <class Function>
Complex integral(Function&& y, double w, double begin, double length) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr int panels = 64;
  Complex sum = 0;
  const double half = length / panels / 2;
  for (int panel = 0; panel < panels; ++panel)
    for (const double sign : {-1.0, 1.0})
      for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const double s = (2 * panel + 1 + sign * Rule::abscissa()[i]) * half;
        sum += half * Rule::weights()[i] * y(s) * std::polar(1.0, -w * (begin + s));
      }
  return sum;
}

TEST(PolynomialArcs, harmonics_are_those_of_a_much_finer_quadrature) {
  constexpr std::size_t highest = 24;
  for (std::uint64_t i = 0; i < 60; ++i) {
    support::Random random(43, i);
    const double base = random.logarithmic(0.1, 3);
    ExactHarmonics harmonics(highest, base);
    std::vector<Complex> expected(highest + 1);
    double begin = 0;
    for (int k = 0; k < 6; ++k) {
      const double step = random.logarithmic(1e-3, 4), length = step * (k % 2 == 0 ? 1.0 : random.uniform(0, 1));
      const motion::PolynomialArc<effects> arc(constants, 0.3, 0.0, step, any_polynomial(random), {});
      harmonics.arc(arc, begin, length);
      for (std::size_t n = 0; n <= highest; ++n)
        expected[n] += integral([&](double s) { return arc.at(s).x; }, base * static_cast<double>(n), begin, length);
      begin += length;
    }
    harmonics.finish(0.0, begin);
    for (std::size_t n = 0; n <= highest; ++n)  // means of values up to 1.3
      EXPECT_LT(std::abs(harmonics.displacement()[n] - expected[n] / begin), 1e-13) << i << ", " << n;
  }
}

TEST(PolynomialArcs, harmonics_of_the_velocity_are_those_of_the_derivative) {
  // pieces of one polynomial and its derivative over 0 ... 3: x' is the velocity everywhere
  const auto offset = by_powers({0.2, -1, 3, 0.5, -4, 1, 0.3});
  const auto velocity = by_powers({-1.0 / 3, 2, 0.5, -16.0 / 3, 5.0 / 3, 0.6, 0});
  const motion::PolynomialArc<effects> arc(constants, 0.1, 0.0, 3.0, offset, velocity);
  const double base = 2 * std::numbers::pi / 3;
  ExactHarmonics harmonics(4, base);
  harmonics.arc(arc, 0.0, 3.0);
  harmonics.finish(arc.at(3.0).x, 3.0);
  for (std::size_t n = 0; n <= 4; ++n) {
    const double w = base * static_cast<double>(n);
    const Complex expected = integral([&](double s) { return arc.at(s).v; }, w, 0.0, 3.0) / 3.0;
    EXPECT_LT(std::abs(harmonics.velocity()[n] - expected), 1e-13 * (1 + w)) << n;
  }
}

TEST(PolynomialArcs, samples_lie_on_their_polynomials_and_the_last_on_the_end) {
  const double third = 1.0 / 3;
  Samples samples(7, third, AtImpact::after, no_stops);
  const motion::PolynomialArc<effects> first(constants, 0.5, 0.0, 2.0, by_powers({0, 1, 1}), by_powers({4, 0, 0, 1}));
  const motion::PolynomialArc<effects> second(constants, -1.0, 0.0, 5.0, by_powers({1, 0, 2}), by_powers({0, 3}));
  samples.arc(first, 0.0, 1.1);  // of their steps only the beginnings
  samples.arc(second, 1.1, 0.9);
  samples.finish(7.0, 8.0, 2.0, false);
  ASSERT_EQ(samples.displacement().size(), 7u);
  for (int i = 0; i < 6; ++i) {
    const double tau = i * third, u = i <= 3 ? tau / 2 : (tau - 1.1) / 5;
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(samples.displacement()[k], i <= 3 ? 0.5 + u + u * u : 2 * u * u, 8 * ulp) << i;
    EXPECT_NEAR(samples.velocity()[k], i <= 3 ? 4 + u * u * u : 3 * u, 8 * ulp) << i;
  }
  EXPECT_EQ(samples.displacement()[6], 7.0);
  EXPECT_EQ(samples.velocity()[6], 8.0);
}

point::Problem with_tolerance(point::Problem scene, double tolerance) {
  scene.integration.tolerance = tolerance;
  return scene;
}

template <class Integrator>
steady::ObservedTime found_by(Integrator& integrator, const point::Problem& scene) {
  return find_steady(integrator, support::start_of(scene), scene, scene.time, scene.integration);
}

TEST(PolynomialArcs, multipliers_are_those_of_the_closed_form) {
  // check 5, in twelve digits; the motion is as far off as its steps
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    const point::Problem scene = with_tolerance(paper_scene(0.5, 0.7, 1.0), tolerance);
    stepping::DormandPrince<general_effects({.damping = 0.1})> integrator(scene, scene.integration, limits_of(scene));
    Stability::Observer stability(scene.stops, 64 * epsilon<double>());
    observe_by(integrator, found_by(integrator, scene), [&](double total, auto run) {
      run(stability);
      stability.finish_period(total, false);
    });
    EXPECT_NEAR(stability.first().real(), 0.349971948059, tolerance + 1e-12);
    EXPECT_NEAR(stability.second().real(), 0.195257796329, tolerance + 1e-12);
    // R^4 e^{-2 h T} whatever the error, since the derivative between its steps, a few hundred, is that of free motion
    const Complex product = stability.first() * stability.second();
    EXPECT_NEAR(product.real() / (std::pow(0.7, 4) * std::exp(-0.4 * std::numbers::pi)), 1, 256 * ulp);
  }
}

TEST(PolynomialArcs, extrema_and_harmonics_come_as_near_to_the_exact_ones_as_the_motion) {
  const point::Problem scene = paper_scene(0.6, 0.8, 1.3);
  std::optional<ExactHarmonics> expected;
  Extrema::Observer exact;
  observe(scene, [&](double total, auto run) {
    expected.emplace(5, 1.3);
    expected->finish(run(*expected, exact).x, total);
  });
  for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
    stepping::DormandPrince<general_effects({.damping = 0.1})> integrator(scene,
                                                                          with_tolerance(scene, tolerance).integration);
    std::optional<ExactHarmonics> harmonics;
    Extrema::Observer extrema;
    observe_by(integrator, found_by(integrator, scene), [&](double total, auto run) {
      harmonics.emplace(5, 1.3);
      harmonics->finish(run(*harmonics, extrema).x, total);
    });
    for (std::size_t n = 0; n <= 5; ++n) {
      EXPECT_LT(std::abs(harmonics->displacement()[n] - expected->displacement()[n]), 3 * tolerance) << n;
      EXPECT_LT(std::abs(harmonics->velocity()[n] - expected->velocity()[n]),
                3 * tolerance * (1 + 1.3 * static_cast<double>(n)))
          << n;
    }
    EXPECT_NEAR(extrema.velocity().high, exact.velocity().high, 3 * tolerance);
    EXPECT_NEAR(extrema.velocity().low, exact.velocity().low, 3 * tolerance);
    EXPECT_EQ(extrema.displacement(scene.stops).high, exact.displacement(scene.stops).high);  // the stop
  }
}

}  // namespace
}  // namespace clatter::observables::polynomial_arcs_test
