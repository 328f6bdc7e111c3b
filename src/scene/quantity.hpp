#pragma once

#include <cstdint>
#include <string_view>

namespace clatter {
inline namespace scene {

/// The physical quantity that a number is.
enum class Quantity : std::uint8_t {
  number,     ///< without dimension
  angle,      ///< rad
  length,     ///< displacements, places of stops
  time,       ///< durations, periods
  frequency,  ///< an angular frequency; of a machine in cycles, Hz
  rate,       ///< one over a time that is no frequency, such as an exponent
  velocity,
  acceleration,
  mass,
  force,
  stiffness,  ///< force over displacement
  damping,    ///< force over velocity
  energy,     ///< of a scene: per unit mass, as are the next two
  power,
  impulse
};

/// The powers of length, time and mass in a quantity.
struct Exponents {
  int length = 0, time = 0, mass = 0;

  friend constexpr bool operator==(const Exponents&, const Exponents&) = default;
};

[[nodiscard]] constexpr Exponents exponents_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::number:
    case Quantity::angle:
      return {};
    case Quantity::length:
      return {1, 0, 0};
    case Quantity::time:
      return {0, 1, 0};
    case Quantity::frequency:
    case Quantity::rate:
      return {0, -1, 0};
    case Quantity::velocity:
      return {1, -1, 0};
    case Quantity::acceleration:
      return {1, -2, 0};
    case Quantity::mass:
      return {0, 0, 1};
    case Quantity::force:
      return {1, -2, 1};
    case Quantity::stiffness:
      return {0, -2, 1};
    case Quantity::damping:
      return {0, -1, 1};
    case Quantity::energy:
      return {2, -2, 1};
    case Quantity::power:
      return {2, -3, 1};
    case Quantity::impulse:
      return {1, -1, 1};
  }
  return {};
}

/// The SI unit of a quantity as UDUNITS, xarray and pint read it.
[[nodiscard]] constexpr std::string_view si_unit(Quantity quantity) {
  switch (quantity) {
    case Quantity::number:
      return "1";
    case Quantity::angle:
      return "rad";
    case Quantity::length:
      return "m";
    case Quantity::time:
      return "s";
    case Quantity::frequency:
      return "Hz";
    case Quantity::rate:
      return "s-1";
    case Quantity::velocity:
      return "m s-1";
    case Quantity::acceleration:
      return "m s-2";
    case Quantity::mass:
      return "kg";
    case Quantity::force:
      return "N";
    case Quantity::stiffness:
      return "N m-1";
    case Quantity::damping:
      return "N s m-1";
    case Quantity::energy:
      return "J";
    case Quantity::power:
      return "W";
    case Quantity::impulse:
      return "N s";
  }
  return "";
}

}  // namespace scene
}  // namespace clatter
