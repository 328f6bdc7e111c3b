#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scene/given_scene.hpp"
#include "scene/key.hpp"

namespace clatter {
inline namespace scene {

/// How a parameter acts on a scene.
enum class Role : std::uint8_t {
  other,
  start,         ///< it says where the motion begins
  damping,       ///< of the damper, in one of several ways
  drive,         ///< amplitude of the force
  force_shape,   ///< of a force in pieces: share of the period of a part, or a factor
  force_order,   ///< of a sine of a further order of the force: amplitude, or phase
  load,          ///< constant force
  shaking,       ///< amplitude of stops or base
  stop_motion,   ///< of one stop by itself: amplitude, or phase
  friction,      ///< a level of dry friction
  loose_load,    ///< constant acceleration of a loose mass
  position,      ///< of a stop, or of a wall of a loose mass
  restitution,   ///< of a rigid stop, or of such walls
  law_of_speed,  ///< how a restitution depends on the speed
  softness,      ///< stiffness of a soft stop
  stop_damping   ///< damping of a soft stop, in one of several ways
};

/// A key in one of [scene] and [machine].
struct KeyText {
  std::string_view fallback{};   ///< the default, as in INI; empty: none
  std::string_view example{};    ///< another value, as in INI
  std::string_view help{};       ///< its meaning, without the range; empty: no key of that section
  std::string_view beside{};     ///< lines of TOML without which it has no effect
  std::string_view long_name{};  ///< of its axis in results
};

/// All that is known of a parameter of the scene. Reading, validation, help, defaults, axes of [sweep], [branch], names
/// and units of results, symmetry and derivatives are made from it.
template <class Number>
struct ParameterRow {
  std::string_view key;
  Quantity quantity = Quantity::number;  ///< of its value in SI
  AllowedRange range{};
  KeyText in_scene{}, in_machine{};
  std::string_view other{};        ///< the key that gives the value of both sides, in its place
  std::string_view counterpart{};  ///< the key that says the same in the other section
  Role role = Role::other;
  Side side = Side::none;     ///< of the stop or wall that it belongs to, if it is of one of them
  bool is_with_unit = false;  ///< the key of the row before, if its value has a unit
  bool is_loose = false;      ///< of a loose mass
  using Place = Number& (*)(BasicGivenScene<Number>&);
  Place place = nullptr, place_of_upper = nullptr;  ///< the second one of a key of both stops, whose first is the lower
};

namespace detail {

/// Arrays one behind the other.
template <class Row, std::size_t... sizes>
constexpr auto joined(const std::array<Row, sizes>&... parts) {
  std::array<Row, (sizes + ...)> all{};
  auto end = all.begin();
  ((end = std::ranges::copy(parts, end).out), ...);
  return all;
}

/// The number of a scene that a member of one of its parts is.
template <class Number, auto part, auto member>
constexpr Number& in(BasicGivenScene<Number>& scene) {
  return scene.*part.*member;
}
template <class Number, auto part, auto law, auto member>
constexpr Number& of_law(BasicGivenScene<Number>& scene) {
  return scene.*part.*law.*member;
}
template <class Number, auto member>
constexpr Number& at(BasicGivenScene<Number>& scene) {
  return scene.*member;
}

}  // namespace detail

}  // namespace scene
}  // namespace clatter
