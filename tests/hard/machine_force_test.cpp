// The simulator of `machine.hpp` under forces of each shape, against closed forms.

#include "hard/machine_force.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "hard/machine.hpp"
#include "hard/machine_checks.hpp"

namespace clatter::hard::machine_force_test {
namespace {

using namespace machine_checks;

/// Each shape, with some duties and rises.
std::vector<MachineScene> each_shape() {
  std::vector<MachineScene> scenes{{.shape = ForceShape::sine},
                                   {.shape = ForceShape::triangle},
                                   {.shape = ForceShape::sawtooth},
                                   {.shape = ForceShape::trapezoid, .rise = 0.5},
                                   {.shape = ForceShape::trapezoid, .rise = 0.125},
                                   {.shape = ForceShape::trapezoid, .rise = 1e-9}};
  for (const ForceShape shape : {ForceShape::square, ForceShape::pulse, ForceShape::half_sine})
    for (const double duty : {0.5, 0.1, 0.9, 1.0}) scenes.push_back({.shape = shape, .duty = duty});
  scenes.push_back({.shape = ForceShape::table, .table = {{0, 0.5, -0.25}, {0.125, 1, 1}, {0.625, -0.5, 0.75}}});
  scenes.push_back({.shape = ForceShape::table, .table = {{0, 1, -1}}});
  scenes.push_back({.shape = ForceShape::orders, .waves = {{1, 0.5, 0.1}, {3, -0.2, 0.3}, {8, 0.1, 0}}});
  return scenes;
}
/// The shape at a share of the period, 0 ... 1.
Real shape_at(const MachineScene& scene, Real share) {
  const Real duty = scene.duty, risen = share < 0.75L ? share + 0.25L : share - 0.75L;
  const Real triangle = risen < 0.5L ? 4 * risen - 1 : 3 - 4 * risen;
  switch (scene.shape) {
    case ForceShape::sine:
      return std::sin(2 * pi * share);
    case ForceShape::square:
      return share < duty ? 1 : -1;
    case ForceShape::pulse:
      return share < duty ? 1 : 0;
    case ForceShape::triangle:
      return triangle;
    case ForceShape::trapezoid:
      return std::max(-1.0L, std::min(1.0L, triangle / (2 * Real(scene.rise))));
    case ForceShape::sawtooth:
      return 2 * share - 1;
    case ForceShape::half_sine:
      return share < duty ? std::sin(pi * share / duty) : 0;
    case ForceShape::table: {
      const auto& rows = scene.table;
      std::size_t i = rows.size() - 1;
      while (rows[i].share > share) --i;
      const Real from = rows[i].share, until = i + 1 < rows.size() ? rows[i + 1].share : 1.0,
                 end = i + 1 < rows.size() ? rows[i + 1].before : rows[0].before;
      return std::lerp(Real(rows[i].after), end, (share - from) / (until - from));
    }
    case ForceShape::orders: {
      Real sum = 0;
      for (const auto& [order, sine, cosine] : scene.waves)
        sum += sine * std::sin(2 * pi * order * share) + cosine * std::cos(2 * pi * order * share);
      return sum;
    }
  }
  return 0;
}

TEST(PeriodicForce, has_the_values_of_its_shape_at_each_time_from_each_phase) {
  for (MachineScene scene : each_shape()) {
    scene.forcing = 2, scene.frequency = 1.7;
    for (int i = -12; i < 12; ++i) {
      scene.phase = 0.77 * i;
      machine::PeriodicForce force(scene);
      for (int sixteenths = 0; sixteenths < 144; ++sixteenths) {
        const machine::Quad time = machine::Quad(sixteenths) / 16;
        while (force.knot() <= time) force.reached(force.knot());
        const Real turns = (scene.frequency * static_cast<Real>(time) + scene.phase) / (2 * pi);
        const Real expected = 2 * shape_at(scene, turns - std::floor(turns));
        const Real found = static_cast<Real>(force.at(time)), rounding = scene.rise < 1e-8 ? 1e-9L : 1e-17L;
        expect_near(found, expected, rounding);
        const machine::Quad step = std::min(machine::Quad(0.125), force.knot() - time);
        expect_near(static_cast<Real>(machine::jet(force.series(time, step), machine::Quad(0.5)).first),
                    static_cast<Real>(force.at(time + step / 2)), 1e-18L);
      }
    }
  }
}

// Without stops.

/// Where a shape jumps and bends, by shares of the period: by how much s, its slope by the share, and what is as the
/// beginning of a sine.
struct Change {
  Real share, jump = 0, bend = 0, sine = 0;
};
/// The changes of a period that begins at phase 0.
std::vector<Change> changes_of(const MachineScene& scene, bool is_first) {
  const Real duty = scene.duty, rise = scene.rise, steep = 2 / rise;
  switch (scene.shape) {
    case ForceShape::sine:
    case ForceShape::orders:
      break;
    case ForceShape::square:
      return {{.share = 0, .jump = is_first ? 1.0L : 2.0L}, {.share = duty, .jump = -2}};
    case ForceShape::pulse:
      return {{.share = 0, .jump = 1}, {.share = duty, .jump = -1}};
    case ForceShape::triangle:
      return {{.share = 0, .bend = is_first ? 4.0L : 0.0L}, {.share = 0.25L, .bend = -8}, {.share = 0.75L, .bend = 8}};
    case ForceShape::trapezoid:
      return {{.share = 0, .bend = is_first ? steep : 0.0L},
              {.share = rise / 2, .bend = -steep},
              {.share = (1 - rise) / 2, .bend = -steep},
              {.share = (1 + rise) / 2, .bend = steep},
              {.share = 1 - rise / 2, .bend = steep}};
    case ForceShape::sawtooth:
      return {{.share = 0, .jump = is_first ? -1.0L : -2.0L, .bend = is_first ? 2.0L : 0.0L}};
    case ForceShape::half_sine:
      return {{.share = 0, .sine = 1}, {.share = duty, .sine = 1}};
    case ForceShape::table: {
      const auto& rows = scene.table;
      std::vector<Change> changes;
      const auto slope = [&](std::size_t i) {
        const Real until = i + 1 < rows.size() ? rows[i + 1].share : 1.0;
        return (Real(i + 1 < rows.size() ? rows[i + 1].before : rows[0].before) - rows[i].after) /
               (until - rows[i].share);
      };
      for (std::size_t i = 0; i < rows.size(); ++i)
        changes.push_back({.share = rows[i].share,
                           .jump = rows[i].after - (i == 0 && is_first ? 0 : Real(rows[i].before)),
                           .bend = slope(i) - (i > 0      ? slope(i - 1)
                                               : is_first ? 0
                                                          : slope(rows.size() - 1))});
      return changes;
    }
  }
  return {};
}
/// x of x'' + 2h x' + x, from rest at 0, after a jump of the force by 1, a bend by 1, or the beginning of sin(p t).
struct Answers {
  Real h, p;
  [[nodiscard]] Real to_jump(Real t) const {
    const Real w = std::sqrt(1 - h * h);
    return 1 - std::exp(-h * t) * (std::cos(w * t) + h / w * std::sin(w * t));
  }
  [[nodiscard]] Real to_bend(Real t) const {
    const Real w = std::sqrt(1 - h * h);
    return t - 2 * h + std::exp(-h * t) * (2 * h * std::cos(w * t) + (2 * h * h - 1) / w * std::sin(w * t));
  }
  [[nodiscard]] Real to_sine(Real t) const {
    const std::complex<Real> r(-h, std::sqrt(1 - h * h)), i(0, 1);
    const Real amplitude = 1 / std::abs(1 - p * p + 2 * h * p * i), lag = std::arg(1 - p * p + 2 * h * p * i);
    const Real x = amplitude * std::sin(lag), v = -amplitude * p * std::cos(lag);  // of the part that fades
    return amplitude * std::sin(p * t - lag) + (std::complex(x, -(v + h * x) / r.imag()) * std::exp(r * t)).real();
  }
};

TEST(Machine, answers_each_jump_and_bend_of_the_force) {
  for (MachineScene scene : each_shape()) {
    if (scene.shape == ForceShape::sine || scene.shape == ForceShape::orders) continue;
    scene.damping = 0.1, scene.forcing = 1, scene.frequency = 0.8;
    const Real period = 2 * pi / scene.frequency;
    const Answers answers{scene.damping, scene.frequency / (2 * Real(scene.duty))};
    for (const double time : {0.5, 3.0, 7.0, 20.0, 33.0}) {
      Real x = 0;
      for (int n = 0; n * period < time; ++n)
        for (const auto& [share, jump, bend, sine] : changes_of(scene, n == 0)) {
          const Real t = time - (Real(n) + share) * period;
          if (t > 0) x += jump * answers.to_jump(t) + bend / period * answers.to_bend(t) + sine * answers.to_sine(t);
        }
      const Real rounding = scene.rise < 1e-8 ? 1e-9L : 1e-15L;
      expect_near(run_of(scene, time).x, x, rounding);
    }
  }
}

TEST(Machine, answers_a_sum_of_sines_by_the_sum_of_its_answers) {
  const MachineScene scene{.damping = 0.1, .forcing = 1.3, .frequency = 0.8, .phase = 0.4};
  for (const int order : {2, 5}) {
    const double turned = order * scene.phase;
    MachineScene both = scene, alone = scene;
    both.shape = ForceShape::orders, both.waves = {{1, 1, 0}, {order, 0.3, -0.2}};
    alone.frequency *= order, alone.phase = turned + std::atan2(-0.2, 0.3), alone.forcing *= std::hypot(0.3, 0.2);
    for (const double time : {0.5, 7.0, 33.0})
      expect_near(run_of(both, time).x, run_of(scene, time).x + run_of(alone, time).x, 1e-14L);
  }
}

/// x = f/k + Re C e^(r tau) in the first half, r = -h + i w, and the same of -x in the other one:
/// C (1 + e^(r T/2)) has the real part -2f/k, and with r before it none.
TEST(Machine, settles_on_the_periodic_answer_to_a_square_wave) {
  const MachineScene scene{
      .damping = 0.125, .stiffness = 2, .forcing = 1.5, .frequency = 0.8, .shape = ForceShape::square, .x = 1, .v = -1};
  const Real h = 0.125, k = 2, f = 1.5, w = std::sqrt(k - h * h), period = 2 * pi / Real(0.8);
  const std::complex<Real> r(-h, w),
      C = -2 * f / k * std::complex<Real>(1, -h / w) / (1.0L + std::exp(r * period / 2.0L));
  for (const Real share : {0.0L, 0.1L, 0.3L, 0.45L}) {
    const std::complex<Real> part = C * std::exp(r * share * period);
    const MachineRun first = run_of(scene, (60 + share) * period), second = run_of(scene, (60.5L + share) * period);
    expect_near(first.x, f / k + part.real(), 1e-13L), expect_near(first.v, (r * part).real(), 1e-13L);
    expect_near(second.x, -first.x, 1e-13L), expect_near(second.v, -first.v, 1e-13L);
  }
}

/// Without a spring each period begins at rest, -f T^2/6 further: x'' = f (2 t/T - 1).
TEST(Machine, drifts_under_a_sawtooth) {
  const MachineScene scene{
      .stiffness = 0, .forcing = 2, .frequency = static_cast<double>(2 * pi), .shape = ForceShape::sawtooth};
  const MachineRun run = run_of(scene, 8.5);
  expect_near(run.x, 2 * (-8 / 6.0L + 1 / 24.0L - 1 / 8.0L), 1e-14L), expect_near(run.v, -0.5L, 1e-14L);
}

}  // namespace
}  // namespace clatter::hard::machine_force_test
