#pragma once

#include <cstdint>

#include "dynamics/tangent.hpp"

namespace clatter {

/// What the search for a periodic motion sees between sections: the stops that are hit and rested on, in their order,
/// and where asked for the derivative of the motion.
class SectionWatch {
 public:
  explicit SectionWatch(const Stops& stops) : stops_(stops), tangent_(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (differentiates_) [[unlikely]]
      tangent_.arc(arc, begin, length);
  }
  void rest(const Rest& rest) {
    add(rest.side == Side::upper ? 4 : 3);
    if (differentiates_) tangent_.rest(rest);
  }
  void impact(const Impact& impact) {
    add(impact.side == Side::upper ? 2 : 1);
    if (differentiates_) tangent_.impact(impact);
  }

  void begin_section() { itinerary_ = 0; }
  /// Begins a new derivative.
  void differentiate() { differentiates_ = true, tangent_ = Tangent<double>(stops_); }

  /// A number that is the same for the same stops in the same order, 0 without contact.
  [[nodiscard]] std::uint64_t itinerary() const { return itinerary_; }
  [[nodiscard]] Map<double> derivative() const { return tangent_.map(); }

 private:
  void add(std::uint64_t event) { itinerary_ = (itinerary_ + event) * 0x9e3779b97f4a7c15u; }

  Stops stops_;
  Tangent<double> tangent_;
  std::uint64_t itinerary_ = 0;
  bool differentiates_ = false;
};

}  // namespace clatter
