#pragma once

#include "motion/arc.hpp"
#include "motion/pull_rule.hpp"
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
class Exact : public EventDriven<Exact<N, E, Search>, N, E> {
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
      : EventDriven<Exact, N, E>(scene, in_reach, limits, rule), search_(this->constants(), in_reach) {}

  /// The arc that begins with `start`, and its first contact, or its end at the horizon.
  [[nodiscard]] ArcToEvent<motion::Arc<Number, E.arc()>> fly(const motion::State<Number>&,
                                                             const motion::Motion<Number>& start, const Number& anchor,
                                                             const Number& horizon) {
    ArcToEvent<motion::Arc<Number, E.arc()>> flight{motion::Arc<Number, E.arc()>(this->constants(), start, anchor)};
    if constexpr (E.stops()) {
      flight.crossing = search_(flight.arc, this->stops(), horizon);
    } else {
      const motion::Motion<Number> there = flight.arc.at(horizon);
      flight.crossing = {0, Side::none, horizon, there, 1, this->finite(there.x)};
    }
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

  /// The flight of a loose mass in its housing up to its next impact on a wall, or to the horizon.
  [[nodiscard]] ArcToEvent<motion::RelativeArc<Number, E.arc()>> fly_in_housing(
      const motion::State<Number>&, const motion::Motion<Number>& start, const Number& anchor,
      const motion::RelativeStart<Number>& loose, const motion::Walls<Number>& walls,
      const Number& horizon) requires(E.loose) {
    const motion::Arc<Number, E.arc()> main(this->constants(), start, anchor);
    ArcToEvent<motion::RelativeArc<Number, E.arc()>> flight{{main, loose, walls.load}};
    flight.crossing = next_contact(flight.arc, walls.places, horizon);
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }
  /// Both masses as one while a wall presses the loose one, or for all of the time.
  template <Effects Both>
  [[nodiscard]] ArcToEvent<motion::Arc<Number, Both>> carry(const motion::ArcConstants<Number, Both>& constants,
                                                            const motion::State<Number>&,
                                                            const motion::Motion<Number>& start, const Number& anchor,
                                                            const Pressing<Number>& pressing,
                                                            const Number& horizon) requires(E.loose) {
    ArcToEvent<motion::Arc<Number, Both>> flight{motion::Arc<Number, Both>(constants, start, anchor)};
    if (pressing.wall == Side::none)
      flight.crossing = {1, Side::none, horizon, flight.arc.at(horizon)};
    else
      flight.crossing = end_of_press(flight.arc, pressing.wall, pressing.load, horizon);
    this->count_evaluations(flight.crossing.evaluations);
    return flight;
  }

 private:
  [[no_unique_address]] Search search_;
};

}  // namespace clatter::stepping
