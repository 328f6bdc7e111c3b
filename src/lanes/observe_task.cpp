#include "lanes/observe_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "point/exact_points.hpp"
#include "point/point_run.hpp"
#include "steady/contact_at_section.hpp"

namespace clatter::lanes {
namespace {

steady::ObservedTime failure(stepping::Outcome outcome, double simulated) {
  return {.status = steady::status_of(outcome), .simulated = simulated};
}

}  // namespace

template <Effects E>
bool lanes_can_observe(const SettledPoint<E>& settled) {
  if (E.soft) return false;
  const point::Problem& problem = settled.item.problem;
  const steady::ObservedTime& observed = settled.observed;
  const observables::ObservedSpan span{.scene = problem,
                                       .turns = observed.turns,
                                       .periodic = observed.status == steady::Status::periodic,
                                       .transient = observed.status == steady::Status::transient,
                                       .frame = observed_frame(problem)};
  const steady::BeyondContact beyond_contact(problem, settled.loop.period());
  if (span.periodic && beyond_contact.is_beside(observed.from.x, observed.from.v)) return false;  // see CycleEnds
  return !failed(observed.status) && observed.sections.empty() && observed.found_by != steady::FoundBy::closed_form &&
         observed.turns >= 1 && observables::All::in_lanes(problem.observe, span);
}

template <Effects E>
point::PointResult observe_in_scalar_loop(const SettledPoint<E>& settled, point::ThreadScratch& scratch) {
  const point::Problem& problem = settled.item.problem;
  const auto observe = [&](const steady::ObservedTime& observed) {
    return point::ExactPoints<E>::observe(problem, scratch, settled.loop, observed);
  };
  point::PointResult result = observe(settled.observed);
  result.impacts += settled.impacts;
  if (settled.observed.status == steady::Status::event_budget) result.impacts = problem.time.max_impacts + 1;
  if (failed(result.status) || result.impacts <= problem.time.max_impacts) return result;
  point::PointResult over = observe(failure(stepping::Outcome::event_budget, settled.observed.simulated));
  over.impacts = result.impacts, over.periods = result.periods, over.evaluations = result.evaluations;
  return over;
}

template <Effects E>
ObserveTask<E>::ObserveTask(const SettledPoint<E>& settled)
    : settled_(settled),
      scene_(settled_.item.problem),
      sections_in_all_(std::ceil(settled_.observed.turns)),
      first_turns_(sections_in_all_ - settled_.observed.turns),
      fallback_(scalar_loop(), true) {
  skip_impact_at_start();
}

/// The last section is the end of the observed time. If that is no whole number of periods, the first period is cut.
template <Effects E>
ScalarLoop<E> ObserveTask<E>::scalar_loop() {
  if (first_turns_ == 0) return settled_.loop;
  scene_.start.phase = std::fmod(scene_.start.phase + 2 * pi<double>() * (1 - first_turns_), 2 * pi<double>());
  return {scene_, settled_.loop.stops(), limits_of(item().problem)};
}

/// An impact at the very beginning lies outside the observed time: lanes begin after it.
template <Effects E>
void ObserveTask<E>::skip_impact_at_start() {
  motion::State<double>& from = settled_.observed.from;
  for (const Side side : {Side::lower, Side::upper}) {
    const motion::Stop<double> stop = motion::stop_at<double>(settled_.loop.stops(), side);
    if (from.x != stop.position || !(stop.into(from.v) > 0)) continue;
    from.v = stop.law.after(from.v), from.from_stop = side, from.offset = 0;
    ++settled_.impacts;
    return;
  }
}

template <Effects E>
void ObserveTask<E>::begin(LaneView& lane) {
  const motion::State<double>& from = settled_.observed.from;
  lane.load(settled_.loop.constants(), settled_.loop.stops());
  lane.set_state({from.x, from.v, first_turns_}, 0);
  lane.begin_observing(item().problem.observe);
  if (wants_section()) add_to_section(from.x, from.v);
  expect_section(lane);
}

/// Tells the lane about the section that it reports next. Reports become rarer as it becomes likely that the motion
/// goes on meeting stops. The lane halts at the last one, and at every one once it coasts, since the extrema it has
/// seen there would else depend on its neighbours.
template <Effects E>
void ObserveTask<E>::expect_section(LaneView& lane) {
  const double left = sections_in_all_ - static_cast<double>(sections_ + to_report_);
  const bool last = left == 0;
  after_report_ = last || coasts_ || wants_section()
                      ? 1
                      : std::min({1 + sections_ / 4, rarest_report, static_cast<std::int64_t>(left)});
  lane.expect_section(last || coasts_, last && settled_.observed.status != steady::Status::periodic, after_report_);
}

template <Effects E>
bool ObserveTask<E>::has_spent_budget(double impacts) const {
  return fallback_.loop().impacts() + settled_.impacts + impacts > item().problem.time.max_impacts;
}

template <Effects E>
bool ObserveTask<E>::leaves_lane() const {
  return fallback_.rested() || fallback_.calls() > 64 + 2 * sections_;
}

/// However late that is found, a point that has spent its budget fails with the same numbers: those of the last section
/// before.
template <Effects E>
SettledPoint<E> ObserveTask<E>::failed(stepping::Outcome outcome, const LaneView&) const {
  SettledPoint<E> failed = settled_;
  failed.observed = failure(outcome, settled_.observed.simulated + static_cast<double>(sections_));
  return failed;
}

template <Effects E>
bool ObserveTask<E>::pass_section(LaneView& lane) {
  if (has_spent_budget(lane.section().impacts)) return true;
  // a whole number of periods that rounding has made longer begins with a piece whose end is its beginning
  const bool begins = sections_ == 0 && first_turns_ > 0.5;
  sections_ += std::exchange(to_report_, after_report_);
  const bool at_end = static_cast<double>(sections_) == sections_in_all_;
  if (wants_section() && !begins) add_to_section(lane.section().x, lane.section().v);
  const bool over = at_end || may_end_early(lane);
  if (!at_end && over) coast(lane);
  if (!over) expect_section(lane);
  return over || leaves_lane();
}

/// True if the rest of the observed time cannot change a result: no stop is in reach, and response plus transient stay
/// within the extrema found.
template <Effects E>
bool ObserveTask<E>::may_end_early(const LaneView& lane) {
  const Oscillator& o = item().problem.oscillator;
  const PhaseState now = lane.section_from_load();
  if (wants_section()) return false;
  if (coasts_) {
    const PhasePoint transient = transient_of(o, now);
    const double most = transient_bound(o, transient);
    return lane.extrema_hold(E.stiffness ? std::max(most, std::abs(transient.v)) : most);  // of k = 0: v only decays
  }
  coasts_ = lane.section().itinerary == 0 && out_of_reach(o, now, settled_.loop.stops());
  return coasts_ && !item().problem.observe.extrema;
}

/// Moves a lane that can't meet a stop from the section that it has passed to the end of the observed time.
template <Effects E>
void ObserveTask<E>::coast(LaneView& lane) const {
  const Oscillator& o = item().problem.oscillator;
  const ScalarLoop<E>& loop = fallback_.loop();
  const PhasePoint free = transient_of(o, lane.section_from_load());
  const auto [sine, cosine] = loop.phase({});
  const PhasePoint response = response_at(o, sine, cosine);
  const motion::Propagator<double> to =
      loop.constants().propagator((sections_in_all_ - static_cast<double>(sections_)) * loop.period());
  lane.set_section(response.x + to.a * free.x + to.b * free.v,
                   response.v - loop.constants().spring(to.b * free.x) + to.c * free.v);
}

template <Effects E>
double ObserveTask<E>::share(const LaneView& lane) const {
  const double impacts = fallback_.loop().impacts() + settled_.impacts + lane.impacts();
  const double turns = static_cast<double>(sections_) / sections_in_all_;
  return std::min(1.0, std::max(impacts / item().problem.time.max_impacts, turns));
}

template <Effects E>
point::PointResult ObserveTask<E>::result(const LaneView& lane, point::ThreadScratch& scratch) const {
  const steady::ObservedTime& observed = settled_.observed;
  const LaneSection section = lane.section();
  if (has_spent_budget(section.impacts))
    return observe_in_scalar_loop(failed(stepping::Outcome::event_budget, lane), scratch);
  if (leaves_lane()) return observe_in_scalar_loop(settled_, scratch);
  ScalarLoop<E> loop = fallback_.loop();
  point::Point point(item().problem, scratch, loop);
  point::Observers observers = point.begin(observed);
  motion::State<double> end = observed.from;
  end.x = section.x, end.v = section.v;
  end.periods += static_cast<std::int64_t>(observed.turns),
      end.phase_turns = observed.turns - std::floor(observed.turns);
  if (auto& extrema = observers.of<observables::Extrema>()) extrema->include(lane.x_range(), lane.v_range());
  if (auto& impacts = observers.of<observables::Impacts>()) impacts->include(lane.stops());
  if (auto& section_of = observers.of<observables::Section>()) section_of->take(section_x_, section_v_);
  if (auto& period = observers.of<observables::Period>()) period->include(lane.first_speed());
  if (auto& harmonics = observers.of<observables::Harmonics>())
    harmonics->flights(point.span(), {observed.from.x, observed.from.v}, {end.x, end.v}, lane.velocity_jumps());
  point::PointResult result = point.end(observers, end, stepping::Outcome::completed);
  result.impacts += settled_.impacts + section.impacts, result.in_lanes = true;
  return result;
}

template bool lanes_can_observe(const SettledPoint<sprung>&);
template bool lanes_can_observe(const SettledPoint<unsprung>&);
template bool lanes_can_observe(const SettledPoint<cushioned>&);
template point::PointResult observe_in_scalar_loop(const SettledPoint<sprung>&, point::ThreadScratch&);
template point::PointResult observe_in_scalar_loop(const SettledPoint<unsprung>&, point::ThreadScratch&);
template point::PointResult observe_in_scalar_loop(const SettledPoint<cushioned>&, point::ThreadScratch&);
template class ObserveTask<sprung>;
template class ObserveTask<unsprung>;
template class ObserveTask<cushioned>;

}  // namespace clatter::lanes
