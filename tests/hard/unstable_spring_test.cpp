// A spring that pushes away: differences grow, and a mass left on top departs by the rounding of its place.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::unstable_spring_test {
namespace {

TEST(UnstableSpring, agrees_with_fifty_digits) { expect_agreement("unstable_spring"); }

}  // namespace
}  // namespace clatter::hard::unstable_spring_test
