// Stops that move: another force in their frame, with a phase of its own.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::shaken_stops_test {
namespace {

TEST(ShakenStops, agrees_with_fifty_digits) { expect_agreement("shaken_stops"); }

}  // namespace
}  // namespace clatter::hard::shaken_stops_test
