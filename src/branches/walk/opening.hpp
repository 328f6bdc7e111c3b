#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "branches/walk/graze.hpp"

namespace clatter::branches {

/// What begins from nothing at an event of a motion in a special point.
struct Opening {
  enum class Kind : std::uint8_t {
    contact,  ///< a contact with a soft stop, or the interruption of one, at the event that grazes
    rebound,  ///< an impact on the stop on which the mass comes to stick, and a short slip back before it sticks
    turn,     ///< a reversal where it comes to stick, and likewise
    release,  ///< an early release from a stick the other way, and a short slip before the mass sticks again
    within,   ///< a halt on the position of a soft stop comes to lie beyond it
    outside   ///< or before it: then the contact with the stop, to that halt or from it on, vanishes, or another begins
  };
  Kind kind = Kind::contact;
  std::size_t event = 0;

  /// Whether it is of a halt on the position of a soft stop.
  [[nodiscard]] bool is_of_soft_stop() const { return kind == Kind::within || kind == Kind::outside; }
};

/// An orbit in which that has begun, as if its slip, or the contact or interruption, lasted for `advance` of the phase.
[[nodiscard]] Orbit with_opening(const FollowedScene& scene, const Orbit& orbit, const Opening& opening,
                                 double advance);

/// A motion in which that has begun, where it is short. It begins with the event that has the number of the opening.
/// Nothing if there is none.
struct Opened {
  Orbit orbit;
  Vector at, tangent;  ///< of the equations with one parameter, towards longer ones
};
[[nodiscard]] std::optional<Opened> opened(const Equations& equations, const FollowedScene& scene, const Orbit& orbit,
                                           const Opening& opening, double tolerance);

}  // namespace clatter::branches
