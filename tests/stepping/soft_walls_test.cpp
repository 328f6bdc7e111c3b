// Soft walls of a loose mass: against an integrator of its own for both masses, closed forms, and general methods.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/walls.hpp"
#include "stepping/dormand_prince.hpp"
#include "stepping/moreau.hpp"
#include "support/loose_scenes.hpp"
#include "support/methods.hpp"
#include "support/random_machine.hpp"

namespace clatter::stepping::soft_walls_test {
namespace {

using support::Random;

/// Both masses under the forces of springs and dampers between them, and between the main one and soft stops, none of
/// which pulls: x, x', y and y' by Runge and Kutta's method of order 4 in steps that end where a force begins or ends.
class OwnIntegrator {
 public:
  using Real = long double;
  using State = std::array<Real, 4>;

  explicit OwnIntegrator(const point::Problem& scene) : scene_(scene) {}

  [[nodiscard]] State run(Real duration, Real step) const {
    const auto& start = scene_.start;
    State y{start.displacement, start.velocity, start.displacement + scene_.loose.place,
            start.velocity + scene_.loose.velocity};
    Real t = 0;
    while (t < duration) {
      const Real whole = std::min(step, duration - t);
      Acting acting = acting_in(y);
      Real low = 0, high = whole;
      State next = stepped(y, t, whole, acting);
      if (acting_in(next) != acting) {  // to the last instant before, and just beyond
        for (int i = 0; i < 70 && high - low > 1e-19L; ++i) {
          const Real middle = (low + high) / 2;
          (acting_in(stepped(y, t, middle, acting)) == acting ? low : high) = middle;
        }
        next = stepped(y, t, high, acting);
      }
      y = next, t += high;
    }
    return y;
  }

 private:
  /// Which of the springs push: both stops, both walls.
  using Acting = std::array<bool, 4>;
  struct Push {
    Real place, sign, stiffness, damper;

    [[nodiscard]] Real depth(Real at) const { return sign * (at - place); }
    [[nodiscard]] Real force(Real at, Real rate) const { return stiffness * depth(at) + damper * sign * rate; }
  };
  [[nodiscard]] std::array<Push, 4> pushes() const {
    const auto push = [](const Stops& of, Side side, Real mass) {
      const bool upper = side == Side::upper, soft = is_soft(of, side);
      const Real kappa = !soft   ? 0
                         : upper ? of.stiffness_upper
                                 : of.stiffness_lower,
                 zeta = upper ? of.damping_upper : of.damping_lower;
      return Push{upper ? of.upper : of.lower, Real(sign_of(side)), kappa, 2 * zeta * std::sqrt(kappa * mass)};
    };
    const Real ratio = scene_.loose.ratio, reduced = ratio / (1 + ratio);
    const Stops walls = walls_of(scene_.loose);
    return {push(scene_.stops, Side::lower, 1), push(scene_.stops, Side::upper, 1), push(walls, Side::lower, reduced),
            push(walls, Side::upper, reduced)};
  }
  [[nodiscard]] Acting acting_in(const State& y) const {
    Acting acting{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Real at = i < 2 ? y[0] : y[2] - y[0], rate = i < 2 ? y[1] : y[3] - y[1];
      acting[i] = pushes_[i].stiffness > 0 && pushes_[i].depth(at) > 0 && pushes_[i].force(at, rate) > 0;
    }
    return acting;
  }
  [[nodiscard]] State rate(const State& y, Real t, const Acting& acting) const {
    const auto& o = scene_.oscillator;
    std::array<Real, 4> push{};  // along x, and along z
    for (std::size_t i = 0; i < 4; ++i) {
      const Real at = i < 2 ? y[0] : y[2] - y[0], speed = i < 2 ? y[1] : y[3] - y[1];
      if (acting[i]) push[i] = pushes_[i].sign * pushes_[i].force(at, speed);
    }
    const Real between = push[2] + push[3];
    const Real drive = o.forcing * std::sin(Real(o.frequency) * t + Real(scene_.start.phase));
    return {y[1], drive + o.load - 2 * Real(o.damping) * y[1] - Real(o.stiffness) * y[0] - push[0] - push[1] + between,
            y[3], scene_.loose.load - between / scene_.loose.ratio};
  }
  [[nodiscard]] State stepped(const State& y, Real t, Real h, const Acting& acting) const {
    const auto plus = [](const State& a, Real c, const State& b) {
      State sum;
      for (std::size_t i = 0; i < 4; ++i) sum[i] = a[i] + c * b[i];
      return sum;
    };
    const State k1 = rate(y, t, acting), k2 = rate(plus(y, h / 2, k1), t + h / 2, acting),
                k3 = rate(plus(y, h / 2, k2), t + h / 2, acting), k4 = rate(plus(y, h, k3), t + h, acting);
    State next;
    for (std::size_t i = 0; i < 4; ++i) next[i] = y[i] + h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
    return next;
  }

  point::Problem scene_;
  std::array<Push, 4> pushes_ = pushes();
};

/// Makes the walls of a loose mass soft, both or one.
point::Problem with_soft_walls(point::Problem scene, Random& random) {
  LooseMass& loose = scene.loose;
  const bool both = random.happens(0.6);
  if (both || random.happens(0.5)) loose.stiffness_lower = random.logarithmic(1, 1000);
  if (both || std::isinf(loose.stiffness_lower)) loose.stiffness_upper = random.logarithmic(1, 1000);
  if (random.happens(0.7)) loose.damping_lower = random.uniform(0, 1.5);
  if (random.happens(0.7)) loose.damping_upper = random.uniform(0, 0.5);
  return scene;
}
/// A random machine without friction and rigid stops.
point::Problem smooth_machine(std::uint64_t index) {
  Random random(20911, index);
  point::Problem scene = with_soft_walls(support::random_machine(index), random);
  scene.friction = {}, scene.loose.friction = scene.loose.friction_static = 0;
  LooseMass& loose = scene.loose;
  for (double* const kappa :
       {&loose.stiffness_lower, &loose.stiffness_upper, &scene.stops.stiffness_lower, &scene.stops.stiffness_upper})
    if (std::isinf(*kappa)) *kappa = random.logarithmic(1, 1000);
  return scene;
}

TEST(SoftWalls, both_masses_move_as_an_integrator_of_its_own_says) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const point::Problem scene = smooth_machine(index);
    const accuracy::RunRecord run = accuracy::record_of(scene, 6);
    ASSERT_EQ(run.outcome, Outcome::completed) << index;
    const OwnIntegrator own(scene);
    const auto coarse = own.run(6, 2e-4L), fine = own.run(6, 1e-4L);
    const std::array got{run.x, run.v, run.x + run.z, run.v + run.w};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto error = static_cast<double>(std::abs(fine[i] - coarse[i]));  // fifteen times that of `fine`
      EXPECT_NEAR(got[i], static_cast<double>(fine[i]), error + 1e-11) << index << ' ' << i;
    }
  }
}

/// With rigid stops and both frictions, too, by a method that shares neither flights nor events.
TEST(SoftWalls, time_stepping_tends_to_the_exact_motion_in_proportion_to_the_step) {
  std::vector<double> coarse, fine;
  for (std::uint64_t index = 0; index < 100; ++index) {
    Random random(20912, index);
    const point::Problem scene = with_soft_walls(support::random_machine(index), random);
    const accuracy::RunRecord exact = accuracy::record_of(scene, 10);
    ASSERT_EQ(exact.outcome, Outcome::completed) << index;
    const auto error_of = [&](double steps) {
      point::Problem stepped = scene;
      stepped.integration.method = Method::moreau, stepped.integration.step = 1 / steps;
      const auto run = support::record_by<Moreau>(stepped, 10);
      EXPECT_EQ(run.outcome, Outcome::completed);
      return std::max(std::abs(run.x - exact.x), std::abs(run.z - exact.z));
    };
    coarse.push_back(error_of(1e3)), fine.push_back(error_of(3e4));
    if (fine.back() > 1e-3) {  // a motion that stretches differences, as near a graze
      EXPECT_LT(error_of(1e6), 0.3 * fine.back()) << index;
    }
  }
  const auto median = [](std::vector<double> errors) {
    std::ranges::nth_element(errors, errors.begin() + 50);
    return errors[50];
  };
  EXPECT_NEAR(std::log(median(coarse) / median(fine)) / std::log(30), 1, 0.1);
}

/// But for a few machines that stretch its errors, as near a graze.
TEST(SoftWalls, dormand_prince_comes_as_near_as_its_tolerance) {
  std::size_t far = 0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    point::Problem scene = smooth_machine(index);
    const accuracy::RunRecord exact = accuracy::record_of(scene, 6);
    scene.integration.method = Method::dopri5, scene.integration.tolerance = 1e-11;
    const auto run = support::record_by<DormandPrince>(scene, 6);
    ASSERT_EQ(run.outcome, Outcome::completed) << index;
    const double error = std::max(std::abs(run.x - exact.x), std::abs(run.z - exact.z));
    EXPECT_LT(error, 1e-5) << index;
    if (error > 1e-8) ++far;
  }
  EXPECT_LE(far, 5u);
}

/// Two free bodies that meet on a wall leave with the share R of their relative speed, and keep their momentum
/// (eq. 55).
TEST(SoftWalls, an_isolated_collision_leaves_the_share_of_the_speed_that_was_given) {
  for (const double R : {1.0, 0.9, 0.5, 0.1, 0.01}) {
    const double eps = 0.3, w = 0.7;
    point::Problem scene = support::loose_scene(eps, 0, 0, 1, 1, 1);
    scene.oscillator.stiffness = 0;
    scene.loose.stiffness_lower = scene.loose.stiffness_upper = 40;
    scene.loose.damping_upper = damping_ratio_of(R), scene.loose.velocity = w;
    const accuracy::RunRecord run = accuracy::record_of(scene, 1 / w + 1.5);
    EXPECT_NEAR(run.w, -R * w, 1e-14) << R;
    EXPECT_NEAR((1 + eps) * run.v + eps * run.w, eps * w, 1e-15) << R;
  }
}

/// The stiffer the wall, the nearer is it to a rigid one, by the time that a contact takes, but for scenes that a graze
/// makes differ by more.
TEST(SoftWalls, a_stiff_wall_is_nearly_rigid) {
  const std::array stiffnesses{1e6, 1e8, 1e10};
  std::array<std::vector<double>, 3> off;
  for (std::uint64_t index = 0; index < 41; ++index) {
    point::Problem rigid = support::random_loose_scene(index);
    rigid.loose.load = 0;
    const accuracy::RunRecord as_rigid = accuracy::record_of(rigid, 4);
    point::Problem soft = rigid;
    soft.loose.damping_lower = soft.loose.damping_upper = damping_ratio_of(rigid.loose.restitution_lower.R);
    for (std::size_t i = 0; i < stiffnesses.size(); ++i) {
      soft.loose.stiffness_lower = soft.loose.stiffness_upper = stiffnesses[i];
      const accuracy::RunRecord run = accuracy::record_of(soft, 4);
      off[i].push_back(std::abs(run.x - as_rigid.x) + std::abs(run.z - as_rigid.z));
    }
  }
  for (std::vector<double>& each : off) std::ranges::nth_element(each, each.begin() + 20);
  for (std::size_t i = 1; i < off.size(); ++i)
    EXPECT_NEAR(std::log10(off[i][20] / off[i - 1][20]), -1, 0.1) << stiffnesses[i];
}

/// Sections cut contacts anywhere.
TEST(SoftWalls, a_run_that_sections_cut_is_the_same_motion) {
  for (std::uint64_t index = 0; index < 100; ++index) {
    Random random(20913, index);
    point::Problem scene = with_soft_walls(support::random_machine(index), random);
    const accuracy::RunRecord whole = accuracy::record_of(scene, 6);
    const double cut = random.uniform(1, 5);
    const accuracy::RunRecord first = accuracy::record_of(scene, cut);
    point::Problem then = scene;
    then.start = {first.x, first.v, scene.start.phase + scene.oscillator.frequency * cut};
    then.loose.place = first.z, then.loose.velocity = first.w;
    const bool in_wall = first.z < scene.loose.lower || first.z > scene.loose.upper;
    if (in_wall || std::abs(first.w) < 1e-9 || std::abs(first.v) < 1e-9) continue;
    const accuracy::RunRecord rest = accuracy::record_of(then, 6 - cut);
    EXPECT_NEAR(rest.x, whole.x, 1e-8) << index;
    EXPECT_NEAR(rest.z, whole.z, 1e-8) << index;
  }
}

}  // namespace
}  // namespace clatter::stepping::soft_walls_test
