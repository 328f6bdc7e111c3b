#include "sweep/run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "lanes/run_in_lanes.hpp"
#include "lanes/scheduler.hpp"
#include "point/point.hpp"
#include "sweep/branches.hpp"
#include "sweep/mirror_images.hpp"
#include "sweep/parallel.hpp"
#include "sweep/result_store.hpp"
#include "sweep/rounding_fingerprint.hpp"
#include "sweep/scatter.hpp"
#include "sweep/sweep_progress.hpp"
#include "sweep/thread_stacks.hpp"

namespace clatter::sweep {
namespace {

WorkStats work_of(const point::WorkItem& item, const point::PointResult& result) {
  WorkStats work{.effects = item.effects,
                 .points = 1,
                 .impacts = result.impacts,
                 .periods = result.periods,
                 .evaluations = result.evaluations};
  work.found_by[static_cast<std::size_t>(result.found_by)] = 1;
  return work;
}

void add(std::vector<WorkStats>& sum, const WorkStats& part) {
  auto same = std::ranges::find(sum, part.effects, &WorkStats::effects);
  if (same == sum.end()) same = sum.insert(sum.end(), WorkStats{.effects = part.effects});
  same->points += part.points;
  for (std::size_t i = 0; i < part.found_by.size(); ++i) same->found_by[i] += part.found_by[i];
  same->impacts += part.impacts, same->periods += part.periods, same->evaluations += part.evaluations;
}

/// Size of packed results from which on they are written at once.
constexpr std::size_t enough_to_save = 256UL * 1024;  // bytes

/// The threads that run a sweep, and their shared state.
class WorkerPool {
 public:
  /// Leaves out the branches that are saved; `restored` is the number of their points.
  WorkerPool(const Sweep& sweep, const Share& share, const RunOptions& options, int threads, ResultStore& store,
             std::vector<std::atomic<BranchState>>& states, std::size_t restored)
      : sweep_(sweep),
        share_(share),
        store_(store),
        states_(states),
        progress_(options, static_cast<std::size_t>(threads), share.points(), restored),
        chunk_(sweep.follow
                   ? 1
                   : std::clamp<std::size_t>(share_.count() / (64 * static_cast<std::size_t>(threads)), 1, 64)),
        chunks_((share_.count() + chunk_ - 1) / chunk_),
        most_branches_((share_.count() + static_cast<std::size_t>(threads) - 1) / static_cast<std::size_t>(threads)),
        arch_(options.arch),
        in_lanes_(runs_in_lanes(sweep, options.arch)),
        mirror_images_(sweep),
        has_whole_pairs_(mirror_images_.exist() && share.points() == size(sweep)),
        scratches_(static_cast<std::size_t>(threads)),
        work_(static_cast<std::size_t>(threads)) {
    for (std::size_t thread = 0; options.progress && thread < scratches_.size(); ++thread)
      scratches_[thread].progress = [this, thread](double part) { progress_.add_part(thread, part); };
    const observables::FourierScratch fourier = observables::Harmonics::scratch_for(sweep.problem.observe);
    for (point::ThreadScratch& scratch : scratches_) scratch.fourier = fourier.for_another_thread();
    for (std::size_t point = 0; has_whole_pairs_ && restored > 0 && point < share_.count(); ++point)
      if (const auto original = mirror_images_.original_of(point))
        if (states_[point] == BranchState::open && states_[*original] == BranchState::saved) bereft_.push_back(point);
  }

  /// Runs every branch; results go by index, so their bits don't depend on which thread runs what.
  void run() {
    on_each_thread(static_cast<int>(scratches_.size()), [this](std::size_t thread) { run_thread(thread); });
  }

  /// The work of all threads, the cheapest compiled set first.
  [[nodiscard]] std::vector<WorkStats> work() const {
    std::vector<WorkStats> sum;
    for (const std::vector<WorkStats>& of_thread : work_)
      for (const WorkStats& part : of_thread) add(sum, part);
    std::ranges::sort(sum, cheaper, &WorkStats::effects);
    return sum;
  }

  [[nodiscard]] const LaneWork& lane_work() const { return lane_work_; }

  /// Rethrows the first exception of a thread.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// The work of one thread: chunk after chunk, until none is left.
  void run_thread(std::size_t thread) noexcept {
    try {
      if (in_lanes_) {
        run_lanes(thread);
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
  /// Branches that no thread has begun; empty if none is left or another thread has failed.
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
  /// Whether a branch needs no run: it is restored, or follows from its mirror image.
  [[nodiscard]] bool is_left_out(std::size_t branch) const {
    return is_restored(branch) || (has_whole_pairs_ && mirror_images_.original_of(branch) && !is_bereft(branch));
  }
  /// Whether the original of a mirror image is restored, and can't give it its result any more.
  [[nodiscard]] bool is_bereft(std::size_t point) const { return std::ranges::binary_search(bereft_, point); }

  /// A point of a branch, the first or, if there is an end of the one before, from that.
  point::WorkItem item_of(std::size_t branch, std::size_t position = 0, const std::optional<Start>& end = {},
                          const Units& units_of_end = {}) const {
    const std::size_t point = share_.point(branch, position);
    point::WorkItem item{branch, position, problem_at(sweep_, mirror_images_.original_of(point).value_or(point)), {}};
    if (sweep_.follow) start_from(item.problem, end, units_of_end);
    item.effects = effects_of(item.problem);
    return item;
  }

  /// Runs the points that lanes accept, and between them, one by one, those that they don't. Of branches, a thread
  /// takes no more than its share, so that the others have as many.
  void run_lanes(std::size_t thread) {
    std::vector<point::WorkItem> ready;  // next points of branches that have been begun
    std::size_t begun = 0, ended = 0;    // branches
    const auto take = [&](const point::WorkItem& item, point::PointResult&& result) {
      if (auto successor = store(item, std::move(result), thread))
        ready.push_back(std::move(*successor));
      else
        ++ended;
    };
    Chunk chunk{0, 0};
    const auto begin_branch = [&]() -> std::optional<point::WorkItem> {
      if (sweep_.follow && begun - ended >= most_branches_) return std::nullopt;
      for (;; ++chunk.begin) {
        if (chunk.begin == chunk.end) {
          const auto other = next_chunk();
          if (!other) return std::nullopt;
          chunk = *other;
        }
        if (is_left_out(chunk.begin)) continue;
        ++begun;
        return item_of(chunk.begin++);
      }
    };
    const auto next = [&]() -> std::optional<point::WorkItem> {
      for (;;) {
        std::optional<point::WorkItem> item;
        if (ready.empty()) {
          item = begin_branch();
        } else {
          item = std::move(ready.back()), ready.pop_back();
        }
        if (!item || lanes::accepts(*item)) return item;
        run_batch({&*item, 1}, scratches_[thread], take);
      }
    };
    lanes::Scheduler scheduler(arch_, scratches_[thread], next, take);
    scheduler.run();
    const std::lock_guard lock(mutex_);
    lane_work_.proved += scheduler.proved(), lane_work_.refined += scheduler.refined();
  }

  /// Stores a point's result; returns the next point of its branch, if there is one.
  std::optional<point::WorkItem> store(const point::WorkItem& item, point::PointResult&& result, std::size_t thread) {
    std::optional<Start> end = failed(result.status) ? std::nullopt : std::optional<Start>(result.end);
    if (end) end->phase -= item.problem.shaking.lead;
    add(work_[thread], work_of(item, result));
    if (mirror_images_.exist()) {
      const std::size_t point = share_.point(item.branch, item.position);
      if (mirror_images_.original_of(point)) {
        result = mirrored(result);
      } else if (has_whole_pairs_) {
        store_image_of(point, result, item.problem.units, thread);
      }
    }
    store_.store(share_.local_index(item.branch, item.position), std::move(result), item.problem.units);
    progress_.add_point(thread);
    if (item.position + 1 < share_.length()) return item_of(item.branch, item.position + 1, end, item.problem.units);
    states_[item.branch] = BranchState::finished;
    return std::nullopt;
  }

  /// Stores the result of a point's mirror image, which no other thread touches.
  void store_image_of(std::size_t point, const point::PointResult& result, const Units& units, std::size_t thread) {
    const auto image = mirror_images_.image_of(point);
    if (!image || is_restored(*image) || is_bereft(*image)) return;
    store_.store(*image, mirrored(result), units);
    progress_.add_point(thread);
    states_[*image] = BranchState::finished;
  }

  /// Runs the points of a branch, each from the end of the one before.
  void run_branch(std::size_t branch, std::size_t thread) {
    std::optional<point::WorkItem> item = item_of(branch), successor;
    for (; item; item = std::move(successor))
      run_batch({&*item, 1}, scratches_[thread], [&](const point::WorkItem& done, point::PointResult&& result) {
        successor = store(done, std::move(result), thread);
      });
  }

  void run_chunk(const Chunk& chunk, std::size_t thread) {
    if (sweep_.follow) {
      if (!is_restored(chunk.begin)) run_branch(chunk.begin, thread);
    } else {
      run_points(chunk, thread);
    }
  }

  /// Runs points that don't depend on each other, those with the same compiled set of effects together.
  void run_points(const Chunk& chunk, std::size_t thread) {
    std::vector<point::WorkItem> items;
    items.reserve(chunk.end - chunk.begin);
    for (std::size_t branch = chunk.begin; branch < chunk.end; ++branch)
      if (!is_left_out(branch)) items.push_back(item_of(branch));
    const auto set_of = [](const point::WorkItem& item) { return effect_set_of(item.effects); };
    std::ranges::stable_sort(items, {}, set_of);
    for (std::span<const point::WorkItem> left(items); !left.empty();) {
      const auto other =
          std::ranges::find_if(left, [&](const point::WorkItem& item) { return set_of(item) != set_of(left[0]); });
      const auto batch = static_cast<std::size_t>(other - left.begin());
      run_batch(left.first(batch), scratches_[thread], [&](const point::WorkItem& item, point::PointResult&& result) {
        store(item, std::move(result), thread);
      });
      left = left.subspan(batch);
    }
  }

  const Sweep& sweep_;
  const Share& share_;
  ResultStore& store_;
  std::vector<std::atomic<BranchState>>& states_;  ///< [branch]
  SweepProgress progress_;
  std::size_t chunk_;          ///< branches that a thread takes at once
  Scatter chunks_;             ///< the order of the chunks
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

}  // namespace

int threads_used(const RunOptions& options) { return options.threads > 0 ? options.threads : default_threads(); }

/// Lanes take the exact method's shortcuts to steady motion.
bool runs_in_lanes(const Sweep& sweep, lanes::InstructionSet arch) {
  const stepping::Integration& integration = sweep.problem.integration;
  return arch != lanes::InstructionSet::scalar && integration.method == stepping::Method::exact &&
         integration.shortcuts && !integration.all_effects;
}

SweepRun::SweepRun(const Sweep& sweep, const std::optional<Shard>& shard)
    : sweep_(sweep), shard_(shard), share_(sweep, shard), store_(sweep, shard), states_(share_.count()) {}

bool SweepRun::restore(std::span<const std::byte> results) {
  while (!results.empty()) {
    std::uint64_t branch = 0;
    if (results.size() < sizeof branch) return false;
    std::memcpy(&branch, results.data(), sizeof branch);
    results = results.subspan(sizeof branch);
    if (branch >= share_.count() || states_[branch] != BranchState::open) return false;
    for (std::size_t i = 0; i < share_.length(); ++i)
      if (!store_.unpack(share_.local_index(branch, i), results)) return false;
    states_[branch] = BranchState::saved, restored_ += share_.length();
  }
  return true;
}

double SweepRun::most_saved() const {
  return enough_to_save + sizeof(std::uint64_t) +
         static_cast<double>(share_.length()) * static_cast<double>(store_.most_packed_without_log());
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
    for (std::size_t i = 0; i < share_.length(); ++i) more += store_.most_packed(share_.local_index(branch, i));
    if (more > enough_to_save)
      results.reserve(results.size() + more);  // growing by doubling would take up to twice as much
    const auto number = std::as_bytes(std::span(&branch, 1));
    results.insert(results.end(), number.begin(), number.end());
    for (std::size_t i = 0; i < share_.length(); ++i) store_.pack(share_.local_index(branch, i), results);
    packed.push_back(branch);
    if (results.size() >= enough_to_save) write_packed();
  }
  if (!results.empty()) write_packed();
}

void SweepRun::run(const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto threads = static_cast<std::size_t>(threads_used(options));
  result_.threads =
      static_cast<int>(std::clamp<std::size_t>(share_.count(), 1, threads));  // more would have nothing to do
  require_thread_stacks(result_.threads);
  WorkerPool pool(sweep_, share_, options, result_.threads, store_, states_, restored_);
  pool.run();
  pool.rethrow();
  store_.number_motions(result_.threads);
  result_.work = pool.work();
  result_.arch = options.arch, result_.lanes = pool.lane_work();
  result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

RunResult SweepRun::result() {
  result_.points = share_.points();
  result_.failed_points = store_.failed_points();
  result_.dataset = store_.dataset();
  if (shard_)
    result_.dataset.attributes = {{"shard", text_of(*shard_)},
                                  {"rounding", rounding_fingerprint(sweep_, result_.arch)}};
  return std::move(result_);
}

RunResult run(const Sweep& sweep, const RunOptions& options) {
  SweepRun sweep_run(sweep);
  sweep_run.run(options);
  return sweep_run.result();
}

}  // namespace clatter::sweep
