// Motions that 31 digits tell are those that 50 digits tell, to the last bit of a double.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "point/in_digits.hpp"
#include "point/point.hpp"
#include "support/random.hpp"

namespace clatter::point::digits_test {
namespace {

/// A scene between stops that a force presses the mass onto.
Problem pressed_scene(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Problem scene;
  scene.oscillator = {.damping = between(0.02, 0.2), .forcing = between(0.8, 1.6), .frequency = between(0.3, 1.2)};
  scene.oscillator.load = between(-0.4, 0.4);
  scene.stops = {-between(0.05, 0.4), between(0.05, 0.4), between(0.5, 0.85), between(0.5, 0.85)};
  if (between(0, 1) < 0.3) scene.friction = {0.05, 0.07};
  return scene;
}

template <class Number>
void expect_same_sections(const std::vector<motion::State<double>>& one,
                          const std::vector<motion::State<double>>& other, const Number& where) {
  ASSERT_EQ(one.size(), other.size()) << where;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].x, other[i].x) << where;
    EXPECT_EQ(one[i].v, other[i].v) << where;
  }
}

TEST(Digits, MotionFromAReleaseIsTheSameIn31AndIn50) {
  std::mt19937_64 random(66);
  using Kind = RestingMotion::Kind;
  int told = 0, periodic = 0, departing = 0;  // without sections
  for (int i = 0; i < 120; ++i) {
    const Problem scene = pressed_scene(random);
    const RestingMotion few = InDigits<DoubleDouble>::resting_motion(scene, Side::lower);
    if (few.kind == Kind::undecided) continue;
    const RestingMotion many = InDigits<WideFloat>::resting_motion(scene, Side::lower);
    EXPECT_EQ(few.kind, many.kind) << i;
    EXPECT_EQ(few.simulated, many.simulated) << i;
    ++told;
    if (few.kind == Kind::departs && few.sections.empty()) ++departing;
    if (few.kind != Kind::periodic) continue;
    ++periodic;
    expect_same_sections(few.sections, many.sections, i);
  }
  EXPECT_GT(told, 60);
  EXPECT_GT(periodic, 30);
  EXPECT_GT(departing, 0);
}

TEST(Digits, PeriodicMotionIsTheSameIn31AndIn50) {
  std::mt19937_64 random(67);
  ThreadScratch scratch;
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    Problem scene = pressed_scene(random);
    scene.stops = {-1.0, std::numeric_limits<double>::infinity(), 0.7,
                   1.0};  // within reach, and nothing holds the mass
    scene.oscillator.load = 0.0, scene.oscillator.frequency += 0.4, scene.friction = {};
    const PointResult result = run_point(scene, scratch);
    if (result.status != steady::Status::periodic) continue;
    motion::State<double> near;
    near.x = result.end.displacement * (1 + 1e-9), near.v = result.end.velocity;
    scene.start.phase = result.end.phase;
    const auto periods = static_cast<std::int64_t>(result.observed_turns);
    const auto few = InDigits<DoubleDouble>::fixed_point(scene, near, periods);
    const auto many = InDigits<WideFloat>::fixed_point(scene, near, periods);
    if (!few) continue;
    ASSERT_TRUE(many) << i;
    ++found;
    expect_same_sections(few->sections, many->sections, i);
    const auto reference = fixed_point(scene, near, periods);  // in Boost's numbers, without double
    ASSERT_TRUE(reference) << i;
    expect_same_sections(many->sections, reference->sections, i);
  }
  EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace clatter::point::digits_test
