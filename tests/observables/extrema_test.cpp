#include "observables/extremes/extrema_observer.hpp"

#include <gtest/gtest.h>

#include "observables/runs.hpp"

namespace clatter::observables::extrema_test {
namespace {

TEST(Extrema, without_impact_they_are_the_amplitude_of_the_forced_response) {
  for (double nu : {0.2, 0.98, 1.0, 1.4, 7.0}) {  // check 3: |x| -> |f|/sqrt(D)
    Extrema::Observer extrema;
    observe(paper_scene(20.0, 0.7, nu), [&](double, auto run) { run(extrema); });
    const double D = std::pow(1 - nu * nu, 2) + std::pow(0.2 * nu, 2), amplitude = 1 / std::sqrt(D);
    const auto x = extrema.displacement({-20, 20, 1, 1}), v = extrema.velocity();
    EXPECT_NEAR(x.high / amplitude, 1.0, 1e-13) << nu;  // settled to 1e-14; D cancels to 25 ulps at nu = 0.98
    EXPECT_NEAR(x.low / amplitude, -1.0, 1e-13) << nu;
    EXPECT_NEAR(v.high / (nu * amplitude), 1.0, 1e-13) << nu;
    EXPECT_NEAR(v.low / (nu * amplitude), -1.0, 1e-13) << nu;
  }
}

/// Extrema of what is sampled densely.
struct Scan {
  Range x{}, v{};
  int hits = 0;

  template <class A>
  void arc(const A& arc, double, double length) {
    for (int i = 0; i <= 400; ++i) {
      const auto m = arc.at(length * i / 400);
      x.include(m.x), v.include(m.v);
    }
  }
  void event(const motion::Event& event) { hits += event.kind == motion::Event::Kind::impact; }
};

TEST(Extrema, are_never_passed_by_a_dense_scan_and_never_far_from_it) {
  int hits = 0;
  for (double nu : {0.37, 0.9, 2.3})
    for (double load : {0.0, 0.4}) {
      point::Problem scene = paper_scene(0.8, 0.6, nu);
      scene.oscillator.load = load;
      scene.stops.upper = std::numeric_limits<double>::infinity();
      scene.time.mode = steady::Mode::transient;
      scene.time.duration = 60.0;
      Extrema::Observer extrema;
      Scan scan;
      observe(scene, [&](double, auto run) { run(extrema, scan); });
      const auto x = extrema.displacement(scene.stops), v = extrema.velocity();
      // a scan of step d misses an extremum by at most |x''| d^2/8, here 4 * (2 pi/0.37/400)^2/8 on the longest arc
      EXPECT_GE(x.high, scan.x.high - 1e-14);
      EXPECT_LE(x.high, scan.x.high + 1e-3);
      EXPECT_GE(v.high, scan.v.high - 1e-14);
      EXPECT_LE(v.high, scan.v.high + 1e-3);
      EXPECT_LE(v.low, scan.v.low + 1e-14);
      EXPECT_GE(v.low, scan.v.low - 1e-3);
      if (scan.hits > 0) {
        EXPECT_EQ(x.low, -0.8);  // a stop that is hit is the extremum, exactly
      }
      hits += scan.hits;
    }
  EXPECT_GT(hits, 20);
}

TEST(Extrema, of_a_long_arc_are_found_among_thousands_of_its_oscillations) {
  // an undamped oscillation on a force so slow that one arc holds thousands of turns: the highest is where both are
  point::Problem scene;
  scene.oscillator = {0.0, 1.0, 1e-4, 0.0};
  scene.start.velocity = 0.5;
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 2 * 3.141592653589793 / 1e-4;
  Extrema::Observer extrema;
  observe(scene, [&](double, auto run) { run(extrema); });
  const double f = 1 / (1 - 1e-8), free = 0.5 - f * 1e-4;  // x = f sin(nu tau) + free sin(tau)
  // within half a turn of the force's peak the two are in step: sin falls short of 1 there by (pi nu)^2/2 at the most
  EXPECT_LE(extrema.displacement(scene.stops).high, f + free);
  EXPECT_GE(extrema.displacement(scene.stops).high, f + free - 5e-8);
  EXPECT_LE(extrema.velocity().high, free + f * 1e-4 + 1e-14);
  EXPECT_GE(extrema.velocity().high, free + f * 1e-4 - 5e-12);  // in step at tau = 0 and whole turns near it
}

TEST(Extrema, of_heavily_damped_and_slow_motion_are_exact) {
  point::Problem scene;
  scene.oscillator = {1e3, 1.0, 1e-3, 0.1};
  scene.time.tolerance = 1e-13;
  Extrema::Observer extrema;
  observe(scene, [&](double, auto run) { run(extrema); });
  const double D = std::pow(1 - 1e-6, 2) + std::pow(2 * 1e3 * 1e-3, 2);
  EXPECT_NEAR(extrema.displacement(scene.stops).low, 0.1 - 1 / std::sqrt(D), 1e-12);
  EXPECT_NEAR(extrema.displacement(scene.stops).high, 0.1 + 1 / std::sqrt(D), 1e-12);
}

}  // namespace
}  // namespace clatter::observables::extrema_test
