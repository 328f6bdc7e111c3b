#pragma once

#include <utility>

#include "observables/samples.hpp"
#include "observables/trajectory.hpp"

namespace clatter::observables {

class Trajectory::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : samples_(count_of(settings), span.total / static_cast<double>(settings.trajectory - 1), AtImpact::after,
                 span.scene.stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    samples_.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) { samples_.rest(rest); }
  void impact(const motion::Impact& impact) { samples_.impact(impact); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    samples_.finish(x, v, span.total, span.periodic);
    if (span.frame) samples_.add(*span.frame);
    return {samples_.times(span.total), std::move(samples_.displacement()), std::move(samples_.velocity())};
  }
  [[nodiscard]] double evaluations() const { return samples_.evaluations(); }  ///< of arcs

 private:
  Samples samples_;
};

}  // namespace clatter::observables
