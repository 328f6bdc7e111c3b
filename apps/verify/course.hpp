#pragma once

#include <vector>

#include "certificate.hpp"
#include "report.hpp"

namespace verify {

/// Follows a motion along the claimed events.
class Course {
 public:
  Course(const Certificate& certificate, Followed& motion, const Ball& end)
      : certificate_(certificate), motion_(motion), end_(end) {}

  /// Throws Refuted if the motion takes another course, and Undecided if that can't be told.
  void run();

  [[nodiscard]] const std::vector<Event>& events() const { return events_; }  ///< found so far
  /// Of periodic motion that starts with a release.
  [[nodiscard]] bool ends_with_release() const;

 private:
  [[nodiscard]] Event found_for(const ClaimedEvent& claim);
  [[nodiscard]] Event next_for(const ClaimedEvent& claim);

  const Certificate& certificate_;
  Followed& motion_;
  Ball end_;
  std::vector<Event> events_{};
};

/// Compares the events that were found with those that are claimed.
void compare_events(const Certificate& certificate, const std::vector<Event>& events, Report& report);
/// Compares the extrema of the displacement on the way of a motion.
void compare_extrema(const Certificate& certificate, const Followed& motion, const std::vector<Event>& events,
                     const Scene& scene, Report& report);

}  // namespace verify
