#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/state.hpp"
#include "point/problem.hpp"

namespace clatter::point {

/// The motion that a stop's release from rest leads to. A release is always in the same state, so this depends on the
/// scene alone.
struct RestingMotion {
  enum class Kind : std::uint8_t {
    none,       ///< the stop never releases a mass
    periodic,   ///< it rests again and again; `sections` are one period
    longer,     ///< it returns to rest only after more than RepeatFinder::longest forcing periods
    departs,    ///< it doesn't rest any more, at least for so long; `sections`, if known, ends with its state then
    undecided,  ///< 50 digits don't tell
  };
  Kind kind = Kind::none;
  std::vector<motion::State<double>> sections{};  ///< states at the stroboscopic sections, rounded
  double simulated = 0.0;                         ///< forcing periods, in more digits
};

/// Runs a problem from the release by a stop to the next one, until the same stop releases the mass again: in 31 digits
/// if they tell that, else in 50. Of motion that departs 31 digits may tell no more than that it does.
[[nodiscard]] RestingMotion resting_motion(const Problem& problem, Side side);
/// Runs it in 50 digits, for a stop that may hold the mass.
[[nodiscard]] RestingMotion resting_motion_in_fifty_digits(const Problem& problem, Side side);

/// A motion from a stop's release on.
struct ReleasedMotion {
  double release = 0.0;                 ///< tau since the section before
  std::vector<motion::Event> events{};  ///< their times are tau since the release
};

/// The motion of so many forcing periods from the release by a stop, computed in 50 digits; nothing if the stop doesn't
/// release the mass, or not as the motion ends, or if 50 digits don't tell.
[[nodiscard]] std::optional<ReleasedMotion> released_motion(const Problem& problem, Side side, std::int64_t periods);

}  // namespace clatter::point
