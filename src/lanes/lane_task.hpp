#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "lanes/lane_view.hpp"
#include "lanes/scheduler.hpp"
#include "model/displacement_bound.hpp"
#include "steady/forced_search.hpp"

namespace clatter::lanes {

/// A point in a lane: its scene, the state of the search for its steady motion, and the scalar loop to fall back on.
class Scheduler::LaneTask {
 public:
  explicit LaneTask(const point::WorkItem& item);
  LaneTask(const LaneTask&) = delete;
  LaneTask& operator=(const LaneTask&) = delete;

  [[nodiscard]] const point::WorkItem& item() const { return item_; }

  /// The observed time if it is known at the start, as for a transient; else nothing, and the lane is loaded to settle.
  [[nodiscard]] std::optional<steady::ObservedTime> begin(BlockState& lanes, std::size_t lane);
  /// The observed time if it is known at the stroboscopic section that the lane has passed.
  [[nodiscard]] std::optional<steady::ObservedTime> at_section(const BlockState& lanes, std::size_t lane);
  [[nodiscard]] steady::ObservedTime failure(stepping::Outcome outcome) const;

  /// Sets the time to observe.
  void keep(const steady::ObservedTime& observed) { observed_ = observed; }
  /// Whether lanes can observe it.
  [[nodiscard]] bool lanes_can_observe() const;
  void begin_to_observe(BlockState& lanes, std::size_t lane);
  /// Records a section that was passed while observing; true if the observed time is over.
  [[nodiscard]] bool pass_section(BlockState& lanes, std::size_t lane);

  /// Advances a lane in the scalar loop: by two steps, or to the next section.
  [[nodiscard]] stepping::Outcome scalar_fallback(BlockState& lanes, std::size_t lane);
  /// Whether the scalar loop alone would be quicker, or has to observe.
  [[nodiscard]] bool leaves_lane() const { return gives_up_ || fallbacks_ > 64 + 2 * sections_; }

  /// Makes the point fail if the lane's impacts exceed the budget; true if so.
  [[nodiscard]] bool fail_if_budget_is_spent(double impacts);
  /// The share of its limits that the point has spent.
  [[nodiscard]] double share(const BlockState& lanes, std::size_t lane) const;

  void add_impacts(double impacts) { impacts_ += impacts; }                      ///< adds impacts met in a lane
  [[nodiscard]] point::PointResult result(point::ThreadScratch& scratch) const;  ///< observed in the scalar loop
  [[nodiscard]] point::PointResult result(const BlockState& lanes, std::size_t lane,
                                          point::ThreadScratch& scratch) const;

 private:
  static constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
  using ScalarLoop = stepping::Exact<double, effects>;
  static constexpr std::int64_t longest_quiet = 15;  ///< sections

  void skip_impact_at_start();
  void finish_period(BlockState& lanes, std::size_t lane, double part);
  [[nodiscard]] bool may_end_early(const BlockState& lanes, std::size_t lane);
  void coast(BlockState& lanes, std::size_t lane) const;
  [[nodiscard]] PhaseState section(const BlockState& lanes, std::size_t lane) const;

  point::WorkItem item_;
  ScalarLoop exact_;
  double log_area_;  ///< logarithm of the factor by which an impact shrinks areas, at the stop that shrinks them less
  std::optional<steady::ForcedSearch<effects>> search_{};  ///< none for a transient
  steady::ObservedTime observed_{};
  std::optional<ScalarLoop> before_observing_{};  ///< the scalar integrator as it was before lanes observed
  double impacts_before_observing_ = 0.0;         ///< impacts that lanes had met until then
  motion::State<double> fallback_end_{};          ///< the state in which the scalar loop left the lane
  double fallback_left_ = std::numeric_limits<double>::quiet_NaN();  ///< the lane's time to the next section then
  std::int64_t sections_ = 0, fallbacks_ = 0;
  std::int64_t skip_sections_ = 0;  ///< sections that the lane passes without a report before the next one
  double impacts_ = 0.0;            ///< impacts in lanes that the point has left
  double section_impacts_ = 0.0;    ///< impacts of lane and scalar loop, up to the last section
  bool observing_ = false;
  bool coasts_ = false;    ///< no stop can be met any more while observing
  bool gives_up_ = false;  ///< it rested while observed, or failed: only the scalar loop can have its result
};

}  // namespace clatter::lanes
