#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "hard/slide.hpp"
#include "motion/event.hpp"

namespace clatter::hard {

/// The scales of a motion, to which deviations are relative: its length, and the largest displacement and speed of it
/// or of the response to the force, since a flight is a difference of terms of that size.
struct SlideScales {
  double duration, size, fastest;
};
[[nodiscard]] SlideScales scales_of(const Scene& scene, double duration, const SlideRun& run);

/// The events of the program in the terms of the simulator.
[[nodiscard]] std::vector<SlideEvent> as_slide_events(const std::vector<motion::Event>& events);

/// Events without stands too short to be told from none, and those that sections cut joined.
[[nodiscard]] std::vector<SlideEvent> joined(const std::vector<SlideEvent>& events, double duration);

/// The largest relative difference of two events of one kind.
[[nodiscard]] double deviation_of(const SlideEvent& event, const SlideEvent& reference, const SlideScales& scales);

/// Events of two runs that are the same.
struct SlideMatch {
  std::vector<std::pair<std::size_t, std::size_t>> pairs{};  ///< places in both lists
  std::size_t first_difference = 0;  ///< place in the reference from which on no events were matched
  std::string difference{};          ///< the first one; empty: none up to the end, or to that of a list cut short
};

/// Pairs the events of a run with those of the reference, in their order. Impacts of a chatter that only one of the two
/// tells have no partner, nor has an event within `at_the_end` of the end, over the duration.
[[nodiscard]] SlideMatch match(const std::vector<SlideEvent>& events, bool is_cut,
                               const std::vector<SlideEvent>& reference, bool reference_is_cut,
                               const SlideScales& scales);

}  // namespace clatter::hard
