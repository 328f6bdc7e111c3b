#pragma once

#include <limits>

namespace clatter {
inline namespace scene {

/// A mass that lies loose in a housing which the main mass carries: it moves freely between two rigid walls, and the
/// main mass feels its impacts. Its place in the housing is z = y - x, with y its displacement and x that of the main
/// mass.
template <class Number>
struct BasicLooseMass {
  Number ratio{0.0};                                       ///< eps, its mass over the main mass, >= 0; 0: there is none
  Number lower{-std::numeric_limits<double>::infinity()};  ///< z at the lower wall; -inf: none
  Number upper{std::numeric_limits<double>::infinity()};   ///< z at the upper wall; +inf: none
  Number restitution_lower{1.0};                           ///< R of the lower wall, 0 ... 1
  Number restitution_upper{1.0};                           ///< R of the upper wall, 0 ... 1
  Number load{0.0};                                        ///< constant acceleration y'' between impacts, any finite
  Number place{0.0};                                       ///< z at tau = 0, between the walls
  Number velocity{0.0};                                    ///< z' at tau = 0
  Number friction{0.0};         ///< of the housing, over the main mass, >= 0: against z' on both masses
  Number friction_static{0.0};  ///< at z' = 0; no less than `friction` in a computed scene

  friend bool operator==(const BasicLooseMass&, const BasicLooseMass&) = default;
};
using LooseMass = BasicLooseMass<double>;

template <class Number = double>
[[nodiscard]] constexpr bool has_loose_mass(const BasicLooseMass<Number>& loose) {
  return loose.ratio != 0;  // NaN keeps it
}

/// Whether it rubs on its housing.
template <class Number = double>
[[nodiscard]] constexpr bool has_loose_friction(const BasicLooseMass<Number>& loose) {
  return has_loose_mass(loose) && (loose.friction != 0 || loose.friction_static != 0);  // NaN keeps it
}

}  // namespace scene
}  // namespace clatter
