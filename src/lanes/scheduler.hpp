#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/lane_view.hpp"
#include "point/point.hpp"

namespace clatter::lanes {

/// Runs the points of one thread side by side in SIMD lanes: first until their motion is known, then, in other lanes,
/// to observe it. A lane whose point is done takes the next one; chatter, rest and grazes, which the vector code leaves
/// out, run in the scalar loop for a short time. A point's result depends neither on its lane nor on its neighbours.
class Scheduler {
 public:
  /// Gives the next point that lanes accept; nothing if there are no more.
  using WorkQueue = std::function<std::optional<point::WorkItem>()>;
  using ResultSink = std::function<void(const point::WorkItem&, point::PointResult&&)>;

  Scheduler(const StepFunctions& step_functions, point::ThreadScratch& scratch, WorkQueue next, ResultSink take);
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// Runs all points that `next` gives, and passes their results to `take`.
  void run();

  /// Lanes times steps to be proved free of contact, and lanes times contacts to be refined.
  [[nodiscard]] double proved() const { return settling_.lanes.proved + observing_.lanes.proved; }
  [[nodiscard]] double refined() const { return settling_.lanes.refined + observing_.lanes.refined; }

 private:
  class LaneTask;
  struct Block {
    BlockState lanes{};
    std::array<std::unique_ptr<LaneTask>, LaneArray::width> tasks;
    std::size_t taken = 0;
  };

  void step_block(Block& block, StepFunction step);
  void take_stock();
  void scalar_fallback(Block& block, std::size_t lane);
  void handle_sections(Block& block);
  void handle_section(Block& block, std::size_t lane);
  void fill();
  void settle_next(std::size_t lane);
  void observe_next(std::size_t lane);
  void observe_or_queue(std::unique_ptr<LaneTask> task);
  [[nodiscard]] std::unique_ptr<LaneTask> leave(Block& block, std::size_t lane, double impacts);

  StepFunctions step_functions_;
  point::ThreadScratch& scratch_;
  WorkQueue next_;
  ResultSink take_;
  Block settling_, observing_;
  std::vector<std::unique_ptr<LaneTask>> waiting_;  ///< to be observed: about as many as there are lanes at most
  bool exhausted_ = false;                          ///< there are no more points
  std::uint64_t steps_made_ = 0;
};

}  // namespace clatter::lanes
