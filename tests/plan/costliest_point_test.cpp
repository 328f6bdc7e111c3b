// The warning of a single point that may take long since nothing is lost at the stops.

#include "plan/costliest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plan/plans.hpp"
#include "sweep/figures.hpp"

namespace clatter::plan::costliest_point_test {
namespace {

point::Problem transient(const Oscillator& oscillator, double R, double v0) {
  point::Problem scene;
  scene.oscillator = oscillator;
  scene.stops = {-1, 1, R, R};
  scene.start = {0.5, v0, 0.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 1000;
  return scene;
}

bool warns(const point::Problem& scene) { return warning_of_costliest_point(sweep::sweep_of(scene, {})).has_value(); }

/// Without damping it bounces as high as at the start, with it ever lower and more often.
TEST(CostliestPoint, of_a_pressed_mass_without_loss_takes_the_impacts_that_it_has_time_for) {
  point::ThreadScratch scratch;
  for (const double h : {0.0, 0.02, 0.05})
    for (const double duration : {50.0, 100.0, 200.0}) {
      point::Problem scene = transient({h, 0.0, 1.0, 2.0}, 1.0, 0.0);
      scene.time.duration = duration;
      EXPECT_NEAR(impacts_without_loss(scene) / run_point(scene, scratch).impacts, 1, 0.2) << h << ' ' << duration;
    }
  point::Problem ball = transient({0.0, 0.0, 1.0, -9.8}, 1.0, 0.0);
  ball.oscillator.stiffness = 0, ball.stops = {0.0, HUGE_VAL, 1.0, 1.0}, ball.start.displacement = 50;
  ball.time.duration = 50;
  EXPECT_NEAR(impacts_without_loss(ball), 8, 0.5);  // 3.19 s down, 6.39 s from bounce to bounce
  EXPECT_FALSE(warns(ball));
}

TEST(CostliestPoint, of_a_pressed_mass_takes_all_impacts_there_are_at_most) {
  const Oscillator pressed{0.05, 0.3, 1.4, 2.0};
  EXPECT_EQ(impacts_without_loss(transient(pressed, 1.0, 0.0)), 1e8);
  EXPECT_TRUE(warns(transient(pressed, 1.0, 0.0)));
  EXPECT_EQ(impacts_without_loss(transient(pressed, 0.99, 0.0)), 0);
  EXPECT_FALSE(warns(transient(pressed, 0.99, 0.0)));
  point::Problem few = transient(pressed, 1.0, 0.0);
  few.time.max_impacts = 1e4;
  EXPECT_FALSE(warns(few));
}

/// A chatter is summed before it ends, so there are fewer impacts than those in which friction takes all digits.
TEST(CostliestPoint, of_a_pressed_mass_is_not_endless_under_friction) {
  point::ThreadScratch scratch;
  for (const double friction : {0.003, 0.03, 0.3}) {
    point::Problem scene = transient({0.0, 0.0, 1.0, 2.0}, 1.0, 0.0);
    scene.friction = {friction, friction}, scene.time.duration = 10000;
    const double impacts = run_point(scene, scratch).impacts;
    EXPECT_GT(impacts_without_loss(scene), impacts) << friction;
    EXPECT_LT(impacts_without_loss(scene), 10 * impacts) << friction;
  }
  point::Problem fast = transient({0.0, 0.0, 1.0, 0.0}, 1.0, 1e5);
  fast.friction = {500, 500};
  EXPECT_NEAR(impacts_without_loss(fast) / (1e10 / (2 * 500) / 2), 1, 1e-6);
}

TEST(CostliestPoint, of_a_fast_one_costs_its_path_in_distances_between_the_stops) {
  const Oscillator free{0.0, 0.0, 1.0, 0.0}, damped{0.1, 0.0, 1.0, 0.0};
  const point::Problem fast = transient(free, 1.0, 1e5);
  EXPECT_NEAR(impacts_without_loss(fast) / (1e5 * 1000 / 2), 1, 1e-6);
  point::ThreadScratch scratch;
  point::Problem shorter = fast;
  shorter.time.duration = 3;
  EXPECT_NEAR(run_point(shorter, scratch).impacts / impacts_without_loss(shorter), 1, 0.01);
  EXPECT_TRUE(warns(transient(free, 1.0, 1e8)));
  EXPECT_NEAR(impacts_without_loss(transient(damped, 1.0, 1e5)) / (1e5 / 0.1 / 2), 1, 1e-6);
  point::Problem steady = transient(free, 1.0, 1e8);
  steady.time.mode = steady::Mode::steady;
  EXPECT_FALSE(warns(steady)) << "in closed form";
}

/// Damping takes the relative velocity of a loose mass through the share of it that the main mass has. The swing of the
/// main mass adds to that velocity, so the number holds to a factor of 2.
TEST(CostliestPoint, of_a_loose_mass_on_a_wall_without_loss_takes_the_impacts_that_it_has_time_for) {
  point::ThreadScratch scratch;
  for (const double eps : {0.1, 1.0})
    for (const double h : {0.0, 0.1, 0.3})
      for (const double sign : {1.0, -1.0}) {
        point::Problem scene = transient({h, 0.01, 1.3, 0.0}, 1.0, 0.0);
        scene.stops = {}, scene.time.duration = 40;
        scene.loose = {.ratio = eps,
                       .lower = -0.1,
                       .upper = 0.1,
                       .restitution_lower = 1,
                       .restitution_upper = 1,
                       .load = -0.5 * sign};
        (sign > 0 ? scene.loose.upper : scene.loose.lower) = sign * HUGE_VAL;
        EXPECT_NEAR(std::log(impacts_without_loss(scene) / run_point(scene, scratch).impacts), 0, std::log(2.0))
            << eps << ' ' << h;
        EXPECT_FALSE(warns(scene));
        if (h * eps < 0.1) continue;
        scene.time.duration = 1000;
        EXPECT_TRUE(warns(scene)) << eps << ' ' << h;
        const std::string warning = *warning_of_costliest_point(sweep::sweep_of(scene, {}));
        EXPECT_NE(warning.find("with loose_R = 1 nothing ends its bouncing"), std::string::npos) << warning;
        scene.loose.restitution_lower = scene.loose.restitution_upper = 0.99;
        EXPECT_FALSE(warns(scene));
        scene.loose.restitution_lower = scene.loose.restitution_upper = 1,
        scene.oscillator.forcing = 3;  // which throws it off
        EXPECT_FALSE(warns(scene));
      }
}

TEST(CostliestPoint, of_a_sweep_is_named_in_its_plan) {
  const sweep::Sweep sweep =
      sweep::sweep_of(transient({0.05, 0.3, 1.4, 2.0}, 0.5, 0.0), {{Parameter("R"), {0.5, 0.9, 1.0}}});
  const Plan plan = plan_of(sweep, 1);
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_NE(plan.warnings[0].find("point 2 alone may take 1e+08 impacts"), std::string::npos) << plan.warnings[0];
}

/// A slip in the mass, 1e-308 kg, makes a second of so many periods that no run ends.
TEST(CostliestPoint, of_a_transient_is_the_one_of_the_most_periods) {
  sweep::Sweep sweep = sweep::sweep_of(transient({0.1, 0.3, 1.4, 0.0}, 0.7, 0.0), {{Parameter("mass"), {1, 1e-308}}});
  sweep.problem.is_si = true;
  sweep.problem.oscillator = {.forcing = 40, .frequency = 25, .stiffness = 800};
  sweep.problem.time.duration = 1;
  sweep.problem.stops = {-0.01, 0.01, 0.7, 0.7}, sweep.problem.start = {};
  const auto warning = warning_of_costliest_point(sweep);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->find("point 1 alone may take "), std::string::npos) << *warning;
  EXPECT_NE(warning->find("look for a slip in mass, stiffness or frequency"), std::string::npos) << *warning;
  sweep.dimensions[0][0].values = {1, 2};
  EXPECT_FALSE(warning_of_costliest_point(sweep));
}

TEST(Progress, moves_within_a_point) {
  for (const lanes::InstructionSet arch : {lanes::InstructionSet::scalar, lanes::widest_instruction_set()}) {
    point::Problem scene = transient({0.0, 0.3, 1.4, 0.0}, 1.0, 1e5);
    scene.time.duration = 60, scene.time.max_impacts = 1e8;
    std::vector<double> shares;
    (void)sweep::run(
        sweep::sweep_of(scene, {}),
        {.threads = 1, .progress = [&](double done, std::size_t) { shares.push_back(done); }, .arch = arch});
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.back(), 1.0);
    EXPECT_LT(shares.front(), 1.0) << name_of(arch);
  }
}

TEST(BlockState, spend_no_more_than_their_budget_within_a_forcing_period) {
  point::Problem scene = transient({0.0, 0.3, 1.4, 0.0}, 1.0, 1e8);  // 2e8 impacts in a forcing period
  scene.time.max_impacts = 2e5;
  scene.observe.extrema = true;
  for (const lanes::InstructionSet arch :
       {lanes::InstructionSet::scalar, lanes::InstructionSet::sse2, lanes::widest_instruction_set()}) {
    const results::Dataset figure = sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = arch}).dataset;
    EXPECT_EQ(statuses(figure)[0], static_cast<std::uint8_t>(steady::Status::event_budget));
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(find(figure, "impact_total")->values)[0], 200001);
  }
}

}  // namespace
}  // namespace clatter::plan::costliest_point_test
