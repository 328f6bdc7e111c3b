#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "motion/closed_form.hpp"
#include "support/force_orders.hpp"
#include "support/motion.hpp"
#include "support/random.hpp"

namespace clatter::motion::force_orders_test {
namespace {

std::string text(const Oscillator& o) {
  std::string said = "k = " + std::to_string(o.stiffness) + ", h = " + std::to_string(o.damping) +
                     ", nu = " + std::to_string(o.frequency) + ", orders";
  for (std::size_t j = 1; j <= o.shape.orders.of.size(); ++j)
    if (!o.shape.orders.is_zero(j)) said += " " + std::to_string(j);
  return said;
}

/// Oscillators of all kinds of free motion, each with an order of its force in resonance, beside it, and away from it.
std::vector<Oscillator> oscillators() {
  std::vector<Oscillator> all;
  for (const double k : {1.0, 100.0, 1e-3, 0.0, -1e-6, -4.0})
    for (const double h : {0.0, 1e-9, 0.01, 0.1, 1 - 1e-9, 1.0, 10.0})
      for (const double nu : {1.0 / 3, 0.507, 1.0, 4.0}) {
        support::Random random(5, all.size());
        const double natural = k > 0 && random.happens(0.7) ? std::sqrt(k) : 1.0;
        all.push_back({h, -1.3, nu * natural, 0.2, k, support::any_force_orders(random)});
      }
  return all;
}

double sum_of(const ForceOrders<double>& orders, double turns, int derivative = 0) {
  double sum = 0;
  for (std::size_t j = 1; j <= orders.of.size(); ++j) {
    const double n = static_cast<double>(j),
                 angle = n * 2 * std::numbers::pi * turns + derivative * std::numbers::pi / 2;
    sum += std::pow(n, derivative) *
           (orders.of[j - 1].in_phase * std::sin(angle) + orders.of[j - 1].quadrature * std::cos(angle));
  }
  return sum;
}

TEST(ForceOfOrders, is_the_sum_of_its_sines) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    support::Random random(11, i);
    const ForceOrders<double> orders = support::any_force_orders(random).orders;
    const double turns = random.uniform(0, 1);
    const auto s = orders.derivatives(sine_cosine_of_turns(turns));
    for (int n = 0; n < 5; ++n) {
      EXPECT_NEAR(s[static_cast<std::size_t>(n)], sum_of(orders, turns, n), 1e-14 * std::pow(8, n));
      EXPECT_LE(std::abs(sum_of(orders, turns, n)), orders.most_of(n) * (1 + 1e-14));
    }
    EXPECT_NEAR(orders.most_of(0), 1, 1e-14);
  }
}

TEST(ForceOfOrders, closed_form_is_the_solution_of_the_equation_of_motion) {
  for (const Oscillator& o : oscillators()) expect_closed_form(o, text(o));
}

TEST(ForceOfOrders, double_agrees_with_fifty_digits) {
  for (const Oscillator& o : oscillators()) expect_fifty_digits(o, 2e-14, text(o));
}

TEST(ForceOfOrders, short_flights_keep_their_digits) {
  for (const Oscillator& o : oscillators()) {
    const double rate = std::max(1.0, 8 * o.frequency);
    for (const double s : {1e-9, 1e-4, 0.24 / rate, 0.26 / rate, 0.5 / rate}) {
      const auto rounded = support::motion_after<double>(o, {1, 0, 0.137}, s);
      const auto exact = support::motion_after<FiftyDigits>(o, {1, 0, 0.137}, s);
      const double size = static_cast<double>(abs(exact.offset)) + std::abs(rounded.a) * s * s,
                   response = s * rate > 0.25 ? std::abs(o.forcing) / o.frequency * s : 0.0;
      EXPECT_NEAR(rounded.offset, static_cast<double>(exact.offset), 1e-12 * size + 4e-15 * response)
          << text(o) << ", s = " << s;
    }
  }
}

TEST(ForceOfOrders, bound_of_the_sixth_derivative_holds) {
  const auto all = oscillators();
  for (std::uint64_t i = 0; i < 2000; ++i) {
    support::Random random(31, i);
    const Oscillator& o = all[i % all.size()];
    with_any_stops(o, [&]<Effects effects>() {
      constexpr Effects E = effects.arc();
      const ArcConstants<double, E> constants(o);
      const SineCosine<double> phase = constants.phase_at(random.uniform(0, 1));
      Motion<double> m{0, random.uniform(-1, 1), random.uniform(-1, 1), 0, phase.sine, phase.cosine};
      if (random.happens(0.5)) m.x = constants.equilibrium, m.v = 0;  // so that all of it is the response
      m.a = constants.acceleration(m.x - constants.equilibrium, m.v, phase);
      const Arc<double, E> arc(constants, m);
      const double span = random.uniform(0, 2) / constants.rate, bound = sixth_bound(constants, arc.start(), span, 0);
      const auto d = constants.derivatives(arc.at(random.uniform(0, span)));
      EXPECT_LE(std::abs(d.d6) * std::pow(span, 6), bound * (1 + 1e-9) + 1e-12) << text(o);
    });
  }
}

/// Against a scan of the turn.
TEST(ForceOfOrders, the_first_phase_at_which_it_passes_a_value_is_found) {
  int found = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    support::Random random(13, i);
    const ForceOrders<double> orders = support::any_force_orders(random).orders;
    const double f = random.sign() * random.logarithmic(0.01, 10), begin = random.uniform(0, 1),
                 needed = f * random.uniform(-1, 1);
    const bool rises = random.happens(0.5);
    const auto height = [&](double turns) { return (rises ? 1 : -1) * (f * sum_of(orders, turns) - needed); };
    const auto turns = phase_of_orders(orders, f, needed, rises, begin);
    constexpr int scan = 4000;
    int first = 0;
    while (first < scan &&
           !(height(begin + first / double(scan)) < 0 && height(begin + (first + 1) / double(scan)) >= 0))
      ++first;
    if (!turns) {
      EXPECT_EQ(first, scan) << i;
      continue;
    }
    ++found;
    EXPECT_LE(part_of_turn(*turns - begin), (first + 1.0) / scan) << i;  // an earlier one may lie within a step
    EXPECT_NEAR(height(*turns), 0, 1e-13 * std::abs(f) * 8) << i;
    EXPECT_GT(height(*turns + 1e-7), height(*turns - 1e-7)) << i;
    const auto exact =
        phase_of_orders(with_numbers<FiftyDigits>(ForceShape{.waveform = Waveform::orders, .orders = orders}).orders,
                        FiftyDigits(f), FiftyDigits(needed), rises, FiftyDigits(begin));
    ASSERT_TRUE(exact) << i;
    EXPECT_NEAR(static_cast<double>(*exact), *turns, 1e-9) << i;
  }
  EXPECT_GT(found, 200);
}

}  // namespace
}  // namespace clatter::motion::force_orders_test
