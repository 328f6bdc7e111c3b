#pragma once

#include "model/oscillator.hpp"
#include "model/stops.hpp"

namespace clatter {
inline namespace model {

/// The state at tau = 0.
struct Start {
  double displacement = 0.0;  ///< x0, between the stops
  double velocity = 0.0;      ///< v0
  double phase = 0.0;         ///< forcing phase at tau = 0, rad
};

/// An oscillator, its stops and its start: everything that the motion depends on.
struct Scene {
  Oscillator oscillator;
  Stops stops;
  Start start;
};

}  // namespace model
}  // namespace clatter
