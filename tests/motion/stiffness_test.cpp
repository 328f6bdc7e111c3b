#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "math/bernstein.hpp"
#include "math/fifty_digits.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "motion/scenes.hpp"
#include "support/motion.hpp"
#include "support/random.hpp"

namespace clatter::motion::stiffness_test {
namespace {

constexpr double stiffnesses[] = {100.0, 4.0, 1e-3, 0.0, -1e-6, -1.0, -25.0};

std::vector<Oscillator> oscillators() {
  std::vector<Oscillator> all;
  for (const double k : stiffnesses)
    for (const double h : {0.0, 1e-300, 1e-9, 0.1, 2.0, 3.0, 10.0})
      for (const double nu : {0.3, 2.0, 9.9}) all.push_back({h, -1.3, nu, 0.2, k});
  for (const double k : {100.0, 4.0, 1e-3})  // a rotation that hardly turns
    for (const double below_critical : {1e-2, 1e-3, 1e-8, 1e-15})
      for (const double nu : {0.3, 2.0, 9.9}) all.push_back({std::sqrt(k) * (1 - below_critical), -1.3, nu, 0.2, k});
  return all;
}

std::string text(const Oscillator& o) {
  return "k = " + std::to_string(o.stiffness) + ", h = " + std::to_string(o.damping) +
         ", nu = " + std::to_string(o.frequency);
}

/// The value of a polynomial in Bernstein form, by de Casteljau's subdivision.
FiftyDigits value_of(Bernstein<FiftyDigits> c, const FiftyDigits& u) {
  for (std::size_t n = c.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) c[i] += u * (c[i + 1] - c[i]);
  return c[0];
}

TEST(Stiffness, closed_form_is_the_solution_of_the_equation_of_motion) {
  for (const Oscillator& o : oscillators()) {
    const support::ArcStart start{0.37, -1.1, 0.137};
    const auto closed = support::motion_after<FiftyDigits>(o, start, 2.3),
               stepped = support::motion_by_taylor<FiftyDigits>(o, start, 2.3);
    const FiftyDigits size = 1 + abs(stepped.x) + abs(stepped.v);
    EXPECT_LT(abs(closed.x - stepped.x), 1e-40 * size) << text(o);
    EXPECT_LT(abs(closed.v - stepped.v), 1e-40 * size) << text(o);
    EXPECT_LT(abs(closed.a - stepped.a), 1e-38 * size) << text(o);
    EXPECT_LT(abs(closed.offset - (closed.x - FiftyDigits(0.37))), 1e-40 * size) << text(o);
  }
}

TEST(Stiffness, double_agrees_with_fifty_digits) {
  for (const Oscillator& o : oscillators())
    for (const double s : {1e-6, 0.03, 0.2, 1.0, 6.0}) {
      const support::ArcStart start{0.37, -1.1, 0.137};
      const auto rounded = support::motion_after<double>(o, start, s);
      const auto exact = support::motion_after<FiftyDigits>(o, start, s);
      // the start, the response and, with an unstable spring, their growth; at resonance the force adds up to f s/(2
      // nu)
      const double natural = std::sqrt(std::abs(o.stiffness)), growth = o.stiffness < 0 ? std::exp(natural * s) : 1.0;
      const double forced = 1.3 * (1 + s) / std::max(0.09, std::abs(o.stiffness - o.frequency * o.frequency));
      const double load = o.stiffness == 0.0 ? 0.2 * s * s : std::min(0.2 * s * s, 0.4 / std::abs(o.stiffness));
      const double scale = (1.1 * (1 + s) + std::min(forced, 1.3 * s * (1 + s)) + load) * growth * (1 + natural),
                   tolerance = 1e-15 * (8 + (natural + o.frequency) * s) * scale;
      EXPECT_NEAR(rounded.x, static_cast<double>(exact.x), tolerance) << text(o) << ", s = " << s;
      EXPECT_NEAR(rounded.v, static_cast<double>(exact.v), tolerance * (1 + natural + o.frequency))
          << text(o) << ", s = " << s;
    }
}

TEST(Stiffness, the_enclosure_of_a_step_holds_the_motion) {
  for (std::size_t i = 0; i < 300; ++i) {
    support::Random random(11, i);
    const double k = stiffnesses[i % std::size(stiffnesses)];
    const Oscillator o{random.logarithmic(1e-3, 5), random.uniform(-2, 2), random.logarithmic(0.2, 5),
                       random.uniform(-1, 1), k};
    with_any_stops(o, [&]<Effects effects>() {
      using N = FiftyDigits;  // so that the bound isn't blurred by rounding
      const ArcConstants<N, effects.arc()> constants(o);
      const N x(random.uniform(-1, 1)), v(random.uniform(-1, 1));
      const Arc<N, effects.arc()> arc(
          constants, {N(0), x, v, constants.acceleration(N(x - constants.equilibrium), v, {N(0), N(1)}), N(0), N(1)});
      const N step(random.logarithmic(0.05, 2) / std::max(1.0, std::sqrt(std::abs(k))));
      const auto end = arc.at(step);
      const N bound = hermite_error(sixth_bound(constants, arc.start(), step, 0));
      const auto c =
          hermite(HermiteData<N>::over(step, {N(0), arc.start().v, arc.start().a, end.offset, end.v, end.a}));
      for (int part = 1; part < 8; ++part) {
        const N u = N(part) / 8, error = arc.at(u * step).offset - value_of(c, u);
        EXPECT_LE(abs(error), bound * middle_function(u) * (1 + N(1e-30)) + N(1e-45)) << text(o);
      }
    });
  }
}

TEST(Stiffness, reach_is_never_exceeded) {
  for (std::size_t i = 0; i < 300; ++i) {
    support::Random random(12, i);
    const double k = stiffnesses[i % std::size(stiffnesses)];
    const Oscillator o{random.logarithmic(1e-3, 5), random.uniform(-2, 2), random.logarithmic(0.2, 5),
                       random.uniform(-1, 1), k};
    with_any_stops(o, [&]<Effects effects>() {
      const ArcConstants<double, effects.arc()> constants(o);
      const double x = random.uniform(-1, 1), v = random.uniform(-1, 1), span = random.logarithmic(0.1, 8);
      const Arc<double, effects.arc()> arc(
          constants, {0, x, v, constants.acceleration(x - constants.equilibrium, v, {0.0, 1.0}), 0, 1});
      const double far = reach(constants, arc.start(), span);
      for (int part = 0; part <= 16; ++part)
        EXPECT_LE(std::abs(arc.at(span * part / 16).x - constants.equilibrium), far) << text(o) << " " << span;
    });
  }
}

TEST(Stiffness, contacts_of_free_flight_are_known) {
  // no spring, no load: constant speed; a load alone: a parabola; an unstable spring: a hyperbolic cosine
  const Crossing<double> straight = first_contact({0.0, 0.0, 1.0, 0.0, 0.0}, {-1, 1, 1, 1}, 0.25, 0.5, 10);
  EXPECT_EQ(straight.side, Side::upper);
  EXPECT_NEAR(straight.elapsed, 1.5, 4e-16);
  EXPECT_EQ(straight.motion.v, 0.5);
  const Crossing<double> thrown = first_contact({0.0, 0.0, 1.0, -2.0, 0.0}, {0, 9, 1, 1}, 0.0, 3.0, 10);
  EXPECT_EQ(thrown.side, Side::lower);
  EXPECT_NEAR(thrown.elapsed, 3.0, 1e-15);
  EXPECT_EQ(thrown.motion.v, -3.0);  // by its energy
  const Crossing<double> pushed = first_contact({0.0, 0.0, 1.0, 0.0, -1.0}, {-2, 2, 1, 1}, 0.5, 0.0, 10);
  EXPECT_EQ(pushed.side, Side::upper);
  EXPECT_NEAR(pushed.elapsed, std::acosh(4.0), 1e-15 * 4);
  EXPECT_NEAR(pushed.motion.v, std::sqrt(4 - 0.25), 1e-15 * 2);
  const Crossing<double> slowed = first_contact({0.5, 0.0, 1.0, 0.0, 0.0}, {-1, 1, 1, 1}, 0.0, 2.0, 10);
  EXPECT_NEAR(slowed.elapsed, std::log(2.0), 1e-15);  // 1 = 2 (1 - e^-s)
  EXPECT_NEAR(slowed.motion.v, 1.0, 1e-15 * 2);
  // one that is slowed to a halt before the stop never gets there
  EXPECT_EQ(first_contact({1.0, 0.0, 1.0, 0.0, 0.0}, {-1, 1, 1, 1}, 0.0, 1.9, 1e6).side, Side::none);
}

}  // namespace
}  // namespace clatter::motion::stiffness_test
