#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "config/config.hpp"
#include "lanes/instruction_set.hpp"
#include "plan/memory_need.hpp"
#include "results/output_place.hpp"
#include "runs/checkpointer.hpp"
#include "storage/error.hpp"
#include "storage/journal.hpp"
#include "sweep/run.hpp"
#include "sweep/share.hpp"
#include "terminal/progress.hpp"

namespace clatter::app {

/// The choices of the command line for a run, besides its configuration.
struct RunRequest {
  std::string began;  ///< UTC
  Checkpointer::Clock::time_point started = Checkpointer::Clock::now();
  std::optional<Checkpointer::Clock::time_point> end;  ///< of --max-time
  lanes::InstructionSet arch = lanes::InstructionSet::scalar;
  int threads = 1;
  ProgressKind progress = ProgressKind::none;
  storage::Journal::Begin begin = storage::Journal::Begin::resume_if_any;
  std::optional<results::Shard> shard;
  std::string output;
  bool force = false;
  bool quiet = false;
  bool verbose = false;
};

/// A run from a configuration to its output file.
class RunSession {
 public:
  /// Throws IoError if the output can't be written or would replace a file that isn't its predecessor.
  RunSession(config::Config config, RunRequest request);

  /// Checks the memory, says plan and warnings, continues an interrupted run or begins, and writes the output. Returns
  /// the exit code. Throws IoError and BusyError; finished points are then saved if they can be.
  [[nodiscard]] int run();

 private:
  void announce(const plan::MemoryNeed& need) const;
  void open_journal();
  void restore(std::span<const std::byte> results);
  void announce_restored() const;
  void compute();
  void run_points();
  void run_with_progress(sweep::RunOptions options);
  void save();
  void write();
  void report() const;
  [[nodiscard]] storage::IoError failure(const storage::IoError& error);

  config::Config config_;
  RunRequest request_;
  results::OutputPlace place_;
  std::optional<sweep::SweepRun> sweep_;
  std::optional<storage::Journal> journal_;
  sweep::RunResult result_;
  std::string summary_;
  std::optional<Checkpointer> checkpointer_;  ///< the first to go: it saves `sweep_` into `journal_`
};

}  // namespace clatter::app
