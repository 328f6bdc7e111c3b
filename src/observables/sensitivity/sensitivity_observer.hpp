#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/polynomial_arc.hpp"
#include "observables/sensitivity/course.hpp"
#include "observables/sensitivity/sensitivity.hpp"
#include "observables/stability/stability_observer.hpp"

namespace clatter::observables {

/// The derivatives by each key along a course, which is a whole period. Motion has to close, or they are NaN.
[[nodiscard]] std::vector<Sensitivity::ByKey> sensitivities(const Course& course, const ObservedSpan& span,
                                                            const std::vector<Parameter>& keys);
/// The derivatives by each key along a course of a machine with a loose mass; that course has to close, too.
[[nodiscard]] std::vector<Sensitivity::ByKey> sensitivities_in_housing(const Course& course, const ObservedSpan& span,
                                                                       const std::vector<Parameter>& keys);

/// Records the course of a period; the derivatives follow from it at the end.
class Sensitivity::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : keys_(settings.sensitivity),
        is_sought_(span.periodic && span.given != nullptr && span.scene.oscillator.forcing != 0),
        is_housed_(has_loose_mass(span.scene.loose)),
        rubs_(has_loose_friction(span.scene.loose)),
        stability_({}, span) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (!motion::Polynomial<A>) {  // of general methods there are none
      if (!is_sought_) return;
      stability_.arc(arc, begin, length);
      // the sign of the friction, of 0 too, is against the velocity
      const Side ahead = std::signbit(arc.constants().friction) ? Side::upper : Side::lower;
      course_.push_back({arc.start(), arc.anchor(), begin, length, Side::none, ahead});
      if constexpr (A::effects.stiffness) course_.back().pressed = arc.constants().stop.side;
      if constexpr (motion::Housed<A>) {
        Stretch& stretch = course_.back();
        add_loose(arc.loose);
        if (held_) stretch.is_held = true, stretch.held_on = held_->side;
        const double rubbing = held_ ? held_->rubbing : static_cast<double>(arc.constants().rubbing);
        if (rubs_ && !stretch.carries) stretch.slides_to = std::signbit(rubbing) ? Side::lower : Side::upper;
        held_.reset();
      }
    }
  }
  void event(const motion::Event& event) {
    if (!is_sought_) return;
    stability_.event(event);
    if (is_housed_) return end_housed(event);
    if (!event.lasts()) return end_with(event);
    if (event.is_stick() && !course_.empty() && !course_.back().end) end_with(event);
    motion::Motion<double> place{};
    place.x = event.place;
    course_.push_back({place, event.place, event.time, event.length, Side::none, Side::none, event});
  }

  /// Whether a derivative that is sought doesn't exist, since the motion grazes a stop.
  [[nodiscard]] bool grazes() const { return is_sought_ && stability_.grazes(); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    if (!is_sought_ || grazes()) return {};
    if (is_housed_) return {sensitivities_in_housing(course_, span, keys_.list())};
    return {sensitivities(course_, span, keys_.list())};
  }
  [[nodiscard]] double evaluations() const { return stability_.evaluations(); }  ///< of arcs

 private:
  template <Effects E>
  void add_loose(const motion::RelativeArc<double, E>& loose) {
    course_.back().loose = {loose.anchor(), loose.start().offset, loose.start().v, loose.velocity(0.0)};
  }
  void add_loose(const motion::Pressed& loose) {
    course_.back().wall = loose.wall, course_.back().carries = true, course_.back().loose.offset = loose.place;
  }
  /// With a loose mass: the arc that follows shows a time for which the main one is held. A stick ends the slip before.
  void end_housed(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::hold) return;
    if (event.lasts()) held_ = event;
    if (course_.empty() || (event.lasts() && !event.is_stick())) return;
    Stretch& last = course_.back();
    if (!event.is_stick() || (!last.is_held && last.ends.empty())) last.ends.push_back(event);
  }
  void end_with(const motion::Event& event) {
    if (!course_.empty()) course_.back().end = event;
  }

  ParameterSet keys_;
  bool is_sought_, is_housed_, rubs_;
  Stability::Observer stability_;  ///< tells grazes
  Course course_{};
  std::optional<motion::Event> held_{};  ///< a time for which the main mass is held, whose arc comes next
};

}  // namespace clatter::observables
