// Random scenes with shaken stops or a shaken base, between soft and rigid stops, seen from the ground.

#include <gtest/gtest.h>

#include <iostream>

#include "hard/any_soft_scene.hpp"
#include "hard/ground_check.hpp"
#include "hard/tally.hpp"
#include "sweep/sweep.hpp"

namespace clatter::hard::shaken_test {
namespace {

/// A random scene with shaken stops or a shaken base; every other one has soft stops.
AnyScene any_shaken_scene(std::uint64_t index) {
  AnyScene any = index % 2 == 0 ? any_scene(index / 2) : any_soft_scene(index / 2);
  support::Random random(20251, index);
  const double b = random.sign() * random.logarithmic(0.01, 2) / (1 + any.scene.oscillator.frequency);
  (random.happens(0.5) ? any.scene.shaking.stops : any.scene.shaking.base) = b;
  return any;
}

constexpr Kind shaken{"shaken", any_shaken_scene, 2000};

/// The scene in the frame of what is shaken, in which it is computed.
AnyScene in_frame(AnyScene any) {
  sweep::enter_shaken_frame(any.scene);
  return any;
}

TEST(ShakenProperties, motion_seen_from_the_ground_obeys_the_forces_there) {
  Tally energy("work in the ground's frame", shaken), way("displacement in the ground's frame", shaken),
      speed("velocity in the ground's frame", shaken), pressed("mass at rest on a moving stop is pressed", shaken);
  std::uint64_t stops = 0, arcs = 0, rests = 0;
  in_every_scene(shaken, [&](const AnyScene& any) {
    GroundCheck check(any.scene);
    (void)watch(in_frame(any), check);
    energy.take(any, check.energy), way.take(any, check.displacement), speed.take(any, check.velocity);
    pressed.take(any, check.pressed);
    stops += any.scene.shaking.stops != 0, arcs += check.arcs, rests += check.rests;
  });
  for (const Tally* tally : {&energy, &way, &speed, &pressed}) tally->conclude(1);
  const auto [from, to] = tested_scenes(shaken);
  std::cout << stops << " scenes with shaken stops, " << to - from - stops << " with a shaken base; " << arcs
            << " arcs, " << rests << " rests\n";
  if (to - from < Tally::enough) return;
  EXPECT_GT(stops, (to - from) / 3);
  EXPECT_LT(stops, (to - from) * 2 / 3);
  EXPECT_GT(arcs, 20 * (to - from));
  EXPECT_GT(rests, (to - from) / 2);
}

}  // namespace
}  // namespace clatter::hard::shaken_test
