// How deep motion goes into soft stops.

#include <gtest/gtest.h>

#include <iostream>

#include "hard/any_soft_scene.hpp"
#include "hard/penetration.hpp"
#include "hard/tally.hpp"

namespace clatter::hard::penetration_test {
namespace {

TEST(SoftProperties, no_stop_is_pressed_deeper_than_the_energy_allows) {
  Tally tally("depth in soft stops", between_soft_stops);
  std::uint64_t met = 0, deep = 0;
  in_every_scene(between_soft_stops, [&](const AnyScene& any) {
    Penetration penetration(any.scene);
    (void)watch(any, penetration);
    met += penetration.is_met(), deep += penetration.is_deep();
    tally.take(any, (penetration.over() - 1) / (64 * epsilon<double>()));  // a depth is a sum of some ten terms
  });
  tally.conclude(1);
  std::cout << met << " scenes press soft stops, " << deep << " to half of what is allowed\n";
  const auto [from, to] = tested_scenes(between_soft_stops);
  if (to - from < Tally::enough) return;
  EXPECT_GT(met, (to - from) * 3 / 4);
  EXPECT_GT(deep, (to - from) / 2);
}

}  // namespace
}  // namespace clatter::hard::penetration_test
