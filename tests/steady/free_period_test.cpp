#include "steady/free_period.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/fifty_digits.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::steady::free_period_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity(), ulp = std::numeric_limits<double>::epsilon();
constexpr double pi_ = std::numbers::pi;

/// Conservative motion: x'' + x = load between stops of R = 1, from (x, v).
struct Free {
  double load;
  Stops stops;
  double x, v;

  [[nodiscard]] double period() const { return free_period<double>(load, stops, x, v); }
  [[nodiscard]] FiftyDigits reference() const { return free_period<FiftyDigits>(load, stops, x, v); }
};

/// The change of the period by an ulp of each input, which no computation in double can avoid. Between stops that are
/// close or beyond the load, and in grazes, it is far more than an ulp. A start on a stop stays there.
double conditioning(const Free& free) {
  const FiftyDigits period = free.reference();
  double sum = static_cast<double>(period) * ulp;
  for (int i = 0; i < 5; ++i) {
    double worst = 0;
    for (const double by : {1 + ulp, 1 - ulp}) {
      Free moved = free;
      double* const inputs[] = {&moved.load, &moved.stops.lower, &moved.stops.upper, &moved.x, &moved.v};
      *inputs[i] *= by;
      if (free.x == free.stops.lower) moved.x = moved.stops.lower;
      worst = std::max(worst, static_cast<double>(FiftyDigits(abs(moved.reference() - period))));
    }
    sum += worst;
  }
  return sum;
}

/// A random motion: stops around the load or beyond it, close or far, hit hard or softly, or none.
Free any_free(std::uint64_t i) {
  support::Random random(31, i);
  const double kind = random.uniform(0, 1), near = random.logarithmic(1e-9, 10), width = random.logarithmic(1e-9, 10);
  const double load = random.happens(0.5) ? 0 : random.sign() * random.logarithmic(1e-3, 1e3);
  Stops stops{load - near, load + width, 1, 1};
  if (kind < 0.4) stops.lower = load + random.sign() * near, stops.upper = stops.lower + width;
  if (kind < 0.1) stops.upper = none;
  if (kind > 0.9) stops.lower = -none;
  const double low = std::isfinite(stops.lower) ? stops.lower : stops.upper - 1;
  const double high = std::isfinite(stops.upper) ? stops.upper : stops.lower + 1;
  const double x = random.happens(0.3) ? low : std::clamp(low + random.uniform(0, 1) * (high - low), low, high);
  return {load, stops, x, random.sign() * random.logarithmic(1e-6, 1e3)};
}

TEST(FreePeriod, is_that_of_fifty_digits) {
  double worst = 0, short_ones = 0;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Free free = any_free(i);
    const FiftyDigits reference = free.reference();
    ASSERT_TRUE(reference > 0 && reference <= 2 * pi<FiftyDigits>()) << i;
    const double error = static_cast<double>(FiftyDigits(abs(free.period() - reference))) / conditioning(free);
    EXPECT_LE(error, 8) << "motion " << i << ": load " << free.load << ", stops " << free.stops.lower << " "
                        << free.stops.upper << ", x " << free.x << ", v " << free.v;
    worst = std::max(worst, error), short_ones += reference < 1e-3;
  }
  EXPECT_GT(short_ones, 500);
}

TEST(FreePeriod, between_stops_around_the_load_has_closed_forms) {
  // eq. 35: 4 arcsin(g/V); one stop in the centre: pi; stops at 0 and g: 2 arcsin(g/V); one stop beside the centre:
  // pi +- 2 arcsin(g/V)
  for (const double V : {1e-3, 0.2, 3.0, 1e9})
    for (const double part : {1e-12, 1e-3, 0.5, 0.99}) {
      const double g = V * part, turn = std::asin(g / V), allowed = 4 * ulp;
      for (const double sign : {-1.0, 1.0}) {
        EXPECT_NEAR((Free{0, {-g, g, 1, 1}, 0, sign * V}.period()) / (4 * turn), 1, allowed + 8 * ulp * part);
        EXPECT_NEAR((Free{0, {0, g, 1, 1}, 0, sign * V}.period()) / (2 * turn), 1, allowed + 8 * ulp * part);
        EXPECT_NEAR((Free{0, {-none, 0, 1, 1}, 0, sign * V}.period()) / pi_, 1, allowed);
        EXPECT_NEAR((Free{0, {-none, g, 1, 1}, 0, sign * V}.period()) / (pi_ + 2 * turn), 1, allowed);
        EXPECT_EQ((Free{0, {-V * 1.01, V * 1.01, 1, 1}, 0, sign * V}.period()), 2 * pi_);
      }
    }
}

TEST(FreePeriod, beyond_the_load_has_closed_forms) {
  // one stop at Delta on the near side of the load: pi - 2 arcsin(Delta/A), the arc above it; thrown from it at speed v
  // with A^2 = Delta^2 + v^2, twice the angle whose tangent is v/Delta
  for (const double Delta : {1e-6, 0.5, 1e6})
    for (const double v : {1e-6, 0.1, 1e3}) {
      const double period = 2 * std::atan2(v, Delta);
      EXPECT_NEAR((Free{0, {Delta, none, 1, 1}, Delta, v}.period()) / period, 1, 8 * ulp);
      EXPECT_NEAR((Free{0, {-none, -Delta, 1, 1}, -Delta, v}.period()) / period, 1, 8 * ulp);
    }
  // between two close stops far from the load the mass flies like a ball: up and down again, 2 v/Delta, or through
  const double far = 1e6, width = 0x1p-20, v = 1.0;
  EXPECT_NEAR((Free{0, {far, far + 1, 1, 1}, far, v}.period()) / (2 * v / far), 1, 1e-11);  // (v/far)^2 / 3
  const double pull = far, slower = std::sqrt(9 - 2 * pull * width - width * width), through = 3;
  EXPECT_NEAR((Free{0, {far, far + width, 1, 1}, far, through}.period()) / (4 * width / (through + slower)), 1, 1e-11);
}

TEST(FreePeriod, between_close_stops_beyond_the_load_keeps_its_digits) {
  // powers of two, so that the gap is exact: the angle between the stops is no difference of their two angles
  for (const double far : {0x1p0, 0x1p10, 0x1p20})
    for (const double width : {0x1p-10, 0x1p-20, 0x1p-30})
      for (const double v : {0x1p8, 0x1p14})
        for (const double sign : {-1.0, 1.0}) {
          Free free{0, {far, far + width, 1, 1}, far, sign * v};
          if (sign < 0) free.stops = {-far - width, -far, 1, 1}, free.x = -far;
          if (far + width - far != width) continue;
          EXPECT_NEAR(static_cast<double>(FiftyDigits(free.period() / free.reference())), 1, 16 * ulp)
              << far << " " << width << " " << v;
        }
}

TEST(FreePeriod, grows_with_the_root_of_the_distance_from_a_graze) {
  // stops at -g and g, the speed in the centre V = g(1 + eps): 4 arcsin(1/(1 + eps)) =
  // 2 pi - 4 (2 eps)^(1/2) (1 + O(eps)); V to half an ulp moves it by 4 (2 eps)^(1/2) ulp/(4 eps)
  for (const double eps : {0x1p-10, 0x1p-26, 0x1p-40, 0x1p-50}) {
    const double gap = 2 * pi_ - Free{0, {-1, 1, 1, 1}, 0, 1 + eps}.period(), root = 4 * std::sqrt(2 * eps);
    EXPECT_NEAR(gap / root, 1, eps + 16 * ulp / root + ulp / eps / 4) << eps;
  }
  EXPECT_EQ((Free{0, {-1, 1, 1, 1}, 0, 1}.period()), 2 * pi_);  // a touch without speed changes nothing
}

TEST(FreePeriod, is_the_time_after_which_a_simulated_motion_returns) {
  int returned = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const Free free = any_free(i);
    const double period = free.period(), late = conditioning(free);
    point::Problem scene = support::scene_of({0.0, 0.0, 1.0, free.load}, free.stops.lower, free.stops.upper, 1.0);
    scene.start = {free.x, free.v, 0.0};
    if (period < 1e-6 || late > 1e-9 * period)
      continue;  // sections round time to ulps of 2 pi, which matters for so short a period
    const auto run = support::run_scene<double>(scene, period);
    ASSERT_EQ(run.outcome, stepping::Outcome::completed) << i;
    const double offset = free.x - free.load, a = std::abs(offset), amplitude = norm(offset, free.v);
    const double size = std::abs(free.load) + std::abs(free.x) + amplitude;
    // two roundings an impact, and that of time: an ulp of 2 pi a section, or the uncertainty of the period
    const double time = 8 * late + 64 * ulp;
    const bool on_stop = free.x == free.stops.lower || free.x == free.stops.upper;  // before or after its impact
    const double v = on_stop ? std::abs(std::abs(run.end.v) - std::abs(free.v)) : std::abs(run.end.v - free.v);
    EXPECT_NEAR(run.end.x, free.x, time * std::abs(free.v) + 16 * ulp * size) << "motion " << i;
    // on a stop the speed is the root of the energy that is left there
    const double soft = on_stop ? 1 + size / std::abs(free.v) : 1;
    EXPECT_LE(v, time * a + 16 * ulp * size * soft) << "motion " << i;
    ++returned;
  }
  EXPECT_GT(returned, 700);
}

}  // namespace
}  // namespace clatter::steady::free_period_test
