#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "point/point.hpp"
#include "sweep/mirror_images.hpp"
#include "sweep/result_store.hpp"
#include "sweep/run.hpp"
#include "sweep/scatter.hpp"
#include "sweep/share.hpp"
#include "sweep/sweep_progress.hpp"

namespace clatter::sweep {

/// The threads that run a sweep, and their shared state.
class WorkerPool {
 public:
  /// Leaves out the chains that are saved; `restored` is the number of their points.
  WorkerPool(const Sweep& sweep, const Share& share, const RunOptions& options, int threads, ResultStore& store,
             ChainStates& states, std::size_t restored);

  /// Runs every chain; results go by index, so their bits don't depend on which thread runs what.
  void run();

  /// The work of all threads, the cheapest compiled set first.
  [[nodiscard]] std::vector<WorkStats> work() const;

  [[nodiscard]] const LaneWork& lane_work() const { return lane_work_; }

  /// Rethrows the first exception of a thread.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// The work of one thread: chunk after chunk, until none is left.
  void run_thread(std::size_t thread) noexcept;

  struct Chunk {
    std::size_t begin, end;
  };
  /// Chains that no thread has begun; empty if none is left or another thread has failed.
  std::optional<Chunk> next_chunk();

  [[nodiscard]] bool is_restored(std::size_t chain) const { return states_.is_saved(chain); }
  /// Whether a chain needs no run: it is restored, or follows from its mirror image.
  [[nodiscard]] bool is_left_out(std::size_t chain) const {
    return is_restored(chain) || (has_whole_pairs_ && mirror_images_.original_of(chain) && !is_bereft(chain));
  }
  /// Whether the original of a mirror image is restored, and can't give it its result any more.
  [[nodiscard]] bool is_bereft(std::size_t point) const { return std::ranges::binary_search(bereft_, point); }

  /// A point of a chain, the first or, if there is an end of the one before, from that.
  [[nodiscard]] point::WorkItem item_of(std::size_t chain, std::size_t position = 0,
                                        const std::optional<point::End>& end = {},
                                        const Units& units_of_end = {}) const;

  /// Runs the points that lanes accept, and between them, one by one, those that they don't. Of chains, a thread
  /// takes no more than its share, so that the others have as many.
  void run_lanes(std::size_t thread);

  /// Stores a point's result; returns the next point of its chain, if there is one.
  std::optional<point::WorkItem> store(const point::WorkItem& item, point::PointResult&& result, std::size_t thread);

  /// Keeps the result of a point, which is in `units`, by its local index.
  void keep(std::size_t local_index, point::PointResult&& result, const Units& units);

  /// Stores the result of a point's mirror image, which no other thread touches.
  void store_image_of(std::size_t point, const point::PointResult& result, const Units& units, std::size_t thread);

  /// Runs the points of a chain, each from the end of the one before.
  void run_chain(std::size_t chain, std::size_t thread);

  void run_chunk(const Chunk& chunk, std::size_t thread);

  /// Runs points that don't depend on each other, those with the same compiled set of effects together.
  void run_points(const Chunk& chunk, std::size_t thread);

  const Sweep& sweep_;
  const Share& share_;
  std::function<void(std::size_t, const point::PointResult&)> see_;
  ResultStore& store_;
  ChainStates& states_;
  SweepProgress progress_;
  std::size_t chunk_;          ///< chains that a thread takes at once
  ScatterInSlabs chunks_;      ///< the order of the chunks
  std::size_t most_branches_;  ///< that a thread has under way
  lanes::InstructionSet arch_;
  bool in_lanes_;
  MirrorImages mirror_images_;
  bool has_whole_pairs_;               ///< both points of every pair are in this run, and only one of them is run
  std::vector<std::size_t> bereft_;    ///< mirror images whose originals are restored without them
  std::atomic<std::size_t> turn_ = 0;  ///< the next one of the chunks
  std::vector<point::ThreadScratch> scratches_;  ///< [thread]
  std::vector<std::vector<WorkStats>> work_;     ///< [thread]
  LaneWork lane_work_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> stopped_ = false;  ///< by a failure; no further chunk is begun
};

}  // namespace clatter::sweep
