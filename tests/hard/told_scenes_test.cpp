// Random scenes with dry friction, and with a loose mass: the program against the simulator of `machine.hpp`, event by
// event.

#include <gtest/gtest.h>

#include "hard/any_carrying_scene.hpp"
#include "hard/any_force_in_pieces.hpp"
#include "hard/any_force_orders.hpp"
#include "hard/any_law_of_speed.hpp"
#include "hard/any_sliding_scene.hpp"
#include "hard/told_scenes.hpp"

namespace clatter::hard::told_scenes_test {
namespace {

using told_scenes::compare;

TEST(SlidingScenes, are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"sliding", any_sliding_scene, 160});
}
TEST(CarryingScenes, are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"carrying", any_carrying_scene, 60});
}
TEST(SlidingScenes, of_which_the_restitution_depends_on_the_speed_are_told_as_taylor_series_tell_them) {
  compare({"sliding, by speed", by_speed<any_sliding_scene>, 12}, 0.8);
}
TEST(ScenesInPieces, that_slide_are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"sliding, in pieces", in_pieces<any_sliding_scene>, 60});
}
TEST(ScenesInPieces, that_carry_a_loose_mass_are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"carrying, in pieces", in_pieces<any_carrying_scene>, 20});
}
TEST(ScenesOfOrders, that_slide_are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"sliding, of orders", of_orders<any_sliding_scene>, 60});
}
TEST(ScenesOfOrders, that_carry_a_loose_mass_are_told_event_by_event_as_taylor_series_tell_them) {
  compare({"carrying, of orders", of_orders<any_carrying_scene>, 20});
}
TEST(CarryingScenes, of_which_the_restitution_depends_on_the_speed_are_told_as_taylor_series_tell_them) {
  compare({"carrying, by speed", by_speed<any_carrying_scene>, 15}, 0.8);
}

}  // namespace
}  // namespace clatter::hard::told_scenes_test
