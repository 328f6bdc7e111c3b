#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "lanes/lane_view.hpp"
#include "lanes/scheduler.hpp"
#include "model/displacement_bound.hpp"
#include "steady/forced_search.hpp"

namespace clatter::lanes {

/// A point in a lane: what it is, how far its motion is known, and the scalar kernel that helps it.
class Scheduler::LaneTask {
 public:
  explicit LaneTask(const point::WorkItem& item);
  LaneTask(const LaneTask&) = delete;
  LaneTask& operator=(const LaneTask&) = delete;

  [[nodiscard]] const point::WorkItem& item() const { return item_; }

  /// What is known at the start, of a transient all of it; else takes a lane to settle in.
  [[nodiscard]] std::optional<steady::ObservedTime> begin(BlockState& lanes, std::size_t lane);
  /// What is known at the section that the lane has passed.
  [[nodiscard]] std::optional<steady::ObservedTime> at_section(const BlockState& lanes, std::size_t lane);
  [[nodiscard]] steady::ObservedTime failure(stepping::Outcome outcome) const;

  /// Notes what is to be observed, and whether lanes can do it.
  [[nodiscard]] bool can_observe(const steady::ObservedTime& observed);
  void begin_to_observe(BlockState& lanes, std::size_t lane);
  /// Takes note of a section that was passed under observation; whether the observed time is over.
  [[nodiscard]] bool ends(BlockState& lanes, std::size_t lane);

  /// Takes a stuck lane on by the scalar kernel: by two steps, or to the next section.
  [[nodiscard]] stepping::Outcome scalar_fallback(BlockState& lanes, std::size_t lane);
  /// Whether the scalar kernel alone would be quicker, or has to observe.
  [[nodiscard]] bool leaves_lane() const { return gives_up_ || fallbacks_ > 64 + 2 * sections_; }

  /// Whether so many impacts that the lane has met are too many; the point has failed then.
  [[nodiscard]] bool has_spent_budget(double impacts);
  /// The share done of all that the point may come to.
  [[nodiscard]] double share(const BlockState& lanes, std::size_t lane) const;

  void add_impacts(double impacts) { impacts_ += impacts; }                      ///< that a lane met
  [[nodiscard]] point::PointResult result(point::ThreadScratch& scratch) const;  ///< observed by the scalar kernel
  [[nodiscard]] point::PointResult result(const BlockState& lanes, std::size_t lane,
                                          point::ThreadScratch& scratch) const;

 private:
  static constexpr Effects effects = effect_sets::complete(Damping::light, Forcing::regular);
  using Kernel = stepping::Exact<double, effects>;
  static constexpr std::int64_t longest_quiet = 15;  ///< sections

  void skip_impact_at_start();
  void finish_period(BlockState& lanes, std::size_t lane, double part);
  [[nodiscard]] bool has_seen_all(const BlockState& lanes, std::size_t lane);
  void coast(BlockState& lanes, std::size_t lane) const;
  [[nodiscard]] PhaseState section(const BlockState& lanes, std::size_t lane) const;
  [[nodiscard]] double x_of(const BlockState& lanes, std::size_t lane, double y) const;

  point::WorkItem item_;
  Kernel exact_;
  double
      log_area_;  ///< logarithm of the area that an impact leaves, on the stop that takes less: which it is isn't known
  std::optional<steady::SteadySearch<effects>> search_{};  ///< a transient needs none
  steady::ObservedTime observed_{};
  std::optional<Kernel> settled_{};       ///< the scalar kernel before lanes began to observe
  double settled_impacts_ = 0.0;          ///< that lanes had met until then
  motion::State<double> fallback_end_{};  ///< where the scalar kernel left the lane
  double fallback_left_ = std::numeric_limits<double>::quiet_NaN();  ///< its time to the next section then
  std::int64_t sections_ = 0, fallbacks_ = 0;
  std::int64_t skip_sections_ = 0;  ///< sections that the lane passes without a report before the next one
  double impacts_ = 0.0;            ///< that lanes have met, once the member has left them
  double section_impacts_ = 0.0;    ///< of lane and scalar kernel, up to the last section
  bool observing_ = false;
  bool coasts_ = false;    ///< no stop can be met under observation any more
  bool gives_up_ = false;  ///< it rested under observation, or failed: only the scalar kernel tells what comes of it
};

}  // namespace clatter::lanes
