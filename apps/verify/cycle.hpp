#pragma once

#include <optional>
#include <string>
#include <vector>

#include "event.hpp"

namespace verify {

/// The events that were found in a period, as they come round: nothing depends on which of them is the first, or on how
/// many impacts of a chatter are listed before its sum.
class Cycle {
 public:
  /// `pressed`: the motion starts within the press that is both the first event and the last.
  Cycle(std::vector<Event> events, const Ball& period, bool pressed = false);

  /// Whether the events show that a motion doesn't repeat after a share 1/parts of the period.
  [[nodiscard]] bool differs_after(std::size_t parts) const;
  /// Whether they show that half a period later it isn't its own mirror image.
  [[nodiscard]] bool differs_from_mirror() const;
  /// How often a stop lets the mass go at one of its phases, at most.
  [[nodiscard]] long releases() const;
  /// Whether one stop lets the mass go half a period after the other.
  [[nodiscard]] bool releases_mirrored() const;
  /// The stops of the impacts in order, L and U, or of walls that are told from them l and u; those that end in rest
  /// are one L* or U*.
  [[nodiscard]] std::vector<std::string> letters(bool tells_walls) const;

  [[nodiscard]] const std::vector<Event>& events() const { return events_; }

 private:
  void begin_after_rest();
  [[nodiscard]] bool is_held_throughout() const;
  [[nodiscard]] std::vector<Event> without_rebounds() const;
  [[nodiscard]] bool differs(const std::vector<Event>& events, std::size_t shift, const Ball& later,
                             bool mirrored) const;

  std::vector<Event> events_;
  Ball period_;
};

}  // namespace verify
