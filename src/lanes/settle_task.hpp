#pragma once

#include <array>
#include <optional>

#include "lanes/observe_task.hpp"
#include "lanes/scalar_fallback.hpp"
#include "steady/forced_search.hpp"

namespace clatter::lanes {

/// A point in a lane whose motion isn't known yet: its scene, and the search for its steady motion.
template <Effects E>
class SettleTask {
 public:
  explicit SettleTask(const point::WorkItem& item);
  SettleTask(const SettleTask&) = delete;
  SettleTask& operator=(const SettleTask&) = delete;

  [[nodiscard]] const point::WorkItem& item() const { return item_; }
  [[nodiscard]] LaneView view(BlockState& block, std::size_t lane) const { return {block, lane, item_.problem}; }

  /// The point if its observed time is known at the start, as for a transient; else nothing, and the lane is loaded.
  [[nodiscard]] std::optional<SettledPoint<E>> begin(LaneView& lane);
  /// Keeps the stroboscopic section that the lane has passed; whether it is time to look at those that are kept.
  [[nodiscard]] bool pass_section(const LaneView& lane) {
    unseen_[passed_++] = lane.report();
    return passed_ >= together_;
  }
  /// Looks at the sections that are kept: the point if its observed time is known at one, or if it has failed.
  [[nodiscard]] std::optional<SettledPoint<E>> look(LaneView& lane);
  /// The point if it can't be run on, `lane` being where it is now.
  [[nodiscard]] SettledPoint<E> failed(stepping::Outcome outcome, const LaneView& lane) const;

  /// Advances the lane in the scalar loop: by two steps, or to the next section.
  [[nodiscard]] stepping::Outcome fall_back(LaneView& lane) { return fallback_.advance(lane); }
  /// Whether the scalar loop alone would be quicker, or has to decide on which side of a section an impact falls.
  [[nodiscard]] bool leaves_lane() const {
    return fallback_.calls() > 64 + 2 * sections_ || (search_ && search_->is_cut());
  }

  [[nodiscard]] bool has_spent_budget(const LaneView& lane) const;
  /// The share of its limits that the point has spent.
  [[nodiscard]] double share(const LaneView& lane) const;

 private:
  [[nodiscard]] ScalarLoop<E>& loop() { return fallback_.loop(); }
  [[nodiscard]] const ScalarLoop<E>& loop() const { return fallback_.loop(); }
  [[nodiscard]] SettledPoint<E> settled(const steady::ObservedTime& observed, double impacts) const;
  [[nodiscard]] std::optional<SettledPoint<E>> look_at(const LaneSection& section);
  [[nodiscard]] std::size_t looked_at_together() const;

  static constexpr std::size_t most_together = 8;

  // The search takes as long as a forcing period in lanes, much of it until its memory is at hand.
  std::array<LaneReport, most_together> unseen_;  ///< sections that it hasn't seen yet
  std::size_t passed_ = 0, together_ = 1;         ///< how many they are, and how many it is to see together
  point::WorkItem item_;
  ScalarFallback<E> fallback_;
  /// Logarithm of the factor by which an impact shrinks areas, at the stop that shrinks them less; 0 with soft stops,
  /// whose part lanes tell.
  double log_area_;
  std::optional<steady::ForcedSearch<E>> search_{};  ///< none for a transient
  std::int64_t sections_ = 0;
  std::int64_t to_report_ = 1, after_report_ = 1;  ///< forcing periods to the next report, and to the one after it
  double section_impacts_ = 0.0;                   ///< impacts of lane and scalar loop, up to the last section
};

}  // namespace clatter::lanes
