#pragma once

#include <string>
#include <vector>

#include "certificate.hpp"
#include "motion.hpp"
#include "report.hpp"

namespace verify {

/// Follows a motion to its end. Its events are found one after the other, whatever is claimed, but for the number of
/// impacts before the sum of a chatter, and the place of a graze.
class Course {
 public:
  Course(const Certificate& certificate, Motion& motion, const Ball& end)
      : certificate_(certificate), motion_(motion), end_(end) {}

  /// Throws Refuted if its events aren't the claimed ones, and Undecided if that can't be told.
  void run();

  [[nodiscard]] const std::vector<Event>& events() const { return events_; }  ///< found so far
  /// Of periodic motion that starts with a release.
  [[nodiscard]] bool ends_with_release() const;

 private:
  [[nodiscard]] Event found_for(const ClaimedEvent& claim);
  [[nodiscard]] Event next_event(const ClaimedEvent* claim);
  void require_order(const Event& event) const;

  const Certificate& certificate_;
  Motion& motion_;
  Ball end_;
  std::vector<Event> events_{};
};

/// The number and the kind of a claimed event, for messages.
[[nodiscard]] std::string named(std::size_t number, const ClaimedEvent& event);
/// Compares the events that were found with those that are claimed.
void compare_events(const Certificate& certificate, const std::vector<Event>& events, Report& report);
/// Compares the extrema of the displacement on the way of a motion.
void compare_extrema(const Certificate& certificate, const Motion& motion, const std::vector<Event>& events,
                     const Scene& scene, Report& report);

}  // namespace verify
