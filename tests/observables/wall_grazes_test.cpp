#include "observables/stability/wall_grazes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/loose_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::observables::wall_grazes_test {
namespace {

/// Sees the flights and impacts of a run.
struct Watch : support::LooseRecorder {
  explicit Watch(const WallGrazes& of) : grazes(of) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    grazes.arc(arc, begin, length);
  }
  void event(const motion::Event& event) { LooseRecorder::event(event), grazes.event(event); }

  WallGrazes grazes;
};

/// A loose mass that drifts at a constant velocity v while the main mass swings as cos(tau): it leaves the lower wall
/// at tau = 1, and turns back `clear` above it at sin(tau) = -v, where z'' = cos(tau).
struct Hover {
  static constexpr double begin = 1.0, late = 6.5;

  explicit Hover(double clear) {
    double slow = 0.0, fast = 1.0;
    for (int halving = 0; halving < 60; ++halving) {
      v = (slow + fast) / 2;
      const double turn = 2 * pi<double>() - std::asin(v);
      (v * (turn - begin) - std::cos(turn) + std::cos(begin) < clear ? slow : fast) = v;
    }
  }

  /// The scene, or its mirror image.
  [[nodiscard]] point::Problem scene(double sign) const {
    point::Problem scene = support::loose_scene(0.1, 0, 0, 1, 1, 0.5);
    scene.start.displacement = sign * std::cos(begin), scene.start.velocity = -sign * std::sin(begin);
    scene.loose.velocity = sign * (v + std::sin(begin));
    scene.loose.lower = sign > 0 ? -1 : -50, scene.loose.upper = sign > 0 ? 50 : 1;
    scene.loose.place = -sign;
    return scene;
  }

  double v = 0.0;
};

TEST(WallGrazes, a_turn_within_rounding_of_the_wall_is_one_and_so_is_an_impact_that_turns_back_as_near) {
  constexpr double rounding = 1e-10;
  for (const double sign : {1.0, -1.0})
    for (const double clear : {3.0, 1.5, 0.7, 0.1, -0.1, -0.7, -1.5, -3.0}) {
      const point::Problem scene = Hover(clear * rounding).scene(sign);
      Watch watch(WallGrazes(scene, rounding));
      stepping::Exact<double, effect_sets::with_loose_mass(Damping::light, Forcing::secular)> exact(scene);
      motion::State<double> state = support::start_of(scene);
      ASSERT_EQ(run_for(exact, state, (Hover::late - Hover::begin) / exact.period(), watch),
                stepping::Outcome::completed);
      EXPECT_EQ(watch.strikes.empty(), clear > 0) << clear;
      EXPECT_EQ(watch.grazes.found(), std::abs(clear) < 1) << clear;
    }
}

/// The main mass moves as sin(tau) and meets its stop at tau = 1, the loose one drifts three times as fast and meets
/// its wall `late` of rounding after that, or before. At the first contact the other mass is nearer than rounding or
/// not.
TEST(WallGrazes, contacts_of_both_masses_within_rounding_of_one_instant_are_one) {
  constexpr double rounding = 1e-10, fast = 3;
  const double w = fast - std::cos(1.0);
  for (const double sign : {1.0, -1.0})
    for (const double late : {-20.0, -6.0, -3.0, -0.5, 0.5, 0.9, 1.5, 3.0, 20.0}) {
      point::Problem scene = support::loose_scene(0.1, 0, 0, 1, 50, 0.5);
      scene.start.velocity = sign, scene.loose.velocity = sign * (fast - 1);
      const double stop = std::sin(1.0), wall = fast - stop + late * rounding;
      (sign > 0 ? scene.stops.upper : scene.stops.lower) = sign * stop;
      (sign > 0 ? scene.loose.upper : scene.loose.lower) = sign * wall;
      scene.stops.restitution_lower = scene.stops.restitution_upper = 0.5;
      Watch watch(WallGrazes(scene, rounding));
      stepping::Exact<double, effect_sets::with_everything(Damping::light, Forcing::secular)> exact(scene);
      motion::State<double> state = support::start_of(scene);
      ASSERT_EQ(run_for(exact, state, 1.1 / exact.period(), watch), stepping::Outcome::completed);
      EXPECT_FALSE(watch.strikes.empty());
      const double gap = late > 0 ? late : -late * std::cos(1.0) / w;
      EXPECT_EQ(watch.grazes.found(), gap < 1) << sign << ' ' << late;
    }
}

/// The steady motion on one wall, which another just beyond its highest place doesn't change.
TEST(WallGrazes, a_wall_at_the_turning_point_of_steady_motion_takes_its_multipliers) {
  point::Problem scene = support::loose_scene(0.1, 0.1, 0.35, 0.8, 1, 0.5);
  scene.loose.load = -0.3, scene.loose.upper = std::numeric_limits<double>::infinity();
  const auto free = support::observed(scene);
  ASSERT_EQ(free.status, steady::Status::periodic);
  ASSERT_EQ(free.impact_word, "L");
  const auto below = [&](double ceiling) {
    point::Problem same = scene;
    same.start = free.end;
    same.loose.place = free.end.loose_place, same.loose.velocity = free.end.loose_velocity;
    same.loose.upper = ceiling;
    return support::observed(same);
  };
  for (const double room : {1e-3, 1e-7}) {
    const auto found = below(free.z_max + room);
    EXPECT_EQ(found.status, steady::Status::periodic) << room;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found.multiplier_re[i], free.multiplier_re[i], 1e-9) << room;
  }
  const auto grazing = below(free.z_max + 1e-12);  // the tolerance of a repeat
  EXPECT_EQ(grazing.status, steady::Status::grazing);
  EXPECT_EQ(grazing.impact_word, "L");
  EXPECT_TRUE(std::isnan(grazing.multiplier_re[0]));
}

}  // namespace
}  // namespace clatter::observables::wall_grazes_test
