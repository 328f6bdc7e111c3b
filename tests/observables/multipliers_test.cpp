// The four multipliers of motion with a loose mass: a bifurcation in closed form, their product, and difference
// quotients.

#include "motion/linear_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "scene/response.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"

namespace clatter::observables::multipliers_test {
namespace {

using support::loose_scene;
using Exact = stepping::Exact<double, effect_sets::with_loose_mass(Damping::light, Forcing::secular)>;

constexpr double pi_ = std::numbers::pi;

/// The symmetric motion with two impacts a period (Masri & Caughey 1966), just after the one on the upper wall.
struct SymmetricMotion {
  double w = 0;  ///< z' before that impact
  double x = 0, v = 0, w_after = 0;
  double phase = 0;  ///< of the force, rad
};

/// The motion of the faster impacts: x and v after the impact are linear in w, and the response has the amplitude of
/// (6).
SymmetricMotion symmetric_motion(const point::Problem& scene) {
  const auto& [h, f, nu, load, k, shape, paces] = scene.oscillator;
  const double eps = scene.loose.ratio, s = scene.loose.upper, R = scene.loose.restitution_lower.R, half = pi_ / nu;
  const double c = eps * (1 + R) / (1 + eps), lambda = std::sqrt(1 - h * h), decay = std::exp(-h * half);
  const double B = decay * std::sin(lambda * half) / lambda, C = decay * std::cos(lambda * half) - h * B,
               A = C + 2 * h * B;
  const double determinant = (A + 1) * (C + 1) + B * B, u = -B * c / determinant, p = (A + 1) * c / determinant;
  const double v = -(1 - R - c) / 2, a = (1 + R - c) * half / 4 - u, b = (v - p) / nu;
  const auto response = steady_response(scene.oscillator);
  const double square = a * a + b * b,
               root = std::sqrt(a * s * (a * s) - square * (s * s - std::pow(response.amplitude, 2)));
  SymmetricMotion motion{.w = (a * s + root) / square};
  motion.x = (1 + R - c) * motion.w * half / 4 - s, motion.v = v * motion.w, motion.w_after = -R * motion.w;
  const std::complex<double> turned(b * motion.w, a * motion.w - s), of(response.in_phase, response.quadrature);
  motion.phase = std::arg(turned / of);
  return motion;
}

class Watch {
 public:
  explicit Watch(const point::Problem& scene) : tangent(scene) {}
  template <class A>
  void arc(const A& arc, double begin, double length) {
    tangent.arc(arc, begin, length);
  }
  void event(const motion::Event& event) {
    tangent.event(event);
    strikes += event.kind == motion::Event::Kind::strike, presses += event.kind == motion::Event::Kind::press;
  }

  motion::LooseTangent tangent;
  int strikes = 0, presses = 0;
};

TEST(Multipliers, the_closed_form_is_the_motion) {
  const point::Problem scene = support::impact_damper();
  EXPECT_NEAR(symmetric_motion(scene).w, support::impact_damper_speed, 1e-14);
  EXPECT_NEAR(std::abs(symmetric_motion(scene).x), 0.180585488325042, 1e-14);
}

/// A pair of multipliers leaves the unit circle: the symmetric motion has given way to a quasiperiodic one.
TEST(Multipliers, beyond_a_neimark_sacker_bifurcation_a_pair_is_outside_the_unit_circle) {
  point::Problem scene = loose_scene(0.05, 0.02, 0.3, 1.3, 1.9, 0.6);
  const SymmetricMotion start = symmetric_motion(scene);
  scene.start.phase = start.phase;
  Exact exact(scene);
  motion::State<double> state;
  state.x = start.x, state.v = start.v, state.loose = {Side::upper, 0.0, start.w_after};
  stepping::NoObserver none;
  ASSERT_EQ(exact.advance(state, 0.25, 0, none), stepping::Outcome::completed);
  const motion::State<double> quarter = state;
  Watch watch(scene);
  ASSERT_EQ(exact.advance(state, 1.0, 0, watch), stepping::Outcome::completed);
  state.phase_turns = 0, ++state.periods;
  ASSERT_EQ(exact.advance(state, 0.25, 0, watch), stepping::Outcome::completed);
  EXPECT_NEAR(state.x, quarter.x, 1e-13);
  EXPECT_NEAR(state.v, quarter.v, 1e-13);
  EXPECT_NEAR(state.loose.speed, quarter.loose.speed, 1e-13);
  EXPECT_EQ(watch.strikes, 2);
  const auto multipliers = motion::multipliers_of(watch.tangent.mantissa());
  EXPECT_EQ(watch.tangent.exponent(), 0);
  EXPECT_NEAR(std::abs(multipliers[0]), 1.056775, 1e-6);
  EXPECT_GT(std::abs(multipliers[0].imag()), 0.01);
  EXPECT_EQ(multipliers[1], std::conj(multipliers[0]));
  const std::complex<double> product = multipliers[0] * multipliers[1] * multipliers[2] * multipliers[3];
  EXPECT_NEAR(product.real(), std::exp(-2 * 0.02 * 2 * pi_ / 1.3) * std::pow(0.6, 4), 1e-13);
}

/// The derivative of the motion for a time by its start, and by difference quotients of the motion itself.
TEST(Multipliers, the_tangent_is_that_of_difference_quotients) {
  struct Case {
    point::Problem scene;
    double turns;
    bool presses;
  };
  point::Problem light = loose_scene(0.3, 0.04, 0.5, 1.2, 0.5, 0.7), sticking = loose_scene(0.4, 0.1, 0.4, 0.6, 1, 0.3);
  light.start.velocity = 0.1, light.loose.velocity = 0.4, light.loose.load = 0.1;
  sticking.loose.load = -0.3, sticking.loose.lower = -0.1, sticking.loose.velocity = 0.05;
  for (const Case& of : {Case{light, 1.3, false}, Case{sticking, 2.2, true}}) {
    const auto run = [&](const std::array<double, 4>& change, auto& observer) {
      point::Problem scene = of.scene;
      scene.start.displacement += change[0], scene.start.velocity += change[1];
      scene.loose.place += change[2] - change[0], scene.loose.velocity += change[3] - change[1];
      Exact exact(scene);
      motion::State<double> state = support::start_of(scene);
      EXPECT_EQ(run_for(exact, state, of.turns, observer), stepping::Outcome::completed);
      const auto [z, w] = motion::place_in_housing(state, scene.loose);
      return std::array{state.x, state.v, state.x + z, state.v + w};
    };
    Watch watch(of.scene);
    (void)run({}, watch);
    EXPECT_GT(watch.strikes, 1);
    EXPECT_EQ(watch.presses > 0, of.presses);
    constexpr double step = 1e-6;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> change{};
      stepping::NoObserver none;
      change[i] = step;
      const auto up = run(change, none);
      change[i] = -step;
      const auto down = run(change, none);
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_NEAR(watch.tangent.mantissa()[j][i], (up[j] - down[j]) / (2 * step), 1e-6) << of.presses << i << j;
    }
  }
}

/// Motion that strikes nothing is neutral: the loose mass may be anywhere, and drift.
TEST(Multipliers, without_impacts_the_loose_mass_is_neutral) {
  const auto result = support::observed(loose_scene(0.02, 0.05, 0.02, 1, 0.9, 0.8));
  ASSERT_EQ(result.status, steady::Status::periodic);
  EXPECT_EQ(result.impact_word, "-");
  const double decay = std::exp(-0.05 * 2 * pi_);
  EXPECT_NEAR(result.multiplier_re[0], 1, 1e-7);  // a double root
  EXPECT_NEAR(result.multiplier_re[1], 1, 1e-7);
  EXPECT_NEAR(std::hypot(result.multiplier_re[2], result.multiplier_im[2]), decay, 1e-14);
  EXPECT_NEAR(result.lyapunov, 0, 1e-8);
}

}  // namespace
}  // namespace clatter::observables::multipliers_test
