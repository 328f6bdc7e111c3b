// Extrema in the absolute frame, against scans that know only relative motion and the definition of the shaking.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "math/fifty_digits.hpp"
#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"
#include "stepping/run.hpp"
#include "sweep/shaken_scenes.hpp"

namespace clatter::sweep::absolute_extrema_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The highest value of a function of time over several times, each given at equal distances; near the highest of these
/// it is searched by golden sections.
class Highest {
 public:
  static constexpr int steps = 64;
  using Values = std::array<double, steps + 1>;

  template <class Function>
  void search(double length, const Values& y, const Function& value) {
    highest = std::max(highest, *std::ranges::max_element(y));
    for (std::size_t i = 0; i <= steps; ++i) {
      const std::size_t left = i - (i > 0 ? 1 : 0), right = i + (i < steps ? 1 : 0);
      const std::size_t middle = std::clamp<std::size_t>(i, 1, steps - 1);
      const double bend = 2 * y[middle] - y[middle - 1] - y[middle + 1];
      if (y[i] >= y[left] && y[i] >= y[right] && y[i] + bend > highest)
        refine(length * static_cast<double>(left) / steps, length * static_cast<double>(right) / steps, value);
    }
  }
  double highest = -infinity;

 private:
  template <class Function>
  void refine(double low, double high, const Function& value) {
    for (int i = 0; i < 30; ++i) {  // to 1e-6 of the bracket: the value's error is of the order of the square
      const double part = 0.381966011250105 * (high - low), left = value(low + part), right = value(high - part);
      highest = std::max({highest, left, right});
      left > right ? high -= part : low += part;
    }
  }
};

/// Displacement and velocity on the ground, from relative motion and the definition of the shaking alone.
template <class Number>
class GroundScan {
 public:
  GroundScan(const point::Problem& problem)
      : b_(problem.shaking.stops + problem.shaking.base),
        nu_(problem.oscillator.frequency),
        theta_(problem.start.phase - problem.shaking.lead) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    scan(begin, length, [&](double s) {
      const auto m = arc.at(Number(s));
      return PhasePoint{static_cast<double>(m.x), static_cast<double>(m.v)};
    });
  }
  void event(const motion::Event& event) {
    if (event.lasts()) scan(event.time, event.length, [&](double) { return PhasePoint{event.place, 0.0}; });
    rests += event.lasts() ? 1 : 0;
    if (event.kind != motion::Event::Kind::impact) return;
    impacts += event.time > 0 ? 1 : 0;
    const double velocity = event.after + b_ * nu_ * std::cos(nu_ * event.time + theta_);
    v.highest = std::max(v.highest, velocity), minus_v.highest = std::max(minus_v.highest, -velocity);
  }

  [[nodiscard]] double amplitude() const { return std::abs(b_); }  ///< of what is shaken
  [[nodiscard]] double speed() const { return std::abs(b_ * nu_); }

  Highest x, minus_x, v, minus_v;
  int impacts = 0, rests = 0;

 private:
  template <class Relative>
  void scan(double begin, double length, const Relative& relative) {
    if (!(length > 0)) return;
    const auto on_ground = [&](double s) {
      const PhasePoint m = relative(s);
      const double theta = nu_ * (begin + s) + theta_;
      return PhasePoint{m.x + b_ * std::sin(theta), m.v + b_ * nu_ * std::cos(theta)};
    };
    Highest::Values xs, minus_xs, vs, minus_vs;
    for (std::size_t i = 0; i < xs.size(); ++i) {
      const auto [at_x, at_v] = on_ground(length * static_cast<double>(i) / Highest::steps);
      xs[i] = at_x, minus_xs[i] = -at_x, vs[i] = at_v, minus_vs[i] = -at_v;
    }
    x.search(length, xs, [&](double s) { return on_ground(s).x; });
    minus_x.search(length, minus_xs, [&](double s) { return -on_ground(s).x; });
    v.search(length, vs, [&](double s) { return on_ground(s).v; });
    minus_v.search(length, minus_vs, [&](double s) { return -on_ground(s).v; });
  }
  double b_, nu_, theta_;
};

/// Scans a transient in a number type.
template <class Number, Effects E>
GroundScan<Number> scan(const point::Problem& problem) {
  stepping::Exact<Number, E> integrator(problem, limits_of(problem));
  motion::State<Number> state;
  state.x = problem.start.displacement, state.v = problem.start.velocity;
  GroundScan<Number> scan(problem);
  const Number turns = Number(problem.time.duration) / integrator.period();
  EXPECT_EQ(run_for(integrator, state, turns, scan), stepping::Outcome::completed);
  return scan;
}

/// To a tolerance relative to the size of the motion and of what is shaken, which may cancel.
template <class Number>
void expect_extrema(const point::PointResult& result, const GroundScan<Number>& scan, double tolerance) {
  const double x = tolerance * (std::max(scan.x.highest, scan.minus_x.highest) + scan.amplitude()),
               v = tolerance * (std::max(scan.v.highest, scan.minus_v.highest) + scan.speed());
  EXPECT_NEAR(result.x_max, scan.x.highest, x);
  EXPECT_NEAR(-result.x_min, scan.minus_x.highest, x);
  EXPECT_NEAR(result.v_max, scan.v.highest, v);
  EXPECT_NEAR(-result.v_min, scan.minus_v.highest, v);
}

TEST(AbsoluteExtrema, has_the_extrema_of_a_dense_scan_in_fifty_digits) {
  int impacts = 0;
  for (std::uint64_t index = 0; index < 12; ++index) {
    SCOPED_TRACE(index);
    point::Problem scene = any_shaken(index);
    scene.observe.extrema = true;
    const point::PointResult result = run(scene, Frame::absolute);
    const auto found =
        scan<FiftyDigits, effect_sets::complete(Damping::light, Forcing::secular)>(problem_at({.problem = scene}, 0));
    // an impact magnifies rounding; the slowest of these by some 1e3
    expect_extrema(result, found, 1e-12);
    impacts += found.impacts;
  }
  EXPECT_GT(impacts, 100);
}

TEST(AbsoluteExtrema, of_many_scenes_are_those_of_their_arcs) {
  for (std::uint64_t index = 0; index < 1500; ++index) {
    SCOPED_TRACE(index);
    point::Problem scene = any_shaken(index);
    scene.observe.extrema = true;
    const point::Problem problem = problem_at({.problem = scene}, 0);
    const auto found = with_any_stops(problem.oscillator, [&]<Effects E>() { return scan<double, E>(problem); });
    expect_extrema(run(scene, Frame::absolute), found, 1e-13);  // the same arcs: sums of some hundred ulps
  }
}

TEST(AbsoluteExtrema, have_the_velocity_with_which_a_rest_begins) {
  int rests = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    SCOPED_TRACE(index);
    point::Problem scene = any_shaken(index);
    (index % 4 < 2 ? scene.stops.restitution_lower : scene.stops.restitution_upper) = 0.0;
    scene.observe.extrema = true;
    const point::Problem problem = problem_at({.problem = scene}, 0);
    const auto found = with_any_stops(problem.oscillator, [&]<Effects E>() { return scan<double, E>(problem); });
    expect_extrema(run(scene, Frame::absolute), found, 1e-13);  // the same arcs: sums of some hundred ulps
    rests += found.rests;
  }
  EXPECT_GT(rests, 100);
}

TEST(AbsoluteExtrema, has_the_extrema_of_a_dense_scan_whatever_the_spring_the_damper_and_the_force) {
  const Stops walls{-0.4, 0.6, 0.7, 0.5};
  const Oscillator oscillators[] = {{.damping = 0.1, .frequency = 1.3, .stiffness = 0},
                                    {.damping = 0.1, .frequency = 1.3, .stiffness = -0.5},
                                    {.damping = 0.2, .forcing = 1, .frequency = 1.7, .stiffness = 3},
                                    {.damping = 2, .forcing = 1, .frequency = 0.6},
                                    {.damping = 0.01, .forcing = 1, .frequency = 1.001, .load = 0.3},
                                    {.damping = 0.1, .forcing = 3, .frequency = 40}};
  for (const Oscillator& oscillator : oscillators)
    for (const Shaking& shaking : {Shaking{.stops = 0.3}, Shaking{.base = 0.3}}) {
      SCOPED_TRACE(oscillator.frequency);
      point::Problem scene = shaken(oscillator, shaking, walls);
      scene.start.velocity = 0.3, scene.start.phase = 1.1;
      scene.time.mode = steady::Mode::transient, scene.time.duration = 17;
      scene.observe.extrema = true;
      const point::Problem problem = problem_at({.problem = scene}, 0);
      const auto found = with_any_stops(problem.oscillator, [&]<Effects E>() { return scan<double, E>(problem); });
      expect_extrema(run(scene, Frame::absolute), found, 1e-12);  // in computed units, both
    }
}

TEST(AbsoluteExtrema, has_the_extrema_of_free_motion_too) {
  // f = 0, nu^2 = k, h = 0: moving stops leave no force on the mass in their frame
  point::Problem scene = shaken({.load = 0.2}, {.stops = 0.3}, {-0.5, 1, 1, 1});
  scene.start = {0.1, 0.8, 2.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
  scene.observe.extrema = true;
  const point::Problem problem = problem_at({.problem = scene}, 0);
  ASSERT_EQ(problem.oscillator.forcing, 0.0);
  const auto found = scan<double, effect_sets::complete(Damping::none, Forcing::none)>(problem);
  EXPECT_GT(found.impacts, 4);
  expect_extrema(run(scene, Frame::absolute), found, 1e-13);
}

TEST(AbsoluteExtrema, has_the_extrema_of_general_methods_to_their_error) {
  for (const auto& [method, step, tolerance] :
       {std::tuple{stepping::Method::dopri5, 1e-3, 1e-8}, std::tuple{stepping::Method::moreau, 1e-5, 1e-3}}) {
    point::Problem scene =
        shaken({.damping = 0.1, .forcing = 0.4, .frequency = 1.3}, {.stops = 0.3}, {-0.5, 1, 0.5, 0.5});
    scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
    scene.observe.extrema = true;
    const point::PointResult exact = run(scene, Frame::absolute);
    scene.integration.method = method, scene.integration.step = step, scene.integration.tolerance = 1e-11;
    const point::PointResult result = run(scene, Frame::absolute);
    EXPECT_NEAR(result.x_max, exact.x_max, tolerance);
    EXPECT_NEAR(result.x_min, exact.x_min, tolerance);
    EXPECT_NEAR(result.v_max, exact.v_max, tolerance);
    EXPECT_NEAR(result.v_min, exact.v_min, tolerance);
  }
}

}  // namespace
}  // namespace clatter::sweep::absolute_extrema_test
