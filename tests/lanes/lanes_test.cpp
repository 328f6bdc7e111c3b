// Points in SIMD lanes against the same points in the scalar loop.

#include <gtest/gtest.h>

#include "lanes/alike.hpp"
#include "support/scene_range.hpp"

namespace clatter::lanes::lanes_test {
namespace {

/// Every test, for every instruction set that this machine has.
class InLanes : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
  [[nodiscard]] results::Dataset lanes(const sweep::Sweep& sweep, int threads = 1) const {
    return run(sweep, {.threads = threads, .arch = GetParam()}).dataset;
  }
};

sweep::Sweep figure(double xs) {
  sweep::Axis nu{Parameter("nu"), {}};
  for (int i = 0; i <= 500; ++i)
    if (xs != 5 || i != 250) nu.values.push_back(0.5 + i / 500.0);  // that one grazes to 3e-16: rounding decides
  return sweep::sweep_of(observed(sweep::paper_scene(xs, 1.0)), {nu});
}

TEST_P(InLanes, figures_20_to_23_are_those_of_the_scalar_loop) {
  for (const double xs : {6.0, 5.0, 4.0, 3.0}) {
    const Totals totals = expect_alike(figure(xs), GetParam());
    EXPECT_EQ(totals.fit, totals.points);
    EXPECT_GT(totals.periodic, 450u);
    EXPECT_LE(totals.sensitive + totals.chaotic,
              totals.points - totals.periodic + 4);  // hardly any of them has a period
    EXPECT_EQ(totals.slow, 0u);
  }
}

TEST_P(InLanes, long_chaotic_transients_end_in_the_same_motion) {
  // motion of period 3 beside a chaotic saddle, which starts that hardly differ leave after some 900 forcing periods
  point::Problem scene = observed(sweep::paper_scene(2.19231, 0.827759));
  scene.time.max_periods = 20000;
  sweep::Axis x0{Parameter("x0"), {}};
  for (int i = 0; i < 48; ++i) x0.values.push_back(1e-11 * i);
  const results::Dataset dataset = lanes(sweep::sweep_of(scene, {x0}));
  const std::vector<double> ratio = values(dataset, "period_ratio"), periods = values(dataset, "simulated_periods"),
                            v_max = values(dataset, "v_max"), v_min = values(dataset, "v_min");
  std::size_t late = 0;
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    EXPECT_EQ(ratio[i], 3) << i;
    EXPECT_NEAR(std::max(v_max[i], -v_min[i]), std::max(v_max[0], -v_min[0]), 1e-11) << i;  // mirrored or not
    late += periods[i] > 600 ? 1 : 0;
  }
  EXPECT_GT(late, 10u);
}

template <class Change>
sweep::Sweep random_sweep(std::uint64_t count, const Change& change) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = 0; i < count; ++i) scenes.push_back(change(random_scene(i)));
  return sweep::sweep_over(scenes);
}

TEST_P(InLanes, random_steady_motion_is_that_of_the_scalar_loop) {
  const Totals totals = expect_alike(random_sweep(1000, observed), GetParam());
  EXPECT_GT(totals.fit, 800u);
  EXPECT_GT(totals.periodic, 800u);
  EXPECT_LT(totals.sensitive, 50u);
  EXPECT_LT(totals.chaotic, 80u);
  EXPECT_LT(totals.slow, 10u);
}

TEST_P(InLanes, a_few_periods_from_any_start_are_those_of_the_scalar_loop) {
  // one duration for all, so that it ends in different parts of their forcing periods
  const Totals totals = expect_alike(random_sweep(1000,
                                                  [](const point::Problem& scene) {
                                                    point::Problem one = transient(scene, 1);
                                                    one.time.duration = 20;
                                                    return one;
                                                  }),
                                     GetParam());
  EXPECT_LT(totals.sensitive + totals.chaotic, 150u);
}

TEST_P(InLanes, fifty_periods_and_a_part_are_those_of_the_scalar_loop) {
  sweep::Axis nu{Parameter("nu"), {}};
  for (int i = 0; i < 100; ++i) nu.values.push_back(0.4 + i / 25.0);
  for (const double part : {0.0, 1e-9, 0.37, 1 - 1e-9}) {
    point::Problem scene = transient(sweep::paper_scene(0.5, 1.3), 50 + part);
    scene.oscillator.damping = 0.3;
    const Totals totals = expect_alike(sweep::sweep_of(scene, {nu}), GetParam());
    EXPECT_LT(totals.sensitive + totals.chaotic, 50u);
  }
}

/// A slow force presses the mass onto near stops: completed chatter, rest, release.
std::vector<point::Problem> chattering() {
  std::vector<point::Problem> scenes;
  for (const double nu : {0.05, 0.2, 0.5})
    for (const double xs : {0.05, 0.2, 0.5})
      for (const double R : {0.07, 0.2, 0.5, 0.9}) {
        point::Problem scene = sweep::paper_scene(xs, nu);
        scene.stops.restitution_lower = R, scene.stops.restitution_upper = std::sqrt(R);
        scenes.push_back(observed(scene));
        scene.stops.lower = -std::numeric_limits<double>::infinity();
        scenes.push_back(observed(scene));
      }
  return scenes;
}

TEST_P(InLanes, motion_clear_of_its_stops_for_good_is_taken_to_its_end_at_once) {
  // the response stays within 2.5 of the load's equilibrium; the transient of the start meets the stops before
  sweep::Axis nu{Parameter("nu"), {}}, x0{Parameter("x0"), {-2.9, 0.3, 2.5}}, load{Parameter("load"), {0.0, 0.2}};
  for (int i = 0; i < 40; ++i) nu.values.push_back(i % 2 == 0 ? 0.4 + i / 100.0 : 1.25 + i / 50.0);
  point::Problem scene = sweep::paper_scene(3.0, 1.0);
  scene.start.velocity = 3.0;
  scene = transient(scene, 400.37);
  const sweep::Sweep sweep{.problem = scene, .dimensions = {{nu}, {x0}, {load}}, .follow = {}};
  const Totals totals = expect_alike(sweep, GetParam());
  EXPECT_EQ(totals.sensitive + totals.chaotic, 0u);
  const sweep::RunResult result = run(sweep, {.threads = 1, .arch = GetParam()});
  const std::vector<double>& impacts = results::values(result.dataset, "impacts_per_period");
  EXPECT_GT(std::ranges::count_if(impacts, [](double n) { return n > 0; }), 100);
  double periods = 0;
  for (const sweep::WorkStats& part : result.work) periods += part.periods;
  EXPECT_LT(result.lanes.proved, periods);  // steps, of which a period has three at least
}

TEST_P(InLanes, chatter_rest_and_release_are_those_of_the_scalar_loop) {
  std::vector<point::Problem> scenes = chattering();
  EXPECT_LE(expect_alike(sweep::sweep_over(scenes), GetParam()).chaotic, 2u);
  for (point::Problem& scene : scenes) {
    scene = transient(scene, 1);
    scene.time.duration = 123.4;
  }
  EXPECT_EQ(expect_alike(sweep::sweep_over(scenes), GetParam()).chaotic, 0u);
}

TEST_P(InLanes, grazes_and_near_misses_are_those_of_the_scalar_loop) {
  // the steady response has this amplitude; stops a little farther away are missed, those a little nearer are hit
  // softly
  const double amplitude = 0.777909841584413976;
  std::vector<point::Problem> scenes;
  for (const double gap : {1e-14, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2})
    for (const double sign : {-1.0, 1.0}) {
      point::Problem scene = sweep::paper_scene(amplitude * (1 + sign * gap), 1.5);
      scene.oscillator.forcing = 1, scene.start = {-0.181543116490166415, -1.13464447806354009, 0.0};
      scenes.push_back(transient(scene, 20.25));
    }
  const sweep::Sweep sweep = sweep::sweep_over(scenes);
  const results::Dataset lanes = InLanes::lanes(sweep), scalar = run(sweep, {.arch = InstructionSet::scalar}).dataset;
  Totals totals;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const sweep::RunPoint point{lanes, i};
    EXPECT_LE(beyond(scenes[i], point, {scalar, i}, totals), 1) << support::configuration_of(scenes[i], 0);
    if (i % 2 == 1) {
      EXPECT_EQ(point.of("impacts_per_period"), (std::vector<double>{0, 0})) << i;
    }
  }
  EXPECT_LE(totals.chaotic, 4u);  // each impact divides a change by the root of the gap
}

double impacts_of(const point::Problem& scene, InstructionSet arch) {
  const results::Dataset dataset = sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = arch}).dataset;
  return static_cast<double>(std::get<std::vector<std::int64_t>>(find(dataset, "impact_total")->values)[0]);
}

TEST_P(InLanes, a_budget_of_impacts_ends_the_same_transients) {
  for (const auto& [xs, nu] : {std::pair{0.5, 1.3}, {0.5, 0.5}, {0.05, 0.2}}) {  // the last two rest on their stops
    point::Problem scene = transient(sweep::paper_scene(xs, nu), 10.4);
    const double impacts = impacts_of(scene, InstructionSet::scalar);
    for (const double missing : {-1.0, 0.0, 1.0, 10.0}) {
      scene.time.max_impacts = impacts - missing;
      const results::Dataset dataset = lanes(sweep::sweep_of(scene, {}));
      EXPECT_EQ(statuses(dataset)[0], missing > 0 ? 16 : 2) << xs << " " << nu << ": " << impacts << " - " << missing;
      EXPECT_EQ(std::isnan(values(dataset, "x_max")[0]), missing > 0);
    }
  }
}

TEST_P(InLanes, a_budget_of_impacts_holds_for_settling_and_observing_together) {
  // chaos: about 2 impacts a period, for 200 periods of settling and 64 of observation
  point::Problem scene = observed(sweep::paper_scene(3.0, 0.92));
  scene.time.max_periods = 200;
  for (const bool in_lanes : {true, false})
    for (const InstructionSet arch :
         {InstructionSet::scalar, GetParam()}) {  // each with impacts of its own, since the motion is chaotic
      scene.observe.harmonics_method =
          in_lanes ? observables::HarmonicsMethod::exact : observables::HarmonicsMethod::fft;
      scene.time.max_impacts = 1e5;
      const double impacts = impacts_of(scene, arch);
      for (const double missing :
           {-1.0, 0.0, 20.0}) {  // the scalar loop may repeat an observation, and meet one impact less
        scene.time.max_impacts = impacts - missing;
        EXPECT_EQ(results::statuses(sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = arch}).dataset)[0],
                  missing > 0 ? 16 : 1)
            << name_of(arch) << ": " << impacts << " - " << missing;
      }
    }
}

TEST_P(InLanes, nothing_lies_beyond_a_stop_and_nothing_is_missing) {
  const sweep::Sweep sweep = random_sweep(1000, observed);
  const results::Dataset dataset = lanes(sweep);
  for (std::size_t i = 0; i < size(sweep); ++i) {
    const Stops stops = problem_at(sweep, i).stops;
    const sweep::RunPoint point{dataset, i};
    if (point.status() == 16) continue;  // elastic chatter never ends
    EXPECT_GE(point.of("x_min")[0], stops.lower);
    EXPECT_LE(point.of("x_max")[0], stops.upper);
    const std::vector<double> met = point.of("impacts_per_period");
    const std::vector<double> rested = point.of("rest_fraction");
    EXPECT_EQ(met[0] > 0 || rested[0] > 0, point.of("x_min")[0] == stops.lower) << i;
    EXPECT_EQ(met[1] > 0 || rested[1] > 0, point.of("x_max")[0] == stops.upper) << i;
    for (const char* name : {"x_min", "x_max", "v_min", "v_max", "period_ratio"})
      EXPECT_TRUE(std::isfinite(point.of(name)[0]) || met == std::vector<double>(2, 0)) << name << " of " << i;
    for (const double amplitude : point.of("v_amplitude")) EXPECT_TRUE(std::isfinite(amplitude)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, InLanes,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::lanes::lanes_test
