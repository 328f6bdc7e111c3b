#include "lanes/observe_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "point/point_run.hpp"

namespace clatter::lanes {
namespace {

steady::ObservedTime failure(stepping::Outcome outcome, double simulated) {
  return {.status = steady::status_of(outcome), .simulated = simulated};
}

}  // namespace

bool lanes_can_observe(const SettledPoint& settled) {
  const point::Problem& problem = settled.item.problem;
  const steady::ObservedTime& observed = settled.observed;
  const bool whole = std::abs(observed.turns - std::round(observed.turns)) <= 1e-9;  // as the sums of harmonics need
  return !failed(observed.status) && observed.found_by != steady::FoundBy::closed_form && observed.turns >= 1 &&
         (whole || problem.observe.harmonics == 0) &&
         observables::All::in_lanes(problem.observe, problem, problem.time.mode == steady::Mode::transient);
}

point::PointResult observe_in_scalar_loop(const SettledPoint& settled, point::ThreadScratch& scratch) {
  const point::Problem& problem = settled.item.problem;
  const auto observe = [&](const steady::ObservedTime& observed) {
    return point::Point(problem, scratch, settled.loop).observe(observed);
  };
  point::PointResult result = observe(settled.observed);
  result.impacts += settled.impacts;
  if (settled.observed.status == steady::Status::event_budget) result.impacts = problem.time.max_impacts + 1;
  if (failed(result.status) || result.impacts <= problem.time.max_impacts) return result;
  point::PointResult over = observe(failure(stepping::Outcome::event_budget, settled.observed.simulated));
  over.impacts = result.impacts, over.periods = result.periods, over.evaluations = result.evaluations;
  return over;
}

ObserveTask::ObserveTask(const SettledPoint& settled) : settled_(settled), fallback_(settled_.loop, true) {
  skip_impact_at_start();
}

/// An impact at the very beginning lies outside the observed time: lanes begin after it.
void ObserveTask::skip_impact_at_start() {
  motion::State<double>& from = settled_.observed.from;
  for (const Side side : {Side::lower, Side::upper}) {
    const motion::Stop<double> stop = motion::stop_at<double>(settled_.loop.stops(), side);
    if (from.x != stop.position || !(stop.into(from.v) > 0)) continue;
    from.v = stop.law.after(from.v), from.from_stop = side, from.offset = 0;
    ++settled_.impacts;
    return;
  }
}

void ObserveTask::begin(LaneView lane) {
  const steady::ObservedTime& observed = settled_.observed;
  const bool ends = std::floor(observed.turns) == 1;
  lane.load(settled_.loop.stops());
  lane.set_state({observed.from.x, observed.from.v, 0});
  lane.begin_observing(item().problem.observe, ends, ends && observed.status != steady::Status::periodic);
}

bool ObserveTask::has_spent_budget(double impacts) const {
  return fallback_.loop().impacts() + settled_.impacts + impacts > item().problem.time.max_impacts;
}

bool ObserveTask::leaves_lane() const {
  return has_failed_ || fallback_.rested() || fallback_.calls() > 64 + 2 * sections_;
}

/// However late that is found, a point that has spent its budget fails with the same numbers: those of the last section
/// before.
SettledPoint ObserveTask::failed(stepping::Outcome outcome) const {
  SettledPoint failed = settled_;
  failed.observed = failure(outcome, settled_.observed.simulated + static_cast<double>(sections_));
  return failed;
}

bool ObserveTask::pass_section(LaneView lane) {
  if (has_spent_budget(lane.section().impacts)) return true;
  sections_ += 1 + std::exchange(skipped_, 0);
  const double turns = settled_.observed.turns, whole = std::floor(turns);
  const double left = whole - static_cast<double>(sections_);
  const bool over = left == 0 || may_end_early(lane);
  if (left > 0 && over) coast(lane);
  if (left == 0 && turns > whole) {
    has_failed_ = fallback_.finish_period(lane, turns - whole) != stepping::Outcome::completed;
    if (has_spent_budget(lane.section().impacts)) return true;
  }
  const bool ends = left == 1 || coasts_;
  if (left > 1 && !coasts_) skipped_ = std::min({sections_ / 4, longest_quiet, static_cast<std::int64_t>(left) - 2});
  lane.skip_sections(skipped_, ends, left == 1 && settled_.observed.status != steady::Status::periodic);
  return over || leaves_lane();
}

/// True if the rest of the observed time cannot change a result: no stop is in reach, and response plus transient stay
/// within the extrema found. The lane then halts at every section; otherwise the extrema it has seen at one would
/// depend on its neighbours.
bool ObserveTask::may_end_early(LaneView lane) {
  const Oscillator& o = item().problem.oscillator;
  const PhaseState now = lane.section_from_load();
  if (coasts_) return lane.extrema_hold(transient_bound(o, transient_of(o, now)));
  coasts_ = lane.section().itinerary == 0 && out_of_reach(o, now, settled_.loop.stops());
  return coasts_ && !item().problem.observe.extrema;
}

/// Moves a lane that can't meet a stop from the section that it has passed to the end of the observed time.
void ObserveTask::coast(LaneView lane) const {
  const Oscillator& o = item().problem.oscillator;
  const ScalarLoop& loop = fallback_.loop();
  const double turns = settled_.observed.turns;
  const PhasePoint free = transient_of(o, lane.section_from_load());
  motion::State<double> end;
  end.phase_turns = turns - std::floor(turns);
  const auto [sine, cosine] = loop.phase(end);
  const PhasePoint response = response_at(o, sine, cosine);
  const motion::Propagator<double> to =
      loop.constants().propagator((turns - static_cast<double>(sections_)) * loop.period());
  lane.set_section(response.x + to.a * free.x + to.b * free.v, response.v - to.b * free.x + to.c * free.v);
}

double ObserveTask::share(LaneView lane) const {
  const double impacts = fallback_.loop().impacts() + settled_.impacts + lane.impacts();
  const double turns = static_cast<double>(sections_) / settled_.observed.turns;
  return std::min(1.0, std::max(impacts / item().problem.time.max_impacts, turns));
}

point::PointResult ObserveTask::result(LaneView lane, point::ThreadScratch& scratch) const {
  const steady::ObservedTime& observed = settled_.observed;
  const LaneSection section = lane.section();
  if (has_spent_budget(section.impacts))
    return observe_in_scalar_loop(failed(stepping::Outcome::event_budget), scratch);
  if (leaves_lane()) return observe_in_scalar_loop(settled_, scratch);
  point::Point point(item().problem, scratch, fallback_.loop());
  point::Observers observers = point.begin(observed);
  motion::State<double> end = observed.from;
  end.x = section.x, end.v = section.v;
  end.periods += static_cast<std::int64_t>(observed.turns),
      end.phase_turns = observed.turns - std::floor(observed.turns);
  if (auto& extrema = observers.of<observables::Extrema>()) extrema->include(lane.x_range(), lane.v_range());
  if (auto& impacts = observers.of<observables::Impacts>()) impacts->include(lane.stops());
  if (auto& period = observers.of<observables::Period>()) period->include(lane.first_speed());
  if (auto& harmonics = observers.of<observables::Harmonics>())
    harmonics->flights(point.span(), {observed.from.x, observed.from.v}, {end.x, end.v}, lane.velocity_jumps());
  point::PointResult result = point.end(observers, end, stepping::Outcome::completed);
  result.impacts += settled_.impacts + section.impacts, result.in_lanes = true;
  return result;
}

}  // namespace clatter::lanes
