// A loose mass by time stepping: impulses on both momenta at the ends of steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stepping/moreau.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::stepping::moreau_loose_mass_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;
using support::loose_scene;

point::Problem with_steps(point::Problem scene, double steps, double theta = 0.5) {
  scene.integration.method = Method::moreau, scene.integration.step = 1 / steps, scene.integration.theta = theta;
  return scene;
}
RunRecord run_of(const point::Problem& scene, double steps, double duration, double theta = 0.5) {
  return support::record_by<Moreau>(with_steps(scene, steps, theta), duration);
}

TEST(MoreauLooseMass, an_impact_damper_settles_on_the_closed_form_to_the_step) {
  std::vector<double> steps, errors;
  for (const double count : {1000.0, 3000.0, 10000.0, 30000.0}) {
    const RunRecord record = run_of(support::impact_damper(), count, 300 * 2 * pi<double>());
    ASSERT_GT(record.events.size(), 500u);
    double error = 0;
    for (std::size_t i = record.events.size() - 20; i < record.events.size(); ++i)
      error = std::max(error, std::abs(record.events[i].speed() - support::impact_damper_speed));
    steps.push_back(1 / count), errors.push_back(error);
  }
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_GT(support::order_of(steps, errors), 0.7);  // the place of an impact within its step is chance
}

TEST(MoreauLooseMass, has_the_impacts_of_the_exact_motion_at_fine_steps) {
  for (const auto& [name, scene] : support::every_loose_kind()) {
    const auto impacts = [](const RunRecord& record) {
      std::vector<Event> found;
      for (const Event& event : record.events)
        if (event.kind == Event::Kind::impact && event.speed() > 0.02) found.push_back(event);
      return found;
    };
    const auto exact = impacts(accuracy::record_of(scene, 12)), found = impacts(run_of(scene, 1e5, 12));
    ASSERT_EQ(found.size(), exact.size()) << name;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_EQ(found[i].side, exact[i].side) << name;
      EXPECT_NEAR(found[i].time, exact[i].time, 0.01) << name;
      EXPECT_NEAR(found[i].before, exact[i].before, 0.01) << name;
    }
  }
}

/// Newton's law holds for z', and without a force the impulse of a step is shared as eq. 70 has it.
TEST(MoreauLooseMass, impacts_keep_the_momentum) {
  const double eps = 0.4, R = 0.7;
  point::Problem scene = loose_scene(eps, 0, 1e-14, 1, 0.2, R);  // a step is one of the force
  scene.oscillator.stiffness = 1e-12, scene.start.velocity = 0.3, scene.loose.velocity = 0.5;
  support::LooseRecorder record;
  const RunRecord run = support::run_by<Moreau>(with_steps(scene, 1000), 40, record);
  ASSERT_GT(record.strikes.size(), 5u);
  for (const motion::Event& strike : record.strikes) {
    EXPECT_NEAR(strike.main.after - strike.main.before, eps * (1 + R) / (1 + eps) * strike.before, 1e-10);
    if (strike.after == 0) continue;  // its wall presses it
    EXPECT_NEAR(strike.after, -R * strike.before, 1e-15);
  }
  EXPECT_NEAR(run.v + eps * (run.v + run.w), 0.3 + eps * 0.8, 1e-9);
}

TEST(MoreauLooseMass, is_pressed_and_let_go_to_the_step) {
  const point::Problem scene = support::pressed_scene();
  const auto exact = support::rests_of(accuracy::record_of(scene, 60), 0.05);
  ASSERT_GT(exact.size(), 3u);
  for (const double theta : {0.5, 1.0}) {
    const auto found = support::rests_of(run_of(scene, 1e5, 60, theta), 0.05);
    ASSERT_EQ(found.size(), exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_EQ(found[i].side, exact[i].side);
      EXPECT_NEAR(found[i].end(), exact[i].end(), 0.01);
    }
  }
}

TEST(MoreauLooseMass, one_that_stands_stays_exactly_there) {
  point::Problem scene = loose_scene(0.1, 0.05, 0.1, 2, 1, 0.5);
  scene.start.displacement = 0.1, scene.loose.place = 0.2;
  const RunRecord run = run_of(scene, 1000, 40);
  EXPECT_TRUE(run.events.empty());
  EXPECT_NEAR(run.x + run.z, 0.1 + 0.2, 1e-16 * 4);
}

TEST(MoreauLooseMass, more_impacts_than_allowed_is_an_outcome) {
  point::Problem scene = loose_scene(0.4, 0, 0, 1, 0.05, 1);
  scene.loose.velocity = 1, scene.time.max_impacts = 10;
  EXPECT_EQ(run_of(scene, 1000, 100).outcome, Outcome::event_budget);
}

}  // namespace
}  // namespace clatter::stepping::moreau_loose_mass_test
