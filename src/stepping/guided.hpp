#pragma once

#include "motion/arc.hpp"
#include "motion/guided_contact.hpp"
#include "stepping/event_driven.hpp"

namespace clatter::stepping {

/// `Exact` in numbers with more digits than double has, for motion that double has found: the first contact of most
/// flights is proved in double, and only its instant is computed in all digits, which takes a tenth of the time. The
/// reference of `clatter accuracy` doesn't use this, since it has to be independent of double.
template <class N, Effects E>
class Guided : public EventDriven<Guided<N, E>, N, E> {
 public:
  using Number = N;
  static constexpr bool in_closed_form = true;

  explicit Guided(const BasicScene<Number>& scene, const Limits& limits = {})
      : Guided(scene, scene.stops, limits, motion::ChatterRule<Number>::of(scene.stops)) {}

  Guided(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits,
         const motion::ChatterRule<Number>& rule)
      : EventDriven<Guided, N, E>(scene, in_reach, limits, rule), guide_(this->constants(), in_reach) {}

  /// The arc that begins with `start`, and its first contact, or its end at the horizon.
  [[nodiscard]] ArcToEvent<motion::Arc<Number, E.arc()>> fly(const motion::State<Number>&,
                                                             const motion::Motion<Number>& start, const Number& anchor,
                                                             const Number& horizon) {
    ArcToEvent<motion::Arc<Number, E.arc()>> flight{motion::Arc<Number, E.arc()>(this->constants(), start, anchor)};
    const auto guided = guide_.first(flight.arc, horizon);
    flight.crossing = guided ? *guided : next_contact(flight.arc, this->stops(), horizon);
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }

  /// As `Exact` does.
  template <Effects Within, std::size_t count>
  [[nodiscard]] ArcToEvent<motion::Arc<Number, Within>> fly_within(
      const motion::ArcConstants<Number, Within>& constants, const motion::State<Number>&,
      const motion::Motion<Number>& start, const Number& anchor,
      const std::array<motion::Margin<Number>, count>& margins, const Number& horizon) {
    ArcToEvent<motion::Arc<Number, Within>> flight{motion::Arc<Number, Within>(constants, start, anchor)};
    flight.crossing = first_crossing(flight.arc, margins, horizon);
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }

 private:
  motion::GuidedContact<Number, E.arc()> guide_;
};

}  // namespace clatter::stepping
