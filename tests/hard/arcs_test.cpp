// The closed form of free and forced motion against 50 digits, also if its terms are huge and cancel.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "math/fifty_digits.hpp"
#include "math/number.hpp"
#include "support/motion.hpp"
#include "support/random.hpp"
#include "support/scene_range.hpp"

namespace clatter::hard::arcs_test {
namespace {

struct ArcScene {
  Oscillator oscillator;
  support::ArcStart start;
  double s;  ///< length of the arc: at most a forcing period, as in every run
};

/// Everything log-uniform: h from 1e-300 to 1e3 and to both sides of 1, nu from 1e-6 to 1e6 and to both sides of 1 down
/// to an ulp, lengths from 1e-12 to 1e12 and forces, loads and speeds a thousand times more or less.
ArcScene random_arc(std::uint64_t index) {
  support::Random random(20234, index);
  const double kind = random.uniform(0, 1), ulp = epsilon<double>();
  const double h = kind < 0.1    ? 0
                   : kind < 0.3  ? random.logarithmic(1e-300, 1e-3)
                   : kind < 0.5  ? random.logarithmic(1e-3, 1)
                   : kind < 0.75 ? 1 + random.sign() * random.logarithmic(ulp, 0.1)
                                 : random.logarithmic(1, 1e3);
  const double nu =
      random.happens(0.5) ? random.logarithmic(1e-6, 1e6) : 1 + random.sign() * random.logarithmic(ulp, 0.1);
  const double gap = random.logarithmic(1e-12, 1e12), period = 2 * pi<double>() / nu;
  const auto beside = [&] { return random.sign() * gap * random.logarithmic(1e-3, 1e3); };
  ArcScene scene;
  scene.oscillator = {h, random.happens(0.1) ? 0 : beside(), nu, random.happens(0.5) ? 0 : beside()};
  scene.start = {gap * random.uniform(-1, 1), beside(), random.uniform(0, 1)};
  scene.s = random.logarithmic(std::min(1e-9, period / 1e3), period);
  return scene;
}

/// Errors of displacement, velocity, acceleration and offset, each over its natural scale: the size that start, load
/// and force can give it in the time of the arc under its damping.
struct ArcError {
  double x, v, a, offset;

  [[nodiscard]] double largest() const { return std::max({x, v, a, offset}); }
};

ArcError error_of(const ArcScene& scene) {
  const auto& [o, start, s] = scene;
  const auto rounded = motion_after<double>(o, start, s);
  const auto exact = motion_after<FiftyDigits>(o, start, s);
  const auto size = [](const FiftyDigits& y) { return static_cast<double>(abs(y)); };
  const double h = o.damping, nu = o.frequency, x0 = std::abs(start.x), v0 = std::abs(start.v), f = std::abs(o.forcing),
               load = std::abs(o.load), acting = std::min({s, 1.0, 0.5 / h});  // the time a speed or a force acts
  const double response = f * std::min(1 / std::hypot((1 - nu) * (1 + nu), 2 * h * nu), s * s / 2);
  const double moved = v0 * acting + response, x = std::max(x0, size(exact.x)) + load + moved,
               v = v0 + size(exact.v) + (x0 + load + f) * acting, a = x + f + 2 * h * v,
               offset = moved + std::max(size(exact.offset), (x0 + load) * std::min(s * s / 2, 1.0));
  return {size(rounded.x - exact.x) / x, size(rounded.v - exact.v) / v, size(rounded.a - exact.a) / a,
          size(rounded.offset - exact.offset) / offset};
}

std::ostream& operator<<(std::ostream& out, const ArcScene& scene) {
  const auto& [o, start, s] = scene;
  return out << std::setprecision(17) << "h = " << o.damping << ", f = " << o.forcing << ", nu = " << o.frequency
             << ", load = " << o.load << ", x0 = " << start.x << ", v0 = " << start.v << ", phase = " << start.turns
             << " turns, after " << s;
}

TEST(Arcs, agree_with_fifty_digits_on_random_scenes) {
  const support::SceneRange range = support::scene_range(50'000);
  double worst = 0;
  std::uint64_t worst_index = range.from;
  for (std::uint64_t index = range.from; index < range.to; ++index) {
    const ArcScene scene = random_arc(index);
    const double error = error_of(scene).largest();
    EXPECT_LE(error, 1e-12) << "scene " << index << ": " << scene;
    if (!(error <= worst)) worst = error, worst_index = index;
  }
  std::cout << "largest error " << worst << ", scene " << worst_index << ": " << random_arc(worst_index) << '\n';
}

TEST(Arcs, keep_the_phase_of_the_free_motion_over_a_million_turns) {
  for (double h : {0.0, 1e-300, 1e-9, 1e-7})
    EXPECT_LT(error_of({{h, 0.0, 1e-6, 0.0}, {1.0, 0.5, 0.0}, 6e6}).largest(), 1e-14) << "h = " << h;
}

}  // namespace
}  // namespace clatter::hard::arcs_test
