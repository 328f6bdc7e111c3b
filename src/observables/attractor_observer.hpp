#pragma once

#include <cmath>

#include "motion/state.hpp"
#include "observables/attractor.hpp"

namespace clatter::observables {

class Attractor::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact&) {}
  bool response(const ObservedSpan&, double) { return true; }

  /// The end of a period is its beginning. Unforced motion that goes on loses nothing, and is no attractor.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const {
    if (span.transient || span.undecided) return {};
    if (span.scene.oscillator.forcing == 0) return span.stands_still ? Values{x, 0.0, 1.0} : Values{};
    return {x, v, span.periodic ? std::round(span.turns) : 0.0};
  }
};

}  // namespace clatter::observables
