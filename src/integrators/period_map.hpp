#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "integrators/exact.hpp"
#include "integrators/repeat.hpp"
#include "integrators/run.hpp"
#include "integrators/section_watch.hpp"

namespace clatter {

/// A small change of a state.
struct Change {
  double x = 0.0, v = 0.0;

  [[nodiscard]] double size() const { return std::max(std::abs(x), std::abs(v)); }
};

[[nodiscard]] inline Change between(const State<double>& from, const State<double>& to) {
  return {to.x - from.x, to.v - from.v};
}

[[nodiscard]] inline Change operator*(const Map<double>& map, const Change& c) {
  return {map[0] * c.x + map[1] * c.v, map[2] * c.x + map[3] * c.v};
}

/// Where a map that has the derivative D, and moves a state by `gap`, has its fixed point: (I - D)^-1 gap from there.
[[nodiscard]] inline Change newton_step(const Map<double>& D, const Change& gap) {
  const double determinant = (1 - D[0]) * (1 - D[3]) - D[1] * D[2];
  return {((1 - D[3]) * gap.x + D[1] * gap.v) / determinant, (D[2] * gap.x + (1 - D[0]) * gap.v) / determinant};
}

/// A norm in which a map D contracts, and by how much: |e|^2 = e' M e with D' M D - M = -I, so that
/// |D e|^2 <= (1 - 1/lambda) |e|^2 with M's larger eigenvalue lambda. There is one when both multipliers lie within the
/// unit circle.
class ContractionNorm {
 public:
  explicit ContractionNorm(Map<double> D) {
    for (int doubling = 0; doubling < 60; ++doubling) {  // M = sum D'^j D^j, twice as many terms each time
      const double xx = D[0] * (xx_ * D[0] + xv_ * D[2]) + D[2] * (xv_ * D[0] + vv_ * D[2]);
      const double xv = D[0] * (xx_ * D[1] + xv_ * D[3]) + D[2] * (xv_ * D[1] + vv_ * D[3]);
      const double vv = D[1] * (xx_ * D[1] + xv_ * D[3]) + D[3] * (xv_ * D[1] + vv_ * D[3]);
      xx_ += xx, xv_ += xv, vv_ += vv;
      if (!(xx + vv < most)) return;                                 // it grows without end
      if (!(xx_ >= 1 && vv_ >= 1 && xx_ * vv_ > xv_ * xv_)) return;  // M >= I: rounding has eaten it
      if (xx + vv <= std::numeric_limits<double>::epsilon() * (xx_ + vv_)) {
        const double larger = (xx_ + vv_) / 2 + norm((xx_ - vv_) / 2, xv_);
        factor_ = std::sqrt(1 - 1 / larger);
        return;
      }
      D = {D[0] * D[0] + D[1] * D[2], D[1] * (D[0] + D[3]), D[2] * (D[0] + D[3]), D[1] * D[2] + D[3] * D[3]};
    }
  }

  /// At most this share of a change is left after the map; 1 where there is no such norm.
  [[nodiscard]] double factor() const { return factor_; }
  [[nodiscard]] double of(const Change& e) const {
    const double size = e.size();  // divided out: the squares of small changes vanish
    if (!(size > 0)) return size;
    const double x = e.x / size, v = e.v / size;
    return size * std::sqrt(std::max(0.0, xx_ * x * x + 2 * xv_ * x * v + vv_ * v * v));
  }
  /// A change of the same size, at right angles to this one in the norm.
  [[nodiscard]] Change across(const Change& e) const {
    const double size = e.size();
    if (!(size > 0)) return {};
    const double x = e.x / size, v = e.v / size;
    const Change other{-(xv_ * x + vv_ * v), xx_ * x + xv_ * v};
    const double factor = of({x, v}) / of(other);
    return {other.x * factor * size, other.v * factor * size};
  }

 private:
  static constexpr double most = 1e12;
  double xx_ = 1, xv_ = 0, vv_ = 1;  ///< M
  double factor_ = 1;
};

/// A periodic motion of n forcing periods: its states at the sections and its derivative.
struct Orbit {
  std::size_t periods = 0;
  std::array<State<double>, RepeatFinder::longest + 1> states{};     ///< the last as computed from the first
  std::array<Map<double>, RepeatFinder::longest + 1> derivatives{};  ///< of each by the first
  std::array<std::uint64_t, RepeatFinder::longest> itineraries{};    ///< [section]

  [[nodiscard]] Change gap() const { return between(states[0], states[periods]); }
  [[nodiscard]] const Map<double>& derivative() const { return derivatives[periods]; }
};

/// The map of states over n forcing periods, its derivative, and Newton's method for its fixed points.
template <Effects E>
class PeriodMap {
 public:
  PeriodMap(Exact<double, E>& integrator, double tolerance)
      : integrator_(integrator), watch_(integrator.stops()), tolerance_(tolerance) {}

  /// Times that an attempt follows all periods of a motion: the approach, each iteration, three neighbours.
  static constexpr std::size_t most_iterations = 4, most_turns = 1 + most_iterations + 3;

  [[nodiscard]] std::size_t simulated() const { return simulated_; }  ///< forcing periods

  /// The motion over n periods from a state; nothing where it fails.
  [[nodiscard]] std::optional<Orbit> follow(State<double> state, std::size_t periods) {
    Orbit orbit{.periods = periods};
    orbit.states[0] = state, orbit.derivatives[0] = {1, 0, 0, 1};
    watch_.differentiate();
    for (std::size_t i = 1; i <= periods; ++i) {
      ++simulated_;
      watch_.begin_section();
      if (advance_to_section(integrator_, state, state.periods, watch_) != Outcome::completed) return std::nullopt;
      orbit.states[i] = state, orbit.derivatives[i] = watch_.derivative();
      orbit.itineraries[i - 1] = watch_.itinerary();
    }
    return orbit;
  }

  /// The periodic motion that a motion, once round, is settling to: found by Newton's method from where that began,
  /// on the branch that it is really on (the same stops in the same order). It must attract, and the approach be within
  /// its basin.
  [[nodiscard]] std::optional<Orbit> attractor_of(const Orbit& approach) {
    State<double> start = moved(approach.states[0], newton_step(approach.derivative(), approach.gap()));
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
      if (!inside(start)) return std::nullopt;
      std::optional<Orbit> orbit = follow(start, approach.periods);
      if (!orbit || orbit->itineraries != approach.itineraries) return std::nullopt;
      const double gap = orbit->gap().size(), scale = std::max(std::abs(start.x), std::abs(start.v));
      if (gap <= tolerance_ * scale) return attracts(*orbit, approach) ? polished(*orbit) : std::nullopt;
      if (!(gap < before / 4)) return std::nullopt;
      before = gap;
      start = moved(start, newton_step(orbit->derivative(), orbit->gap()));
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool inside(const State<double>& state) const {
    return state.x >= integrator_.stops().lower && state.x <= integrator_.stops().upper && std::isfinite(state.v);
  }

  [[nodiscard]] static State<double> moved(State<double> state, const Change& change) {
    if (change.x == 0 && change.v == 0) return state;
    state.x += change.x, state.rise += change.x, state.v += change.v, state.released = false;
    return state;
  }

  /// Whether the approach ends on the orbit: what the derivative doesn't tell of it is small against the contraction,
  /// and on three more sides of the orbit, as far away as the approach began, motion meets the same stops in the same
  /// order.
  [[nodiscard]] bool attracts(const Orbit& orbit, const Orbit& approach) {
    const ContractionNorm measure(orbit.derivative());
    const Change first = between(orbit.states[0], approach.states[0]);
    const Change last = between(orbit.states[0], approach.states[approach.periods]), told = orbit.derivative() * first;
    const double untold = measure.of({last.x - told.x, last.v - told.v});
    if (!(measure.factor() < 1 && untold <= (1 - measure.factor()) / 4 * measure.of(first))) return false;
    const Change across = measure.across(first);
    for (const Change& other : {Change{-first.x, -first.v}, across, Change{-across.x, -across.v}}) {
      const State<double> neighbour = moved(orbit.states[0], other);
      if (!inside(neighbour)) return false;
      const std::optional<Orbit> beside = follow(neighbour, orbit.periods);
      if (!beside || beside->itineraries != orbit.itineraries) return false;
    }
    return true;
  }

  /// All of its states moved by what the last Newton step still leaves, so that no more than rounding is.
  [[nodiscard]] std::optional<Orbit> polished(Orbit orbit) const {
    const Change step = newton_step(orbit.derivative(), orbit.gap());
    for (std::size_t i = 0; i <= orbit.periods; ++i) {
      orbit.states[i] = moved(orbit.states[i], orbit.derivatives[i] * step);
      if (!inside(orbit.states[i])) return std::nullopt;
    }
    return orbit;
  }

  Exact<double, E>& integrator_;
  SectionWatch watch_;
  double tolerance_;
  std::size_t simulated_ = 0;
};

}  // namespace clatter
