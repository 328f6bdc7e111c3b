// Displacements and velocities in the absolute frame, in which the stops or the base move.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "sweep/mirror_images.hpp"
#include "sweep/shaken_scenes.hpp"

namespace clatter::sweep::frame_test {
namespace {

using Complex = std::complex<double>;
constexpr lanes::InstructionSet scalar = lanes::InstructionSet::scalar;

/// b e^{i theta} times the transfer from the base's displacement to the absolute one.
Complex transmitted(const Oscillator& o, double b) {
  const Complex i(0, 1);
  return b * (o.stiffness + 2.0 * i * o.damping * o.frequency) /
         (o.stiffness - o.frequency * o.frequency + 2.0 * i * o.damping * o.frequency);
}

TEST(AbsoluteFrame, gives_the_transmissibility_of_a_shaken_base) {
  for (const double stiffness : {1.0, 3.0})
    for (const double nu : {0.3, 0.97, 1.4, 6.0})
      for (const auto method : {observables::HarmonicsMethod::exact, observables::HarmonicsMethod::fft}) {
        point::Problem scene =
            shaken({.damping = 0.08, .frequency = nu, .stiffness = stiffness}, {.base = -0.3}, {-90, 90, 1, 1});
        scene.start.phase = 0.7;
        scene.observe.extrema = true;
        scene.observe.harmonics = 2, scene.observe.harmonics_method = method;
        const point::PointResult result = run(scene, Frame::absolute);
        const Units units = problem_at({.problem = scene}, 0).units;
        const Complex expected = transmitted(scene.oscillator, -0.3), phase = std::polar(1.0, 0.7) / Complex(0, 1);
        // k - nu^2 cancels to 30 ulps at nu = 0.97
        EXPECT_NEAR(result.x_max, std::abs(expected), 1e-13) << nu;
        EXPECT_NEAR(result.x_min, -std::abs(expected), 1e-13) << nu;
        EXPECT_NEAR(result.v_max * factor_of(units, Quantity::velocity), nu * std::abs(expected), 1e-13) << nu;
        const Complex first = std::polar(result.x_spectrum.amplitude[1], result.x_spectrum.phase[1]);
        EXPECT_LT(std::abs(first - expected * phase), 1e-13) << nu;
        const Complex speed = std::polar(result.v_spectrum.amplitude[1], result.v_spectrum.phase[1]);
        EXPECT_LT(std::abs(speed * factor_of(units, Quantity::velocity) - Complex(0, nu) * expected * phase), 1e-12);
        EXPECT_LT(result.x_spectrum.amplitude[2], 1e-14);
      }
}

TEST(AbsoluteFrame, has_the_free_response_to_the_force_between_shaken_stops_that_are_not_met) {
  for (const double nu : {0.4, 1.7}) {
    point::Problem scene =
        shaken({.damping = 0.1, .forcing = 0.5, .frequency = nu, .load = 0.2}, {.stops = 0.4}, {-9, 9, 1, 1});
    scene.observe.extrema = true;
    const point::PointResult result = run(scene, Frame::absolute);
    const double amplitude = 0.5 / std::hypot(1 - nu * nu, 0.2 * nu);
    EXPECT_NEAR(result.x_max, 0.2 + amplitude, 1e-15);  // sums of terms near 1
    EXPECT_NEAR(result.x_min, 0.2 - amplitude, 1e-15);
    EXPECT_NEAR(result.v_max, nu * amplitude, 2e-15);
  }
}

TEST(AbsoluteFrame, moves_a_mass_at_rest_with_its_stop) {
  for (const double b : {0.3, -0.3})
    for (const double f : {0.0, 0.2}) {
      point::Problem scene =
          shaken({.damping = 0.1, .forcing = f, .frequency = 1.3, .load = 9}, {.stops = b}, {-1, 2, 0.5, 0.5});
      scene.start = {2.0, 0.0, 0.4};
      scene.observe.extrema = scene.observe.impacts = true;
      const point::PointResult result = run(scene, Frame::absolute);
      EXPECT_EQ(result.rest_fraction[1], 1.0);
      EXPECT_EQ(result.x_min, 2 - 0.3);
      EXPECT_EQ(result.x_max, 2 + 0.3);
      EXPECT_EQ(result.v_min, -0.3 * 1.3);
      EXPECT_EQ(result.v_max, 0.3 * 1.3);
    }
}

TEST(AbsoluteFrame, has_the_ends_of_a_short_rest) {
  point::Problem scene = shaken({.frequency = 1.0, .load = 9}, {.base = 0.5}, {-1, 2, 0.5, 0.5});
  scene.start = {2.0, 0.0, 0.4};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 0.3;
  scene.observe.extrema = true;
  const point::PointResult result = run(scene, Frame::absolute);
  EXPECT_DOUBLE_EQ(result.x_min, 2 + 0.5 * std::sin(0.4));
  EXPECT_DOUBLE_EQ(result.x_max, 2 + 0.5 * std::sin(0.7));
  EXPECT_DOUBLE_EQ(result.v_max, 0.5 * std::cos(0.4));
  EXPECT_DOUBLE_EQ(result.v_min, 0.5 * std::cos(0.7));
}

TEST(AbsoluteFrame, carries_a_mass_on_which_no_force_is_left) {
  // b nu^2 = -f: the mass comes to rest on its base
  point::Problem scene = shaken({.damping = 0.3, .forcing = -2, .frequency = 2}, {.base = 0.5}, {-1, 1, 0.5, 0.5});
  scene.start.velocity = 1;
  ASSERT_EQ(problem_at({.problem = scene}, 0).oscillator.forcing, 0.0);
  scene.observe.extrema = true;
  const point::PointResult result = run(scene, Frame::absolute);
  EXPECT_DOUBLE_EQ(result.x_max, 0.5);
  EXPECT_DOUBLE_EQ(result.x_min, -0.5);
  EXPECT_DOUBLE_EQ(result.v_max, 1.0);
}

TEST(AbsoluteFrame, adds_the_motion_of_the_frame_to_each_sample) {
  for (std::uint64_t index = 0; index < 20; ++index) {
    point::Problem scene = any_shaken(index);
    scene.observe.trajectory = 50;
    if (index % 3 == 0) scene.time = {};  // steady
    const point::PointResult relative = run(scene, Frame::relative), absolute = run(scene, Frame::absolute);
    ASSERT_EQ(relative.tau, absolute.tau);
    const double b = scene.shaking.stops + scene.shaking.base, nu = scene.oscillator.frequency;
    for (std::size_t i = 0; i < relative.x.size(); ++i) {
      const double theta = nu * relative.tau[i] + scene.start.phase;
      // the angle has 30 ulps over some periods, 4e3 over a window of motion without a period
      const double rounding = 1e-12 * std::abs(b) * (1 + nu);
      EXPECT_NEAR(absolute.x[i], relative.x[i] + b * std::sin(theta), rounding) << index;
      EXPECT_NEAR(absolute.v[i], relative.v[i] + b * nu * std::cos(theta), rounding) << index;
    }
  }
}

TEST(AbsoluteFrame, has_sections_at_the_phase_of_the_shaking) {
  point::Problem scene =
      shaken({.damping = 0.1, .forcing = 0.4, .frequency = 1.3}, {.stops = 0.3}, {-0.5, 1, 0.5, 0.5});
  scene.start.phase = 0.2;
  for (const double phase : {0.2, 1.0}) {  // that of the start is observed in lanes, the other one isn't
    scene.observe.section = 3, scene.observe.section_phase = phase;
    const Sweep sweep{.problem = scene};
    const results::Dataset relative = run(sweep, {.threads = 1}).dataset;
    scene.observe.frame = Frame::absolute;
    const results::Dataset absolute = run(Sweep{.problem = scene}, {.threads = 1}).dataset;
    EXPECT_EQ(values(absolute, "section_x")[0], values(relative, "section_x")[0] + 0.3 * std::sin(phase));
    EXPECT_EQ(values(absolute, "section_v")[0], values(relative, "section_v")[0] + 0.3 * 1.3 * std::cos(phase));
    scene.observe.frame = Frame::relative;
  }
}

TEST(AbsoluteFrame, moves_passages_on_which_no_force_acts_by_their_instants) {
  // f = 0, h = 0, nu = 1: x = 0.8 sin(tau) passes 0 upward at tau = 2 pi n, where the stops are at 0.3 sin(2)
  point::Problem scene = shaken({}, {.stops = 0.3}, {-2, 2, 1, 1});
  scene.start = {0.0, 0.8, 2.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
  scene.observe.section = 9;
  const point::PointResult result = run(scene, Frame::absolute);
  ASSERT_EQ(result.section_x.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.section_x[i], 0.3 * std::sin(2), 1e-14) << i;
    EXPECT_NEAR(result.section_v[i], 0.8 + 0.3 * std::cos(2), 1e-14) << i;
  }
}

TEST(AbsoluteFrame, changes_the_harmonics_by_those_of_the_shaking) {
  for (std::uint64_t index = 0; index < 40; ++index) {
    point::Problem scene = any_shaken(index);
    if (index % 2 == 0) scene.time = {};  // steady: whole periods
    scene.observe.harmonics = 4;
    std::array<Complex, 5> by_method[2];
    for (const auto method : {observables::HarmonicsMethod::fft, observables::HarmonicsMethod::exact}) {
      scene.observe.harmonics_method = method;
      const point::PointResult relative = run(scene, Frame::relative), absolute = run(scene, Frame::absolute);
      if (failed(relative.status)) continue;
      for (std::size_t k = 0; k < 5; ++k) {
        const auto change = [&](const observables::Spectrum& from, const observables::Spectrum& to) {
          const auto value = [k](const observables::Spectrum& s) {
            return k == 0 ? Complex(s.amplitude[0]) : std::polar(s.amplitude[k], s.phase[k]);
          };
          return value(to) - value(from);
        };
        by_method[method == observables::HarmonicsMethod::exact][k] = change(relative.x_spectrum, absolute.x_spectrum);
        if (index % 2 == 0) {
          const double b = scene.shaking.stops + scene.shaking.base, nu = scene.oscillator.frequency;
          const Complex expected = k == 1 ? b * std::polar(1.0, scene.start.phase) / Complex(0, 1) : Complex(0);
          const Complex x = change(relative.x_spectrum, absolute.x_spectrum),
                        v = change(relative.v_spectrum, absolute.v_spectrum);
          EXPECT_LT(std::abs(x - expected), 1e-11) << index << ' ' << k;  // sums over up to 64 periods
          EXPECT_LT(std::abs(v - Complex(0, nu) * expected), 1e-10) << index << ' ' << k;
        }
      }
    }
    // of a transient the samples have an error of 1/4096 of the jump from its end to its beginning
    const double b = std::abs(scene.shaking.stops + scene.shaking.base), error = index % 2 == 0 ? 1e-11 : 2 * b / 4096;
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_LT(std::abs(by_method[0][k] - by_method[1][k]), error) << index << ' ' << k;
  }
}

/// Everything that the frame doesn't decide.
point::Problem observing_much(point::Problem scene) {
  scene.time = {};
  scene.observe.extrema = scene.observe.impacts = scene.observe.period = scene.observe.energy = true;
  scene.observe.stability = scene.observe.word = scene.observe.impact_log = true;
  return scene;
}

Sweep over_amplitudes(point::Problem scene, Parameter amplitude) {
  scene.shaking = {};
  return sweep_of(scene, {{amplitude, {0.0, 0.05, 0.1, 0.3}}, {Parameter("nu"), {0.6, 0.9, 1.4, 2.2}}});
}

TEST(AbsoluteFrame, changes_nothing_but_displacements_and_velocities_of_the_mass) {
  for (const Parameter amplitude : {Parameter("stop_amplitude"), Parameter("base_amplitude")})
    for (const bool follows : {false, true})
      for (const lanes::InstructionSet arch : {scalar, lanes::widest_instruction_set()}) {
        point::Problem scene = observing_much(shaken({.damping = 0.1, .forcing = 0.4}, {}, {-0.5, 0.5, 0.7, 0.7}));
        Sweep sweep = over_amplitudes(scene, amplitude);
        if (follows) sweep.follow = 1;
        const results::Dataset relative = run(sweep, {.threads = 1, .arch = arch}).dataset;
        sweep.problem.observe.frame = Frame::absolute;
        const results::Dataset absolute = run(sweep, {.threads = 1, .arch = arch}).dataset;
        for (const std::string name :
             {"v_before", "v_after", "impact_speed", "impacts_per_period", "rest_fraction", "period", "work_in",
              "energy_residual", "impulse", "multiplier_re", "lyapunov", "impact_v_before", "symmetric"}) {
          const std::vector<double>&a = values(relative, name), &b = values(absolute, name);
          ASSERT_EQ(a.size(), b.size()) << name;
          // lanes observe the relative motion, the scalar loop the absolute one: to rounding the same
          for (std::size_t i = 0; i < a.size(); ++i) {
            if (std::isnan(a[i]) && std::isnan(b[i])) continue;
            EXPECT_NEAR(a[i], b[i], 1e-12 * (1 + std::abs(a[i]))) << name;
          }
        }
        EXPECT_EQ(statuses(relative), statuses(absolute));
        // the first row has the amplitude 0
        for (std::size_t i = 0; i < 16; ++i)
          EXPECT_EQ(values(relative, "x_max")[i] == values(absolute, "x_max")[i], i < 4) << i;
      }
}

TEST(AbsoluteFrame, is_observed_by_lanes_and_the_scalar_loop_alike) {
  point::Problem scene = shaken({.damping = 0.1, .forcing = 0.4}, {}, {-0.5, 0.5, 0.7, 0.7});
  scene.observe.frame = Frame::absolute;
  scene.observe.extrema = true;
  scene.observe.harmonics = 3, scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  const Sweep sweep = over_amplitudes(scene, Parameter("stop_amplitude"));
  const results::Dataset a = run(sweep, {.threads = 1}).dataset, b = run(sweep, {.threads = 1, .arch = scalar}).dataset;
  for (std::size_t i = 0; i < 16; ++i) {
    if (statuses(b)[i] != 0) continue;
    EXPECT_NEAR(values(a, "x_max")[i], values(b, "x_max")[i], 1e-11) << i;
    EXPECT_NEAR(values(a, "x_amplitude")[4 * i + 1], values(b, "x_amplitude")[4 * i + 1], 1e-11) << i;
  }
}

TEST(AbsoluteFrame, of_a_mirror_image_is_mirrored) {
  point::Problem scene =
      shaken({.damping = 0.1, .forcing = 0.4, .frequency = 0.8}, {.stops = 0.2}, {-0.5, 0.5, 0.7, 0.7});
  scene.observe.frame = Frame::absolute;
  scene.observe.extrema = true;
  const double half = pi<double>();
  const Sweep sweep = sweep_of(
      scene, {{Parameter("x0"), {-0.3, -0.1, 0.1, 0.3}}, {Parameter("phase"), {0.3, 1.1, 0.3 + half, 1.1 + half}}});
  ASSERT_TRUE(MirrorImages(sweep).exist());
  const results::Dataset all = run(sweep, {.threads = 1, .arch = scalar}).dataset;
  point::ThreadScratch scratch;
  for (std::size_t i = 0; i < size(sweep); ++i) {
    const point::PointResult alone = run_point(problem_at(sweep, i), scratch);
    EXPECT_NEAR(values(all, "x_min")[i], alone.x_min, 1e-11) << i;  // after a repeat to 1e-12
    EXPECT_NEAR(values(all, "v_max")[i], alone.v_max, 1e-11) << i;
  }
}

TEST(AbsoluteFrame, shows_the_states_of_attractors_at_phase_0) {
  point::Problem scene =
      shaken({.damping = 0.1, .forcing = 0.4, .frequency = 1.4}, {.base = 0.2}, {-0.5, 0.5, 0.7, 0.7});
  scene.observe.attractor = true;
  scene.oscillator.stiffness = 2;  // computed in other units of velocity
  Sweep sweep = sweep_of(scene, {{Parameter("v0"), {-1, -0.5, 0.5, 1}}});
  const results::Dataset relative = run(sweep, {.threads = 1}).dataset;
  sweep.problem.observe.frame = Frame::absolute;
  const results::Dataset absolute = run(sweep, {.threads = 1}).dataset;
  EXPECT_EQ(find(relative, "attractor")->values, find(absolute, "attractor")->values);
  EXPECT_EQ(values(relative, "motion_x"), values(absolute, "motion_x"));
  const std::vector<double>&a = values(relative, "motion_v"), &b = values(absolute, "motion_v");
  ASSERT_FALSE(a.empty());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i], a[i] + 0.2 * 1.4, 1e-15);
}

/// The attribute `frame` of a variable, empty if it has none.
std::string frame_of(const results::Dataset& dataset, const std::string& name) {
  const std::vector<results::Attribute>& attributes = find(dataset, name)->attributes;
  const auto found = std::ranges::find(attributes, "frame", &results::Attribute::first);
  return found == attributes.end() ? "" : std::get<std::string>(found->second);
}

TEST(AbsoluteFrame, is_named_by_the_variables_that_it_decides) {
  point::Problem scene = observing_much(shaken({.damping = 0.1, .forcing = 0.4}, {}, {-0.5, 0.5, 0.7, 0.7}));
  scene.observe.harmonics = 1, scene.observe.trajectory = 2, scene.observe.section = 2;
  scene.observe.attractor = scene.observe.settling = true;
  for (const Frame frame : {Frame::relative, Frame::absolute}) {
    scene.observe.frame = frame;
    Sweep sweep = sweep_of(scene, {{Parameter("stop_amplitude"), {0.0, 0.1}}, {Parameter("x0"), {0.0, 0.1}}});
    const results::Dataset dataset = run(sweep, {.threads = 1}).dataset;
    const std::string asked = frame == Frame::absolute ? "absolute" : "relative";
    for (const char* name : {"x_min", "x_max", "v_min", "v_max", "x_amplitude", "x_phase", "v_amplitude", "v_phase",
                             "x", "v", "section_x", "section_v", "motion_x", "motion_v"})
      EXPECT_EQ(frame_of(dataset, name), asked) << name;
    for (const char* name : {"x0", "v_before", "v_after", "impact_speed", "velocity_ratio", "impact_v_before",
                             "impact_v_after", "work_in", "loss_damping", "energy_residual"})
      EXPECT_EQ(frame_of(dataset, name), "relative") << name;
    for (const char* name : {"stop_amplitude", "status", "period", "impact_tau", "impulse", "loss_impact", "tau",
                             "impacts_per_period", "base_frequency", "multiplier_re", "settling_periods", "attractor"})
      EXPECT_EQ(frame_of(dataset, name), "") << name;
    sweep = sweep_of(scene, {{Parameter("x0"), {0.0, 0.1}}});
    const results::Dataset unshaken = run(sweep, {.threads = 1}).dataset;
    for (const results::Variable& variable : unshaken.variables)
      EXPECT_EQ(frame_of(unshaken, variable.name), "") << variable.name;
  }
}

}  // namespace
}  // namespace clatter::sweep::frame_test
