#pragma once

#include <vector>

#include "motion/state.hpp"
#include "observables/samples.hpp"
#include "scene/loose_mass.hpp"

namespace clatter::observables {

/// Samples of the place of a loose mass in its housing, z, and of z'.
class HousingSamples {
 public:
  HousingSamples(std::size_t count, double spacing, AtImpact at_impact, const LooseMass& loose, double first = 0.0)
      : samples_(count, spacing, at_impact, {.lower = loose.lower, .upper = loose.upper}, first) {}

  template <class A>
  void in_housing(const A& arc, double begin, double length) {
    samples_.arc(arc, begin, length);
    const motion::Motion<double> end = arc.at(length);
    z_ = end.x, w_ = end.v;
  }
  void hold(const motion::Rest& hold) { samples_.rest(hold), z_ = hold.position, w_ = 0; }
  void strike(const motion::Strike& strike) {
    samples_.impact(strike.in_housing()), z_ = strike.wall, w_ = strike.after;
  }

  /// Ends the observed time, of length `total`, where the mass is.
  void finish(double total, bool periodic) { samples_.finish(z_, w_, total, periodic); }

  [[nodiscard]] std::vector<double>& place() { return samples_.displacement(); }
  [[nodiscard]] std::vector<double>& velocity() { return samples_.velocity(); }

 private:
  Samples samples_;
  double z_ = 0.0, w_ = 0.0;  ///< where it was seen last
};

}  // namespace clatter::observables
