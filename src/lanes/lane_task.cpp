#include "lanes/lane_task.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "point/point_run.hpp"

namespace clatter::lanes {

static_assert(observables::Harmonics::most_in_lanes == BlockState::most_harmonics);

namespace {

/// Observes the scalar loop while it runs for a lane, and adds to the lane's sums as the vector code does.
class FallbackObserver {
 public:
  FallbackObserver(BlockState& lanes, std::size_t lane, const point::Problem& scene, bool observes)
      : lanes_(lanes), lane_(lane), scene_(scene), observes_(observes) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (observes_) extrema_.arc(arc, begin, length);
  }
  void rest(const motion::Rest&) { rested_ = true; }
  void impact(const motion::Impact& impact) {
    const bool upper = impact.side == Side::upper;
    at(lanes_.itinerary) = 3 * at(lanes_.itinerary) + (upper ? 2 : 1);
    if (!observes_) return;
    extrema_.impact(impact);
    count(impact, upper ? 1 : 0);
    const double jump = impact.after - impact.before, step = 1 / at(lanes_.rate);
    for (std::size_t k = 0; k <= lanes_.harmonics; ++k) {
      const double angle = static_cast<double>(k) * scene_.oscillator.frequency * impact.time;
      at(lanes_.jump_real[k]) += step * jump * std::cos(angle);
      at(lanes_.jump_imaginary[k]) -= step * jump * std::sin(angle);
    }
  }

  /// Widens the lane's ranges to those observed.
  void finish() {
    const double step = 1 / at(lanes_.rate), load = scene_.oscillator.load;
    const auto x = extrema_.displacement(scene_.stops), v = extrema_.velocity();
    at(lanes_.y_low) = std::min(at(lanes_.y_low), x.low == scene_.stops.lower ? at(lanes_.lower) : x.low - load);
    at(lanes_.y_high) = std::max(at(lanes_.y_high), x.high == scene_.stops.upper ? at(lanes_.upper) : x.high - load);
    at(lanes_.v_low) = std::min(at(lanes_.v_low), v.low * step);
    at(lanes_.v_high) = std::max(at(lanes_.v_high), v.high * step);
  }
  [[nodiscard]] bool rested() const { return rested_; }

 private:
  [[nodiscard]] double& at(LaneArray& row) const { return row.lane[lane_]; }
  void count(const motion::Impact& impact, std::size_t stop) {
    const double step = 1 / at(lanes_.rate);
    if (at(lanes_.count[0]) + at(lanes_.count[1]) == 0) at(lanes_.first_before) = impact.before * step;
    if (at(lanes_.count[stop]) == 0)
      at(lanes_.before[stop]) = impact.before * step, at(lanes_.after[stop]) = impact.after * step;
    at(lanes_.count[stop]) += 1;
  }

  BlockState& lanes_;
  std::size_t lane_;
  const point::Problem& scene_;
  bool observes_;
  bool rested_ = false;
  observables::Extrema extrema_;
};

}  // namespace

Scheduler::LaneTask::LaneTask(const point::WorkItem& item)
    : item_(item),
      exact_(item_.problem, stops_in_reach(item_.problem.stops, item_.effects), limits_of(item_.problem)),
      log_area_(2 * std::log(std::max(exact_.stops().restitution_lower, exact_.stops().restitution_upper))) {}

std::optional<steady::ObservedTime> Scheduler::LaneTask::begin(BlockState& lanes, std::size_t lane) {
  motion::State<double> state;
  state.x = item_.problem.start.displacement, state.v = item_.problem.start.velocity;
  if (item_.problem.time.mode == steady::Mode::transient)
    return steady::ObservedTime{steady::Status::transient, state, item_.problem.time.duration / exact_.period(), 0.0,
                                steady::FoundBy::start};
  search_.emplace(exact_, item_.problem, item_.problem.time, steady::TakenBy::lanes);
  const auto found = search_->at_section(state);
  if (!found) load_lane(lanes, lane, item_.problem, exact_.stops());
  return found;
}

steady::ObservedTime Scheduler::LaneTask::failure(stepping::Outcome outcome) const {
  steady::ObservedTime failed{.status = steady::status_of(outcome)};
  if (search_) failed = search_->failure(outcome, {});
  if (observing_) failed.settled += static_cast<double>(sections_);
  return failed;
}

double Scheduler::LaneTask::x_of(const BlockState& lanes, std::size_t lane, double y) const {
  if (y == lanes.lower.lane[lane]) return item_.problem.stops.lower;
  if (y == lanes.upper.lane[lane]) return item_.problem.stops.upper;
  return item_.problem.oscillator.load + y;
}

std::optional<steady::ObservedTime> Scheduler::LaneTask::at_section(const BlockState& lanes, std::size_t lane) {
  const double impacts = exact_.impacts() + lanes.section_impacts.lane[lane];
  if (impacts > item_.problem.time.max_impacts) return failure(stepping::Outcome::event_budget);
  search_->pass_period(
      {std::bit_cast<std::uint64_t>(lanes.section_itinerary.lane[lane]), log_area_ * (impacts - section_impacts_)});
  section_impacts_ = impacts;
  motion::State<double> state;
  state.x = x_of(lanes, lane, lanes.section_y.lane[lane]);
  state.v = lanes.section_v.lane[lane] * lanes.rate.lane[lane], state.periods = ++sections_;
  return search_->at_section(state);
}

bool Scheduler::LaneTask::can_observe(const steady::ObservedTime& observed) {
  observed_ = observed;
  return !failed(observed.status) && observed.found_by != steady::FoundBy::closed_form && observed.turns >= 1 &&
         observables::All::in_lanes(item_.problem.observe, item_.problem,
                                    item_.problem.time.mode == steady::Mode::transient);
}

/// An impact at the very beginning lies outside the observed time: lanes begin after it.
void Scheduler::LaneTask::skip_impact_at_start() {
  motion::State<double>& from = observed_.from;
  for (const Side side : {Side::lower, Side::upper}) {
    const motion::Stop<double> stop = motion::stop_at<double>(exact_.stops(), side);
    if (from.x != stop.position || !(stop.into(from.v) > 0)) continue;
    from.v = stop.law.after(from.v), from.left = side, from.offset = 0;
    return add_impacts(1);
  }
}

void Scheduler::LaneTask::begin_to_observe(BlockState& lanes, std::size_t lane) {
  skip_impact_at_start();
  settled_ = exact_, settled_impacts_ = impacts_;
  observing_ = true, coasts_ = false, sections_ = fallbacks_ = skip_sections_ = 0,
  fallback_left_ = std::numeric_limits<double>::quiet_NaN();
  lanes.extrema = item_.problem.observe.extrema,
  lanes.counts = item_.problem.observe.impacts || item_.problem.observe.period;
  lanes.harmonics = static_cast<std::size_t>(item_.problem.observe.harmonics);
  load_lane(lanes, lane, item_.problem, exact_.stops());
  set_state(lanes, lane, item_.problem, {observed_.from.x, observed_.from.v, 0});
  begin_observing(lanes, lane, std::floor(observed_.turns) == 1, observed_.status != steady::Status::periodic);
}

/// However late that is found, the point fails with the same numbers: those of the last section before its budget was
/// spent.
bool Scheduler::LaneTask::has_spent_budget(double impacts) {
  if (exact_.impacts() + impacts_ + impacts <= item_.problem.time.max_impacts) return false;
  observed_ = failure(stepping::Outcome::event_budget), gives_up_ = true;
  return true;
}

bool Scheduler::LaneTask::ends(BlockState& lanes, std::size_t lane) {
  if (has_spent_budget(lanes.section_impacts.lane[lane])) return true;
  sections_ += 1 + std::exchange(skip_sections_, 0);
  const double whole = std::floor(observed_.turns), left = whole - static_cast<double>(sections_);
  const bool over = left == 0 || has_seen_all(lanes, lane);
  if (left > 0 && over) coast(lanes, lane);
  if (left == 0 && observed_.turns > whole) {
    finish_period(lanes, lane, observed_.turns - whole);
    if (has_spent_budget(lanes.section_impacts.lane[lane])) return true;
  }
  lanes.ends_here.lane[lane] = left == 1 || coasts_ ? 1 : 0;
  lanes.stop_short.lane[lane] = left == 1 && observed_.status != steady::Status::periodic ? 1 : 0;
  if (left > 1 && !coasts_)
    skip_sections_ = std::min({sections_ / 4, longest_quiet, static_cast<std::int64_t>(left) - 2});
  lanes.skip_sections.lane[lane] = static_cast<double>(skip_sections_);
  return over || gives_up_;
}

/// The state of the lane at the section that it has passed.
PhaseState Scheduler::LaneTask::section(const BlockState& lanes, std::size_t lane) const {
  return {lanes.section_y.lane[lane], lanes.section_v.lane[lane] * lanes.rate.lane[lane], lanes.start_sine.lane[lane],
          lanes.start_cosine.lane[lane]};
}

/// True if the rest of the observed time cannot change a result: no stop is in reach, and response plus transient stay
/// within the extrema found. The lane then halts at every section; otherwise the extrema it has seen at one would
/// depend on its neighbours.
bool Scheduler::LaneTask::has_seen_all(const BlockState& lanes, std::size_t lane) {
  const auto at = [lane](const LaneArray& row) { return row.lane[lane]; };
  const Oscillator& o = item_.problem.oscillator;
  if (!coasts_) {
    coasts_ = at(lanes.section_itinerary) == 0 && out_of_reach(o, section(lanes, lane), exact_.stops());
    return coasts_ && !lanes.extrema;
  }
  const double transient = transient_bound(o, transient_of(o, section(lanes, lane))), slack = at(lanes.rounding) / 2;
  const double y = at(lanes.amplitude) + transient - slack;
  const double v = (o.frequency * at(lanes.amplitude) + transient - slack) / at(lanes.rate);
  return at(lanes.y_low) <= -y && at(lanes.y_high) >= y && at(lanes.v_low) <= -v && at(lanes.v_high) >= v;
}

/// Moves a lane that can't meet a stop from the section that it has passed to the end of the observed time.
void Scheduler::LaneTask::coast(BlockState& lanes, std::size_t lane) const {
  const Oscillator& o = item_.problem.oscillator;
  const PhasePoint free = transient_of(o, section(lanes, lane));
  motion::State<double> end;
  end.phase_turns = observed_.turns - std::floor(observed_.turns);
  const auto [sine, cosine] = exact_.phase(end);
  const PhasePoint response = response_at(o, sine, cosine);
  const double time = (observed_.turns - static_cast<double>(sections_)) * exact_.period();
  const motion::Propagator<double> to = exact_.constants().propagator(time);
  lanes.section_y.lane[lane] = response.x + to.a * free.x + to.b * free.v;
  lanes.section_v.lane[lane] = (response.v - to.b * free.x + to.c * free.v) / lanes.rate.lane[lane];
}

/// Advances a transient through the part of a forcing period that is left after its last section.
void Scheduler::LaneTask::finish_period(BlockState& lanes, std::size_t lane, double part) {
  FallbackObserver seen(lanes, lane, item_.problem, true);
  gives_up_ =
      gives_up_ || exact_.advance(fallback_end_, part, 0, seen) != stepping::Outcome::completed || seen.rested();
  seen.finish();
  lanes.section_y.lane[lane] = fallback_end_.x - item_.problem.oscillator.load;
  lanes.section_v.lane[lane] = fallback_end_.v / lanes.rate.lane[lane];
}

stepping::Outcome Scheduler::LaneTask::scalar_fallback(BlockState& lanes, std::size_t lane) {
  const LaneState position = state_of(lanes, lane, item_.problem);
  motion::State<double> state;
  state.x = position.x, state.v = position.v, state.phase_turns = position.phase_turns;
  if (position.x == exact_.stops().lower) state.left = Side::lower;
  if (position.x == exact_.stops().upper) state.left = Side::upper;
  if (lanes.time_to_section.lane[lane] == fallback_left_)
    state = fallback_end_;  // a lane can't hold a release or a short offset
  double end = std::min(1.0, state.phase_turns + 2 / lanes.period.lane[lane]);
  FallbackObserver seen(lanes, lane, item_.problem, observing_);
  stepping::Outcome outcome = exact_.advance(state, end, 0, seen);
  // all motion from the same release is the same: so that it is so to the last bit, it goes on to the section here
  if (outcome == stepping::Outcome::completed && seen.rested()) outcome = exact_.advance(state, end = 1.0, 0, seen);
  ++fallbacks_;
  if (observing_) seen.finish(), gives_up_ = gives_up_ || seen.rested();
  if (end == 1.0) {
    lanes.section_y.lane[lane] = state.x - item_.problem.oscillator.load;
    lanes.section_v.lane[lane] = state.v / lanes.rate.lane[lane];
    lanes.section_itinerary.lane[lane] = std::exchange(lanes.itinerary.lane[lane], 0.0);
    lanes.section_impacts.lane[lane] = lanes.impacts.lane[lane];
    double& skip_sections = lanes.skip_sections.lane[lane];
    if (skip_sections > 0) {
      --skip_sections;
    } else {
      lanes.arrived |= LaneMask{1} << lane;
    }
    state.phase_turns = 0;
  }
  set_state(lanes, lane, item_.problem, {state.x, state.v, state.phase_turns});
  fallback_end_ = state, fallback_left_ = lanes.time_to_section.lane[lane];
  return outcome;
}

double Scheduler::LaneTask::share(const BlockState& lanes, std::size_t lane) const {
  const steady::TimeSettings& time = item_.problem.time;
  const double impacts = exact_.impacts() + impacts_ + lanes.impacts.lane[lane];
  const double longest = observing_ ? observed_.turns : static_cast<double>(time.max_periods);
  return std::min(1.0, std::max(impacts / time.max_impacts, static_cast<double>(sections_) / longest));
}

point::PointResult Scheduler::LaneTask::result(point::ThreadScratch& scratch) const {
  const ScalarLoop& exact = settled_ ? *settled_ : exact_;  // without the work that lanes spent on observing in vain
  point::PointResult result = point::Point(item_.problem, scratch, exact).observe(observed_);
  result.impacts += settled_ ? settled_impacts_ : impacts_;
  if (observed_.status == steady::Status::event_budget) result.impacts = item_.problem.time.max_impacts + 1;
  if (failed(result.status) || result.impacts <= item_.problem.time.max_impacts) return result;
  point::PointResult over =
      point::Point(item_.problem, scratch, exact).observe(failure(stepping::Outcome::event_budget));
  over.impacts = result.impacts, over.periods = result.periods, over.evaluations = result.evaluations;
  return over;
}

point::PointResult Scheduler::LaneTask::result(const BlockState& lanes, std::size_t lane,
                                               point::ThreadScratch& scratch) const {
  const auto at = [lane](const LaneArray& row) { return row.lane[lane]; };
  point::Point point(item_.problem, scratch, exact_);
  point::Observers observers = point.begin(observed_);
  const double rate = at(lanes.rate);
  motion::State<double> end = observed_.from;
  end.x = x_of(lanes, lane, at(lanes.section_y)), end.v = at(lanes.section_v) * rate;
  end.periods += static_cast<std::int64_t>(observed_.turns),
      end.phase_turns = observed_.turns - std::floor(observed_.turns);
  if (auto& extrema = observers.of<observables::Extrema>())
    extrema->include({x_of(lanes, lane, at(lanes.y_low)), x_of(lanes, lane, at(lanes.y_high))},
                     {at(lanes.v_low) * rate, at(lanes.v_high) * rate});
  if (auto& impacts = observers.of<observables::Impacts>()) {
    std::array<observables::Impacts::OfStop, 2> stops;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      if (at(lanes.count[i]) == 0) continue;
      stops[i] = {at(lanes.count[i]), at(lanes.before[i]) * rate, at(lanes.after[i]) * rate, 0.0};
    }
    impacts->include(stops);
  }
  if (auto& period = observers.of<observables::Period>()) {
    const bool met = at(lanes.count[0]) + at(lanes.count[1]) > 0;
    period->include(met ? std::abs(at(lanes.first_before)) * rate : observables::no_value);
  }
  if (auto& harmonics = observers.of<observables::Harmonics>()) {
    std::vector<std::complex<double>> jumps;
    for (std::size_t k = 0; k <= lanes.harmonics; ++k)
      jumps.emplace_back(at(lanes.jump_real[k]) * rate, at(lanes.jump_imaginary[k]) * rate);
    harmonics->flights(point.span(), {observed_.from.x, observed_.from.v}, {end.x, end.v}, jumps);
  }
  point::PointResult result = point.end(observers, end, stepping::Outcome::completed);
  result.impacts += impacts_ + at(lanes.section_impacts), result.in_lanes = true;
  return result;
}

}  // namespace clatter::lanes
