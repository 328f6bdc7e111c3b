#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lanes/instruction_set.hpp"
#include "results/dataset.hpp"
#include "scene/effects.hpp"
#include "steady/observed_time.hpp"
#include "storage/scratch.hpp"
#include "sweep/chain_states.hpp"
#include "sweep/result_store.hpp"
#include "sweep/share.hpp"
#include "sweep/status_tally.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

struct RunOptions {
  int threads = 0;  ///< OpenMP threads; 0: all cores
  std::function<void(double done, std::size_t total)>
      progress{};  ///< called from one thread at a time, a few times a second and for every hundredth
  lanes::InstructionSet arch = lanes::widest_instruction_set();  ///< instruction set of the points that lanes can take
  /// Sees the result of each point, by its local index (`Share`), in computed units; called by several threads at once.
  std::function<void(std::size_t local_index, const point::PointResult& result)> see{};
};

/// The threads that a run with these options uses.
[[nodiscard]] int threads_used(const RunOptions& options);

/// Whether a run takes those points of a sweep that lanes accept into lanes.
[[nodiscard]] bool runs_in_lanes(const Sweep& sweep, lanes::InstructionSet arch);

/// The root attribute of an output that names the instruction sets with the bits of its lanes (`lanes::name_of_bits`):
/// a scene whose motion settles through a long chaos may settle otherwise with others.
inline constexpr std::string_view instruction_set_attribute = "instruction_set";

/// Its value for a run: "scalar", too, if no point of the sweep runs in lanes.
[[nodiscard]] std::string_view instruction_set_name(const Sweep& sweep, lanes::InstructionSet arch);

/// Work spent on the points with equal effects.
struct WorkStats {
  Effects effects;
  std::size_t points = 0;
  std::array<std::size_t, steady::found_by_names.size()> found_by{};  ///< points by how their observed time was found
  double impacts = 0.0;                                               ///< simulated
  double periods = 0.0;                                               ///< forcing periods simulated
  double evaluations = 0.0;                                           ///< of arcs by the scalar loop
};

/// Work in SIMD lanes: lanes times steps whose freedom of contact was to be proved, and lanes times contacts that were
/// refined.
struct LaneWork {
  double proved = 0.0, refined = 0.0;
};

/// The results of a sweep, and the work that they took.
struct RunResult {
  results::Dataset dataset;     ///< coordinates, status, impact_total, simulated_periods, then what is observed
  std::size_t points = 0;       ///< points of the sweep, or of the shard
  StatusTally statuses{};       ///< of all points
  int threads = 1;              ///< threads that were used
  std::vector<WorkStats> work;  ///< the cheapest compiled set first
  lanes::InstructionSet arch = lanes::InstructionSet::scalar;  ///< instruction set that was used
  LaneWork lanes;                                              ///< work in SIMD lanes
};

/// A sweep, or a shard of it, on its way to its results.
class SweepRun {
 public:
  /// Keeps the results in `scratch`. Throws std::bad_alloc, storage::IoError if they don't fit there.
  explicit SweepRun(const Sweep& sweep, const std::optional<results::Shard>& shard = {},
                    std::shared_ptr<storage::Scratch> scratch = std::make_shared<storage::Scratch>());

  /// Restores results that `save` wrote in an earlier run of the same points. Returns false if they don't belong to
  /// this sweep.
  [[nodiscard]] bool restore(std::span<const std::byte> results);
  [[nodiscard]] std::size_t restored_points() const { return restored_; }

  /// Runs every point that isn't restored. The results have the same bits for every number of threads and of restored
  /// points. Throws LimitError before the first point if the threads' stacks are too small.
  void run(const RunOptions& options);

  /// Passes the results of chains finished since the last call to `write`, several at once, at most `most_saved`
  /// bytes each time besides the impact log. Another thread may call it during `run`.
  void save(const std::function<void(std::span<const std::byte> results)>& write);

  [[nodiscard]] double most_saved() const;

  /// The results of all points; call it once. The dataset takes its values from this run while it is written.
  [[nodiscard]] RunResult result();

 private:
  const Sweep& sweep_;
  std::optional<results::Shard> shard_;
  Share share_;
  std::shared_ptr<storage::Scratch> scratch_;
  ResultStore store_;
  ChainStates states_;
  std::size_t restored_ = 0;
  RunResult result_;
};

/// Runs every point of a sweep. The dataset holds its values.
[[nodiscard]] RunResult run(const Sweep& sweep, const RunOptions& options);

}  // namespace clatter::sweep
