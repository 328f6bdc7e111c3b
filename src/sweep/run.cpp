#include "sweep/run.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "sweep/columns.hpp"
#include "sweep/fork_join.hpp"
#include "sweep/point.hpp"

namespace clatter {
namespace {

/// Points that run one after the other: along `follow` a whole branch, else a single point.
struct Branches {
  std::size_t count = 0, length = 1, stride = 1;

  explicit Branches(const Sweep& sweep) : count(size(sweep)) {
    if (!sweep.follow) return;
    length = clatter::length(sweep.dimensions[*sweep.follow]);
    for (std::size_t d = *sweep.follow + 1; d < sweep.dimensions.size(); ++d)
      stride *= clatter::length(sweep.dimensions[d]);
    count /= length;
  }
  /// Index of the i-th point of a branch.
  [[nodiscard]] std::size_t point(std::size_t branch, std::size_t i) const {
    return (branch / stride * length + i) * stride + branch % stride;
  }
};

/// Starts a point of a branch where the one before was left, or from the scene where that failed; a state outside
/// narrower stops moves onto the stop, its velocity kept.
void start_from(Scene& scene, const std::optional<Start>& end) {
  if (end) scene.start = *end;
  scene.start.displacement = std::clamp(scene.start.displacement, scene.stops.lower, scene.stops.upper);
}

/// Calls the user's progress function a few times a second, from one thread at a time.
class Progress {
 public:
  Progress(const RunOptions& options, std::size_t total) : report_(options.progress), total_(total) {}

  void add_point() {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    ++done_;
    const auto now = Clock::now();
    if (now - last_ <= std::chrono::milliseconds(200) && done_ != total_) return;
    last_ = now;
    report_(done_, total_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<void(std::size_t, std::size_t)>& report_;
  std::mutex mutex_;
  std::size_t total_, done_ = 0;
  Clock::time_point last_{};
};

void run_branch(const Sweep& sweep, const Branches& branches, std::size_t branch, Workshop& workshop, Columns& columns,
                Progress& progress) {
  std::optional<Start> end;
  for (std::size_t i = 0; i < branches.length; ++i) {
    const std::size_t point = branches.point(branch, i);
    Scene scene = scene_at(sweep, point);
    start_from(scene, end);
    PointResult result = run_point(scene, workshop);
    end = failed(result.status) || !sweep.follow ? std::nullopt : std::optional<Start>(result.end);
    columns.store(point, std::move(result));
    progress.add_point();
  }
}

/// The threads that run a sweep, and what they share.
class Team {
 public:
  Team(const Sweep& sweep, const RunOptions& options, int threads, Columns& columns)
      : sweep_(sweep),
        branches_(sweep),
        columns_(columns),
        progress_(options, size(sweep)),
        workshops_(static_cast<std::size_t>(threads)) {
    const Observe& observe = sweep.scene.observe;
    if (observe.harmonics == 0 || observe.harmonics_method != HarmonicsMethod::fft) return;
    transform_.emplace(static_cast<std::size_t>(observe.harmonics_samples));
    for (Workshop& workshop : workshops_) workshop = {&*transform_, transform_->workspace()};
  }

  /// Runs every branch; results go by index, so their bits don't depend on which thread runs what.
  CLATTER_PARALLEL_REGION void run() {
    fork_join_.fork();
#pragma omp parallel for schedule(dynamic) num_threads(threads())
    for (std::size_t branch = 0; branch < branches_.count; ++branch)
      work(branch, static_cast<std::size_t>(omp_get_thread_num()));
    fork_join_.join();
  }

  /// Passes on what a thread could not do.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] int threads() const { return static_cast<int>(workshops_.size()); }

  void work(std::size_t branch, std::size_t thread) noexcept {
    const ForkJoin::Member member(fork_join_);
    if (stopped_) return;
    try {
      run_branch(sweep_, branches_, branch, workshops_[thread], columns_, progress_);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  const Sweep& sweep_;
  Branches branches_;
  Columns& columns_;
  Progress progress_;
  std::optional<FourierTransform> transform_;
  std::vector<Workshop> workshops_;  ///< [thread]
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> stopped_ = false;  ///< by a failure: what is left isn't begun
  ForkJoin fork_join_;
};

}  // namespace

RunResult run(const Sweep& sweep, const RunOptions& options) {
  RunResult result;
  const auto begin = std::chrono::steady_clock::now();
  Columns columns(sweep);
  result.points = size(sweep);
  result.threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  Team team(sweep, options, result.threads, columns);
  team.run();
  team.rethrow();
  result.failed_points = columns.failed_points();
  result.impacts = columns.impacts();
  result.periods = columns.periods();
  result.figure = columns.figure();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace clatter
