#pragma once

namespace clatter {
inline namespace scene {

/// Dry friction (Coulomb): a force of constant size against the velocity; at x' = 0 whatever force holds the mass, up
/// to a static level. Both in the unit of the force on the mass.
template <class Number>
struct BasicFriction {
  Number kinetic{0.0};       ///< mu, >= 0: x'' has the term -mu sgn x'
  Number static_level{0.0};  ///< no less than `kinetic` in a computed scene

  friend bool operator==(const BasicFriction&, const BasicFriction&) = default;
};
using Friction = BasicFriction<double>;

[[nodiscard]] constexpr bool has_friction(const Friction& friction) {
  return friction.kinetic != 0 || friction.static_level != 0;  // NaN keeps it
}

}  // namespace scene
}  // namespace clatter
