#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/perturbation.hpp"
#include "motion/state.hpp"
#include "steady/repeat.hpp"

namespace clatter::steady {

/// Summary of one forcing period, from a stroboscopic section to the next.
struct Passage {
  std::uint64_t itinerary = 0;  ///< the same for the same contacts in the same order, 0 without contact
  double log_area = 0.0;        ///< logarithm of the factor by which its stops shrink areas of states; -inf: a rest
                                ///< or a stick
  Side rested_on = Side::none;  ///< the stop that held the mass last
  double size = 0.0;            ///< the largest displacement or speed at an event
  double loose_size = 0.0;      ///< the same of a loose mass in its housing
  bool meets_wall = false;      ///< one strikes the loose mass, or presses it

  /// Whether they have the same contacts; the time in contact with a damped stop may differ, and the area with it.
  friend bool operator==(const Passage& a, const Passage& b) { return a.itinerary == b.itinerary; }
};

/// A motion over n forcing periods: its states at the stroboscopic sections and its derivative; periodic if its gap
/// is 0.
struct MapOrbit {
  std::size_t periods = 0;
  std::array<motion::State<double>, RepeatFinder::longest + 1> states{};  ///< the last as computed from the first
  std::array<motion::Jacobian<double>, RepeatFinder::longest + 1> derivatives{};  ///< of each state by the first
  std::array<Passage, RepeatFinder::longest> passages{};  ///< from each state but the last to the next

  double settling = 0.0;  ///< forcing periods until an approaching motion is within the tolerance of it

  [[nodiscard]] motion::Perturbation gap() const { return between(states[0], states[periods]); }
  [[nodiscard]] const motion::Jacobian<double>& derivative() const { return derivatives[periods]; }
};

}  // namespace clatter::steady
