#include "lanes/run_in_lanes.hpp"

#include <optional>
#include <utility>

#include "lanes/scheduler.hpp"

namespace clatter::lanes {

bool accepts(const point::WorkItem& item) {
  const bool is_transient = item.problem.time.mode == steady::Mode::transient;
  const bool has_work = is_transient ? !item.effects.soft : item.effects.stops();  // lanes settle soft contacts only
  return has_work && !item.effects.loose && !item.effects.own_motion && accepts(item.problem);
}

point::PointResult run_in_lanes(const point::WorkItem& item, std::size_t times, InstructionSet arch,
                                point::ThreadScratch& scratch) {
  point::PointResult result;
  std::size_t begun = 0;
  const auto next = [&] { return begun++ < times ? std::optional(item) : std::nullopt; };
  const auto take = [&](const point::WorkItem&, point::PointResult&& of_point) { result = std::move(of_point); };
  Scheduler scheduler(arch, scratch, next, take);
  scheduler.run();
  return result;
}

}  // namespace clatter::lanes
