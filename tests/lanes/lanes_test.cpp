// Points in SIMD lanes against the same points in the scalar loop.

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

#include "lanes/lane_view.hpp"
#include "support/deviation.hpp"
#include "support/scene_range.hpp"
#include "sweep/two_runs.hpp"

namespace clatter::lanes {
namespace {

constexpr double pi_ = std::numbers::pi;

/// Every test, for every instruction set that this machine has.
class InLanes : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
  [[nodiscard]] sweep::Dataset lanes(const sweep::Sweep& sweep, int threads = 1) const {
    return run(sweep, {.threads = threads, .arch = GetParam()}).dataset;
  }
};

/// Totals of a comparison of many points.
struct Totals {
  std::size_t points = 0, fit = 0, periodic = 0, sensitive = 0, chaotic = 0, slow = 0;
  double worst = 0;  ///< largest difference of those that aren't sensitive
};

std::ostream& operator<<(std::ostream& out, const Totals& t) {
  return out << t.points << " points, " << t.fit << " fit lanes, " << t.periodic << " periodic; largest difference "
             << t.worst << " but for " << t.sensitive << " that 1e-15 of the inputs moves by more, and " << t.chaotic
             << " that it changes visibly; " << t.slow << " took longer to settle";
}

/// How far a repeat may be from the motion that it stands for: without a spring, a mass that meets no stop any more
/// drifts to a place that only damping makes final, and either run takes a repeat within its tolerance for that.
double left_to_drift(const point::Problem& scene, const sweep::RunPoint& run) {
  const Oscillator& o = scene.oscillator;
  const bool drifts =
      o.stiffness == 0 && run.status() == 0 && run.of("impacts_per_period") == std::vector<double>(2, 0);
  return drifts ? -scene.time.tolerance / std::expm1(-2 * o.damping * period_of(o)) : 0;
}

/// The difference of a point's two runs, over the allowed one. Values are the same to 1e-13 of the motion's scale. A
/// motion that multiplies a change of its inputs by 1e-15 multiplies the roundings of either run, too: some ten an
/// impact, so 16 times the effect of one change is allowed. If that changes counts, or values visibly, nothing is
/// compared.
double beyond(const point::Problem& scene, const sweep::RunPoint& lanes, const sweep::RunPoint& scalar,
              Totals& totals) {
  const sweep::Apart apart = compare(lanes, scalar);
  if (apart.by <= 1e-13) {
    totals.worst = std::max(totals.worst, apart.by);
    return 0;
  }
  const double own = sensitivity(scene, scalar);
  const bool chaotic = own > 1e-6, settled = scalar.status() != static_cast<int>(steady::Status::aperiodic);
  const double allowed = (settled ? 16 : 64) * own + left_to_drift(scene, scalar);
  if (chaotic || apart.by <= allowed) ++(chaotic ? totals.chaotic : totals.sensitive);
  return chaotic ? 0 : apart.by / allowed;
}

/// The number of periods that slow motion takes to settle depends on when repeats are looked for; given more of them,
/// both runs find the same motion.
double beyond_if_longer(point::Problem scene, InstructionSet arch, Totals& totals) {
  scene.time.max_periods *= 16;
  const sweep::Sweep sweep = sweep::sweep_of(scene, {});
  const sweep::Dataset lanes = run(sweep, {.threads = 1, .arch = arch}).dataset;
  const sweep::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
  ++totals.slow;
  return beyond(scene, {lanes, 0}, {scalar, 0}, totals);
}

Totals expect_alike(const sweep::Sweep& sweep, InstructionSet arch) {
  const sweep::Dataset lanes = run(sweep, {.threads = 1, .arch = arch}).dataset;
  const sweep::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
  Totals totals;
  for (std::size_t i = 0; i < size(sweep); ++i) {
    const point::Problem scene = problem_at(sweep, i);
    const sweep::RunPoint tested{lanes, i}, reference{scalar, i};
    ++totals.points, totals.fit += accepts(scene), totals.periodic += reference.status() == 0;
    double ratio = beyond(scene, tested, reference, totals);
    if (tested.status() != reference.status() && ratio > 1) ratio = beyond_if_longer(scene, arch, totals);
    EXPECT_LE(ratio, 1) << "point " << i << ", " << compare(tested, reference).what << ", status "
                        << int{tested.status()} << " against " << int{reference.status()} << "\n"
                        << support::configuration_of(scene, scene.time.duration);
  }
  std::cout << totals << '\n';
  return totals;
}

/// Every observable of lanes, for a steady motion.
point::Problem observed(point::Problem scene) {
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.harmonics = 5;
  scene.observe.harmonics_method = observables::HarmonicsMethod::exact;
  scene.observe.impacts = true;
  scene.observe.period = true;
  scene.time.max_periods = 300, scene.time.max_impacts = 1e5;
  return scene;
}

sweep::Sweep figure(double xs) {
  sweep::Axis nu{sweep::Parameter::nu, {}};
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
  sweep::Axis x0{sweep::Parameter::x0, {}};
  for (int i = 0; i < 48; ++i) x0.values.push_back(1e-11 * i);
  const sweep::Dataset dataset = lanes(sweep::sweep_of(scene, {x0}));
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

/// Forced motion between stops, one stop, under a load or without; a tenth has no damping, a tenth too much for lanes.
point::Problem random_scene(std::uint64_t index) {
  support::Random random(4711, index);
  point::Problem scene;
  const double kind = random.uniform(0, 1);
  scene.oscillator = {kind < 0.1   ? 0
                      : kind < 0.2 ? random.uniform(0.9, 2)
                                   : random.logarithmic(5e-3, 0.9),
                      random.sign() * random.logarithmic(0.1, 3), random.logarithmic(0.2, 5),
                      random.happens(0.5) ? 0 : random.uniform(-1, 1)};
  const double lower = random.logarithmic(0.05, 4), upper = random.logarithmic(0.05, 4);
  const double restitution = random.happens(0.1) ? 1 : random.uniform(0.05, 1);
  scene.stops = {-lower, upper, restitution, random.happens(0.5) ? restitution : random.uniform(0.05, 1)};
  scene.start = {random.uniform(-lower, upper), random.uniform(-1, 1), random.uniform(0, 2 * pi_)};
  if (random.happens(0.1))
    scene.stops.lower = -std::numeric_limits<double>::infinity();
  else if (random.happens(0.1))
    scene.stops.upper = std::numeric_limits<double>::infinity();
  return scene;
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

/// The same without a spring, or with an unstable one that presses less than the force on the stops: else the mass
/// would rest on one. The force is large enough for motion from stop to stop.
point::Problem without_spring(std::uint64_t index, double stiffness) {
  point::Problem scene = random_scene(index);
  support::Random random(4712, index);
  Oscillator& o = scene.oscillator;
  Stops& stops = scene.stops;
  o.stiffness = stiffness;
  o.damping = random.happens(0.1) ? 0 : random.logarithmic(5e-3, 0.5) * (o.stiffness == 0 ? o.frequency : 1);
  o.load *= random.happens(0.5) ? 0 : 0.3;
  const bool one_stop = !std::isfinite(stops.lower) || !std::isfinite(stops.upper);
  if (o.stiffness != 0) {
    stops.lower = std::max(stops.lower, -4.0), stops.upper = std::min(stops.upper, 4.0);
    o.forcing = random.sign() * random.uniform(1.1, 3) * (std::max(-stops.lower, stops.upper) + std::abs(o.load));
  } else if (one_stop && random.happens(0.8)) {
    o.load = std::isfinite(stops.lower) ? -0.3 : 0.3;
  }
  return scene;
}

template <class Change>
sweep::Sweep sweep_without_springs(std::uint64_t count, double stiffness, const Change& change) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = 0; i < count; ++i) scenes.push_back(change(without_spring(i, stiffness)));
  return sweep::sweep_over(scenes);
}

TEST_P(InLanes, steady_motion_without_a_spring_is_that_of_the_scalar_loop) {
  for (const double k : {0.0, -1.0}) {
    const Totals totals = expect_alike(sweep_without_springs(500, k,
                                                             [k](const point::Problem& scene) {
                                                               point::Problem one = observed(scene);
                                                               if (k == 0) one.observe.harmonics = 0;
                                                               return one;
                                                             }),
                                       GetParam());
    EXPECT_GT(totals.fit, 400u);
    EXPECT_GT(totals.periodic, 250u);
    EXPECT_LT(totals.sensitive, 50u);
    EXPECT_LT(totals.chaotic, 200u);
    EXPECT_LT(totals.slow, 10u);
  }
}

point::Problem transient(point::Problem scene, double periods) {
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.impacts = true;
  scene.observe.period = true;
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = periods * 2 * pi_ / scene.oscillator.frequency;
  scene.time.max_impacts = 1e5;
  return scene;
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

TEST_P(InLanes, a_few_periods_without_a_spring_are_those_of_the_scalar_loop) {
  for (const double k : {0.0, -1.0}) {
    const Totals totals = expect_alike(sweep_without_springs(500, k,
                                                             [](const point::Problem& scene) {
                                                               point::Problem one = transient(scene, 1);
                                                               one.time.duration = 20;
                                                               return one;
                                                             }),
                                       GetParam());
    EXPECT_GT(totals.fit, 400u);
    EXPECT_LT(totals.sensitive + totals.chaotic, 200u);
  }
}

TEST_P(InLanes, springs_of_every_kind_can_be_followed_through) {
  // with k from -0.5 to 0.5 the kind of lanes changes along a branch, and with the branches of R others wait meanwhile
  sweep::Axis k{sweep::Parameter::stiffness, {}}, R{sweep::Parameter::R, {}};
  for (int i = -10; i <= 10; ++i) k.values.push_back(i / 20.0);
  for (int i = 0; i < 40; ++i) R.values.push_back(0.5 + i / 200.0);
  point::Problem scene = observed(sweep::paper_scene(0.5, 2.0));
  scene.observe.harmonics = 0;
  for (const bool follow : {true, false}) {
    sweep::Sweep sweep = sweep::sweep_of(scene, {R, k});
    if (follow) sweep.follow = 1;
    const sweep::RunResult result = run(sweep, {.threads = 1, .arch = GetParam()});
    sweep::expect_same(result.dataset, lanes(sweep, 3));
    EXPECT_GT(result.lanes.refined, 1000);
    const sweep::Dataset scalar = run(sweep, {.threads = 1, .arch = InstructionSet::scalar}).dataset;
    for (std::size_t i = 0; i < size(sweep); ++i)  // a repeat to 1e-12
      EXPECT_LE(sweep::compare({result.dataset, i}, {scalar, i}).by, 1e-11) << i << ' ' << follow;
  }
}

TEST_P(InLanes, fifty_periods_and_a_part_are_those_of_the_scalar_loop) {
  sweep::Axis nu{sweep::Parameter::nu, {}};
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
  sweep::Axis nu{sweep::Parameter::nu, {}}, x0{sweep::Parameter::x0, {-2.9, 0.3, 2.5}},
      load{sweep::Parameter::load, {0.0, 0.2}};
  for (int i = 0; i < 40; ++i) nu.values.push_back(i % 2 == 0 ? 0.4 + i / 100.0 : 1.25 + i / 50.0);
  point::Problem scene = sweep::paper_scene(3.0, 1.0);
  scene.start.velocity = 3.0;
  scene = transient(scene, 400.37);
  const sweep::Sweep sweep{.problem = scene, .dimensions = {{nu}, {x0}, {load}}, .follow = {}};
  const Totals totals = expect_alike(sweep, GetParam());
  EXPECT_EQ(totals.sensitive + totals.chaotic, 0u);
  const sweep::RunResult result = run(sweep, {.threads = 1, .arch = GetParam()});
  const std::vector<double>& impacts = sweep::values(result.dataset, "impacts_per_period");
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
  const sweep::Dataset lanes = InLanes::lanes(sweep), scalar = run(sweep, {.arch = InstructionSet::scalar}).dataset;
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
  const sweep::Dataset dataset = sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = arch}).dataset;
  return static_cast<double>(std::get<std::vector<std::int64_t>>(find(dataset, "impact_total")->values)[0]);
}

TEST_P(InLanes, a_budget_of_impacts_ends_the_same_transients) {
  for (const auto& [xs, nu] : {std::pair{0.5, 1.3}, {0.5, 0.5}, {0.05, 0.2}}) {  // the last two rest on their stops
    point::Problem scene = transient(sweep::paper_scene(xs, nu), 10.4);
    const double impacts = impacts_of(scene, InstructionSet::scalar);
    for (const double missing : {-1.0, 0.0, 1.0, 10.0}) {
      scene.time.max_impacts = impacts - missing;
      const sweep::Dataset dataset = lanes(sweep::sweep_of(scene, {}));
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
        EXPECT_EQ(sweep::statuses(sweep::run(sweep::sweep_of(scene, {}), {.threads = 1, .arch = arch}).dataset)[0],
                  missing > 0 ? 16 : 1)
            << name_of(arch) << ": " << impacts << " - " << missing;
      }
    }
}

TEST_P(InLanes, nothing_lies_beyond_a_stop_and_nothing_is_missing) {
  const sweep::Sweep sweep = random_sweep(1000, observed);
  const sweep::Dataset dataset = lanes(sweep);
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
}  // namespace clatter::lanes
