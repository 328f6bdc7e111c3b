#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "certificates/growth.hpp"
#include "point/exact_motion.hpp"
#include "point/problem.hpp"

namespace clatter::certificates {

/// A state of the main mass, and of a loose one if there is one.
struct MachineState {
  double x = 0.0, v = 0.0, z = 0.0, w = 0.0;
  Side pressed_by = Side::none;  ///< the wall that presses the loose mass
};
[[nodiscard]] inline double size_of(const MachineState& s) {
  return std::max({std::abs(s.x), std::abs(s.v), std::abs(s.z), std::abs(s.w)});
}
[[nodiscard]] inline double distance(const MachineState& a, const MachineState& b) {
  return size_of({a.x - b.x, a.v - b.v, a.z - b.z, a.w - b.w});
}

/// An event of a motion of n numbers: (x, x'), with a loose mass (x, x', z, z'). Of a wall it is told as one of a mass
/// between stops: a press is a rest.
template <std::size_t n>
struct RecordedEvent : motion::Event {
  typename Growth<n>::Map derivative{};  ///< of the state before it, of a press at its end, by that at the start
  typename Growth<n>::Sizes rounding{};  ///< that of earlier flights as it has grown, in its units
  typename Growth<n>::Map stop{};        ///< of a hold that begins where friction stops a loose mass, there,
  typename Growth<n>::Sizes rounding_at_stop{};

  /// Whether friction holds, or turns, a loose mass in its housing.
  [[nodiscard]] bool is_of_loose_friction() const { return of_wall && side == Side::none; }
  [[nodiscard]] bool is_rest() const { return kind == Kind::rest; }
};

/// A motion of n numbers over some forcing periods, from the start of its problem on.
template <std::size_t n>
struct RecordedMotion {
  std::vector<RecordedEvent<n>> events{};  ///< times since the start
  MachineState end{};
  typename Growth<n>::Map derivative{};  ///< from the start to the end
  typename Growth<n>::Sizes rounding{};  ///< of all flights but the last, grown to the end, as in `RecordedEvent`
  double duration = 0.0;                 ///< tau
};

/// The events of a record, in which each rest and each chatter is one event, however many sections cut it. A chatter
/// follows an impact; a time on a stop that follows none, or a rest, is a rest, though its force be within rounding
/// of 0. On a soft stop this is no event.
/// `growth` is of all of them, up to the last.
[[nodiscard]] std::vector<RecordedEvent<2>> joined_events(const point::MotionRecorder& recorder, const Stops& stops,
                                                          Growth<2>& growth);

/// The events of a record without the last impacts of each chatter on a stop whose restitution depends on the speed:
/// before a run sums them there may be thousands. After one a thousand times slower than the fastest the rest of them
/// is one event.
[[nodiscard]] std::vector<RecordedEvent<2>> with_short_chatters(const std::vector<RecordedEvent<2>>& events,
                                                                const Stops& stops);

/// Records the motion of a problem for a time in forcing periods; if a stop is named, this releases the mass at the
/// start. Nothing if the motion cannot be completed.
[[nodiscard]] std::optional<RecordedMotion<2>> recorded(const point::Problem& problem, double turns,
                                                        Side released = Side::none);

/// Records the motion of a problem from the first release by a stop after its start on, in 50 digits, for so many
/// forcing periods, after which that stop lets go of the mass again: the events are exact, so no error grows on the
/// way. `release` becomes the time of the release since the start. Nothing if there is no such motion, or if 50 digits
/// don't tell.
[[nodiscard]] std::optional<RecordedMotion<2>> recorded_from_release(const point::Problem& problem, Side side,
                                                                     double turns, double& release);

/// The events of a record with a loose mass, without the last impacts of each chatter that ends in a press, which are
/// as slow as rounding: after an impact a thousand times slower than the fastest the rest of them is one event.
[[nodiscard]] std::vector<RecordedEvent<4>> with_chatters(std::vector<RecordedEvent<4>> events);

/// Records the motion of a problem with a loose mass for a time in forcing periods. Nothing if it cannot be completed.
[[nodiscard]] std::optional<RecordedMotion<4>> recorded_in_housing(const point::Problem& problem, double turns);

}  // namespace clatter::certificates
