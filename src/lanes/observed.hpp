#pragma once

#include <optional>

#include "motion/event.hpp"
#include "observables/contacts/impacts_observer.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/velocity_jumps.hpp"

namespace clatter::lanes {

/// The scalar loop's observers of a lane's motion, as far as they have come.
struct Observed {
  observables::Extrema::Observer extrema{};
  observables::Impacts::Observer impacts{};
  std::optional<motion::Event> first{};  ///< impact
  observables::VelocityJumps jumps;
};

}  // namespace clatter::lanes
