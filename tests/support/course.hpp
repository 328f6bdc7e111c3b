#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dynamics/scene.hpp"
#include "integrators/exact.hpp"

namespace clatter {

/// What happens in a run, in the order of time.
struct Event {
  enum class Kind { impact, chatter, rest };  ///< chatter: the completed rest of an infinite sequence of impacts

  Kind kind = Kind::impact;
  Side side = Side::none;
  double time = 0.0;    ///< tau since the start
  double speed = 0.0;   ///< impact: |x'| before it
  double length = 0.0;  ///< chatter, rest: in tau
};

/// A run of a scene, rounded to doubles from the number type it was made in.
struct Course {
  Outcome outcome = Outcome::unresolved;
  std::vector<Event> events{};
  double duration = 0.0;
  double x = 0.0, v = 0.0;   ///< at the end
  double impacts = 0.0;      ///< taken
  double evaluations = 0.0;  ///< of arcs
};

/// The run of a scene from its start for a time in tau, in double.
[[nodiscard]] Course course_of(const Scene& scene, double duration);

/// The same source run in 50 digits: the reference. It completes a chatter only where a double would long have done so.
[[nodiscard]] Course reference_of(const Scene& scene, double duration);

/// How far a course is from its reference. Impacts that the reference takes after the course has completed a chatter
/// don't count.
struct Deviation {
  bool same_events = false;  ///< the same impacts and rests, on the same stops, in the same order
  std::string difference{};  ///< the first one that is not
  std::size_t impacts = 0, chatters = 0, rests = 0;
  double time = 0.0;   ///< largest error of a time, over the length of the run
  double speed = 0.0;  ///< largest error of an impact's speed, over the largest speed
  double end = 0.0;    ///< error of displacement and velocity at the end, over the largest of each

  [[nodiscard]] double largest() const;
};

[[nodiscard]] Deviation deviation(const Course& course, const Course& reference);

/// What the inputs' own rounding does to a run: the largest deviation of the reference when all of them are moved by
/// one ulp, in one and another combination of signs; infinite where that changes the events.
[[nodiscard]] double conditioning(const Scene& scene, const Course& reference);

/// The configuration that replays a scene, for a failing test to print.
[[nodiscard]] std::string configuration_of(const Scene& scene, double duration);

}  // namespace clatter
