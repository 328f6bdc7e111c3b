#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "certificates/growth.hpp"
#include "motion/event.hpp"
#include "point/problem.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::certificates {

using HousingGrowth = BasicGrowth<4>;

/// A state of a main mass and a loose one.
struct HousingState {
  double x = 0.0, v = 0.0, z = 0.0, w = 0.0;
  Side pressed_by = Side::none;  ///< the wall that presses the loose mass
};
[[nodiscard]] inline double size_of(const HousingState& s) {
  return std::max({std::abs(s.x), std::abs(s.v), std::abs(s.z), std::abs(s.w)});
}
[[nodiscard]] inline double distance(const HousingState& a, const HousingState& b) {
  return size_of({a.x - b.x, a.v - b.v, a.z - b.z, a.w - b.w});
}

/// An impact on a wall, a chatter, or a time for which a wall presses the loose mass (`rest`).
struct HousingEvent : motion::Event {
  HousingGrowth::Map derivative{};  ///< of (x, x', z, z') before it by the start; of a press at its end
  HousingGrowth::Sizes rounding{};  ///< that of earlier flights as it has grown, in its units
  PhasePoint main{};                ///< x and x' there

  [[nodiscard]] bool is_press() const { return kind == Kind::rest; }
};

/// A motion with a loose mass over some forcing periods, from the start of its problem on.
struct HousingMotion {
  std::vector<HousingEvent> events{};  ///< times since the start
  HousingState end{};
  HousingGrowth::Map derivative{};  ///< of (x, x', z, z') at the end by the start
  HousingGrowth::Sizes rounding{};  ///< of all flights but the last, grown to the end
  double duration = 0.0;            ///< tau
};

/// The events of a record without the last impacts of each chatter that ends in a press, which are as slow as rounding:
/// after an impact a thousand times slower than the fastest the rest of them is one event.
[[nodiscard]] std::vector<HousingEvent> with_chatters(std::vector<HousingEvent> events);

/// Records the motion of a problem with a loose mass for a time in forcing periods. Nothing if it cannot be completed.
[[nodiscard]] std::optional<HousingMotion> recorded_in_housing(const point::Problem& problem, double turns);

}  // namespace clatter::certificates
