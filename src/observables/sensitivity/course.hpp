#pragma once

#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/relative_arc.hpp"
#include "motion/state.hpp"

namespace clatter::observables {

/// A part of an observed time as it was run: a flight, or a time in contact with a soft stop, up to its event or to a
/// section; or a time on a rigid stop, at rest or in the summed end of a chatter; or a stick. With a loose mass it is
/// any of these, up to an event of either mass, to a release, or to a section.
struct Stretch {
  motion::Motion<double> start{};      ///< of the main mass; of a rest and a stick the place alone
  double anchor = 0.0;                 ///< the position that its offset counts from
  double begin = 0.0;                  ///< tau since observation began
  double length = 0.0;                 ///< tau
  Side pressed = Side::none;           ///< the soft stop in contact
  Side ahead = Side::none;             ///< to which it slips; none: it stands
  std::optional<motion::Event> end{};  ///< that ends it; of a rest or a stick that itself; nothing: a section
  // with a loose mass
  motion::RelativeStart<double> loose{};  ///< its flight, of one that moves with the main mass its place
  Side wall = Side::none;                 ///< the wall that presses it
  bool carries = false;                   ///< that wall, or friction, makes both move as one
  Side slides_to = Side::none;            ///< the side to which one that rubs slides in its housing
  bool is_held = false;                   ///< friction or a stop holds the main mass,
  Side held_on = Side::none;              ///< that stop
  std::vector<motion::Event> ends{};      ///< the events at its end, in order; of a section or a release none

  [[nodiscard]] bool stands() const { return ahead == Side::none; }
  [[nodiscard]] bool is_rest() const { return stands() && end->side != Side::none; }  ///< on a rigid stop
};

/// An observed time, stretch by stretch.
using Course = std::vector<Stretch>;

}  // namespace clatter::observables
