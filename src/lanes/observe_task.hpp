#pragma once

#include <vector>

#include "lanes/scalar_fallback.hpp"
#include "point/point.hpp"

namespace clatter::lanes {

/// A point whose observed time is known, or which has failed, and the work that this took.
template <Effects E>
struct SettledPoint {
  point::WorkItem item;
  ScalarLoop<E> loop;
  double impacts = 0.0;  ///< met in lanes
  steady::ObservedTime observed{};
};

/// Whether lanes can observe a point.
template <Effects E>
[[nodiscard]] bool lanes_can_observe(const SettledPoint<E>& settled);

/// The result of a point that the scalar loop observes, or of one that has failed.
template <Effects E>
[[nodiscard]] point::PointResult observe_in_scalar_loop(const SettledPoint<E>& settled, point::ThreadScratch& scratch);

/// A point in a lane that observes it.
template <Effects E>
class ObserveTask {
 public:
  explicit ObserveTask(const SettledPoint<E>& settled);
  ObserveTask(const ObserveTask&) = delete;
  ObserveTask& operator=(const ObserveTask&) = delete;

  [[nodiscard]] const point::WorkItem& item() const { return settled_.item; }
  [[nodiscard]] LaneView view(BlockState& block, std::size_t lane) const { return {block, lane, scene_}; }

  void begin(LaneView& lane);
  /// Records the section that the lane has passed; true if the observed time is over, or the point has failed.
  [[nodiscard]] bool pass_section(LaneView& lane);
  /// Advances the lane in the scalar loop: by two steps, or to the next section.
  [[nodiscard]] stepping::Outcome fall_back(LaneView& lane) { return fallback_.advance(lane); }
  /// Whether the scalar loop alone would be quicker, or has to observe.
  [[nodiscard]] bool leaves_lane() const;

  [[nodiscard]] bool has_spent_budget(double impacts) const;
  [[nodiscard]] bool has_spent_budget(const LaneView& lane) const { return has_spent_budget(lane.impacts()); }
  /// The share of its limits that the point has spent.
  [[nodiscard]] double share(const LaneView& lane) const;

  /// The point as it was before lanes observed it, for the scalar loop to do so.
  [[nodiscard]] const SettledPoint<E>& settled() const { return settled_; }
  /// The point if it can't be run on.
  [[nodiscard]] SettledPoint<E> failed(stepping::Outcome outcome, const LaneView& lane) const;
  /// The result of a point whose observed time is over, or that has failed or leaves its lane.
  [[nodiscard]] point::PointResult result(const LaneView& lane, point::ThreadScratch& scratch) const;

 private:
  static constexpr std::int64_t rarest_report = 64;  ///< forcing periods

  [[nodiscard]] ScalarLoop<E> scalar_loop();
  void skip_impact_at_start();
  void expect_section(LaneView& lane);
  [[nodiscard]] bool may_end_early(const LaneView& lane);
  void coast(LaneView& lane) const;
  /// Whether states of the section (`observables::Section`) are still to come.
  [[nodiscard]] bool wants_section() const {
    return section_x_.size() < static_cast<std::size_t>(item().problem.observe.section);
  }
  void add_to_section(double x, double v) { section_x_.push_back(x), section_v_.push_back(v); }

  SettledPoint<E> settled_;
  Scene scene_;             ///< started so that a section ends the observed time
  double sections_in_all_;  ///< up to the end of the observed time
  double first_turns_;      ///< forcing periods that lie before the observed time in its first period
  ScalarFallback<E> fallback_;
  std::int64_t sections_ = 0;
  std::int64_t to_report_ = 1, after_report_ = 1;  ///< forcing periods to the next report, and to the one after it
  bool coasts_ = false;                            ///< no stop can be met any more
  std::vector<double> section_x_{}, section_v_{};  ///< states seen so far
};

}  // namespace clatter::lanes
