// A chatter is summed from the same rebound on, wherever sections or the ends of runs cut it.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::chatter_sections_test {
namespace {

constexpr int periods = 3;

/// The run of a scene over some periods, each cut at some phases (turns).
template <Effects E>
support::Run<> cut_at(const point::Problem& scene, const std::vector<double>& cuts) {
  Exact<double, E> integrator(scene);
  support::Run<> run;
  run.end.x = scene.start.displacement, run.end.v = scene.start.velocity;
  for (int period = 0; period < periods; ++period) {
    for (const double cut : cuts) EXPECT_EQ(integrator.advance(run.end, cut, 0, run.record), Outcome::completed);
    run.outcome = advance_to_section(integrator, run.end, 0, run.record);
  }
  return run;
}

double time_at_rest(const support::Run<>& run) {
  double sum = 0;
  for (const motion::Event& rest : run.record.rests) sum += rest.length;
  return sum;
}

TEST(ChatterSections, a_cut_changes_neither_the_impacts_nor_the_motion) {
  int in_chatter = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    support::Random random(4101, i);
    const auto weak = [&] { return random.happens(0.3) ? 0.0 : random.logarithmic(1e-12, 1); };
    point::Problem scene = support::scene_of({weak(), weak(), random.logarithmic(0.2, 2), -1, weak()}, 0,
                                             std::numeric_limits<double>::infinity(), random.uniform(0.2, 0.9));
    if (random.happens(0.5)) scene.stops.upper = random.logarithmic(0.3, 3);
    scene.start.displacement = random.uniform(0, 0.3), scene.start.velocity = random.uniform(-1, 1);
    std::vector<double> cuts(40);
    for (double& cut : cuts) cut = random.uniform(0, 1);
    std::ranges::sort(cuts);
    const auto compare = [&]<Effects E>() {
      const support::Run<> whole = cut_at<E>(scene, {});
      for (const motion::Event& rest : whole.record.rests)  // and cut right within the first chatter
        if (const double turns = rest.time / (2 * pi<double>()) * scene.oscillator.frequency; !rest.held && turns < 1) {
          const double length = rest.length / (2 * pi<double>()) * scene.oscillator.frequency;
          if (scene.oscillator.forcing != 0 && turns + length < 1) {
            ++in_chatter;
            for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) cuts.push_back(turns + part * length);
            std::ranges::sort(cuts);
          }
          break;
        }
      const support::Run<> cut = cut_at<E>(scene, cuts);
      ASSERT_EQ(cut.record.impacts.size(), whole.record.impacts.size()) << i;
      for (std::size_t k = 0; k < cut.record.impacts.size(); ++k)
        EXPECT_NEAR(cut.record.impacts[k].time, whole.record.impacts[k].time, 1e-10) << i;
      EXPECT_NEAR(time_at_rest(cut), time_at_rest(whole), 1e-10 + 1e-14 * time_at_rest(whole)) << i;
      EXPECT_NEAR(cut.end.x, whole.end.x, 1e-10) << i;
      EXPECT_NEAR(cut.end.v, whole.end.v, 1e-10) << i;
    };
    if (rotates(scene.oscillator))
      compare.operator()<effect_sets::of_any_stiffness(Damping::light, Forcing::secular)>();
    else
      compare.operator()<effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular)>();
  }
  EXPECT_GT(in_chatter, 100);
}

TEST(ChatterSections, a_ball_rebounds_to_its_closed_form_before_its_chatter_is_summed) {
  // dropped from the height y on a floor: the rebounds reach y R^(2n), and those above 1e-12 y are told
  for (const double R : {0.15, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    point::Problem scene = support::scene_of({0, 0, 1, -1.5, 0}, 0.25, std::numeric_limits<double>::infinity(), R);
    const double y = 0.4, fall = std::sqrt(2 * y / 1.5), end = fall * (1 + 2 * R / (1 - R));
    scene.start.displacement = 0.25 + y;
    const auto run = support::run_scene<double>(scene, 1.5 * end);
    const auto& impacts = run.record.impacts;
    const double last = std::log(1e-12) / (2 * std::log(R));  // R^(2 n) = 1e-12
    EXPECT_EQ(static_cast<double>(impacts.size()), std::ceil(last)) << R;
    double time = fall, speed = 1.5 * fall;
    for (const motion::Event& impact : impacts) {
      EXPECT_NEAR(impact.time, time, 1e-14 * end) << R;
      EXPECT_NEAR(-impact.before, speed, 1e-13 * speed) << R;
      speed *= R, time += 2 * speed / 1.5;
    }
    ASSERT_FALSE(run.record.rests.empty());
    EXPECT_NEAR(run.record.rests.front().time + run.record.rests.front().length, end, 1e-14 * end) << R;
  }
}

}  // namespace
}  // namespace clatter::stepping::chatter_sections_test
