#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sweep/figures.hpp"
#include "sweep/run.hpp"

namespace clatter::attractors::basins_test {
namespace {

using results::Dataset;

/// The middles of n equal parts of -a ... a.
std::vector<double> middles(double a, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(-a + 2 * a * (i + 0.5) / n);
  return values;
}

point::Problem scene(double stop, double nu, double forcing) {
  point::Problem problem;
  problem.oscillator = {.damping = 0.1, .forcing = forcing, .frequency = nu};
  problem.stops = {-stop, stop, 0.7, 0.7};
  problem.observe.attractor = true;
  return problem;
}

Dataset basins_of(const point::Problem& problem, double x, double v, int n) {
  return run(sweep::sweep_of(problem, {{Parameter("x0"), middles(x, n)}, {Parameter("v0"), middles(v, n)}}), {})
      .dataset;
}

template <class T>
const std::vector<T>& of(const Dataset& dataset, const std::string& name) {
  return std::get<std::vector<T>>(results::find(dataset, name)->values);
}

/// Points that end in each motion, by its word.
std::map<std::string, std::int64_t> points_by_word(const Dataset& dataset) {
  std::map<std::string, std::int64_t> points;
  const auto& words = of<std::string>(dataset, "motion_word");
  for (std::size_t i = 0; i < words.size(); ++i) points[words[i]] += of<std::int64_t>(dataset, "motion_points")[i];
  return points;
}

/// Counted by an independent program from the same starts.
TEST(Basins, have_the_sizes_that_another_program_counts) {
  for (const auto& [nu, impacting] : {std::pair(2.0, 37375), std::pair(3.0, 21320)}) {
    const Dataset dataset = basins_of(scene(0.5, nu, 1.0), 0.5, 2.0, 200);
    const std::map<std::string, std::int64_t> expected{{"-", 40000 - impacting}, {"LU", impacting}};
    EXPECT_EQ(points_by_word(dataset), expected) << nu;
  }
}

/// The basins of the two are finely mixed, so that rounding decides where some starts end: of 14400 starts, lists of
/// their middles rounded in two ways differ in three.
TEST(Basins, of_a_mirror_pair_are_told_apart) {
  const Dataset dataset = basins_of(scene(3.0, 0.868, 1.0), 3.0, 6.0, 120);
  const auto points = points_by_word(dataset);
  ASSERT_EQ(points.size(), 2);
  EXPECT_NEAR(static_cast<double>(points.at("L")), 7623, 8);
  EXPECT_EQ(points.at("L") + points.at("U"), 14400);
  EXPECT_EQ(of<std::int64_t>(dataset, "motion_period_ratio"), (std::vector<std::int64_t>{2, 2}));
  EXPECT_EQ(of<std::int32_t>(dataset, "motion_mirror"), (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(of<double>(dataset, "motion_symmetric"), (std::vector<double>{0, 0}));
}

TEST(Basins, of_chaos_are_one_motion_until_it_splits_into_a_mirror_pair) {
  point::Problem problem = scene(3.0, 0.0, -1.0);
  problem.time.max_periods = 300;
  const Dataset dataset = run(sweep::sweep_of(problem, {{Parameter("nu"), {0.92, 0.93, 0.94, 0.95}},
                                                        {Parameter("x0"), middles(3, 12)},
                                                        {Parameter("v0"), middles(6, 12)}}),
                              {})
                              .dataset;
  EXPECT_EQ(of<std::int64_t>(dataset, "motion_count"), (std::vector<std::int64_t>{1, 1, 2, 2}));
  EXPECT_EQ(of<std::int64_t>(dataset, "motion_period_ratio"), (std::vector<std::int64_t>{0, 0, 0}));
  EXPECT_EQ(of<std::int32_t>(dataset, "motion_mirror"), (std::vector<std::int32_t>{0, 2, 1}));
  EXPECT_EQ(of<std::int64_t>(dataset, "motion_points")[0], 288);
  EXPECT_EQ(std::ranges::count(of<std::int32_t>(dataset, "attractor"), undecided), 0);
}

/// The steady response, and the symmetric motion with one impact on each stop, in closed form (Masri & Caughey 1966;
/// Shaw 1985): after an impact x = e^(-h t) (A cos + B sin) + P sin(nu t + psi), and half a period later the mirror
/// image of the same.
class ClosedForm {
 public:
  explicit ClosedForm(const point::Problem& problem) : p_(problem) {
    const double h = p_.oscillator.damping, nu = p_.oscillator.frequency;
    omega_ = std::sqrt(1 - h * h), half_ = M_PI / nu;
    const double re = 1 - nu * nu, im = 2 * h * nu;
    amplitude_ = std::abs(p_.oscillator.forcing) / std::hypot(re, im);
    lag_ = std::atan2(im, re) + (p_.oscillator.forcing < 0 ? M_PI : 0);
  }

  [[nodiscard]] PhasePoint response() const {
    return {amplitude_ * std::sin(-lag_), amplitude_ * p_.oscillator.frequency * std::cos(-lag_)};
  }

  /// The states at forcing phase 0 of both symmetric motions, as far as they are real and leave the stops inwards.
  [[nodiscard]] std::vector<PhasePoint> symmetric() const {
    const double h = p_.oscillator.damping, nu = p_.oscillator.frequency, s = p_.stops.upper;
    const double R = p_.stops.restitution_upper.R, e = std::exp(-h * half_);
    const double c = std::cos(omega_ * half_), sine = std::sin(omega_ * half_);
    const double b = -(1 + e * c) / (e * sine), d1 = -h + omega_ * b;
    const double d2 = e * (d1 * c - (h * b + omega_) * sine);
    const double g = (d2 - d1 / R) / (1 + 1 / R), q = 1 + g * g / (nu * nu);
    const double root = s * s - q * (s * s - amplitude_ * amplitude_);
    std::vector<PhasePoint> found;
    for (const double sign : {-1.0, 1.0}) {
      const double A = (s + sign * std::sqrt(root)) / q, speed = -A * (d1 + g);
      if (!(root >= 0) || !(speed > 0)) continue;
      const double psi = std::atan2(s - A, A * g / nu);
      double late = std::fmod(-(psi + lag_) / nu, 2 * half_);  // from the impact to forcing phase 0
      if (late < 0) late += 2 * half_;
      const double mirror = late < half_ ? 1 : -1, t = late < half_ ? late : late - half_, decay = std::exp(-h * t);
      const double co = std::cos(omega_ * t), si = std::sin(omega_ * t);
      const double x = decay * A * (co + b * si) + amplitude_ * std::sin(nu * t + psi);
      const double v = decay * A * (d1 * co - (h * b + omega_) * si) + amplitude_ * nu * std::cos(nu * t + psi);
      found.push_back({mirror * x, mirror * v});
    }
    return found;
  }

 private:
  const point::Problem& p_;
  double omega_ = 0, half_ = 0, amplitude_ = 0, lag_ = 0;
};

double distance(const PhasePoint& a, const PhasePoint& b) { return std::max(std::abs(a.x - b.x), std::abs(a.v - b.v)); }

TEST(Basins, of_bistable_motion_hold_both_closed_forms_under_two_numbers) {
  std::vector<double> nu;
  for (int i = 0; i <= 20; ++i) nu.push_back(1.15 + 0.03 * i);
  const point::Problem problem = scene(3.0, 0.0, -1.0);
  const Dataset dataset =
      run(sweep::sweep_of(
              problem, {{Parameter("nu"), nu}, {Parameter("x0"), middles(3, 16)}, {Parameter("v0"), middles(6, 16)}}),
          {})
          .dataset;
  ASSERT_EQ(of<std::string>(dataset, "motion_word"), (std::vector<std::string>{"-", "LU"}));
  EXPECT_EQ(of<double>(dataset, "motion_symmetric"), (std::vector<double>{1, 1}));
  const auto& counts = of<std::int64_t>(dataset, "motion_count");
  for (std::size_t i = 0; i < nu.size(); ++i) {
    // at each frequency the motions that a run of its own finds, with their states, are the closed forms
    const point::Problem at = scene(3.0, nu[i], -1.0);
    const ClosedForm closed(at);
    EXPECT_EQ(counts[i] == 2, !closed.symmetric().empty()) << nu[i];  // up to its fold
    const Dataset here = basins_of(at, 3.0, 6.0, 16);
    const auto& words = of<std::string>(here, "motion_word");
    ASSERT_EQ(words.size(), static_cast<std::size_t>(counts[i]));
    for (std::size_t m = 0; m < words.size(); ++m) {
      const PhasePoint state{of<double>(here, "motion_x")[m], of<double>(here, "motion_v")[m]};
      double nearest = distance(state, closed.response());
      if (words[m] != "-") {
        nearest = INFINITY;
        for (const PhasePoint& candidate : closed.symmetric()) nearest = std::min(nearest, distance(state, candidate));
      }
      EXPECT_LT(nearest, 1e-11) << nu[i] << ' ' << words[m];
    }
  }
  EXPECT_EQ(std::ranges::count(counts, 2), 10);
}

TEST(Basins, shares_have_the_intervals_of_clopper_and_pearson) {
  const Dataset dataset = basins_of(scene(3.0, 1.2, -1.0), 3.0, 6.0, 10);
  const auto& points = of<std::int64_t>(dataset, "motion_points");
  ASSERT_EQ(points.size(), 2);
  for (std::size_t m = 0; m < 2; ++m) {
    const auto k = static_cast<double>(points[m]);
    EXPECT_DOUBLE_EQ(of<double>(dataset, "motion_share")[m], k / 100);
    // the probability of so many or more points at the lower end is 2.5 %, of so many or fewer at the upper end too
    const auto tail = [](double p, double from, double to) {
      double sum = 0;
      for (double i = from; i <= to; ++i)
        sum += std::exp(std::lgamma(101) - std::lgamma(i + 1) - std::lgamma(101 - i) + i * std::log(p) +
                        (100 - i) * std::log1p(-p));
      return sum;
    };
    EXPECT_NEAR(tail(of<double>(dataset, "motion_share_low")[m], k, 100), 0.025, 1e-9);
    EXPECT_NEAR(tail(of<double>(dataset, "motion_share_high")[m], 0, k), 0.025, 1e-9);
  }
}

}  // namespace
}  // namespace clatter::attractors::basins_test
