#pragma once

#include <bit>
#include <vector>

#include "lanes/lane_view.hpp"
#include "stepping/exact.hpp"
#include "support/runs.hpp"

namespace clatter::lanes {

/// The scalar integrator with the effects of lanes.
template <Effects E = sprung>
using LaneExact = stepping::Exact<double, E>;

/// The state at a stroboscopic section.
struct Section {
  double x, v;
};

/// The impacts and sections of a lane, until it needs the scalar loop or has enough.
struct LaneRun {
  std::vector<motion::Event> impacts{};  ///< times in tau since the start
  std::vector<Section> sections{};
  bool to_scalar = false;
  LaneState stuck_at{};
  std::int64_t calls = 0;
};

/// Reads an impact from a lane, which is on a stop with the velocity after it.
inline motion::Event impact_of(const LaneView& lane, const point::Problem& scene, double sections) {
  const LaneState position = lane.state();
  const bool upper = position.x == scene.stops.upper;
  const double R = law_of(scene.stops, upper ? Side::upper : Side::lower).R;
  return {.side = upper ? Side::upper : Side::lower,
          .time = (sections + position.phase_turns) * period_of(scene.oscillator),
          .before = -position.v / R,
          .after = position.v,
          .place = position.x};
}

/// Runs scenes side by side until each has met so many impacts, passed so many sections, or needs the scalar loop.
template <Effects E = sprung>
std::vector<LaneRun> run_lanes(const std::vector<point::Problem>& scenes, StepFunction step, std::size_t impacts,
                               std::size_t sections) {
  BlockState lanes{};
  std::vector<LaneRun> runs(scenes.size());
  for (std::size_t i = 0; i < LaneArray::width; ++i) clear_lane(lanes, i);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    LaneView(lanes, i, scenes[i]).load(LaneView::Constants<E>(scenes[i].oscillator), scenes[i].stops);
  std::vector<bool> done(scenes.size(), false);
  for (std::size_t left = scenes.size(); left > 0;) {
    std::vector<double> before(lanes.impacts.lane, lanes.impacts.lane + LaneArray::width);
    lanes.arrived = lanes.to_scalar = 0;
    step(lanes);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (done[i]) continue;
      LaneRun& run = runs[i];
      const LaneView lane(lanes, i, scenes[i]);
      ++run.calls;
      if (lanes.arrived >> i & 1) run.sections.push_back({lane.section().x, lane.section().v});
      if (lane.impacts() > before[i])
        run.impacts.push_back(impact_of(lane, scenes[i], static_cast<double>(run.sections.size())));
      run.to_scalar = lanes.to_scalar >> i & 1;
      if (run.to_scalar) run.stuck_at = lane.state();
      done[i] = run.to_scalar || run.impacts.size() >= impacts || run.sections.size() >= sections || run.calls > 100000;
      if (done[i]) clear_lane(lanes, i), --left;
    }
  }
  return runs;
}

/// The scalar loop's impacts and sections of the same scene, for so many forcing periods.
struct ScalarRun {
  support::Recorder record{};
  std::vector<Section> sections{};
};

template <Effects E = sprung>
ScalarRun run_scalar(const point::Problem& scene, std::size_t sections) {
  ScalarRun run;
  LaneExact<E> exact(scene);
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  for (std::size_t i = 0; i < sections; ++i) {
    if (advance_to_section(exact, state, 0, run.record) != stepping::Outcome::completed) break;
    run.sections.push_back({state.x, state.v});
  }
  return run;
}

/// Ways to move inputs by an ulp, each up or down.
inline constexpr unsigned move_signs[] = {0, 21, 42, 63};

/// A scene whose inputs are moved by an ulp each.
inline point::Problem moved(point::Problem scene, unsigned signs) {
  unsigned i = 0;
  for (double* value : {&scene.oscillator.damping, &scene.oscillator.frequency, &scene.oscillator.forcing,
                        &scene.stops.lower, &scene.stops.upper, &scene.start.velocity})
    *value *= 1 + (signs >> i++ & 1 ? 1 : -1) * epsilon<double>();
  return scene;
}

}  // namespace clatter::lanes
