// Motion with dry friction at the edges of double precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "hard/as_machine.hpp"
#include "hard/event_match.hpp"
#include "hard/machine.hpp"
#include "point/exact_motion.hpp"

namespace clatter::hard::friction_edges_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// The program's motion of a scene.
struct Told {
  Told(const Scene& scene, double duration) {
    point::Problem problem;
    static_cast<Scene&>(problem) = scene;
    const auto motion = point::ExactMotion::of(problem);
    point::MotionRecorder recorder(motion->stops());
    recorder.keep_events();
    end = motion->start();
    outcome = motion->run_for(end, duration / motion->period(), recorder);
    events = told_events(recorder.events);
  }

  motion::State<double> end{};
  stepping::Outcome outcome{};
  std::vector<ToldEvent> events{};
};

/// Heavy damping and no force: the mass comes ever closer to the edge of the places at which friction holds it, free or
/// inside a soft stop, in which moving down it is balanced at (load + kappa stop + mu)/(k + kappa).
TEST(FrictionEdges, a_mass_that_creeps_comes_to_its_place) {
  const Stops soft{0.5, none, 1, 1, 1, none, 0.1};
  for (const double h : {1.5, 4.0, 7.0, 20.0}) {
    const Scene within{{.damping = h, .load = -2}, soft, {1, 0, 0}, {}, {1e-3, 1e-3}},
        free{{.damping = h}, {-none, none, 1, 1}, {1, 0, 0}, {}, {1e-3, 1e-3}};
    const Told inside(within, 3000), outside(free, 3000);
    EXPECT_EQ(inside.outcome, stepping::Outcome::completed) << h;
    EXPECT_NEAR(inside.end.x, (-2 + 0.5 + 1e-3) / 2, 2e-14) << h;
    EXPECT_EQ(inside.end.v, 0) << h;
    EXPECT_NEAR(outside.end.x, 1e-3, 2e-14) << h;
    EXPECT_EQ(outside.end.v, 0) << h;
  }
}

/// Without spring, damping and kinetic friction the velocity f/nu (cos phase - cos theta) is 0 whenever a period ends.
TEST(FrictionEdges, a_reversal_at_a_section_is_told) {
  const Scene scene{{.forcing = 1.4888849208456318, .frequency = 5.4007878267559333, .stiffness = 0},
                    {-none, none, 1, 1},
                    {-1, 0, 3.0829789492606681},
                    {},
                    {0, 0.0033766245}};
  const double period = period_of(scene.oscillator);
  const Told told(scene, 3.3 * period);
  const auto expected = told_events(run_machine(as_machine(scene), 3.3 * period, 100));
  ASSERT_EQ(told.events.size(), expected.size());
  for (std::size_t i = 0; i < told.events.size(); ++i) {
    EXPECT_EQ(told.events[i].kind, ToldEvent::Kind::reversal);
    EXPECT_NEAR(static_cast<double>(told.events[i].time), static_cast<double>(expected[i].time), 1e-14 * 4);
  }
}

}  // namespace
}  // namespace clatter::hard::friction_edges_test
