// Impacts and sections that lanes report without the scalar loop, against the scalar loop and against Taylor steps in
// long double that share no formula with either.

#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <span>

#include "hard/taylor_scan.hpp"
#include "lanes/lane_run.hpp"
#include "support/deviation.hpp"
#include "support/random.hpp"

namespace clatter::lanes::step_block_test {
namespace {

constexpr double pi_ = std::numbers::pi;

class LaneSteps : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this machine has no " << name_of(GetParam());
  }
};

/// A random scene that lanes accept; without a spring every second one has an unstable one.
template <Effects E = sprung>
point::Problem lane_scene(std::uint64_t index) {
  support::Random random(160, index);
  point::Problem scene;
  do {
    scene.oscillator = {random.happens(0.2) ? 0 : random.logarithmic(1e-3, 0.9),
                        random.sign() * random.logarithmic(0.1, 4), random.logarithmic(0.1, 6),
                        random.happens(0.5) ? 0 : random.uniform(-1, 1)};
    if (E.stiffness) scene.oscillator.stiffness = index % 2 == 0 ? 0 : -1;
    const double lower = random.logarithmic(0.05, 4), upper = random.logarithmic(0.05, 4);
    scene.stops = {-lower, upper, random.uniform(0.1, 1), random.uniform(0.1, 1)};
    scene.start = {random.uniform(-lower, upper), random.uniform(-1, 1), random.uniform(0, 2 * pi_)};
    if (random.happens(0.1)) scene.stops.upper = std::numeric_limits<double>::infinity();
  } while (!accepts(scene));
  return scene;
}

template <Effects E = sprung>
std::vector<point::Problem> lane_scenes(std::uint64_t from, std::size_t count) {
  std::vector<point::Problem> scenes;
  for (std::uint64_t i = from; i < from + count; ++i) scenes.push_back(lane_scene<E>(i));
  return scenes;
}

/// A row of a block.
using RowOf = std::function<LaneArray&(BlockState&)>;

/// A scene of one long flight, far from its stops.
point::Problem wide_scene() { return support::scene_of({0.1, 1.0, 1.5, 0.0}, -100, 100, 0.7); }

/// Puts a NaN into a row of one lane after the other: it stays where it is, and its neighbours advance.
template <Effects E>
void expect_no_step_with_a_nan(InstructionSet arch, const point::Problem& scene, std::span<const RowOf> rows) {
  for (const StepFunction step : {step_functions_of<E>(arch).plain, step_functions_of<E>(arch).observed})
    for (std::size_t i = 0; i < rows.size(); ++i) {
      BlockState lanes{};
      for (std::size_t lane = 0; lane < LaneArray::width; ++lane) {
        LaneView view(lanes, lane, scene);
        view.load(LaneView::Constants<E>(scene.oscillator), scene.stops), view.begin_observing(scene.observe),
            view.expect_section(false, false, 1);
      }
      const std::size_t broken = i % LaneArray::width, sound = (i + 1) % LaneArray::width;
      rows[i](lanes).lane[broken] = std::numeric_limits<double>::quiet_NaN();
      const double left = lanes.time_to_section.lane[broken];
      step(lanes);
      EXPECT_EQ(lanes.time_to_section.lane[broken], left) << "row " << i;
      EXPECT_TRUE(lanes.to_scalar >> broken & 1) << "row " << i;
      EXPECT_LT(lanes.time_to_section.lane[sound], left) << "row " << i;
    }
}

TEST_P(LaneSteps, a_step_with_a_nan_in_any_input_of_its_proof_is_not_proved) {
  using B = BlockState;
  std::vector<RowOf> rows;
  for (LaneArray B::*const row : {&B::bound,    &B::bound_forced, &B::rounding,  &B::free_a,
                                  &B::free_b,   &B::free_c,       &B::turn_sine, &B::turn_cosine_minus_one,
                                  &B::in_phase, &B::quadrature,   &B::f,         &B::nu,
                                  &B::twice_h,  &B::step,         &B::free_x,    &B::free_v,
                                  &B::sine,     &B::cosine,       &B::y,         &B::v,
                                  &B::a,        &B::lower,        &B::upper})
    rows.push_back([row](B& lanes) -> LaneArray& { return lanes.*row; });
  expect_no_step_with_a_nan<sprung>(GetParam(), wide_scene(), rows);
  using U = BlockState::Unsprung;
  for (LaneArray U::*const row :
       {&U::k, &U::pull, &U::free_kb, &U::pulled_x, &U::pulled_v, &U::reach_x, &U::reach_v, &U::reach_of_pull})
    rows.push_back([row](B& lanes) -> LaneArray& { return lanes.unsprung.*row; });
  point::Problem scene = wide_scene();
  scene.oscillator.stiffness = 0, scene.oscillator.load = 0.1;
  expect_no_step_with_a_nan<unsprung>(GetParam(), scene, rows);
}

/// The first impacts of a run, as a run record.
accuracy::RunRecord first_of(const std::vector<motion::Event>& impacts, std::size_t count, double duration) {
  accuracy::RunRecord record;
  record.duration = duration;
  for (std::size_t i = 0; i < count; ++i) record.events.push_back(impacts[i]);
  return record;
}

/// Runs in the scalar loop of a scene whose inputs are moved by an ulp each.
template <Effects E>
std::vector<ScalarRun> moved_runs(const point::Problem& scene, std::size_t sections) {
  std::vector<ScalarRun> runs;
  for (const unsigned signs : move_signs) runs.push_back(run_scalar<E>(moved(scene, signs), sections));
  return runs;
}

/// The largest deviation of the first impacts of other runs from these.
double own_deviation(const std::vector<ScalarRun>& others, const accuracy::RunRecord& record) {
  double worst = 0;
  for (const ScalarRun& other : others) {
    const std::vector<motion::Event>& impacts = other.record.impacts;
    if (impacts.size() < record.events.size()) return std::numeric_limits<double>::infinity();
    const support::Deviation d = support::deviation(first_of(impacts, record.events.size(), record.duration), record);
    worst = std::max(worst, d.same_events ? d.largest() : std::numeric_limits<double>::infinity());
  }
  return worst;
}

/// Compares displacement and velocity at the sections, until roundings have grown to 1e-10 of them. They keep the
/// roundings of all steps if nothing damps them.
void expect_sections(const point::Problem& scene, const LaneRun& run, const ScalarRun& scalar,
                     const std::vector<ScalarRun>& others) {
  const double rate = std::max(1.0, scene.oscillator.frequency), period = period_of(scene.oscillator);
  double size = 0, own = 0;
  for (const Section& s : scalar.sections) size = std::max({size, std::abs(s.x), std::abs(s.v) / rate});
  for (std::size_t k = 0; k < run.sections.size(); ++k) {
    const auto [x, v] = scalar.sections[k];
    for (const ScalarRun& other : others)
      own = std::max({own, std::abs(other.sections[k].x - x), std::abs(other.sections[k].v - v) / rate});
    if (own > 1e-10 * size) return;
    const double steps = static_cast<double>(k + 1) * period * rate;
    const double allowed = (1e-13 + 4 * epsilon<double>() * steps) * size + 32 * own;
    EXPECT_NEAR(run.sections[k].x, x, allowed) << k << "\n" << support::configuration_of(scene, 0);
    EXPECT_NEAR(run.sections[k].v, v, allowed * rate) << k << "\n" << support::configuration_of(scene, 0);
  }
}

/// Totals of many runs.
struct Sum {
  std::size_t impacts = 0, sections = 0, to_scalar = 0;
  double worst = 0;
};

/// Compares the impacts of a run until an ulp of the inputs has grown to 1e-10: later ones would only show the growth
/// of roundings.
template <Effects E>
void expect_same_impacts(const point::Problem& scene, const LaneRun& run, Sum& sum) {
  const std::size_t sections = run.sections.size() + 4;
  const ScalarRun scalar = run_scalar<E>(scene, sections);
  const std::vector<ScalarRun> others = moved_runs<E>(scene, sections);
  const double duration = static_cast<double>(sections) * period_of(scene.oscillator);
  std::size_t count = std::min(run.impacts.size(), scalar.record.impacts.size());
  accuracy::RunRecord expected = first_of(scalar.record.impacts, count, duration);
  double own = own_deviation(others, expected);
  for (; own > 1e-10 && count > 0; own = own_deviation(others, expected))
    count /= 2, expected = first_of(scalar.record.impacts, count, duration);
  const support::Deviation d = support::deviation(first_of(run.impacts, count, duration), expected);
  EXPECT_TRUE(d.same_events) << d.difference << "\n" << support::configuration_of(scene, duration);
  // some ten roundings an impact, each of which acts as one of the inputs does; lanes round displacements from the
  // load's equilibrium, which may be larger than speeds
  double speed = 0, far = 0;
  for (const motion::Event& impact : scalar.record.impacts)
    speed = std::max(speed, std::abs(impact.before)),
    far = std::max(far, std::abs(impact.place - equilibrium_of(scene.oscillator)));
  const double allowed = (16 + static_cast<double>(count)) * epsilon<double>() * std::max(1.0, far / speed) + 32 * own;
  EXPECT_LE(d.largest(), allowed) << count << " impacts\n" << support::configuration_of(scene, duration);
  sum.worst = std::max(sum.worst, d.largest() / allowed);
  sum.impacts += count, sum.sections += run.sections.size(), sum.to_scalar += run.to_scalar;
  expect_sections(scene, run, scalar, others);
}

template <Effects E>
Sum first_hundred_impacts(InstructionSet arch) {
  Sum sum;
  for (std::uint64_t from = 0; from < 480; from += LaneArray::width) {
    const std::vector<point::Problem> scenes = lane_scenes<E>(from, LaneArray::width);
    const std::vector<LaneRun> runs = run_lanes<E>(scenes, step_functions_of<E>(arch).plain, 100, 100);
    for (std::size_t i = 0; i < scenes.size(); ++i) expect_same_impacts<E>(scenes[i], runs[i], sum);
  }
  std::cout << sum.impacts << " impacts, " << sum.sections << " sections, " << sum.to_scalar
            << " of 480 went to the scalar loop; at most " << sum.worst << " of the allowed deviation\n";
  return sum;
}

TEST_P(LaneSteps, meet_the_scalar_loops_first_hundred_impacts) {
  const Sum sum = first_hundred_impacts<sprung>(GetParam());
  EXPECT_GT(sum.impacts, 8000u);
  EXPECT_GT(sum.sections, 8000u);
}

TEST_P(LaneSteps, meet_them_without_a_spring_and_with_an_unstable_one) {
  const Sum sum = first_hundred_impacts<unsprung>(GetParam());
  EXPECT_GT(sum.impacts, 4000u);  // more come to rest on a stop
  EXPECT_GT(sum.sections, 3000u);
}

template <Effects E>
void expect_no_impact_missed(InstructionSet arch) {
  // every flight between two reported impacts is computed again: it stays between the stops and ends on the one it hits
  double beyond = 0, off = 0;
  for (std::uint64_t from = 1000; from < 1160; from += 16) {
    const std::vector<point::Problem> scenes = lane_scenes<E>(from, LaneArray::width);
    const std::vector<LaneRun> runs = run_lanes<E>(scenes, step_functions_of<E>(arch).plain, 20, 100);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const Scene& scene = scenes[i];
      const Oscillator& o = scene.oscillator;
      const Stops& stops = scene.stops;
      const Start& start = scene.start;
      motion::Event last{.after = start.velocity, .place = start.displacement};
      for (const motion::Event& impact : runs[i].impacts) {
        const long double phase = start.phase + static_cast<long double>(o.frequency) * last.time;
        const auto flight = hard::TaylorScan(o, 0).fly({last.place, last.after, std::sin(phase), std::cos(phase)},
                                                       impact.time - last.time);
        // the times carry the rounding of a turn count, at the speed of either end
        const double size = std::abs(o.forcing) + std::abs(o.load) + std::abs(last.place) + std::abs(last.after);
        const double slack = 64 * epsilon<double>() * size * std::max(1.0, impact.time) *
                             std::max(1.0, steady_response(o).amplitude / size);
        beyond = std::max({beyond, static_cast<double>((stops.lower - flight.lowest) / slack),
                           static_cast<double>((flight.highest - stops.upper) / slack)});
        off = std::max(off, static_cast<double>(std::abs(flight.end.offset - impact.place) / slack));
        last = impact;
      }
    }
  }
  std::cout << "beyond a stop by " << beyond << ", off it by " << off << " of the allowed rounding\n";
  EXPECT_LE(beyond, 1);
  EXPECT_LE(off, 1);
}

TEST_P(LaneSteps, miss_no_impact_that_taylor_steps_see) {
  expect_no_impact_missed<sprung>(GetParam());
  expect_no_impact_missed<unsprung>(GetParam());
}

TEST(LaneBounds, of_free_motion_are_not_lost_beside_a_large_response) {
  for (const double k : {1.0, 0.0, -1.0}) {
    double bound[2], bound_v[2];
    for (const std::size_t i : {0u, 1u}) {
      const double scale = i == 0 ? 1 : 0x1p70;  // 2^52 would be enough to lose it
      point::Problem scene = support::scene_of({0.1, scale, 1.5, 0.0}, -100 * scale, 100 * scale, 0.7);
      scene.oscillator.stiffness = k;
      BlockState lanes{};
      LaneView view(lanes, 0, scene);
      if (k == 1) {
        view.load(LaneView::Constants<sprung>(scene.oscillator), scene.stops);
      } else {
        view.load(LaneView::Constants<unsprung>(scene.oscillator), scene.stops);
      }
      bound[i] = lanes.bound.lane[0], bound_v[i] = lanes.bound_v.lane[0];
    }
    EXPECT_GT(bound[0], 0x1p-30);
    EXPECT_NEAR(bound[1], bound[0], 0x1p-50) << k;  // displacements are allowed 2^-49 of the free motion for rounding
    EXPECT_NEAR(bound_v[1], bound_v[0], 0x1p-50) << k;
  }
}

TEST_P(LaneSteps, leave_grazes_to_the_scalar_loop) {
  const double amplitude = 0.777909841584413976;
  for (const double gap : {0.0, 1e-15, -1e-15, -1e-13, 1e-12}) {
    point::Problem scene = support::scene_of({0.1, 1.0, 1.5, 0.0}, -2.0, amplitude * (1 + gap), 0.7);
    scene.start = {-0.181543116490166415, -1.13464447806354009, 0.0};
    const LaneRun run = run_lanes({scene}, step_functions_of<>(GetParam()).plain, 1, 3)[0];
    EXPECT_EQ(run.to_scalar, gap < 1e-12) << gap;  // a gap of some thousand roundings can be resolved
    EXPECT_TRUE(run.impacts.empty()) << gap;
    EXPECT_LE(run.stuck_at.x, scene.stops.upper) << gap;
  }
}

TEST_P(LaneSteps, advance_every_lane) {
  // just off the lower stop, on an arc whose quintic, by Newton's method, is least 1e-17 of a step from the present
  const double stop = 0x1.e7807ca49e781p-3;
  const point::Problem scene = support::scene_of({0.1, -1.0, 0x1.07b00c4ce07bp-1, 0.0}, -stop, stop, 0.7);
  BlockState lanes{};
  for (std::size_t lane = 0; lane < LaneArray::width; ++lane) clear_lane(lanes, lane);
  LaneView(lanes, 1, scene).load(LaneView::Constants<>(scene.oscillator), scene.stops);
  lanes.free_x.lane[1] = 0x1.584ce6d702e79p-2, lanes.free_v.lane[1] = -0x1.3c0af122d568p-1;
  lanes.sine.lane[1] = 0x1.2ed29049b0f28p-2, lanes.cosine.lane[1] = -0x1.e9198d9f7dcb6p-1;
  lanes.y.lane[1] = -0x1.e5dc1ac0bc4dap-3, lanes.v.lane[1] = 0x1.6559d0258a1p-7;
  lanes.a.lane[1] = -0x1.f1022e7faa118p-5;
  const double left = lanes.time_to_section.lane[1] = 0x1.abb50e872e83fp+2;
  step_functions_of<>(GetParam()).plain(lanes);
  EXPECT_TRUE(lanes.to_scalar != 0 || lanes.time_to_section.lane[1] < left - 0.01);
}

TEST_P(LaneSteps, report_nothing_of_idle_lanes) {
  BlockState lanes{};
  for (std::size_t i = 0; i < LaneArray::width; ++i) clear_lane(lanes, i);
  for (int step_block = 0; step_block < 2000; ++step_block) {
    lanes.arrived = lanes.to_scalar = 0;
    (step_block % 2 == 0 ? step_functions_of<>(GetParam()).plain : step_functions_of<>(GetParam()).observed)(lanes);
    ASSERT_EQ(lanes.arrived, 0u) << step_block;
    ASSERT_EQ(lanes.to_scalar, 0u) << step_block;
  }
  for (std::size_t i = 0; i < LaneArray::width; ++i) {
    EXPECT_EQ(lanes.impacts.lane[i], 0);
    EXPECT_TRUE(std::isfinite(lanes.y.lane[i]) && std::isfinite(lanes.v.lane[i]));
  }
}

template <Effects E>
void expect_the_same_at_every_index(InstructionSet arch) {
  const std::vector<point::Problem> scenes = lane_scenes<E>(2000, LaneArray::width);
  const std::vector<LaneRun> together = run_lanes<E>(scenes, step_functions_of<E>(arch).plain, 50, 50);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const LaneRun alone = run_lanes<E>({scenes[i]}, step_functions_of<E>(arch).plain, 50, 50)[0];
    ASSERT_EQ(alone.impacts.size(), together[i].impacts.size());
    for (std::size_t k = 0; k < alone.impacts.size(); ++k) {
      EXPECT_EQ(alone.impacts[k].time, together[i].impacts[k].time);
      EXPECT_EQ(alone.impacts[k].after, together[i].impacts[k].after);
    }
    for (std::size_t k = 0; k < std::min(alone.sections.size(), together[i].sections.size()); ++k)
      EXPECT_EQ(alone.sections[k].v, together[i].sections[k].v);
  }
}

TEST_P(LaneSteps, advance_a_lane_the_same_way_at_every_index) {
  expect_the_same_at_every_index<sprung>(GetParam());
  expect_the_same_at_every_index<unsprung>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Of, LaneSteps,
                         testing::Values(InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& of) { return std::string(name_of(of.param)); });

}  // namespace
}  // namespace clatter::lanes::step_block_test
