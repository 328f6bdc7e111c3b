#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/settle_task.hpp"

namespace clatter::lanes {

/// Gives the next point that lanes accept; nothing if there are no more, or none before another result is known.
using WorkQueue = std::function<std::optional<point::WorkItem>()>;
using ResultSink = std::function<void(const point::WorkItem&, point::PointResult&&)>;

/// Runs points with the same step functions side by side in SIMD lanes: first until their motion is known, then, in
/// other lanes, to observe it. A lane whose point is done takes the next one; chatter, rest and grazes, which the
/// vector code leaves out, run in the scalar loop for a short time. A point's result depends neither on its lane nor on
/// its neighbours.
template <Effects E>
class BlockScheduler {
 public:
  BlockScheduler(InstructionSet arch, point::ThreadScratch& scratch, WorkQueue next, ResultSink take);

  /// Runs all points that `next` gives, and passes their results to `take`.
  void run();

  /// Lanes times steps to be proved free of contact, and lanes times contacts to be refined.
  [[nodiscard]] double proved() const { return settling_.lanes.proved + observing_.lanes.proved; }
  [[nodiscard]] double refined() const { return settling_.lanes.refined + observing_.lanes.refined; }

 private:
  template <class Task>
  struct Block {
    BlockState lanes{};
    std::array<std::unique_ptr<Task>, LaneArray::width> tasks;
    std::size_t taken = 0;

    [[nodiscard]] LaneView view(std::size_t lane) { return tasks[lane]->view(lanes, lane); }
  };

  void fill();
  void settle_next(std::size_t lane);
  void observe_next(std::size_t lane);
  void finish(SettledPoint<E> settled);
  void put(const point::WorkItem& item, point::PointResult&& result);

  template <class Task>
  void step_block(Block<Task>& block, StepFunction step);
  template <class Task>
  void handle_sections(Block<Task>& block);
  void handle_section(Block<SettleTask<E>>& block, std::size_t lane);
  bool look(std::size_t lane);
  void handle_section(Block<ObserveTask<E>>& block, std::size_t lane);
  void fall_back(Block<SettleTask<E>>& block, std::size_t lane);
  void fall_back(Block<ObserveTask<E>>& block, std::size_t lane);
  void hand_over(Block<SettleTask<E>>& block, std::size_t lane);

  void take_stock();
  template <class Task>
  [[nodiscard]] double take_stock(Block<Task>& block);
  template <class Task>
  void fail(Block<Task>& block, std::size_t lane, stepping::Outcome outcome);
  template <class Task>
  void leave(Block<Task>& block, std::size_t lane);

  StepFunctions step_functions_;
  point::ThreadScratch& scratch_;
  WorkQueue next_;
  ResultSink take_;
  Block<SettleTask<E>> settling_;
  Block<ObserveTask<E>> observing_;
  std::vector<std::unique_ptr<ObserveTask<E>>> waiting_;  ///< for a lane: about as many as there are lanes at most
  bool exhausted_ = false;                                ///< there are no more points for now
  std::uint64_t steps_made_ = 0;
};

}  // namespace clatter::lanes
