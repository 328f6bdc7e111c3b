#include "lanes/run_in_lanes.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "lanes/scheduler.hpp"

namespace clatter::lanes {

bool accepts(const point::WorkItem& item) {
  return (item.effects.stops() || item.problem.time.mode == steady::Mode::transient) && accepts(item.problem);
}

point::PointResult run_in_lanes(const point::WorkItem& item, std::size_t times, InstructionSet arch,
                                point::ThreadScratch& scratch) {
  point::PointResult result;
  std::size_t begun = 0;
  const auto next = [&] { return begun++ < times ? std::optional(item) : std::nullopt; };
  const auto take = [&](const point::WorkItem&, point::PointResult&& of_point) { result = std::move(of_point); };
  Scheduler scheduler(step_functions_of(arch), scratch, next, take);
  scheduler.run();
  return result;
}

double seconds_per_period(const point::WorkItem& item, InstructionSet arch) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t times = 4 * lanes_per_block;
  point::ThreadScratch scratch;
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 3; ++repetition) {
    const auto begin = Clock::now();
    const double periods = run_in_lanes(item, times, arch, scratch).periods * times;
    least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count() / periods);
  }
  return least;
}

}  // namespace clatter::lanes
