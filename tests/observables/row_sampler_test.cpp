#include "observables/harmonics/row_sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/arc_bounds.hpp"
#include "observables/arc_of.hpp"
#include "observables/contacts/impact_log_observer.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "observables/harmonics/fourier_transform.hpp"
#include "observables/runs.hpp"
#include "support/random.hpp"

namespace clatter::observables::row_sampler_test {
namespace {

/// The motion of an oscillator at instants equally far apart: the powers of the exponential of the matrix of x, v, the
/// sine and the cosine of the phase, and 1.
class MotionByMatrix {
 public:
  using Vector = std::array<FiftyDigits, 5>;
  using Matrix = std::array<Vector, 5>;

  MotionByMatrix(const Oscillator& o, const motion::Motion<double>& from, double spacing)
      : state_{from.x, from.v, from.sine, from.cosine, 1} {
    Matrix rates{};
    rates[0][1] = 1;
    rates[1] = {-FiftyDigits(o.stiffness), -2 * FiftyDigits(o.damping), o.forcing, 0, o.load};
    rates[2][3] = o.frequency, rates[3][2] = -FiftyDigits(o.frequency);
    step_ = exponential(rates, spacing);
  }
  [[nodiscard]] double x() const { return static_cast<double>(state_[0]); }
  [[nodiscard]] double v() const { return static_cast<double>(state_[1]); }
  void advance() { state_ = product(step_, state_); }

 private:
  static Vector product(const Matrix& a, const Vector& b) {
    Vector c{};
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < c.size(); ++j) c[i] += a[i][j] * b[j];
    return c;
  }
  static Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t k = 0; k < c.size(); ++k)
        for (std::size_t j = 0; j < c.size(); ++j) c[i][j] += a[i][k] * b[k][j];
    return c;
  }
  /// By its series at a time 2^-20 as long, whose 24 terms leave out 1e-60, and squaring.
  static Matrix exponential(const Matrix& rates, double time) {
    constexpr int halvings = 20;
    Matrix sum{}, term{};
    for (std::size_t i = 0; i < 5; ++i) sum[i][i] = term[i][i] = 1;
    for (int n = 1; n <= 24; ++n) {
      term = product(rates, term);
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j)
          term[i][j] *= FiftyDigits(time) / (n * std::ldexp(1.0, halvings)), sum[i][j] += term[i][j];
    }
    for (int i = 0; i < halvings; ++i) sum = product(sum, sum);
    return sum;
  }

  Matrix step_;
  Vector state_;
};

constexpr double beyond = 12345;  ///< behind the rows

double any_damping(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.15) return 0;
  if (kind < 0.25) return 1 + random.sign() * random.logarithmic(1e-12, 1e-2);
  return random.logarithmic(1e-4, 30);
}

double any_stiffness(support::Random& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.6) return 1;
  if (kind < 0.7) return 0;
  return kind < 0.8 ? -random.logarithmic(1e-2, 1) : random.logarithmic(0.1, 10);
}

/// Damping and springs of all kinds, with and without a force or a load, also at resonance.
Oscillator any_oscillator(support::Random& random) {
  const double h = any_damping(random), f = random.happens(0.2) ? 0 : random.sign() * random.logarithmic(0.1, 3);
  const double nu =
      random.happens(0.2) ? 1 + random.sign() * random.logarithmic(1e-12, 0.05) : random.logarithmic(0.1, 9);
  return {h, f, nu, random.happens(0.5) ? 0 : random.uniform(-1, 1), any_stiffness(random)};
}

TEST(RowSampler, samples_lie_on_arcs_of_all_kinds) {
  constexpr std::size_t count = 600;  // two evaluations, rows, and a part of a row at the end
  double worst_x = 0, worst_v = 0;
  for (std::uint64_t index = 0; index < 120; ++index) {
    support::Random random(1024, index);
    const Oscillator o = any_oscillator(random);
    with_any_stops(o, [&]<Effects effects>() {
      const motion::ArcConstants<double, effects.arc()> constants(o);
      const auto arc = arc_of(constants, random.uniform(-2, 2), random.uniform(-2, 2));
      // a multiple of 2^-20, so that instants are exact
      const double length = random.logarithmic(1, 60) / constants.rate;
      const double spacing = std::max(1.0, std::round(std::ldexp(length / count, 20))) * 0x1p-20;
      std::vector<double> x(count + 1, beyond), v(count + 1, beyond);
      RowSampler samples({x.data(), count}, {v.data(), count}, spacing, {});
      samples.arc(arc, 0.0, count * spacing);
      ASSERT_TRUE(samples.is_complete());
      EXPECT_EQ(samples.evaluations(), count);
      EXPECT_TRUE(x.back() == beyond && v.back() == beyond);
      MotionByMatrix exact(o, arc.start(), spacing);
      for (std::size_t i = 0; i < count; ++i, exact.advance()) {
        const double s = static_cast<double>(i) * spacing, rate = constants.rate;
        const double size =
            std::abs(arc.start().x) + std::abs(constants.equilibrium) + reach(constants, arc.start(), s);
        const double ulps = std::numeric_limits<double>::epsilon() * (8 + s * rate);
        worst_x = std::max(worst_x, std::abs(x[i] - exact.x()) / (ulps * size));
        worst_v = std::max(
            worst_v, std::abs(v[i] - exact.v()) / (ulps * (std::abs(arc.start().v) + size * std::max(1.0, rate))));
      }
    });
  }
  EXPECT_LT(worst_x, 0.3);  // the argument of a sine rounds to its ulps; if all samples are evaluated they take 0.46
  EXPECT_LT(worst_v, 0.25);
}

TEST(RowSampler, makes_steps_anew_for_another_oscillator) {
  constexpr Effects effects = effect_sets::of_any_stiffness(Damping::light, Forcing::secular).arc();
  const motion::ArcConstants<double, effects> soft({0.1, 1.0, 1.7, 0.3, 0.8}), stiff({0.1, 1.0, 1.7, 0.3, 30.0});
  std::vector<double> x(200), v(200);
  RowSampler samples(x, v, 0x1p-5, {});
  const auto first = arc_of(soft, 0.4, -1.0), second = arc_of(stiff, 0.2, 0.7);
  samples.arc(first, 0.0, 3.0), samples.arc(second, 3.0, 4.0);
  ASSERT_TRUE(samples.is_complete());
  for (std::size_t i = 0; i < 200; ++i) {
    const double tau = static_cast<double>(i) * 0x1p-5;
    EXPECT_NEAR(x[i], tau < 3 ? first.at(tau).x : second.at(tau - 3).x, 1e-14) << i;
    EXPECT_NEAR(v[i], tau < 3 ? first.at(tau).v : second.at(tau - 3).v, 1e-13) << i;
  }
}

TEST(RowSampler, samples_stay_between_the_stops) {
  std::vector<double> x(100000), v(100000);
  const point::Problem scene = paper_scene(0.5, 0.7, 1.0);
  std::optional<RowSampler> samples;
  observe(scene, [&](double total, auto run) {
    samples.emplace(x, v, total / 100000, scene.stops);
    const auto end = run(*samples);
    samples->finish(end.x, end.v, total, true);
  });
  EXPECT_GE(*std::ranges::min_element(x), -0.5);
  EXPECT_LE(*std::ranges::max_element(x), 0.5);
}

TEST(RowSampler, transforms_differ_from_exact_harmonics_by_what_is_aliased) {
  // the transform of N samples has X_j + sum X_{j + mN} over m other than 0, and |X_n| <= J/(T (w^2 - 1)), w = 2 pi
  // n/T, J being the sum of the jumps of the velocity; in V, with the mean at jumps, they sum to a sawtooth of up to pi
  constexpr std::size_t count = 1024, highest = 5;
  const FourierTransform transform(count);
  const auto workspace = transform.workspace();
  int periodic = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    support::Random random(7, index);
    point::Problem scene = paper_scene(random.uniform(0.2, 1), random.uniform(0.5, 0.9), random.uniform(0.5, 1.5));
    scene.oscillator.damping = random.logarithmic(0.03, 0.8), scene.oscillator.load = random.uniform(-0.3, 0.3);
    const auto rows = transform.samples(*workspace);
    std::optional<RowSampler> samples;
    std::optional<ExactHarmonics> exact;
    ImpactLog::Observer log;
    motion::State<double> end;
    const double total = observe(scene, [&](double length, auto run) {
      samples.emplace(rows[0], rows[1], length / count, scene.stops),
          exact.emplace(highest, 2 * std::numbers::pi / length);
      end = run(*samples, *exact, log);
      samples->finish(end.x, end.v, length, true), exact->finish(end.x, length);
    });
    if (!(std::abs(end.x - rows[0][0]) < 1e-9) || log.impacts().empty()) continue;
    ++periodic;
    double jumps = 0;
    for (const LoggedImpact& impact : log.impacts()) jumps += std::abs(impact.after - impact.before);
    const double w = 2 * std::numbers::pi / total * (count - highest), pi = std::numbers::pi;
    const auto sums = transform.transform(*workspace);
    for (std::size_t j = 0; j <= highest; ++j) {
      const double by_x = std::abs(sums[0][j] / static_cast<double>(count) - exact->displacement()[j]),
                   by_v = std::abs(sums[1][j] / static_cast<double>(count) - exact->velocity()[j]);
      EXPECT_LT(by_x, jumps / total / (w * w - 1) * pi * pi / 3) << index << ", j = " << j;
      EXPECT_LT(by_v, jumps / total / w * pi * 1.05) << index << ", j = " << j;
    }
  }
  EXPECT_GE(periodic, 30);
}

}  // namespace
}  // namespace clatter::observables::row_sampler_test
