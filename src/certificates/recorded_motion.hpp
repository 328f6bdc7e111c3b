#pragma once

#include <array>
#include <optional>
#include <vector>

#include "certificates/growth.hpp"
#include "point/exact_motion.hpp"
#include "point/problem.hpp"

namespace clatter::certificates {

/// An event and the derivative of the motion from its start to the instant before it.
struct RecordedEvent : motion::Event {
  motion::Jacobian<double> derivative{};
  std::array<double, 2> rounding{};  ///< that of earlier flights as it has grown, in x and v, in its units

  [[nodiscard]] bool is_rest() const { return kind == Kind::rest; }
};

/// The events of a record, in which each rest and each chatter is one event, however many sections cut it. A chatter
/// follows an impact; a time on a stop that follows none, or a rest, is a rest, though its force be within rounding
/// of 0. On a soft stop this is no event.
/// `growth` is of all of them, up to the last.
[[nodiscard]] std::vector<RecordedEvent> joined_events(const point::MotionRecorder& recorder, const Stops& stops,
                                                       Growth& growth);

/// A motion over some forcing periods, from the start of its problem on.
struct RecordedMotion {
  std::vector<RecordedEvent> events{};  ///< times since the start
  motion::State<double> end{};
  motion::Jacobian<double> derivative{};  ///< from the start to the end
  std::array<double, 2> rounding{};       ///< of all flights but the last, grown to the end, as in `RecordedEvent`
  double duration = 0.0;                  ///< tau
};

/// Records the motion of a problem for a time in forcing periods; if a stop is named, this releases the mass at the
/// start. Nothing if the motion cannot be completed.
[[nodiscard]] std::optional<RecordedMotion> recorded(const point::Problem& problem, double turns,
                                                     Side released = Side::none);

/// Records the motion of a problem from the first release by a stop after its start on, in 50 digits, for so many
/// forcing periods, after which that stop lets go of the mass again: the events are exact, so no error grows on the
/// way. `release` becomes the time of the release since the start. Nothing if there is no such motion, or if 50 digits
/// don't tell.
[[nodiscard]] std::optional<RecordedMotion> recorded_from_release(const point::Problem& problem, Side side,
                                                                  double turns, double& release);

}  // namespace clatter::certificates
