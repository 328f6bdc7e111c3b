#include "sweep/run.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <ranges>
#include <span>
#include <vector>

#include "sweep/branches.hpp"
#include "sweep/columns.hpp"
#include "sweep/crew.hpp"
#include "sweep/fork_join.hpp"
#include "sweep/lane_points.hpp"
#include "sweep/plan.hpp"
#include "sweep/point.hpp"
#include "sweep/rounding.hpp"
#include "sweep/scatter.hpp"
#include "sweep/stack.hpp"
#include "sweep/sweep_progress.hpp"

namespace clatter {
namespace {

Usage usage_of(const Task& task, const PointResult& result) {
  Usage usage{.effects = task.effects,
              .points = 1,
              .impacts = result.impacts,
              .periods = result.periods,
              .evaluations = result.evaluations};
  usage.found_by[static_cast<std::size_t>(result.found_by)] = 1;
  return usage;
}

void add(std::vector<Usage>& sum, const Usage& part) {
  auto same = std::ranges::find(sum, part.effects, &Usage::effects);
  if (same == sum.end()) same = sum.insert(sum.end(), Usage{.effects = part.effects});
  same->points += part.points;
  for (std::size_t i = 0; i < part.found_by.size(); ++i) same->found_by[i] += part.found_by[i];
  same->impacts += part.impacts, same->periods += part.periods, same->evaluations += part.evaluations;
}

/// Results from which on they are written at once.
constexpr std::size_t enough_to_save = 256UL * 1024;  // bytes

/// Whether points of a sweep may go into lanes: those of the exact method that take every shortcut to their steady
/// motion, and don't wait for each other.
bool lanes_can_run(const Sweep& sweep) {
  const Integration& integration = sweep.scene.integration;
  return integration.method == Method::exact && integration.shortcuts && !integration.all_effects && !sweep.follow;
}

/// The threads that run a sweep, and what they share.
class Team {
 public:
  /// Branches that are saved are left out; `restored` is how many points they have.
  Team(const Sweep& sweep, const Share& share, const RunOptions& options, int threads, Columns& columns,
       std::vector<std::atomic<BranchState>>& states, std::size_t restored)
      : sweep_(sweep),
        share_(share),
        columns_(columns),
        states_(states),
        progress_(options, static_cast<std::size_t>(threads), share.points(), restored),
        chunk_(sweep.follow
                   ? 1
                   : std::clamp<std::size_t>(share_.count() / (64 * static_cast<std::size_t>(threads)), 1, 64)),
        chunks_((share_.count() + chunk_ - 1) / chunk_),
        arch_(options.arch),
        in_lanes_(options.arch != Arch::scalar && lanes_can_run(sweep)),
        workshops_(static_cast<std::size_t>(threads)),
        usage_(static_cast<std::size_t>(threads)) {
    for (std::size_t thread = 0; options.progress && thread < workshops_.size(); ++thread)
      workshops_[thread].progress = [this, thread](double part) { progress_.add_part(thread, part); };
    const Observe& observe = sweep.scene.observe;
    if (observe.harmonics == 0 || observe.harmonics_method != HarmonicsMethod::fft) return;
    transform_.emplace(static_cast<std::size_t>(observe.harmonics_samples));
    for (Workshop& workshop : workshops_)
      workshop.transform = &*transform_, workshop.workspace = transform_->workspace();
  }

  /// Runs every branch; results go by index, so their bits don't depend on which thread runs what.
  CLATTER_PARALLEL_REGION void run() {
    fork_join_.fork();
#pragma omp parallel num_threads(threads())
    work(static_cast<std::size_t>(omp_get_thread_num()));
    fork_join_.join();
  }

  /// What all threads took, the cheapest kernel first.
  [[nodiscard]] std::vector<Usage> usage() const {
    std::vector<Usage> sum;
    for (const std::vector<Usage>& of_thread : usage_)
      for (const Usage& part : of_thread) add(sum, part);
    std::ranges::sort(sum, cheaper, &Usage::effects);
    return sum;
  }

  [[nodiscard]] const LaneWork& lane_work() const { return lane_work_; }

  /// Passes on what a thread could not do.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] int threads() const { return static_cast<int>(workshops_.size()); }

  /// What one thread does: chunk after chunk, until none is left.
  void work(std::size_t thread) noexcept {
    const ForkJoin::Member member(fork_join_);
    try {
      if (in_lanes_) {
        run_crew(thread);
      } else {
        while (const auto chunk = next_chunk()) run_chunk(*chunk, thread);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  struct Chunk {
    std::size_t begin, end;
  };
  /// Branches that no thread has begun; nothing where none is left, or another thread has failed.
  std::optional<Chunk> next_chunk() {
    for (;;) {
      const std::size_t turn = turn_.fetch_add(1);
      if (stopped_ || turn >= chunks_.turns()) return std::nullopt;
      const auto number = chunks_.number(turn);
      if (!number) continue;
      return Chunk{*number * chunk_, std::min((*number + 1) * chunk_, share_.count())};
    }
  }

  [[nodiscard]] bool is_restored(std::size_t branch) const { return states_[branch] == BranchState::saved; }

  /// The point that a branch of one is.
  Task task_of(std::size_t branch) const {
    Task task{branch, scene_at(sweep_, share_.point(branch, 0)), {}};
    task.effects = effects_of(task.scene);
    return task;
  }

  /// Runs the points that fit in lanes, and one by one between them those that don't.
  void run_crew(std::size_t thread) {
    const auto take = [&](const Task& task, PointResult&& result) { store(task, std::move(result), thread); };
    Chunk chunk{0, 0};
    const auto next = [&]() -> std::optional<Task> {
      for (;; ++chunk.begin) {
        if (chunk.begin == chunk.end) {
          const auto other = next_chunk();
          if (!other) return std::nullopt;
          chunk = *other;
        }
        if (is_restored(chunk.begin)) continue;
        const Task task = task_of(chunk.begin);
        if (can_go_into_lanes(task)) {
          ++chunk.begin;
          return task;
        }
        run_batch({&task, 1}, workshops_[thread], take);
      }
    };
    Crew crew(visits_of(arch_), workshops_[thread], next, take);
    crew.run();
    const std::lock_guard lock(mutex_);
    lane_work_.proved += crew.proved(), lane_work_.refined += crew.refined();
  }

  void store(const Task& task, PointResult&& result, std::size_t thread) {
    add(usage_[thread], usage_of(task, result));
    columns_.store(task.slot, std::move(result));
    if (!sweep_.follow) states_[task.slot] = BranchState::finished;
    progress_.add_point(thread);
  }

  /// Runs the points of a branch, each from the end of the one before.
  void run_branch(std::size_t branch, std::size_t thread) {
    std::optional<Start> end;
    for (std::size_t i = 0; i < share_.length(); ++i) {
      Task task{share_.slot(branch, i), scene_at(sweep_, share_.point(branch, i)), {}};
      start_from(task.scene, end);
      task.effects = effects_of(task.scene);
      run_batch({&task, 1}, workshops_[thread], [&](const Task&, PointResult&& result) {
        end = failed(result.status) ? std::nullopt : std::optional<Start>(result.end);
        store(task, std::move(result), thread);
      });
    }
    states_[branch] = BranchState::finished;
  }

  void run_chunk(const Chunk& chunk, std::size_t thread) {
    if (sweep_.follow) {
      if (!is_restored(chunk.begin)) run_branch(chunk.begin, thread);
    } else {
      run_points(chunk, thread);
    }
  }

  /// Runs points that don't depend on each other, those of equal kernels together.
  void run_points(const Chunk& chunk, std::size_t thread) {
    std::vector<Task> tasks;
    tasks.reserve(chunk.end - chunk.begin);
    for (std::size_t branch = chunk.begin; branch < chunk.end; ++branch)
      if (!is_restored(branch)) tasks.push_back(task_of(branch));
    const auto kernel = [](const Task& task) { return kernel_of(task.effects); };
    std::ranges::stable_sort(tasks, {}, kernel);
    for (std::span<const Task> left(tasks); !left.empty();) {
      const auto other = std::ranges::find_if(left, [&](const Task& task) { return kernel(task) != kernel(left[0]); });
      const auto batch = static_cast<std::size_t>(other - left.begin());
      run_batch(left.first(batch), workshops_[thread],
                [&](const Task& task, PointResult&& result) { store(task, std::move(result), thread); });
      left = left.subspan(batch);
    }
  }

  const Sweep& sweep_;
  const Share& share_;
  Columns& columns_;
  std::vector<std::atomic<BranchState>>& states_;  ///< [branch]
  SweepProgress progress_;
  std::optional<FourierTransform> transform_;
  std::size_t chunk_;  ///< branches that a thread takes at once
  Scatter chunks_;     ///< the order of the chunks
  Arch arch_;
  bool in_lanes_;
  std::atomic<std::size_t> turn_ = 0;      ///< the next one of the chunks
  std::vector<Workshop> workshops_;        ///< [thread]
  std::vector<std::vector<Usage>> usage_;  ///< [thread]
  LaneWork lane_work_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> stopped_ = false;  ///< by a failure: what is left isn't begun
  ForkJoin fork_join_;
};

}  // namespace

int threads_used(const RunOptions& options) { return options.threads > 0 ? options.threads : omp_get_max_threads(); }

SweepRun::SweepRun(const Sweep& sweep, const std::optional<Shard>& shard)
    : sweep_(sweep), shard_(shard), share_(sweep, shard), columns_(sweep, shard), states_(share_.count()) {}

bool SweepRun::restore(std::span<const std::byte> results) {
  while (!results.empty()) {
    std::uint64_t branch = 0;
    if (results.size() < sizeof branch) return false;
    std::memcpy(&branch, results.data(), sizeof branch);
    results = results.subspan(sizeof branch);
    if (branch >= share_.count() || states_[branch] != BranchState::open) return false;
    for (std::size_t i = 0; i < share_.length(); ++i)
      if (!columns_.unpack(share_.slot(branch, i), results)) return false;
    states_[branch] = BranchState::saved, restored_ += share_.length();
  }
  return true;
}

double SweepRun::most_saved() const {
  return enough_to_save + sizeof(std::uint64_t) +
         static_cast<double>(share_.length()) * static_cast<double>(columns_.packed_size_without_log());
}

void SweepRun::save(const std::function<void(std::span<const std::byte> results)>& write) {
  std::vector<std::byte> results;
  std::vector<std::size_t> packed;
  const auto write_packed = [&] {
    write(results), results.clear();
    for (const std::size_t branch : packed) states_[branch] = BranchState::saved;
    packed.clear();
  };
  for (std::uint64_t branch = 0; branch < share_.count(); ++branch) {
    if (states_[branch] != BranchState::finished) continue;
    std::size_t more = sizeof branch;
    for (std::size_t i = 0; i < share_.length(); ++i) more += columns_.packed_size(share_.slot(branch, i));
    if (more > enough_to_save)
      results.reserve(results.size() + more);  // a buffer that doubles would take up to twice as much
    const auto number = std::as_bytes(std::span(&branch, 1));
    results.insert(results.end(), number.begin(), number.end());
    for (std::size_t i = 0; i < share_.length(); ++i) columns_.pack(share_.slot(branch, i), results);
    packed.push_back(branch);
    if (results.size() >= enough_to_save) write_packed();
  }
  if (!results.empty()) write_packed();
}

void SweepRun::run(const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto threads = static_cast<std::size_t>(threads_used(options));
  result_.threads = static_cast<int>(std::clamp<std::size_t>(share_.count(), 1, threads));  // others would wait
  require_thread_stacks(result_.threads);
  Team team(sweep_, share_, options, result_.threads, columns_, states_, restored_);
  team.run();
  team.rethrow();
  result_.usage = team.usage();
  result_.arch = options.arch, result_.lanes = team.lane_work();
  result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

RunResult SweepRun::result() {
  result_.points = share_.points();
  result_.failed_points = columns_.failed_points();
  result_.figure = columns_.figure();
  if (shard_)
    result_.figure.attributes = {{"shard", text_of(*shard_)}, {"rounding", rounding_of(sweep_, result_.arch)}};
  return std::move(result_);
}

RunResult run(const Sweep& sweep, const RunOptions& options) {
  SweepRun sweep_run(sweep);
  sweep_run.run(options);
  return sweep_run.result();
}

}  // namespace clatter
