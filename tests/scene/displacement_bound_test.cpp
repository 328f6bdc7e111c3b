#include "scene/displacement_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/arc.hpp"
#include "support/random.hpp"

namespace clatter::displacement_bound_test {
inline namespace scene {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity(), ulp = std::numeric_limits<double>::epsilon();

/// An oscillator, its start, and a time in which it beats or fades.
struct Flight {
  Oscillator oscillator;
  double x, v, turns;
  double duration;

  [[nodiscard]] SineCosine<double> phase() const { return sine_cosine_of_turns(turns); }
  [[nodiscard]] PhaseState now() const { return {x - oscillator.load, v, phase().sine, phase().cosine}; }
  [[nodiscard]] double reach(double time = forever) const { return displacement_bound(oscillator, now(), time, 0.0); }
};

/// Calls see(s, |x - load|) at instants about a tenth of the fastest turn apart, in closed form without stops.
template <class See>
void fly(const Flight& flight, int most, See&& see) {
  const Oscillator& o = flight.oscillator;
  with_effects({.damping = damping_of(o), .forcing = forcing_of(o), .load = true}, [&]<Effects effects>() {
    const motion::ArcConstants<double, effects.arc()> constants(o);
    const auto [sine, cosine] = flight.phase();
    const double a = constants.acceleration(flight.x - o.load, flight.v, {sine, cosine});
    const motion::Arc<double, effects.arc()> arc(constants, {0, flight.x, flight.v, a, sine, cosine});
    const double fastest = std::max(o.frequency, 1.0), step = std::max(0.6 / fastest, flight.duration / most);
    for (double s = 0; s <= flight.duration; s += step) see(s, std::abs(arc.at(s).x - o.load));
  });
}

double any_damping(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.15) return 0;
  if (kind < 0.25) return 1 + random.sign() * random.logarithmic(1e-15, 1e-2);
  if (kind < 0.30) return 1;
  return kind < 0.4 ? random.logarithmic(1, 1e3) : random.logarithmic(1e-6, 1);
}

Flight any_flight(std::uint64_t i) {
  support::Random random(4711, i);
  const double h = any_damping(random), f = random.happens(0.15) ? 0 : random.sign() * random.logarithmic(1e-3, 1e3);
  const double nu =
      random.happens(0.3) ? 1 + random.sign() * random.logarithmic(1e-9, 0.1) : random.logarithmic(0.05, 20);
  const double load = random.happens(0.5) ? 0 : random.uniform(-3, 3);
  const bool rests = random.happens(0.2);
  const double x = rests ? 0 : random.sign() * random.logarithmic(1e-3, 1e3),
               v = rests ? 0 : random.sign() * random.logarithmic(1e-3, 1e3);
  return {{h, f, nu, load}, load + x, v, random.uniform(0, 1), random.logarithmic(1, 1e4)};
}

/// Bound of a displacement's rounding: an ulp of each of its parts, and of their phases an ulp of the angle turned by.
double rounding(const Flight& flight, double s) {
  const auto parts = transient_of(flight.oscillator, flight.now());
  const double size = norm(flight.x, flight.v) + std::abs(flight.oscillator.load);
  const double away = norm(parts.x, parts.v),
               response = std::isfinite(away) ? away : std::abs(flight.oscillator.forcing) * s;
  return 8 * ulp *
         (size +
          std::min(response, std::abs(flight.oscillator.forcing) * s) * (1 + (1 + flight.oscillator.frequency) * s));
}

TEST(Reach, no_motion_passes_it) {
  double tightest = 0, tight = 0, checked = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Flight flight = any_flight(i);
    const double reach = flight.reach();
    if (!std::isfinite(reach)) {
      EXPECT_TRUE(flight.oscillator.damping == 0 && flight.oscillator.frequency == 1.0) << i;
      continue;
    }
    double largest = 0;
    fly(flight, 1000, [&](double s, double x) {
      largest = std::max(largest, x);
      EXPECT_LE(x, reach + rounding(flight, s))
          << "flight " << i << " at " << s << ", h = " << flight.oscillator.damping
          << ", nu = " << flight.oscillator.frequency;
    });
    tightest = std::max(tightest, largest / reach), tight += largest > 0.8 * reach, ++checked;
  }
  EXPECT_GT(tightest, 1 - 1e-4);
  EXPECT_GT(tight / checked, 0.5);  // and most bounds are nearly reached
}

TEST(Reach, no_motion_passes_it_in_its_time) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Flight flight = any_flight(i);
    flight.duration = std::min(flight.duration, 300.0);
    if (i % 4 == 0) flight.oscillator.damping = 0, flight.oscillator.frequency = 1;  // then only time bounds it
    const double within = flight.reach(flight.duration);
    EXPECT_LE(within, flight.reach());
    fly(flight, 1000, [&](double s, double x) { EXPECT_LE(x, within + rounding(flight, s)) << "flight " << i; });
  }
}

TEST(Reach, of_free_undamped_motion_is_its_amplitude) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Flight flight = any_flight(i);
    flight.oscillator.damping = flight.oscillator.forcing = 0;
    const double amplitude = norm(flight.x - flight.oscillator.load, flight.v);
    EXPECT_GE(flight.reach(), amplitude);
    EXPECT_LE(flight.reach(), amplitude * (1 + 256 * ulp));
  }
}

TEST(Reach, of_resonance_grows_with_time) {
  // from rest x = -(f/2)(tau cos tau - sin tau): within |f| tau, of which it takes half
  for (const double f : {-3.0, 0.01}) {
    const Flight flight{{0.0, f, 1.0, 0.0}, 0.0, 0.0, 0.0, 0.0};
    EXPECT_EQ(flight.reach(), forever);
    for (const double tau : {0.1, 10.0, 1e6}) EXPECT_NEAR(flight.reach(tau) / (std::abs(f) * tau), 1.0, 256 * ulp);
  }
}

TEST(Reach, of_beats_is_within_a_few_percent) {
  // Fig. 20 from rest: response and transient begin as opposites, and add up only after the transient has faded
  double sum_of_parts = 0;
  for (int i = 0; i <= 100; ++i) {
    const Flight flight{{0.1, -1.0, 0.5 + i / 100.0, 0.0}, 0.0, 0.0, 0.0, 400.0};
    double largest = 0;
    fly(flight, 20000, [&](double, double x) { largest = std::max(largest, x); });
    EXPECT_LE(largest, flight.reach() * (1 + 16 * ulp));
    const double nu = flight.oscillator.frequency;  // a slow beat and its fast oscillation are at their crests together
    EXPECT_GE(largest, flight.reach() * (std::abs(nu - 1) <= 0.1 ? 0.97 : 0.88)) << nu;
    const auto whole = transient_of(flight.oscillator, flight.now());
    sum_of_parts = std::max(sum_of_parts, 2 * transient_bound(flight.oscillator, whole));
  }
  EXPECT_GT(sum_of_parts, 9.0);  // and the parts alone prove nothing
}

TEST(Reach, scales_with_every_length) {
  // x, v, f, load times a power of two: the same bits, however small or large
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Flight flight = any_flight(i);
    const double reach = flight.reach();
    for (const int power : {-900, -600, -20, 20, 600, 900}) {
      Flight other = flight;
      for (double* length : {&other.oscillator.forcing, &other.oscillator.load, &other.x, &other.v})
        *length = std::ldexp(*length, power);
      EXPECT_EQ(other.reach(), std::ldexp(reach, power)) << "flight " << i << ", 2^" << power;
    }
  }
}

TEST(Reach, is_no_sharper_than_asked_for) {
  const Flight flight{{0.1, -1.0, 1.0, 0.0}, 0.0, 0.0, 0.0, 0.0};
  EXPECT_LT(displacement_bound(flight.oscillator, flight.now(), forever, 6.0), 6.0);
  EXPECT_GT(displacement_bound(flight.oscillator, flight.now(), forever, 20.0),
            9.0);  // the sum of the parts is below 20
}

TEST(Reach, response_and_transient_make_up_the_motion) {
  // the transient and the response of amplitude |f| / sqrt(D) add up to the state (eq. 6), so steady motion has none
  for (const double h : {0.0, 1e-9, 0.1, 1.0, 30.0})
    for (const double nu : {1e-3, 0.5, 1 + 1e-9, 40.0}) {
      const double stiffness = (1 - nu) * (1 + nu), D = stiffness * stiffness + 4 * h * h * nu * nu;
      const double P = 2 * stiffness / D, Q = -2 * 2 * h * nu / D, amplitude = std::hypot(P, Q);
      for (const double turns : {0.0, 0.2, 0.7}) {
        const auto [sine, cosine] = sine_cosine_of_turns(turns);
        const PhaseState steady{P * sine + Q * cosine, nu * (P * cosine - Q * sine), sine, cosine};
        const auto left = transient_of({h, 2.0, nu, 0.0}, steady);
        EXPECT_NEAR(left.x, 0, 16 * ulp * amplitude);
        EXPECT_NEAR(left.v, 0, 16 * ulp * amplitude * nu);
      }
    }
}

TEST(Transient, stays_within_its_bound_and_the_decayed_bound) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Flight flight = any_flight(i);
    flight.oscillator.forcing = 0;
    flight.duration = std::min(flight.duration, 30 / std::max(flight.oscillator.damping, 0.1));
    const PhasePoint start = transient_of(flight.oscillator, flight.now());
    const double bound = transient_bound(flight.oscillator, start);
    EXPECT_LE(bound, norm(start.x, start.v));
    fly(flight, 200, [&](double s, double x) {
      EXPECT_LE(x, bound + rounding(flight, s)) << "flight " << i;
      EXPECT_LE(x, transient_bound(flight.oscillator, start, s) + rounding(flight, s))
          << "flight " << i << ", h = " << flight.oscillator.damping;
    });
  }
}

}  // namespace
}  // namespace scene
}  // namespace clatter::displacement_bound_test
