#include "math/number.hpp"

#include <gtest/gtest.h>

#include "math/fifty_digits.hpp"

namespace clatter::number_test {
inline namespace math {
namespace {

TEST(Number, quarter_turns_are_exact) {
  const double sines[] = {0, 1, 0, -1}, cosines[] = {1, 0, -1, 0};
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const auto phase = sine_cosine_of_turns(quarter / 4.0);
    EXPECT_EQ(phase.sine, sines[(quarter + 8) % 4]);
    EXPECT_EQ(phase.cosine, cosines[(quarter + 8) % 4]);
  }
}

TEST(Number, phase_of_whole_turns_is_the_same_to_the_last_bit) {
  for (double turns = 0.0; turns < 1.0; turns += 1.0 / 256) {  // sums with whole turns are exact
    const auto here = sine_cosine_of_turns(turns), later = sine_cosine_of_turns(turns + 1024);
    EXPECT_EQ(here.sine, later.sine);
    EXPECT_EQ(here.cosine, later.cosine);
  }
}

TEST(Number, sine_and_cosine_agree_with_fifty_digits) {
  for (double turns = -1.0; turns < 2.0; turns += 0.00317) {
    const auto rounded = sine_cosine_of_turns(turns);
    const auto exact = sine_cosine_of_turns(FiftyDigits(turns));
    // 2 pi times the reduced turn is rounded twice before the sine, which is within an ulp itself: 3 half-ulps of pi/4
    // at the most
    EXPECT_NEAR(rounded.sine, static_cast<double>(exact.sine), 2e-16);
    EXPECT_NEAR(rounded.cosine, static_cast<double>(exact.cosine), 2e-16);
  }
}

}  // namespace
}  // namespace math
}  // namespace clatter::number_test
