#include "observables/stability/stability_observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/fifty_digits.hpp"
#include "observables/contacts/impacts_observer.hpp"
#include "observables/runs.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::observables::stability_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), ulp = std::numeric_limits<double>::epsilon();

/// The stability of a scene's periodic motion, and what it rests on.
struct Judged {
  Stability::Observer stability;
  Impacts::Observer impacts{};
  double total = 0.0;
};

Judged judged(const point::Problem& scene, bool autonomous = false) {
  Judged result{Stability::Observer(scene.stops, 64 * ulp)};
  result.total = observe(scene, [&](double total, auto&& run) {
    run(result.stability, result.impacts);
    result.stability.finish_period(total, autonomous);
  });
  return result;
}

TEST(Stability, of_the_symmetric_motion_is_that_of_its_closed_form) {
  // check 5: half-period multipliers -0.4418798438, -0.5915842696 of -Phi S: these to ten digits, the squares to as
  // many
  const Judged found = judged(paper_scene(0.5, 0.7, 1.0));
  EXPECT_NEAR(found.stability.first().real(), 0.349971948059, 1e-10);
  EXPECT_NEAR(found.stability.second().real(), 0.195257796329, 1e-10);
  EXPECT_EQ(found.stability.first().imag(), 0);
  EXPECT_NEAR(found.stability.lyapunov(), std::log(0.349971948059) / (2 * pi<double>()), 1e-10);
}

TEST(Stability, multipliers_lose_by_damping_and_restitution_alone) {
  // their product is R^(2n) e^(-2hT), whatever the motion; ten of each kind of it
  int complex = 0, real = 0;
  for (const double xs : {0.3, 0.5, 0.6, 4.0})
    for (const double nu : {0.7, 0.85, 1.0, 1.1, 1.25}) {
      const Judged found = judged(paper_scene(xs, 0.7, nu));
      const double n = found.impacts.stops()[0].count + found.impacts.stops()[1].count;
      if (!(std::abs(found.stability.first()) < 1) || n == 0 || found.impacts.stops()[0].rest_time > 0) continue;
      const double expected = std::pow(0.7, 2 * n) * std::exp(-2 * 0.1 * found.total);
      const auto product = found.stability.first() * found.stability.second();
      // the orbit is known to its tolerance of 1e-14, the determinant doesn't depend on it
      EXPECT_NEAR(product.real() / expected, 1, 32 * ulp * (n + 2)) << "xs " << xs << ", nu " << nu;
      EXPECT_NEAR(product.imag() / expected, 0, 32 * ulp);
      ++(found.stability.first().imag() != 0 ? complex : real);
    }
  EXPECT_GE(complex, 3);
  EXPECT_GE(real, 3);
}

point::Problem linear_scene(double h, double nu) {
  point::Problem scene;
  scene.oscillator = {h, 1.0, nu, 0.0};
  return scene;
}

TEST(Stability, without_impacts_multipliers_are_those_of_free_motion) {
  // e^{(-h +- i lambda) T}
  for (const double h : {0.001, 0.1, 0.7})
    for (const double nu : {0.3, 0.5, 1.2, 10.0}) {
      const Judged found = judged(linear_scene(h, nu));
      const double T = 2 * pi<double>() / nu, lambda = std::sqrt((1 - h) * (1 + h));
      const std::complex<double> expected = std::exp(std::complex<double>(-h * T, lambda * T));
      const double allowed = 16 * ulp * (1 + T) / std::abs(std::sin(lambda * T));  // where the two are nearly one
      EXPECT_NEAR(found.stability.first().real() / std::abs(expected), expected.real() / std::abs(expected), allowed);
      EXPECT_NEAR(std::abs(found.stability.first().imag()), std::abs(expected.imag()), allowed);
      EXPECT_EQ(found.stability.second(), std::conj(found.stability.first()));
      EXPECT_NEAR(found.stability.lyapunov() / -h, 1, 16 * ulp / (h * T));
    }
}

TEST(Stability, of_heavy_damping_is_its_two_decays) {
  // e^{-slow T}, e^{-fast T} with slow = 1/(h + sqrt(h^2 - 1)): the smaller keeps its digits beside the larger
  for (const double h : {1.5, 3.0, 5.0})
    for (const double nu : {0.5, 1.0, 4.0}) {
      const Judged found = judged(linear_scene(h, nu));
      const double T = 2 * pi<double>() / nu, fast = h + std::sqrt((h - 1) * (h + 1));
      EXPECT_NEAR(found.stability.lyapunov() * -fast, 1, 1e-13);
      EXPECT_NEAR(std::log(found.stability.second().real()) / -(fast * T), 1, 1e-13) << "h " << h << ", nu " << nu;
    }
}

TEST(Stability, of_slow_forcing_is_still_the_damping) {
  // what a period of 2 pi/nu leaves of a change is below the smallest double; its exponent is still -h
  for (const double h : {0.2, 0.9}) EXPECT_NEAR(judged(linear_scene(h, 1e-3)).stability.lyapunov(), -h, 1e-12);
}

TEST(Stability, of_arcs_of_any_length) {
  // one arc of up to 1e300 decays, its tangent map made by squaring: the exponent is the slower rate of decay
  const struct {
    double h, nu, rate;
  } cases[] = {{0.5, 1e-12, 0.5}, {0.5, 1e-300, 0.5}, {1e6, 1e-3, 1 / (1e6 + std::sqrt(1e12 - 1))}};
  for (const auto& [h, nu, rate] : cases) {
    point::Problem scene = paper_scene(10, 0.7, nu);
    scene.oscillator.damping = h;
    // the angle of a long arc is known to an ulp of it, which the logarithm of its map hardly feels
    EXPECT_NEAR(judged(scene).stability.lyapunov() / -rate, 1, 1e-9) << "h " << h << ", nu " << nu;
  }
}

TEST(Stability, a_stop_that_is_touched_without_speed_changes_nothing) {
  const Judged found = judged(conservative_scene(1.0, 1.0), true);
  EXPECT_EQ(found.stability.first(), 1.0);
  EXPECT_EQ(found.stability.second(), 1.0);
  motion::TangentMap<double> tangent({-1, 1, 0.7, 0.7});
  tangent.event({.side = Side::upper, .time = 1, .place = 1});
  EXPECT_EQ(tangent.map(), (motion::Jacobian<double>{1, 0, 0, 1}));
}

TEST(Stability, nothing_is_left_of_a_change_after_a_rest) {
  point::Problem scene;
  scene.oscillator = {0.1, 1.0, 0.5, 0.0};
  for (const double R : {0.0, 0.2}) {
    scene.stops = {-0.5, 0.5, R, R};
    const Judged found = judged(scene);
    ASSERT_GT(found.impacts.stops()[1].rest_time, 0);
    EXPECT_EQ(found.stability.first(), 0.0);
    EXPECT_EQ(found.stability.second(), 0.0);
    EXPECT_EQ(found.stability.lyapunov(), -infinity);
  }
}

TEST(Stability, of_conservative_motion_is_neutral) {
  // a shift along the motion stays, and no area is lost: both multipliers are 1
  for (const double V : {0.8, 1.5, 30.0}) {
    const Judged found = judged(conservative_scene(0.749, V), true);
    for (const auto& multiplier : {found.stability.first(), found.stability.second()})
      EXPECT_NEAR(std::abs(multiplier - 1.0), 0, 32 * ulp);
    EXPECT_NEAR(found.stability.lyapunov() * found.total, 0, 32 * ulp);
  }
}

/// Fig. 23's chaos: runs for a number of periods from a state under the eyes of an observer.
template <class Number>
class Chaos {
 public:
  Chaos() : integrator_(paper_scene(3.0, 0.7, 0.95)) {}

  template <class Observer>
  motion::State<Number> after(motion::State<Number> state, int periods, Observer& observer) {
    EXPECT_EQ(run_for(integrator_, state, Number(periods), observer), stepping::Outcome::completed);
    return state;
  }
  [[nodiscard]] Number length(int periods) const { return integrator_.period() * periods; }

 private:
  stepping::Exact<Number, effect_sets::complete(Damping::light, Forcing::secular)> integrator_;
};

TEST(Stability, of_chaos_is_the_growth_of_the_distance_of_neighbouring_runs) {
  // in 50 digits a distance of 1e-40 grows as a derivative would; both runs start on the attractor
  Chaos<double> chaos;
  stepping::NoObserver nobody;
  motion::State<double> start = chaos.after({}, 300, nobody);
  start.periods = 0;
  for (const int periods : {1, 10, 40}) {
    Stability::Observer stability(paper_scene(3.0, 0.7, 0.95).stops, 64 * ulp);
    (void)chaos.after(start, periods, stability);
    stability.finish_window(chaos.length(periods));
    Chaos<FiftyDigits> exact;
    const FiftyDigits step("1e-40");
    const auto from = [&](const FiftyDigits& dx, const FiftyDigits& dv) {
      motion::State<FiftyDigits> state;
      state.x = start.x + dx, state.v = start.v + dv;
      return exact.after(state, periods, nobody);
    };
    const auto end = from(0, 0), by_x = from(step, 0), by_v = from(0, step);
    const FiftyDigits a = (by_x.x - end.x) / step, b = (by_v.x - end.x) / step, c = (by_x.v - end.v) / step,
                      d = (by_v.v - end.v) / step;
    const FiftyDigits square = a * a + b * b + c * c + d * d, area = 2 * abs(a * d - b * c);
    const FiftyDigits stretch = (sqrt(FiftyDigits(square + area)) + sqrt(FiftyDigits(square - area))) / 2;
    const double expected = static_cast<double>(FiftyDigits(log(stretch) / exact.length(periods)));
    // the run in doubles leaves that in 50 digits by a rounding times the stretch, which bends the derivative as much
    EXPECT_NEAR(stability.lyapunov(), expected, 1e-9 * (1 + static_cast<double>(stretch) * 1e-6)) << periods;
  }
}

TEST(Stability, of_chaos_is_positive_and_overflows_in_no_number_of_periods) {
  Chaos<double> chaos;
  stepping::NoObserver nobody;
  motion::State<double> state = chaos.after({}, 300, nobody);
  std::vector<double> exponents;
  Stability::Observer whole(paper_scene(3.0, 0.7, 0.95).stops, 64 * ulp);
  constexpr int pieces = 10, periods = 1000;
  for (int i = 0; i < pieces; ++i) {
    Stability::Observer piece(paper_scene(3.0, 0.7, 0.95).stops, 64 * ulp);
    motion::Together both(whole, piece);
    state = chaos.after(state, periods, both);
    piece.finish_window(chaos.length(periods));
    exponents.push_back(piece.lyapunov());
  }
  whole.finish_window(chaos.length(pieces * periods));
  const double total = chaos.length(pieces * periods);
  EXPECT_GT(whole.lyapunov() * total, 2 * std::log(std::numeric_limits<double>::max()));  // no double holds the stretch
  double mean = 0;
  for (const double exponent : exponents) {
    EXPECT_GT(exponent, 0);
    mean += exponent / pieces;
  }
  EXPECT_LE(whole.lyapunov(), mean + 1e-12);         // a product stretches no more than its factors
  EXPECT_NEAR(whole.lyapunov(), mean, 3e-3 * mean);  // and hardly less: their directions are forgotten in a few periods
  EXPECT_FALSE(std::isfinite(whole.first().real()));  // no period, no multipliers
}

TEST(Stability, of_a_fading_motion_underflows_in_no_number_of_periods) {
  stepping::Exact<double, effect_sets::free_of_stops(Damping::light, Forcing::regular)> integrator(
      linear_scene(0.1, 0.8));
  Stability::Observer stability({}, 64 * ulp);
  motion::State<double> state;
  constexpr int periods = 20000;  // e^{-15708}
  ASSERT_EQ(run_for(integrator, state, double(periods), stability), stepping::Outcome::completed);
  const double total = integrator.period() * periods;
  stability.finish_window(total);
  EXPECT_NEAR(stability.lyapunov(), -0.1, std::log(1.2) / total);  // a rotation, seen as an ellipse of axes 1 +- h
}

}  // namespace
}  // namespace clatter::observables::stability_test
