// Without a spring: gravity or walls alone bring the mass back; a spring so weak that it hardly differs.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::no_spring_test {
namespace {

TEST(NoSpring, agrees_with_fifty_digits) { expect_agreement("no_spring"); }

}  // namespace
}  // namespace clatter::hard::no_spring_test
