#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "motion/tangent_map.hpp"

namespace clatter::steady {

/// What a forcing period between two sections does to a motion.
struct Passage {
  std::uint64_t itinerary = 0;  ///< the same for the same stops in the same order, 0 without contact
  double log_area = 0.0;        ///< logarithm of what its impacts leave of a small area of states; -inf after a rest

  friend bool operator==(const Passage&, const Passage&) = default;
};

/// What the search for a periodic motion sees between sections: the stops that are hit and rested on, in their order,
/// and where asked for the derivative of the motion.
class SectionObserver {
 public:
  explicit SectionObserver(const Stops& stops)
      : stops_(stops),
        log_lower_(2 * std::log(stops.restitution_lower)),
        log_upper_(2 * std::log(stops.restitution_upper)),
        tangent_(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (differentiates_) [[unlikely]]
      tangent_.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) {
    add(rest.side == Side::upper ? 4 : 3);
    passage_.log_area = -std::numeric_limits<double>::infinity();
    if (differentiates_) tangent_.rest(rest);
  }
  void impact(const motion::Impact& impact) {
    const bool upper = impact.side == Side::upper;
    add(upper ? 2 : 1);
    passage_.log_area += upper ? log_upper_ : log_lower_;
    if (differentiates_) tangent_.impact(impact);
  }

  void begin_section() { passage_ = {}; }
  /// Begins a new derivative.
  void differentiate() { differentiates_ = true, tangent_ = motion::TangentMap<double>(stops_); }

  [[nodiscard]] const Passage& passage() const { return passage_; }  ///< since the section
  [[nodiscard]] motion::Jacobian<double> derivative() const { return tangent_.map(); }

 private:
  void add(std::uint64_t event) { passage_.itinerary = (passage_.itinerary + event) * 0x9e3779b97f4a7c15u; }

  Stops stops_;
  double log_lower_, log_upper_;  ///< of the area that an impact on a stop leaves, R^2
  motion::TangentMap<double> tangent_;
  Passage passage_;
  bool differentiates_ = false;
};

}  // namespace clatter::steady
