#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include "motion/rough_neighbourhood.hpp"
#include "motion/together.hpp"
#include "steady/contraction.hpp"
#include "steady/map_orbit.hpp"
#include "steady/passage_observer.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// The map of states over n forcing periods, its derivative, and Newton's method for its fixed points.
template <Effects E>
class StroboscopicMap {
 public:
  /// `pace` is the rate by which velocities are divided before they are compared with displacements (`pace_of`).
  StroboscopicMap(stepping::Exact<double, E>& integrator, double tolerance, double pace = 1)
      : integrator_(integrator), watch_(integrator.stops()), tolerance_(tolerance), pace_(pace) {}

  /// The most times that an attempt follows all periods of a motion: the approach, each iteration, the proof.
  static constexpr std::size_t most_iterations = 4, most_turns = 1 + most_iterations + 1;

  [[nodiscard]] std::size_t simulated() const { return simulated_; }  ///< forcing periods

  /// The motion over n periods from a state, reporting also to another observer; nothing if it fails.
  template <class Observer>
  [[nodiscard]] std::optional<MapOrbit> follow(const motion::State<double>& from, std::size_t periods, Observer& also) {
    motion::Together observers(watch_, also);
    return follow_under(observers, from, periods);
  }
  [[nodiscard]] std::optional<MapOrbit> follow(const motion::State<double>& from, std::size_t periods) {
    return follow_under(watch_, from, periods);
  }

  /// The periodic motion that `approach`, one round of a motion, settles to. Newton's method finds it from the start of
  /// the round, with the same stops met in the same order, and it is proved to attract a neighbourhood that holds the
  /// end of the round.
  [[nodiscard]] std::optional<MapOrbit> attractor_of(const MapOrbit& approach) {
    motion::State<double> start = moved(approach.states[0], newton_step(approach.derivative(), approach.gap()));
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
      if (!inside(start)) return std::nullopt;
      const std::optional<MapOrbit> orbit = follow(start, approach.periods);
      if (!orbit || orbit->passages != approach.passages) return std::nullopt;
      const double gap = orbit->gap().size();
      const bool found = gap <= tolerance_ * size_of(start);
      if (!found && !(gap < before / 4)) return std::nullopt;
      before = gap;
      start = moved(start, newton_step(orbit->derivative(), orbit->gap()));
      if (found) return attracting(start, *orbit, approach.states[approach.periods]);
    }
    return std::nullopt;
  }

 private:
  /// Follows a motion that is reported to `watch_`, or to it and another observer.
  template <class Observer>
  [[nodiscard]] std::optional<MapOrbit> follow_under(Observer& observer, const motion::State<double>& from,
                                                     std::size_t periods) {
    return orbit_from(from, periods, watch_, [&](motion::State<double>& state) {
      ++simulated_;
      return advance_to_section(integrator_, state, from.periods, observer);
    });
  }

  [[nodiscard]] bool inside(const motion::State<double>& state) const {
    const Stops stops = rigid_ones(integrator_.stops());
    return state.x >= stops.lower && state.x <= stops.upper && std::isfinite(state.v);
  }

  [[nodiscard]] static double size_of(const motion::State<double>& state) {
    return std::max(std::abs(state.x), std::abs(state.v));
  }

  [[nodiscard]] static motion::State<double> moved(motion::State<double> state, const motion::Perturbation& change) {
    if (change.x == 0 && change.v == 0) return state;
    state.x += change.x, state.offset += change.x, state.v += change.v, state.released = false;
    state.within = Side::none, state.pressed = false;  // which the next arc finds out
    return state;
  }

  /// The periodic motion from `start`, if it is proved to attract `motion` (eq. 30): all motions from the disc around
  /// `start` that holds `motion`, in a norm in which the derivative contracts, meet the same stops in the same order,
  /// and the remainder beyond the derivative is smaller than the contraction.
  [[nodiscard]] std::optional<MapOrbit> attracting(const motion::State<double>& start, const MapOrbit& orbit,
                                                   const motion::State<double>& motion) {
    if (!(spectral_radius(orbit.derivative()) < 1) || !inside(start)) return std::nullopt;
    const ContractionNorm measure(at_pace(orbit.derivative()));
    const double rounding = 64 * epsilon<double>() * std::max(std::abs(start.x), std::abs(start.v) / pace_);
    const double radius = measure.of(at_pace(between(start, motion))) * (1 + 1e-9) + rounding;
    auto neighbourhood = neighbourhood_of(measure.disc(radius), rounding);
    std::optional<MapOrbit> attractor = follow(start, orbit.periods, neighbourhood);
    if (!attractor || !neighbourhood.holds()) return std::nullopt;
    const double left = measure.of(neighbourhood.first_order()) + measure.of(neighbourhood.remainder()) +
                        measure.of(at_pace(attractor->gap()));
    if (!(left < radius)) return std::nullopt;
    const double rounds = std::log(between(start, motion).size() / (tolerance_ * size_of(start))) /
                          -std::log(spectral_radius(orbit.derivative()));
    attractor->settling = static_cast<double>(orbit.periods) * (1 + std::max(0.0, rounds));
    return attractor;
  }

  /// A change, and a map of changes, of (x, v/`pace_`).
  [[nodiscard]] motion::Perturbation at_pace(const motion::Perturbation& change) const {
    return {change.x, change.v / pace_};
  }
  [[nodiscard]] motion::Jacobian<double> at_pace(const motion::Jacobian<double>& map) const {
    return {map[0], map[1] * pace_, map[2] / pace_, map[3]};
  }

  /// The proof for the motions of an ellipse.
  [[nodiscard]] auto neighbourhood_of(const motion::Ellipse& start, double rounding) const {
    const Stops& stops = integrator_.stops();
    if constexpr (E.friction) {
      return motion::RoughNeighbourhood(stops, start, rounding, integrator_.static_level(), pace_);
    } else if constexpr (E.soft) {
      return motion::SoftNeighbourhood(stops, start, rounding, false, pace_);
    } else {
      return motion::Neighbourhood(stops, start, rounding, false, pace_);
    }
  }

  stepping::Exact<double, E>& integrator_;
  PassageObserver watch_;
  double tolerance_;
  double pace_;
  std::size_t simulated_ = 0;
};

}  // namespace clatter::steady
