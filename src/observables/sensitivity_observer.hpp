#pragma once

#include <cmath>
#include <vector>

#include "motion/event.hpp"
#include "motion/polynomial_arc.hpp"
#include "observables/course.hpp"
#include "observables/housing_course.hpp"
#include "observables/sensitivity.hpp"
#include "observables/stability_observer.hpp"

namespace clatter::observables {

/// The derivatives by each key along a course, which is a whole period. Motion has to close, or they are NaN.
[[nodiscard]] std::vector<Sensitivity::ByKey> sensitivities(const Course& course, const ObservedSpan& span,
                                                            const std::vector<Parameter>& keys);
/// The same with a loose mass.
[[nodiscard]] std::vector<Sensitivity::ByKey> sensitivities(const HousingCourse& course, const ObservedSpan& span,
                                                            const std::vector<Parameter>& keys);

/// Records the course of a period; the derivatives follow from it at the end.
class Sensitivity::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : keys_(settings.sensitivity),
        is_sought_(span.periodic && span.given != nullptr && span.scene.oscillator.forcing != 0),
        is_housed_(has_loose_mass(span.scene.loose)),
        stability_({}, span) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (!motion::Polynomial<A>) {  // of general methods there are none
      if (!is_sought_) return;
      stability_.arc(arc, begin, length);
      if (is_housed_) return housing_.push_back({arc.start(), arc.anchor(), begin, length});
      // the sign of the friction, of 0 too, is against the velocity
      const Side ahead = std::signbit(arc.constants().friction) ? Side::upper : Side::lower;
      course_.push_back({arc.start(), arc.anchor(), begin, length, Side::none, ahead});
      if constexpr (A::effects.stiffness) course_.back().pressed = arc.constants().stop.side;
    }
  }
  void rest(const motion::Rest& rest) {
    if (!is_sought_) return;
    stability_.rest(rest);
    const motion::Event event = event_of(rest);
    if (rest.is_stick() && !course_.empty() && !course_.back().end) end_with(event);
    motion::Motion<double> place{};
    place.x = rest.position;
    course_.push_back({place, rest.position, rest.time, rest.length, Side::none, Side::none, event});
  }
  void reversal(const motion::Reversal& reversal) {
    if (is_sought_) stability_.reversal(reversal), end_with(event_of(reversal));
  }
  void impact(const motion::Impact& impact) {
    if (is_sought_) stability_.impact(impact), end_with(event_of(impact));
  }
  void touch(const motion::Touch& touch) {
    if (is_sought_) stability_.touch(touch), end_with(event_of(touch));
  }
  void separate(const motion::Separation& separation) {
    if (is_sought_) end_with(event_of(separation));
  }

  /// A loose mass in its housing, along the arc that was shown last.
  template <Effects E>
  void in_housing(const motion::RelativeArc<double, E>& arc, double begin, double length) {
    if (!is_sought_) return;
    stability_.in_housing(arc, begin, length);
    housing_.back().loose = {arc.anchor(), arc.start().offset, arc.start().v, arc.velocity(0.0)};
  }
  template <class A>
  void hold(const A&, const motion::Rest& hold) {
    if (is_sought_ && !housing_.empty()) housing_.back().held = hold.side;
  }
  void strike(const motion::Strike& strike) {
    if (is_sought_) stability_.strike(strike), housing_.back().struck = strike.side;
  }
  void press(const motion::Press& press) {
    if (!is_sought_) return;
    stability_.press(press);
    if (!housing_.empty()) housing_.back().comes_to_rest = true;
  }

  /// Whether a derivative that is sought doesn't exist, since the motion grazes a stop.
  [[nodiscard]] bool grazes() const { return is_sought_ && stability_.grazes(); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    if (!is_sought_ || grazes()) return {};
    if (is_housed_) return {sensitivities(housing_, span, keys_.list())};
    return {sensitivities(course_, span, keys_.list())};
  }
  [[nodiscard]] double evaluations() const { return stability_.evaluations(); }  ///< of arcs

 private:
  void end_with(const motion::Event& event) {
    if (!course_.empty()) course_.back().end = event;
  }

  ParameterSet keys_;
  bool is_sought_, is_housed_;
  Stability::Observer stability_;  ///< tells grazes
  Course course_{};
  HousingCourse housing_{};  ///< with a loose mass, in place of it
};

}  // namespace clatter::observables
