// The simulator of `machine.hpp` against closed forms of a ball on a floor whose restitution depends on the speed.

#include <cmath>
#include <functional>

#include "hard/machine.hpp"
#include "hard/machine_checks.hpp"

namespace clatter::hard::machine_law_test {
namespace {

using namespace machine_checks;

/// On a floor, pressed by 2, thrown up with a speed of 1.
MachineScene on_floor(double R, const Law& law) {
  return {.stiffness = 0, .load = -2, .lower = 0, .restitution_lower = R, .law_lower = law, .v = 1};
}
/// Impacts with the speeds v, R(v) v, ... after flights of 2 v/g; at most so many.
void expect_speeds(const MachineRun& run, std::size_t impacts, const std::function<Real(Real)>& R) {
  const auto found = those(run, Told::impact, Side::lower);
  ASSERT_GE(found.size(), impacts);
  Real v = 1, time = 1;
  for (std::size_t i = 0; i < impacts; ++i) {
    expect_near(-found[i].velocity / v, 1), expect_near(found[i].time, time);
    v *= R(v), time += v;
  }
}

TEST(Machine, rebounds_by_a_power_of_the_speed_but_no_less_than_leaves_faster_impacts_faster) {
  const Law law{.exponent = 0.5, .reference = 4};
  const auto R = [](Real v) { return std::max(1 - 0.25L * std::sqrt(v / 4), 1 / 3.0L); };
  expect_speeds(run_of(on_floor(0.75, law), 5), 5, R);
  const Law strong{.exponent = 0.5, .reference = 0.25};  // 1 - C v^p = 1/3 at v = 4/9
  expect_speeds(run_of(on_floor(0.5, strong), 5), 8,
                [](Real v) { return std::max(1 - 0.5L * std::sqrt(v / 0.25L), 1 / 3.0L); });
}

TEST(Machine, rebounds_by_straight_lines_between_knots) {
  const Law law{.knots = {{0.25, 0.5}, {0.5, 0.75}, {1.5, 0.5}}};
  const auto R = [](Real v) { return v < 0.25L ? 0.5L : v < 0.5L ? v + 0.25L : 0.75L - (v - 0.5L) / 4; };
  expect_speeds(run_of(on_floor(1, law), 5), 30, R);
  Law other = law;
  other.unit = 0.5;
  expect_speeds(run_of(on_floor(1, other), 5), 30, [&](Real v) { return v < 0.75L ? R(2 * v) : 0.5L; });
}

TEST(Machine, rests_after_an_impact_slower_than_those_that_rebound) {
  const double below = 0.25;  // 1, 1/2, 1/4 aren't below
  for (const Law& law : {Law{.below = below}, Law{.below = below, .knots = {{0, 0.5}}}}) {
    const MachineRun run = run_of(on_floor(0.5, law), 5);
    expect_speeds(run, 4, [](Real) { return 0.5L; });
    ASSERT_EQ(those(run, Told::impact, Side::lower).size(), 4u);
    const auto rests = those(run, Told::rest, Side::lower);
    ASSERT_EQ(rests.size(), 1u);
    EXPECT_EQ(rests[0].time, 1 + 0.5L + 0.25L + 0.125L);
    EXPECT_EQ(run.x, 0);
  }
}

/// A wall throws back by the speed of the loose mass as the main one sees it.
TEST(Machine, throws_a_loose_mass_back_by_its_speed_in_the_housing) {
  const Law law{.below = 0.25, .knots = {{0, 0.75}, {1, 0.5}}};
  const MachineScene scene{.stiffness = 0,
                           .loose_mass = 0.25,
                           .wall_lower = -0.5,
                           .wall_upper = 0.5,
                           .wall_law_lower = law,
                           .wall_law_upper = law,
                           .v = 3,
                           .w = 1};
  const MachineRun run = run_of(scene, 20);
  Real w = 1, time = 0.5L;
  int side = 1;
  for (const MachineEvent& event : run.events) {
    if (event.kind != MachineEvent::Kind::wall_impact) continue;
    EXPECT_EQ(event.side, side);
    expect_near(event.before, side * w), expect_near(event.time, time);
    w *= w < 0.25L ? 0 : 0.75L - w / 4, side = -side, time += 1 / w;
  }
  EXPECT_EQ(w, 0);
  EXPECT_EQ(run.w, 0);
}

}  // namespace
}  // namespace clatter::hard::machine_law_test
