#pragma once

#include "motion/state.hpp"
#include "observables/settling.hpp"

namespace clatter::observables {

class Settling::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact&) {}
  bool response(const ObservedSpan&, double) { return true; }
  [[nodiscard]] Values finish(const ObservedSpan&, double, double) const { return {}; }
};

}  // namespace clatter::observables
