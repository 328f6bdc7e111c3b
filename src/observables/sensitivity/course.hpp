#pragma once

#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/relative_arc.hpp"
#include "motion/state.hpp"

namespace clatter::observables {

/// A part of an observed time as it was run: a flight, or a time in contact with a soft stop, up to its event or to a
/// section; or a time on a rigid stop, at rest or in the summed end of a chatter; or a stick. With a loose mass: a
/// flight of that, up to an impact on a wall or a section; or a time in which a wall presses it, up to its release or a
/// section.
struct Stretch {
  motion::Motion<double> start{};         ///< of the main mass; of a rest and a stick the place alone
  double anchor = 0.0;                    ///< the position that its offset counts from
  double begin = 0.0;                     ///< tau since observation began
  double length = 0.0;                    ///< tau
  Side pressed = Side::none;              ///< the soft stop in contact, or the wall that presses a loose mass
  Side ahead = Side::none;                ///< to which it slips; none: it stands
  std::optional<motion::Event> end{};     ///< that ends it; of a rest or a stick that itself; nothing: a section, or a
                                          ///< release by a wall
  motion::RelativeStart<double> loose{};  ///< of a loose mass in flight
  bool comes_to_rest = false;             ///< a loose mass, after the impact at the end

  [[nodiscard]] Side struck() const { return end ? end->side : Side::none; }  ///< the wall, of a loose mass
  [[nodiscard]] bool stands() const { return ahead == Side::none; }
  [[nodiscard]] bool is_rest() const { return stands() && end->side != Side::none; }  ///< on a rigid stop
};

/// An observed time, stretch by stretch.
using Course = std::vector<Stretch>;

}  // namespace clatter::observables
