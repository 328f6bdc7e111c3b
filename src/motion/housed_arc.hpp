#pragma once

#include <type_traits>

#include "scene/stops.hpp"

namespace clatter::motion {

/// A loose mass that moves with the main one, and its place z: a wall presses it, or friction alone holds it.
struct Pressed {
  Side wall = Side::none;
  double place = 0.0;
};

/// The place of a loose mass in its housing a time s after the beginning of a flight, or while a wall presses it.
template <class L>
[[nodiscard]] double place_at(const L& loose, double s) {
  if constexpr (std::is_same_v<L, Pressed>)
    return loose.place;
  else
    return loose.at(s).x;
}

/// The wall that presses a loose mass meanwhile; none if it flies, or friction alone holds it.
template <class L>
[[nodiscard]] Side wall_of(const L& loose) {
  if constexpr (std::is_same_v<L, Pressed>) return loose.wall;
  return Side::none;
}

/// The motion of a main mass along an arc, and meanwhile that of its loose mass: a `RelativeArc`, a
/// `PolynomialInHousing`, or `Pressed`. Whoever asks only for the main mass takes it for that arc.
template <class A, class L>
struct HousedArc : A {
  L loose;

  [[nodiscard]] const A& main() const { return *this; }
};
template <class A, class L>
HousedArc(A, L) -> HousedArc<A, L>;

template <class A>
concept Housed = requires(const A& arc) {
  arc.loose;
};

/// The arc of the main mass.
template <class A>
[[nodiscard]] const auto& main_of(const A& arc) {
  if constexpr (Housed<A>)
    return arc.main();
  else
    return arc;
}

}  // namespace clatter::motion
