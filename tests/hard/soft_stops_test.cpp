// Soft stops from nearly none to nearly rigid, undamped to overdamped, hardly touched and never left.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::soft_stops_test {
namespace {

TEST(SoftStops, agrees_with_fifty_digits) { expect_agreement("soft_stops"); }

}  // namespace
}  // namespace clatter::hard::soft_stops_test
