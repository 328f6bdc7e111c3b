#pragma once

#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/state.hpp"

namespace clatter::observables {

/// A part of an observed time as it was run: a flight, or a time in contact with a soft stop, up to its event or to a
/// section; or a time on a rigid stop, at rest or in the summed end of a chatter.
struct Stretch {
  motion::Motion<double> start{};      ///< not of a rest
  double anchor = 0.0;                 ///< the position that its offset counts from
  double begin = 0.0;                  ///< tau since observation began
  double length = 0.0;                 ///< tau
  Side pressed = Side::none;           ///< the soft stop in contact
  std::optional<motion::Event> end{};  ///< the event that ends it; of a rest that rest itself; nothing: a section

  [[nodiscard]] bool is_rest() const {
    return end && (end->kind == motion::Event::Kind::rest || end->kind == motion::Event::Kind::chatter);
  }
};

/// An observed time, stretch by stretch.
using Course = std::vector<Stretch>;

}  // namespace clatter::observables
