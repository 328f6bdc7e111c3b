#include "sweep/lane_points.hpp"

#include <optional>
#include <utility>

#include "sweep/crew.hpp"

namespace clatter {

static_assert(full_crew == Row::width);

bool can_go_into_lanes(const Task& task) {
  return (task.effects.stops() || task.scene.time.mode == Mode::transient) && fits_lanes(task.scene);
}

PointResult run_in_lanes(const Task& task, std::size_t times, Arch arch, Workshop& workshop) {
  PointResult result;
  std::size_t begun = 0;
  const auto next = [&] { return begun++ < times ? std::optional(task) : std::nullopt; };
  const auto take = [&](const Task&, PointResult&& of_point) { result = std::move(of_point); };
  Crew crew(visits_of(arch), workshop, next, take);
  crew.run();
  return result;
}

}  // namespace clatter
