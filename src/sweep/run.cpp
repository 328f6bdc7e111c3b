#include "sweep/run.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <exception>
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

/// Starts a point of a branch where the one before was left, or from the scene where that failed; a state outside narrower stops moves onto
/// the stop, its velocity kept.
void start_from(Scene& scene, const std::optional<Start>& end) {
  if (end) scene.start = *end;
  scene.start.displacement = std::clamp(scene.start.displacement, scene.stops.lower, scene.stops.upper);
}

void run_branch(const Sweep& sweep, const Branches& branches, std::size_t branch, Workshop& workshop,
                Columns& columns) {
  std::optional<Start> end;
  for (std::size_t i = 0; i < branches.length; ++i) {
    const std::size_t point = branches.point(branch, i);
    Scene scene = scene_at(sweep, point);
    start_from(scene, end);
    PointResult result = run_point(scene, workshop);
    end = failed(result.status) || !sweep.follow ? std::nullopt : std::optional<Start>(result.end);
    columns.store(point, std::move(result));
  }
}

/// Calls the user's progress function a few times a second, from one thread at a time.
class Progress {
 public:
  Progress(const RunOptions& options, std::size_t total) : report_(options.progress), total_(total) {}

  void add(std::size_t points) {
    if (!report_) return;
#pragma omp critical(clatter_progress)
    {
      done_ += points;
      const auto now = Clock::now();
      if (now - last_ > std::chrono::milliseconds(200) || done_ == total_) {
        last_ = now;
        report_(done_, total_);
      }
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<void(std::size_t, std::size_t)>& report_;
  std::size_t total_, done_ = 0;
  Clock::time_point last_{};
};

void run_all(const Sweep& sweep, const RunOptions& options, int threads, Columns& columns) {
  const Branches branches(sweep);
  const Observe& observe = sweep.scene.observe;
  std::optional<FourierTransform> transform;
  if (observe.harmonics > 0 && observe.harmonics_method == HarmonicsMethod::fft)
    transform.emplace(static_cast<std::size_t>(observe.harmonics_samples));
  std::vector<Workshop> workshops(static_cast<std::size_t>(threads));
  for (Workshop& workshop : workshops)
    if (transform) workshop = {&*transform, transform->workspace()};
  Progress progress(options, size(sweep));
  std::exception_ptr failure;
  ForkJoin fork_join;
#pragma omp parallel num_threads(threads)
  {
    const ForkJoin::Member member(fork_join);
    Workshop& workshop = workshops[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(dynamic)
    for (std::size_t branch = 0; branch < branches.count; ++branch) try {
        run_branch(sweep, branches, branch, workshop, columns);
        progress.add(branches.length);
      } catch (...) {
#pragma omp critical(clatter_failure)
        failure = std::current_exception();
      }
  }
  fork_join.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

RunResult run(const Sweep& sweep, const RunOptions& options) {
  RunResult result;
  const auto begin = std::chrono::steady_clock::now();
  Columns columns(sweep);
  result.points = size(sweep);
  result.threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  run_all(sweep, options, result.threads, columns);
  result.failed_points = columns.failed_points();
  result.impacts = columns.impacts();
  result.periods = columns.periods();
  result.figure = columns.figure();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace clatter
