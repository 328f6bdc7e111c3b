#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motion/rough_neighbourhood.hpp"
#include "motion/watched_run.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::motion::neighbourhood_units_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon(), none = std::numeric_limits<double>::infinity();
constexpr Effects effects = effect_sets::with_friction(Damping::light, Forcing::secular);

/// A random scene with friction or without, between stops of which some are soft, and its start.
struct Case {
  point::Problem scene;
  State<double> from;
};

Case any_case(std::uint64_t i) {
  support::Random random(71, i);
  const double g = random.logarithmic(0.2, 3), nu = random.logarithmic(0.3, 3), h = random.logarithmic(1e-4, 0.8);
  Case any;
  any.scene = support::scene_of({h, 1.0, nu, random.uniform(-0.2, 0.2)}, -g, g * random.uniform(0.5, 2), 0);
  const double kinetic = random.happens(0.3) ? 0 : random.logarithmic(1e-4, 0.6);
  any.scene.friction = {kinetic, random.happens(0.5) ? kinetic : kinetic * 1.5};
  Stops& stops = any.scene.stops;
  stops.restitution_lower = random.uniform(0.2, 1), stops.restitution_upper = random.uniform(0.2, 1);
  if (random.happens(0.4))
    stops.stiffness_lower = random.logarithmic(1.2, 1e4), stops.damping_lower = random.uniform(0, 1);
  if (random.happens(0.2)) stops.upper = none;
  any.from = at(random.uniform(-0.9 * g, 0.4 * g), random.uniform(-2, 2));
  return any;
}

/// The same in units of time that are shorter by so much.
Case in_time(Case any, double faster) {
  const double square = faster * faster;
  auto& [h, f, nu, load, k, shape, paces] = any.scene.oscillator;
  h /= faster, nu /= faster, f /= square, load /= square, k /= square;
  any.scene.friction.kinetic /= square, any.scene.friction.static_level /= square;
  any.scene.stops.stiffness_lower /= square, any.scene.stops.stiffness_upper /= square;
  any.from.v /= faster;
  return any;
}

RoughNeighbourhood neighbourhood_of(const Case& any, double size, double rate) {
  stepping::Exact<double, effects> integrator(any.scene);
  RoughNeighbourhood neighbourhood(any.scene.stops, Ellipse::disc(size), 64 * ulp, any.scene.friction.static_level,
                                   rate);
  State<double> state = any.from;
  EXPECT_EQ(run_for(integrator, state, 1.7, neighbourhood), stepping::Outcome::completed);
  return neighbourhood;
}

/// Powers of two change no digit of a scene, but where a search begins may differ, and with it the last digits.
TEST(NeighbourhoodUnits, a_proof_is_the_same_in_all_units_of_time) {
  int proved = 0, refused = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case any = any_case(i);
    const double size = support::Random(72, i).logarithmic(1e-9, 1e-1);
    const RoughNeighbourhood proof = neighbourhood_of(any, size, 1);
    ++(proof.holds() ? proved : refused);
    for (const double faster : {0x1p-12, 0x1p9}) {
      const RoughNeighbourhood same = neighbourhood_of(in_time(any, faster), size, 1 / faster);
      ASSERT_EQ(same.holds(), proof.holds()) << i << " " << faster;
      if (!proof.holds()) continue;
      EXPECT_NEAR(same.first_order().x(), proof.first_order().x(), 1e-9 * size) << i << " " << faster;
      EXPECT_NEAR(same.first_order().v(), proof.first_order().v(), 1e-9 * size) << i << " " << faster;
      EXPECT_NEAR(same.remainder().x(), proof.remainder().x(), 1e-6 * proof.remainder().x()) << i << " " << faster;
      EXPECT_NEAR(same.remainder().v(), proof.remainder().v(), 1e-6 * proof.remainder().v()) << i << " " << faster;
    }
  }
  EXPECT_GT(proved, 200);
  EXPECT_GT(refused, 200);
}

/// Tells an observer of a motion as of one that comes later, so that its clock has fewer digits.
class Later {
 public:
  Later(RoughNeighbourhood& seen, double by) : seen_(seen), by_(by) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    seen_.arc(arc, begin + by_, length);
  }
  void event(Event event) {
    event.time += by_;
    seen_.event(event);
  }

 private:
  RoughNeighbourhood& seen_;
  double by_;
};

/// Differences of rounding are passed at an impact in a time as short as an ulp of the clock after some periods.
TEST(NeighbourhoodUnits, a_proof_around_rounding_holds_however_late_the_motion_is) {
  int proved = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case any = any_case(i);
    const auto holds = [&](double later_by) {
      stepping::Exact<double, effects> integrator(any.scene);
      RoughNeighbourhood neighbourhood(any.scene.stops, Ellipse::disc(4 * ulp), 4 * ulp,
                                       any.scene.friction.static_level, 1);
      Later later(neighbourhood, later_by);
      State<double> state = any.from;
      EXPECT_EQ(run_for(integrator, state, 1.7, later), stepping::Outcome::completed);
      return neighbourhood.holds();
    };
    if (!holds(0)) continue;
    ++proved;
    for (const double later_by : {50.0, 300.0, 3000.0}) EXPECT_TRUE(holds(later_by)) << i << " " << later_by;
  }
  EXPECT_GT(proved, 300);
}

/// The norm of the propagator, a matrix of (Omega x, v).
double norm_of(const Propagator<double>& p, double k, double weight) {
  const double b = weight * p.b, c = -k * p.b / weight;
  return norm((p.a + p.c) / 2, (c - b) / 2) + norm((p.a - p.c) / 2, (b + c) / 2);
}

TEST(NeighbourhoodUnits, differences_grow_by_no_more_than_their_bound_and_without_a_spring_as_the_time) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    support::Random random(73, i);
    const double h = random.happens(0.3) ? 0 : random.logarithmic(1e-4, 30), t = random.logarithmic(1e-3, 100);
    const double k = random.happens(0.3)   ? 0
                     : random.happens(0.8) ? random.logarithmic(1e-6, 1e3)
                                           : -random.uniform(0, 1);
    const auto constants =
        ArcConstants<double, effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular).arc()>::of(h, 1.0, 1.3,
                                                                                                        0.0, k);
    const Field field = Field::of(constants, 1);
    const auto rotating =
        ArcConstants<double, effect_sets::of_any_stiffness(Damping::light, Forcing::regular).arc()>::of(h, 1.0, 1.3,
                                                                                                        0.0, k);
    const double size = h * h < k ? norm_of(rotating.propagator(t), k, 1) : norm_of(constants.propagator(t), k, 1);
    EXPECT_LE(size, field.growth(t) * (1 + 1e-12)) << i << " h = " << h << ", k = " << k << ", t = " << t;
    if (k == 0) {
      EXPECT_NEAR(field.growth(t), std::exp(std::asinh(t / 2)), 1e-12 * (1 + t)) << i;
    }
  }
}

}  // namespace
}  // namespace clatter::motion::neighbourhood_units_test
