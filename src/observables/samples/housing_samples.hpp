#pragma once

#include <vector>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/state.hpp"
#include "observables/samples/samples.hpp"
#include "scene/loose_mass.hpp"

namespace clatter::observables {

/// Samples of the place of a loose mass in its housing, z, and of z'.
class HousingSamples {
 public:
  HousingSamples(std::size_t count, double spacing, AtImpact at_impact, const LooseMass& loose, double first = 0.0)
      : samples_(count, spacing, at_impact, {.lower = loose.lower, .upper = loose.upper}, first) {}

  /// Of the arc of a main mass, what the loose one does meanwhile; a time for which a wall presses it is an event.
  template <motion::Housed A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (requires { arc.loose.at(length); }) {
      samples_.arc(arc.loose, begin, length);
      const motion::Motion<double> end = arc.loose.at(length);
      z_ = end.x, w_ = end.v;
    }
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind != Kind::strike && event.kind != Kind::hold) return;
    samples_.event(event.in_housing());
    z_ = event.place, w_ = event.after;
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
