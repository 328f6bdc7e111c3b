#pragma once

#include <cmath>
#include <utility>

#include "math/number.hpp"
#include "motion/event.hpp"
#include "observables/period.hpp"

namespace clatter::observables {

class Period::Observer {
 public:
  Observer(const Settings&, const ObservedSpan& span)
      : is_of_walls_(has_loose_mass(span.scene.loose) && !has_events_of_its_own(span.scene)) {}

  template <class A>
  void arc(const A&, double, double length) {
    moves_ = moves_ || length > 0;
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const bool begins_contact =
        event.is_contact() && event.kind != Kind::separation && event.kind != Kind::wall_separation;
    const bool on_wall = event.kind == Kind::strike || event.is_of_soft_wall();
    if (begins_contact && on_wall == is_of_walls_ && !(first_speed_ >= 0.0)) first_speed_ = event.speed();
  }
  /// Takes over the speed before the first impact, NaN if there is none, of motion that isn't at rest throughout.
  void include(double first_speed) { first_speed_ = first_speed, moves_ = true; }
  bool response(const ObservedSpan&, double) { return include(no_value), true; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    Values values;
    const auto [lower, upper] = is_of_walls_ ? std::pair(span.scene.loose.lower, span.scene.loose.upper)
                                             : std::pair(span.scene.stops.lower, span.scene.stops.upper);
    if (lower == -upper) values.velocity_ratio = first_speed_ / upper;
    if (!span.periodic && !span.transient && !span.undecided) values.period_ratio = 0.0;
    if (!span.periodic || span.stands_still || !moves_) return values;
    values.period = span.total;
    const bool forced = is_driven(span.scene.oscillator);
    if (forced) values.period_ratio = span.turns;
    if (!forced) values.eigenfrequency = 2 * pi<double>() / span.total;
    return values;
  }

 private:
  bool is_of_walls_;    ///< contacts are those of a loose mass
  bool moves_ = false;  ///< the mass isn't at rest throughout
  double first_speed_ = no_value;
};

}  // namespace clatter::observables
