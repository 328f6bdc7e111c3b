#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lanes/block_scheduler.hpp"

namespace clatter::lanes {

/// Runs the points of one thread in SIMD lanes. Those that need other step functions than the ones now at work wait
/// until these are done, or until too many wait.
class Scheduler {
 public:
  Scheduler(InstructionSet arch, point::ThreadScratch& scratch, WorkQueue next, ResultSink take);

  /// Runs all points that `next` gives, and passes their results to `take`.
  void run();

  /// Lanes times steps to be proved free of contact, and lanes times contacts to be refined.
  [[nodiscard]] double proved() const { return proved_; }
  [[nodiscard]] double refined() const { return refined_; }

 private:
  template <Effects E>
  void run_with();
  /// The next point that needs lanes of a kind.
  [[nodiscard]] std::optional<point::WorkItem> next_of(std::size_t kind);

  InstructionSet arch_;
  point::ThreadScratch& scratch_;
  WorkQueue next_;
  ResultSink take_;
  std::array<std::vector<point::WorkItem>, kinds> waiting_;  ///< [kind of lanes]
  double proved_ = 0.0, refined_ = 0.0;
};

}  // namespace clatter::lanes
