#pragma once

#include "motion/arc.hpp"
#include "motion/coupled_arc.hpp"
#include "motion/pull_rule.hpp"
#include "motion/slide_rule.hpp"
#include "stepping/event_driven.hpp"

namespace clatter::stepping {

/// The first contact of an arc with the stops, proved in the arc's own numbers.
struct OwnSearch {
  template <class Constants, class Stops>
  OwnSearch(const Constants&, const Stops&) {}

  template <class A, class Stops, class Number>
  [[nodiscard]] motion::Crossing<Number> operator()(const A& arc, const Stops& stops, const Number& horizon) const {
    return next_contact(arc, stops, horizon);
  }
};

/// Closed-form arcs and proved first contacts, which a `Search` finds, for the effects in E.
template <class N, Effects E, class Search = OwnSearch>
class Exact : public EventDriven<Exact<N, E, Search>, ExactArcs<N>, N, E> {
 public:
  using Number = N;
  static constexpr bool in_closed_form = true;

  explicit Exact(const BasicScene<Number>& scene, const Limits& limits = {}) : Exact(scene, scene.stops, limits) {}
  /// Of a scene with numbers of another type.
  template <class Other>
  explicit Exact(const BasicScene<Other>& scene, const Limits& limits = {})
      : Exact(with_numbers<Number>(scene), limits) {}

  /// Looks for contacts with the stops in reach only.
  Exact(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits = {})
      : Exact(scene, in_reach, limits, motion::ChatterRule<Number>::of(scene.stops)) {}

  Exact(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits,
        const motion::ChatterRule<Number>& rule)
      : EventDriven<Exact, ExactArcs<N>, N, E>(scene, in_reach, limits, rule), search_(this->constants(), in_reach) {}

  /// The arc that begins with `start`, and its first contact, or its end at the horizon. Without stops a loose mass
  /// ends it, and its motion there isn't computed.
  template <Effects Of>
  [[nodiscard]] ArcToEvent<motion::Arc<Number, Of>> fly(const motion::ArcConstants<Number, Of>& constants,
                                                        const motion::State<Number>&,
                                                        const motion::Motion<Number>& start, const Number& anchor,
                                                        const Number& horizon) {
    ArcToEvent<motion::Arc<Number, Of>> flight{motion::Arc<Number, Of>(constants, start, anchor)};
    if constexpr (E.stops() && Of == E.arc() && !E.loose) {
      flight.crossing = search_(flight.arc, this->stops(), horizon);
    } else if constexpr (E.stops()) {
      flight.crossing = next_contact(flight.arc, this->stops(), horizon);
    } else if constexpr (E.loose) {
      flight.crossing = {0, Side::none, horizon, start};
    } else {
      const motion::Motion<Number> there = flight.arc.at(horizon);
      flight.crossing = {0, Side::none, horizon, there, 1, this->finite(there.x)};
    }
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }

  /// The same between other stops.
  template <Effects Of>
  [[nodiscard]] ArcToEvent<motion::Arc<Number, Of>> fly_between(const BasicStops<Number>& stops,
                                                                const motion::ArcConstants<Number, Of>& constants,
                                                                const motion::Motion<Number>& start,
                                                                const Number& anchor, const Number& horizon) {
    ArcToEvent<motion::Arc<Number, Of>> flight{motion::Arc<Number, Of>(constants, start, anchor)};
    flight.crossing = next_contact(flight.arc, stops, horizon);
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }

  /// The same beyond the position of a soft stop, with the first of some margins that falls to 0.
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

  /// The motion of a loose mass beside an arc of the main one.
  template <Effects Of>
  [[nodiscard]] static motion::RelativeArc<Number, Of> beside(const motion::Arc<Number, Of>& main,
                                                              const motion::RelativeStart<Number>& start,
                                                              const Number& load) {
    return {main, start, load};
  }
  template <Effects Of>
  [[nodiscard]] motion::Crossing<Number> meet_wall(const motion::RelativeArc<Number, Of>& beside, const Stops& walls,
                                                   const Number& horizon) {
    const motion::Crossing<Number> contact = next_contact(beside, walls, horizon);
    this->count_evaluations(contact.evaluations);
    return contact;
  }
  /// Where it comes to a stop in its housing, if it slides to a side.
  template <Effects Of>
  [[nodiscard]] motion::Crossing<Number> come_to_stop(const motion::RelativeArc<Number, Of>& beside, Side towards,
                                                      const Number& horizon) {
    const motion::Crossing<Number> end = end_of_slide(beside, towards, horizon);
    this->count_evaluations(end.evaluations);
    return end;
  }
  template <Effects Of>
  [[nodiscard]] motion::Crossing<Number> let_go(const motion::Arc<Number, Of>& main, const Pressing<Number>& pressing,
                                                const Number& horizon) {
    const motion::Crossing<Number> end = end_of_press(main, pressing.wall, pressing.load, horizon);
    this->count_evaluations(end.evaluations);
    return end;
  }
  /// A step of both masses beside a soft wall.
  template <Effects Of>
  [[nodiscard]] motion::CoupledInHousing<Number> couple(const motion::ArcConstants<Number, Of>& constants,
                                                        const motion::Coupling<Number>& coupling,
                                                        const motion::Motion<Number>& start, const Number& anchor,
                                                        const motion::RelativeStart<Number>& from, const Number& load,
                                                        const Number& horizon) {
    this->count_evaluations(1);
    return coupled(constants, coupling, start, anchor, from, load, horizon);
  }
  [[nodiscard]] static motion::Arc<Number, HeldConstants<Number>::effects> held_arc(
      const HeldConstants<Number>& constants, const motion::State<Number>&, const motion::Motion<Number>& start,
      const Number& anchor, const Number&) {
    return {constants, start, anchor};
  }

 private:
  [[no_unique_address]] Search search_;
};

}  // namespace clatter::stepping
