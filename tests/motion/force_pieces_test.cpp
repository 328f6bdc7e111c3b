#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "motion/closed_form.hpp"
#include "motion/contact_force.hpp"
#include "support/force_table.hpp"
#include "support/motion.hpp"
#include "support/random.hpp"

namespace clatter::motion::force_pieces_test {
namespace {

constexpr Waveform in_pieces[] = {Waveform::square,   Waveform::pulse,     Waveform::triangle, Waveform::trapezoid,
                                  Waveform::sawtooth, Waveform::half_sine, Waveform::table};

/// A random shape, of a kind of them.
ForceShape any_shape(Waveform waveform, support::Random& random) {
  ForceShape shape{waveform, random.uniform(0.02, 0.98), random.uniform(0.02, 0.5)};
  if (waveform == Waveform::table) shape.table = support::any_force_table(random);
  return shape;
}

std::string text(const Oscillator& o) {
  return (o.shape.table ? "table" : std::string(force_shapes[static_cast<std::size_t>(o.shape.waveform)])) +
         ", k = " + std::to_string(o.stiffness) + ", h = " + std::to_string(o.damping) +
         ", nu = " + std::to_string(o.frequency);
}

/// Oscillators of all kinds of free motion, under lines of all slopes and half-sines in and beside resonance.
std::vector<Oscillator> oscillators() {
  std::vector<Oscillator> all;
  for (const double k : {1.0, 100.0, 1e-3, 1e-12, 0.0, -1e-6, -4.0})
    for (const double h : {0.0, 1e-9, 0.1, 1 - 1e-9, 1.0, 10.0})
      for (const double nu : {0.3, 1.0, 4.0}) {
        all.push_back({h, -1.3, nu, 0.2, k, {.waveform = Waveform::triangle}});
        all.push_back({h, 1.3, nu, 0.2, k, {.waveform = Waveform::trapezoid, .rise = 1e-3}});
        all.push_back({h, 1.3, nu, 0.0, k, {.waveform = Waveform::square, .duty = 0.3}});
        support::Random random(3, all.size());
        all.push_back({h, 0.7, nu, 0.2, k, any_shape(Waveform::table, random)});
        for (const double duty : {0.5, 0.15, nu / 2 < 1 ? nu / 2 : 0.9})  // the last one resonates at k = 1
          all.push_back({h, 0.7, nu, 0.2, k, {.waveform = Waveform::half_sine, .duty = duty}});
      }
  return all;
}

TEST(ForceInPieces, closed_form_is_the_solution_of_the_equation_of_motion) {
  for (const Oscillator& o : oscillators()) expect_closed_form(o, text(o));
}

TEST(ForceInPieces, double_agrees_with_fifty_digits) {
  for (const Oscillator& o : oscillators()) expect_fifty_digits(o, 1e-14, text(o));
}

TEST(ForceInPieces, the_velocity_keeps_its_digits_on_a_ramp_of_a_billionth_of_the_period) {
  const Oscillator o{0.05, 1.0, 1.3, 0.0, 1.0, {.waveform = Waveform::trapezoid, .rise = 1e-9}};
  const support::ArcStart start{0.2, 0.4, 0.0};  // in the middle of the ramp
  for (const double s : {1e-10, 1e-9, 1.0}) {
    const auto rounded = support::motion_after<double>(o, start, s);
    const auto exact = support::motion_after<FiftyDigits>(o, start, s);
    EXPECT_NEAR(rounded.v, static_cast<double>(exact.v), 4e-15 * (1 + static_cast<double>(abs(exact.v)))) << s;
  }
}

TEST(ForceInPieces, bound_of_the_sixth_derivative_holds) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    support::Random random(31, i);
    const auto all = oscillators();
    const Oscillator& o = all[i % all.size()];
    with_any_stops(o, [&]<Effects effects>() {
      constexpr Effects E = effects.arc();
      const ArcConstants<double, E> constants(o);
      const auto [sine, cosine] = constants.phase_at(random.uniform(0, 1));
      Motion<double> m{0, random.uniform(-1, 1), random.uniform(-1, 1), 0, sine, cosine};
      if (random.happens(0.5)) m.x = constants.equilibrium, m.v = 0;  // so that all of it is the response
      m.a = constants.acceleration(m.x - constants.equilibrium, m.v, {m.sine, m.cosine});
      const Arc<double, E> arc(constants, m);
      const double span = random.uniform(0, 2) / constants.rate, bound = sixth_bound(constants, arc.start(), span, 0);
      const auto within = arc.at(random.uniform(0, span));
      const auto d = constants.derivatives(within);
      EXPECT_LE(std::abs(d.d6) * std::pow(span, 6), bound * (1 + 1e-9) + 1e-12) << text(o);
    });
  }
}

/// s by its definition.
double shape(const ForceShape& of, double turns) {
  const double t = turns - std::floor(turns), pi = std::numbers::pi;
  switch (of.waveform) {
    case Waveform::square:
      return t < of.duty ? 1 : -1;
    case Waveform::pulse:
      return t < of.duty ? 1 : 0;
    case Waveform::triangle:
      return 2 / pi * std::asin(std::sin(2 * pi * t));
    case Waveform::trapezoid:
      return std::max(-1.0, std::min(1.0, std::asin(std::sin(2 * pi * t)) / (pi * of.rise)));
    case Waveform::sawtooth:
      return 2 * t - 1;
    case Waveform::half_sine:
      return t < of.duty ? std::sin(pi * t / of.duty) : 0;
    case Waveform::table: {
      const auto& knots = of.table->knots();
      std::size_t i = knots.size() - 1;
      while (i > 0 && knots[i].turns > t) --i;
      const bool is_last = i + 1 == knots.size();
      const double end = is_last ? 1 : knots[i + 1].turns, share = (t - knots[i].turns) / (end - knots[i].turns);
      return std::lerp(knots[i].after, knots[is_last ? 0 : i + 1].before, share) / of.table->peak();
    }
    case Waveform::sine:
    case Waveform::orders:
      break;
  }
  return std::sin(2 * pi * t);
}

TEST(ForceInPieces, shapes_are_as_defined) {
  for (std::uint64_t i = 0; i < 7000; ++i) {
    support::Random random(7, i);
    const ForceShape of = any_shape(in_pieces[i % 7], random);
    const double turns = random.uniform(-3, 3), shortly = 1e-7;
    const auto [s, slope] = shape_at(of, turns);
    EXPECT_NEAR(s, shape(of, turns), 1e-13) << turns;
    const double rise = (shape(of, turns + shortly) - shape(of, turns - shortly)) / (4 * std::numbers::pi * shortly);
    if (std::abs(rise) > 1e3) continue;  // a jump
    EXPECT_NEAR(slope, rise, 1e-4 + 1e-6 * std::abs(rise)) << turns;
  }
}

TEST(ForceInPieces, at_a_knot_the_piece_holds_that_begins_there) {
  for (const Waveform waveform : in_pieces)
    for (const double duty : {0.5, 0.3, 1.0 / 3}) {
      support::Random random(17, static_cast<std::uint64_t>(duty * 100));
      ForceShape of{waveform, duty, 0.2};
      if (waveform == Waveform::table) of.table = support::any_force_table(random);
      const ForcePieces<double> pieces(of);
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto [begin, value, slope] = pieces[i];
        for (const double turns : {begin, begin + 1, begin - 1, begin * (1 - 1e-16)}) {
          EXPECT_NEAR(shape_at(of, turns).sine, value, 1e-15);
          EXPECT_NEAR(shape_at(of, turns).cosine, slope, 1e-15);
        }
      }
    }
}

TEST(ForceInPieces, the_mean_is_that_of_the_shape) {
  for (const Waveform waveform : in_pieces) {
    support::Random random(19, 0);
    ForceShape of{waveform, 0.3, 0.2};
    if (waveform == Waveform::table) of.table = support::any_force_table(random);
    constexpr int count = 100000;
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += shape(of, (i + 0.5) / count);
    EXPECT_NEAR(mean_of(of), sum / count, waveform == Waveform::table ? 1e-5 : 1e-8);
  }
}

TEST(ForceInPieces, a_force_passes_a_value_at_the_phase_that_is_told_within_a_piece) {
  int found = 0;
  for (std::uint64_t i = 0; i < 3500; ++i) {
    support::Random random(11, i);
    const ForceShape of = any_shape(in_pieces[i % 7], random);
    const double f = random.uniform(-2, 2), needed = random.uniform(-1.1, 1.1) * std::abs(f), shortly = 1e-9;
    if (std::abs(needed) < 1.1 * std::abs(f) / 1000) continue;  // a half-sine comes to 0 at its knot
    const bool rises = random.happens(0.5);
    const ForcePieces<double> pieces(of);
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
      const double begin = pieces.begin_of(piece), length = pieces.end_of(piece) - begin;
      const auto turns = phase_of_shape(of, f, needed, rises, begin + length * random.uniform(0, 0.9));
      int crossings = 0;  // of a run through the piece
      constexpr int steps = 1000;
      for (int step = 0; step < steps; ++step) {
        const double before = f * shape(of, begin + length * (step + 0.001) / steps),
                     after = f * shape(of, begin + length * (step + 0.999) / steps);
        if (rises ? before < needed && after >= needed : before > needed && after <= needed) ++crossings;
      }
      if (turns && crossings == 0) {  // between two steps
        EXPECT_NEAR(f * shape(of, *turns), needed, 1e-12);
        continue;
      }
      EXPECT_EQ(turns.has_value(), crossings == 1) << static_cast<int>(of.waveform) << ' ' << needed / f;
      if (!turns) continue;
      ++found;
      EXPECT_NEAR(f * shape(of, *turns), needed, 1e-12);
      EXPECT_EQ(f * shape(of, *turns + shortly) > f * shape(of, *turns - shortly), rises);
    }
  }
  EXPECT_GT(found, 500);
}

}  // namespace
}  // namespace clatter::motion::force_pieces_test
