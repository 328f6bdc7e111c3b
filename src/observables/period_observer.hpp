#pragma once

#include <cmath>

#include "math/number.hpp"
#include "motion/event.hpp"
#include "observables/period.hpp"

namespace clatter::observables {

class Period::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double length) {
    moves_ = moves_ || length > 0;
  }
  void event(const motion::Event& event) {
    const bool begins_contact = event.is_contact() && event.kind != motion::Event::Kind::separation;
    if (begins_contact && !(first_speed_ >= 0.0)) first_speed_ = event.speed();
  }
  /// Takes over the speed before the first impact, NaN if there is none, of motion that isn't at rest throughout.
  void include(double first_speed) { first_speed_ = first_speed, moves_ = true; }
  bool response(const ObservedSpan&, double) { return include(no_value), true; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    Values values;
    const Stops& stops = span.scene.stops;
    if (stops.lower == -stops.upper) values.velocity_ratio = first_speed_ / stops.upper;
    if (const LooseMass& loose = span.scene.loose; has_loose_mass(loose))
      values.velocity_ratio = loose.lower == -loose.upper ? first_speed_ / loose.upper : no_value;
    if (!span.periodic && !span.transient && !span.undecided) values.period_ratio = 0.0;
    if (!span.periodic || span.stands_still || !moves_) return values;
    values.period = span.total;
    const bool forced = span.scene.oscillator.forcing != 0;
    if (forced) values.period_ratio = span.turns;
    if (!forced) values.eigenfrequency = 2 * pi<double>() / span.total;
    return values;
  }

 private:
  bool moves_ = false;  ///< the mass isn't at rest throughout
  double first_speed_ = no_value;
};

}  // namespace clatter::observables
