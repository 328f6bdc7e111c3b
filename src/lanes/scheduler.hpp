#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/lane_view.hpp"
#include "point/point.hpp"

namespace clatter::lanes {

/// The points that one thread runs side by side in SIMD lanes: first until their motion is known, then, in other lanes,
/// to observe it. A lane whose point is done takes the next one; what the lanes' kernel leaves undone, chatter, rest
/// and grazes, the scalar kernel does for a short time. What a point gives depends neither on its lane nor on its
/// neighbours.
class Scheduler {
 public:
  /// The next point, one that fits into lanes; nothing: there are no more.
  using WorkQueue = std::function<std::optional<point::WorkItem>()>;
  using ResultSink = std::function<void(const point::WorkItem&, point::PointResult&&)>;

  Scheduler(const StepFunctions& visits, point::ThreadScratch& scratch, WorkQueue next, ResultSink take);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Runs all points that `next` gives, and lets `take` have their results.
  void run();

  /// Lanes times steps that were to be proved free of contact, and times contacts that were looked for.
  [[nodiscard]] double proved() const { return settling_.lanes.proved + observing_.lanes.proved; }
  [[nodiscard]] double refined() const { return settling_.lanes.refined + observing_.lanes.refined; }

 private:
  class LaneTask;
  struct Block {
    BlockState lanes{};
    std::array<std::unique_ptr<LaneTask>, LaneArray::width> tasks;
    std::size_t taken = 0;
  };

  void step_block(Block& block, StepFunction kernel);
  void take_stock();
  void scalar_fallback(Block& block, std::size_t lane);
  void look(Block& block);
  void look(Block& block, std::size_t lane);
  void fill();
  void settle_next(std::size_t lane);
  void observe_next(std::size_t lane);
  void settled(std::unique_ptr<LaneTask> task);
  [[nodiscard]] std::unique_ptr<LaneTask> leave(Block& block, std::size_t lane, double impacts);

  StepFunctions step_functions_;
  point::ThreadScratch& scratch_;
  WorkQueue next_;
  ResultSink take_;
  Block settling_, observing_;
  std::vector<std::unique_ptr<LaneTask>> waiting_;  ///< to be observed; as many as there are lanes, at most some more
  bool exhausted_ = false;                          ///< there are no more points
  std::uint64_t steps_made_ = 0;
};

}  // namespace clatter::lanes
