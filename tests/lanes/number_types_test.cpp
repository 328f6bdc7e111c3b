// The physics is one source for three kinds of numbers: double, 50 digits and SIMD vectors. Each piece of it gives the
// same in all of them, to the rounding of double.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "lanes/functions.hpp"
#include "lanes/lane_effects.hpp"
#include "lanes/vector.hpp"
#include "math/fifty_digits.hpp"
#include "math/quintic.hpp"
#include "motion/equation_of_motion.hpp"
#include "motion/propagation.hpp"
#include "observables/harmonics/velocity_jumps.hpp"
#include "scene/response.hpp"
#include "scene/stops.hpp"
#include "support/random.hpp"

namespace clatter::lanes::number_types_test {
namespace {

using V = Pair<xsimd::sse2>;

FiftyDigits exact(double y) { return y; }
FiftyDigits exact(const FiftyDigits& y) { return y; }
FiftyDigits exact(const V& y) { return y.second.get(1); }

/// The results of a piece of physics, and the size that their roundings are relative to.
struct Results {
  std::vector<FiftyDigits> values;
  double size = 1;
};

/// Runs `piece` in each kind of number on random inputs, and compares the results.
template <std::size_t inputs, class Piece>
void expect_one_physics(const Piece& piece) {
  for (std::uint64_t index = 0; index < 500; ++index) {
    support::Random random(20, index);
    std::array<double, inputs> of_double;
    for (double& y : of_double) y = random.uniform(-1, 1);
    std::array<V, inputs> of_vector;
    std::array<FiftyDigits, inputs> of_fifty;
    for (std::size_t i = 0; i < inputs; ++i) of_vector[i] = V(of_double[i]), of_fifty[i] = of_double[i];
    const Results one = piece(of_double), other = piece(of_vector), reference = piece(of_fifty);
    ASSERT_EQ(one.values.size(), reference.values.size());
    ASSERT_FALSE(reference.values.empty());
    for (std::size_t i = 0; i < reference.values.size(); ++i) {
      const FiftyDigits allowed = 32 * epsilon<double>() * reference.size;
      EXPECT_LE(abs(one.values[i] - reference.values[i]), allowed) << "double, value " << i << " of case " << index;
      EXPECT_LE(abs(other.values[i] - reference.values[i]), allowed) << "vector, value " << i << " of case " << index;
    }
  }
}

template <class Inputs>
using NumberOf = typename Inputs::value_type;

TEST(OnePhysics, response) {
  expect_one_physics<4>([](const auto& in) {
    const Response<NumberOf<std::decay_t<decltype(in)>>> response{in[0], in[1], {}};
    return Results{{exact(response.displacement(in[2], in[3])), exact(response.velocity(in[0], in[2], in[3]))}};
  });
}

TEST(OnePhysics, propagator_and_turn) {
  expect_one_physics<6>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const motion::Turn<N> turn{in[1], in[2]};
    const auto propagator = motion::light_propagator<N>(in[0], in[1], in[2], in[3]);
    const motion::FreeMotion<N> free = propagator.advance({in[4], in[5]});
    const SineCosine<N> phase = motion::turned(SineCosine<N>{in[4], in[5]}, turn);
    return Results{{exact(propagator.a), exact(propagator.b), exact(propagator.c), exact(propagator.d), exact(free.x),
                    exact(free.v), exact(phase.sine), exact(phase.cosine)}};
  });
}

template <class N>
using Equation = motion::EquationOfMotion<N, Effects{.damping = Damping::light, .forcing = Forcing::regular}>;

TEST(OnePhysics, equation_of_motion) {
  expect_one_physics<7>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const Equation<N> equation{in[0], in[1], in[2]};
    const N a = equation.acceleration(in[3], in[4], in[5]);
    const auto d = equation.derivatives(in[4], a, in[5], in[6]);
    return Results{
        {exact(a), exact(equation.jerk(in[4], a, in[6])), exact(d.d3), exact(d.d4), exact(d.d5), exact(d.d6)}, 8};
  });
}

TEST(OnePhysics, equation_of_motion_without_a_spring_or_with_an_unstable_one) {
  expect_one_physics<9>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const motion::EquationOfMotion<N, unsprung.arc()> equation{in[0], in[1], in[2], in[7], in[8]};
    const N a = equation.acceleration(in[3], in[4], in[5]);
    const auto d = equation.derivatives(in[4], a, in[5], in[6]);
    return Results{
        {exact(a), exact(equation.jerk(in[4], a, in[6])), exact(d.d3), exact(d.d4), exact(d.d5), exact(d.d6)}, 16};
  });
}

TEST(OnePhysics, two_exponentials_and_the_pull_of_a_load) {
  expect_one_physics<3>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const N s = in[0] * in[0], h = in[1] * in[1];
    const auto p = short_propagator<N>(s, h, -(h * h + in[2] * in[2]));
    return Results{{exact(p.a), exact(p.b), exact(p.c), exact(short_second_divided_decay<N>(N(2.0) * s * h))}, 2};
  });
}

TEST(OnePhysics, time_over_a_small_distance_and_the_velocity_after_it) {
  expect_one_physics<7>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const motion::HigherDerivatives<N> d{in[2], in[3], in[4], in[5]};
    const N v = N(2.0) + in[0], distance = in[1] * N(1.0 / 256), a = in[6];
    const N t = motion::TimeOver<N>(distance, v, a, d).time;
    return Results{{exact(t), exact(motion::velocity_after(t, v, a, d))}, 4};
  });
}

/// The distance covered in a time, by the Taylor series.
FiftyDigits distance_over(const FiftyDigits& t, double v, double a, const motion::HigherDerivatives<FiftyDigits>& d) {
  return t * (v + t * (a / 2 + t * (d.d3 / 6 + t * (d.d4 / 24 + t * (d.d5 / 120 + t * (d.d6 / 720))))));
}

TEST(TimeOver, covers_the_distance_once_it_has_converged) {
  for (const double speed : {1.0, 0.1, 0.01, 1e-3, 1e-4}) {  // towards a graze
    int converged = 0;
    for (std::uint64_t index = 0; index < 500; ++index) {
      support::Random random(21, index);
      const double v = random.sign() * speed * random.uniform(1, 2), a = random.uniform(-2, 2);
      const motion::HigherDerivatives<FiftyDigits> d{random.uniform(-1, 1), random.uniform(-1, 1),
                                                     random.uniform(-1, 1), random.uniform(-1, 1)};
      const FiftyDigits distance = distance_over(random.uniform(-1.0 / 256, 1.0 / 256), v, a, d);
      const motion::TimeOver<FiftyDigits> over(distance, v, a, d);
      if (!over.converged()) continue;
      ++converged;
      EXPECT_LE(abs(distance_over(over.time, v, a, d) - distance), epsilon<double>()) << speed << ' ' << index;
    }
    EXPECT_GE(converged, speed == 1 ? 500 : 1);
  }
}

TEST(TimeOver, has_not_converged_if_only_the_jerk_moves_it) {
  const motion::HigherDerivatives<double> d{1, 0, 0, 0};
  EXPECT_FALSE(motion::TimeOver<double>(1e-6, 1e-6, 0, d).converged());
}

TEST(OnePhysics, enclosures) {
  expect_one_physics<7>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    const N error = in[6] * in[6], step = N(1.5) + in[5];
    const Bernstein<N> c = hermite(HermiteData<N>::over(step, {in[0], in[1], in[2], in[3], in[4], in[5]}));
    const Interval<N> inner = enclosure(c, error), slope = slope_enclosure(c, error);
    Results results{{exact(inner.low), exact(inner.high), exact(slope.low), exact(slope.high)}, 16};
    for (const N& y : c) results.values.push_back(exact(y));
    return results;
  });
}

TEST(OnePhysics, guesses_of_a_first_root_and_of_a_least_value) {
  expect_one_physics<4>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    // falls through 0, steadily; the other one is a bowl
    const HermiteData<N> falling{N(2.0) + in[0], N(-6.0) + in[1], in[2], N(-2.0) + in[3], N(-6.0), in[0]};
    const HermiteData<N> bowl{N(2.0), N(-4.0) + in[0], N(6.0) + in[1], N(2.0), N(4.0) + in[2], N(6.0) + in[3]};
    const Bernstein<N> c = hermite(falling), b = hermite(bowl);
    const N start = polygon_root(c);
    return Results{{exact(start), exact(Quintic<N>(c).root(start, start > N(0.0))), exact(Quintic<N>(b).least(b))},
                   1024};  // guesses: their polynomials are formed by differences
  });
}

TEST(OnePhysics, restitution) {
  expect_one_physics<2>([](const auto& in) {
    const ConstantRestitution<NumberOf<std::decay_t<decltype(in)>>> law{in[0]};
    return Results{{exact(law.after(in[1])), exact(law.jump(in[1]))}};
  });
}

TEST(OnePhysics, jumps_of_the_velocity_times_the_harmonics) {
  expect_one_physics<3>([](const auto& in) {
    using N = NumberOf<std::decay_t<decltype(in)>>;
    Results results;
    observables::over_harmonics<N>(in[0], {in[1], in[2]}, 8, [&](std::size_t, const N& real, const N& imaginary) {
      results.values.push_back(exact(real)), results.values.push_back(exact(imaginary));
    });
    results.size = 16;
    return results;
  });
}

}  // namespace
}  // namespace clatter::lanes::number_types_test
