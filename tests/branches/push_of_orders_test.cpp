#include "branches/equations/push_of_orders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "math/dual.hpp"
#include "support/random.hpp"

namespace clatter::branches::push_of_orders_test {
namespace {

using support::Random;

constexpr double turn = 2 * std::numbers::pi;

template <class Number>
ForceOrders<Number> orders_of(const ForceOrders<double>& orders) {
  ForceOrders<Number> same;
  for (std::size_t i = 0; i < same.of.size(); ++i) same.of[i] = {orders.of[i].in_phase, orders.of[i].quadrature};
  return same;
}

ForceOrders<double> any_orders(Random& draw) {
  ForceOrders<double> orders;
  const int most = 1 + static_cast<int>(draw.uniform(0, 8));
  for (int j = 0; j < most; ++j)
    if (j == 0 || draw.happens(0.5))
      orders.of[static_cast<std::size_t>(j)] = {draw.uniform(-1, 1), draw.uniform(-1, 1)};
  return orders;
}

double sum(const ForceOrders<double>& orders, double phase) {
  double s = 0;
  for (std::size_t j = 1; j <= orders.of.size(); ++j) {
    const double of = static_cast<double>(j) * phase;
    s += orders.of[j - 1].in_phase * std::sin(of) + orders.of[j - 1].quadrature * std::cos(of);
  }
  return s;
}

TEST(ForceOrders, have_their_crests_where_a_dense_scan_has_them) {
  for (int scene = 0; scene < 40; ++scene) {
    Random draw(1, static_cast<std::uint64_t>(scene));
    const ForceOrders<double> orders = any_orders(draw);
    for (const double sign : {-1.0, 1.0}) {
      constexpr int parts = 20000;
      const auto at = [&](int i) { return sign * sum(orders, -turn / 2 + turn * i / parts); };
      std::size_t count = 0;
      double highest = -1e9;
      for (int i = 0; i < parts; ++i)
        count += at(i) > at(i - 1) && at(i) >= at(i + 1), highest = std::max(highest, at(i));
      const std::vector<double> crests = crests_of(orders, sign);
      EXPECT_EQ(crests.size(), count) << scene;
      for (const double crest : crests)
        EXPECT_NEAR(orders.derivative().derivatives({std::sin(crest), std::cos(crest)})[0], 0, 1e-12);
      EXPECT_NEAR(sign * sum(orders, crest_of(orders, sign)), highest, 1e-5) << scene;
    }
  }
}

TEST(PushOfOrders, holds_a_mass_until_it_first_rises_through_the_level) {
  int held = 0, never = 0, later = 0;
  for (int scene = 0; scene < 400; ++scene) {
    Random draw(2, static_cast<std::uint64_t>(scene));
    const ForceOrders<double> orders = any_orders(draw);
    const double f = draw.uniform(-2, 2), from = draw.uniform(-10, 10);
    const Side side = draw.happens(0.5) ? Side::upper : Side::lower;
    const auto push = [&](double phase) { return sign_of(side) * f * sum(orders, phase); };
    const double level = push(from) + draw.uniform(0.01, 1);
    const PushOfOrders<double> pushes(f, orders, side);
    const double hold = pushes.hold(from, level);
    constexpr int parts = 20000;
    int first = 1;
    while (first <= parts && push(from + turn * first / parts) < level) ++first;
    if (first > parts) {
      EXPECT_FALSE(hold < turn) << scene;
      ++never;
    } else {
      EXPECT_NEAR(hold, turn * first / parts, 2 * turn / parts) << scene;
      EXPECT_NEAR(push(from + hold), level, 1e-12) << scene;
      ++held, later += pushes.hold_to_crest(from, level) > hold + 1;
    }
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(never, 30);
  EXPECT_GT(later, 3);
}

TEST(PushOfOrders, that_has_passed_the_level_has_done_so_before_its_next_crest) {
  for (int scene = 0; scene < 300; ++scene) {
    Random draw(3, static_cast<std::uint64_t>(scene));
    const ForceOrders<double> orders = any_orders(draw);
    const PushOfOrders<double> pushes(1.0, orders, Side::upper);
    const double crest = crest_of(orders, 1), before = draw.uniform(1e-3, 0.05);
    const double level = sum(orders, crest - before), from = crest - before * draw.uniform(0.1, 0.9);
    EXPECT_NEAR(pushes.hold(from, level), crest - before - from, 1e-9) << scene;  // negative
  }
}

TEST(PushOfOrders, has_the_derivatives_of_its_instants) {
  using Three = Dual<double, 3>;  // by the phase, the level and the first order
  int seen = 0;
  for (int scene = 0; scene < 300; ++scene) {
    Random draw(4, static_cast<std::uint64_t>(scene));
    const ForceOrders<double> orders = any_orders(draw);
    const double from = draw.uniform(-3, 3), level = sum(orders, from) + draw.uniform(0.05, 0.5), step = 1e-6;
    ForceOrders<Three> moving = orders_of<Three>(orders);
    moving.of[0].in_phase = Three(orders.of[0].in_phase, 2);
    const PushOfOrders<Three> pushes(Three(1.0), moving, Side::upper);
    const Three hold = pushes.hold(Three(from, 0), Three(level, 1));
    if (!(hold.value < turn) || !(pushes.at(Three(from + hold.value))[1].value > 0.1)) continue;
    const auto at = [&](double phase, double needed, double change) {
      ForceOrders<double> changed = orders;
      changed.of[0].in_phase += change;
      const PushOfOrders<double> push(1.0, changed, Side::upper);
      return push.hold(phase, needed);
    };
    EXPECT_NEAR(hold.slope[0], -1, 1e-12);
    EXPECT_NEAR(hold.slope[1], (at(from, level + step, 0) - at(from, level - step, 0)) / (2 * step), 1e-4) << scene;
    EXPECT_NEAR(hold.slope[2], (at(from, level, step) - at(from, level, -step)) / (2 * step), 1e-4) << scene;
    ++seen;
  }
  EXPECT_GT(seen, 100);
}

TEST(PushOfOrders, falls_through_a_level_beside_its_crest) {
  for (int scene = 0; scene < 300; ++scene) {
    Random draw(5, static_cast<std::uint64_t>(scene));
    const ForceOrders<double> orders = any_orders(draw);
    const PushOfOrders<double> pushes(1.0, orders, Side::upper);
    const double crest = pushes.highest_crest_near(4), after = draw.uniform(1e-3, 0.05);
    EXPECT_NEAR(pushes.fall_near(crest, sum(orders, crest + after)), crest + after, 1e-9) << scene;
    EXPECT_LE(std::abs(crest - 4), turn / 2 + 1e-9);
  }
}

}  // namespace
}  // namespace clatter::branches::push_of_orders_test
