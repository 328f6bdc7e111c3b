#include "lanes/settle_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::lanes {

template <Effects E>
SettleTask<E>::SettleTask(const point::WorkItem& item)
    : item_(item),
      fallback_({item_.problem, stops_in_reach(item_.problem.stops, item_.effects), limits_of(item_.problem)}, false),
      log_area_(E.soft
                    ? 0.0
                    : 2 * std::log(std::max(loop().stops().restitution_lower.R, loop().stops().restitution_upper.R))) {}

template <Effects E>
std::optional<SettledPoint<E>> SettleTask<E>::begin(LaneView& lane) {
  const point::Problem& problem = item_.problem;
  motion::State<double> state;
  state.x = problem.start.displacement, state.v = problem.start.velocity;
  if (problem.time.mode == steady::Mode::transient) {
    const double turns = problem.time.duration / loop().period();
    return settled({steady::Status::transient, state, turns, 0.0, steady::FoundBy::start}, 0);
  }
  search_.emplace(loop(), problem, problem.time, steady::AdvancedBy::lanes);
  if (const auto found = search_->at_section(state)) return settled(*found, 0);
  lane.load(loop().constants(), loop().stops());
  return std::nullopt;
}

template <Effects E>
std::optional<SettledPoint<E>> SettleTask<E>::look(LaneView& lane) {
  if (passed_ == 0) return std::nullopt;
  const std::size_t passed = std::exchange(passed_, 0);
  for (std::size_t i = 0; i < passed && !leaves_lane(); ++i)
    if (auto found = look_at(lane.section_of(unseen_[i]))) return found;
  lane.expect_section(false, false, after_report_);
  together_ = looked_at_together();
  return std::nullopt;
}

template <Effects E>
std::optional<SettledPoint<E>> SettleTask<E>::look_at(const LaneSection& section) {
  const double impacts = loop().impacts() + section.impacts;
  sections_ += to_report_;
  if (impacts > item_.problem.time.max_impacts)
    return settled(search_->failure(stepping::Outcome::event_budget, {}), section.impacts);
  double log_area = log_area_ * (impacts - section_impacts_);
  if constexpr (E.soft) log_area = section.log_area;
  search_->pass_periods({section.itinerary, log_area, fallback_.take_holding_stop()}, to_report_);
  section_impacts_ = impacts;
  if (!search_->skips(section.x, section.v)) {
    motion::State<double> state;
    state.x = section.x, state.v = section.v, state.periods = sections_;
    if (const auto found = search_->at_section(state)) return settled(*found, section.impacts);
  }
  to_report_ = std::exchange(after_report_, search_->periods_from(sections_ + after_report_));
  return std::nullopt;
}

/// The number of sections to look at together: all of them are reported, whatever the search finds at one, and those
/// that the lane passes in vain, once the motion is known, are few beside those before.
template <Effects E>
std::size_t SettleTask<E>::looked_at_together() const {
  const std::int64_t next = sections_ + to_report_, most = std::min<std::int64_t>(most_together, sections_ / 4);
  std::int64_t n = 1;
  if (after_report_ == 1)
    while (n < most && !search_->may_sample(next + n)) ++n;
  return static_cast<std::size_t>(n);
}

template <Effects E>
SettledPoint<E> SettleTask<E>::failed(stepping::Outcome outcome, const LaneView& lane) const {
  return settled(search_->failure(outcome, {}), lane.impacts());
}

template <Effects E>
SettledPoint<E> SettleTask<E>::settled(const steady::ObservedTime& observed, double impacts) const {
  return {item_, loop(), impacts, observed};
}

template <Effects E>
bool SettleTask<E>::has_spent_budget(const LaneView& lane) const {
  return loop().impacts() + lane.impacts() > item_.problem.time.max_impacts;
}

template <Effects E>
double SettleTask<E>::share(const LaneView& lane) const {
  const steady::TimeSettings& time = item_.problem.time;
  const double impacts = loop().impacts() + lane.impacts();
  const double sections = static_cast<double>(sections_) / static_cast<double>(time.max_periods);
  return std::min(1.0, std::max(impacts / time.max_impacts, sections));
}

template class SettleTask<sprung>;
template class SettleTask<unsprung>;
template class SettleTask<cushioned>;

}  // namespace clatter::lanes
