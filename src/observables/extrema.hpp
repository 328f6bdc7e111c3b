#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "math/bernstein.hpp"
#include "model/response.hpp"
#include "model/stops.hpp"
#include "motion/polynomial_arc.hpp"
#include "observables/observable.hpp"
#include "observables/range_search.hpp"

namespace clatter::observables {

/// Least and greatest displacement and velocity, between the ends of arcs too: every stretch of an arc is either proved
/// not to exceed the extrema found so far, by the enclosure that finds contacts (eq. 13), or split, at its turning
/// point if it has one. An arc without length takes no time, so the speed of a start into a stop doesn't count.
class Extrema {
 public:
  using Range = observables::Range;

  struct Settings {
    bool extrema = false;
  };
  struct Values {
    double x_min = no_value, x_max = no_value, v_min = no_value, v_max = no_value;
  };
  static constexpr std::tuple fields{Field{
      Key{"observe", "extrema", Kind::flag, "false", "true", "x_min x_max v_min v_max, exact, between samples too"},
      &Settings::extrema}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.extrema; }
  [[nodiscard]] static std::string description(const Settings&) { return "extrema"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    return {scalar("x_min", "minimum displacement", &Values::x_min, Quantity::length),
            scalar("x_max", "maximum displacement", &Values::x_max, Quantity::length),
            scalar("v_min", "minimum velocity", &Values::v_min, Quantity::velocity),
            scalar("v_max", "maximum velocity", &Values::v_max, Quantity::velocity)};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  Extrema() = default;
  Extrema(const Settings&, const ObservedSpan&) {}

  template <Effects E>
  void arc(const motion::Arc<double, E>& arc, double, double length) {
    if (!(length > 0)) return;
    const auto see = [this](const motion::Motion<double>& m) { x_.include(m.x), v_.include(m.v); };
    RangeSearch search(arc, length, see);
    search.exceed(DisplacementOnArc{}, x_);
    search.exceed(VelocityOnArc{}, v_);
    evaluations_ += search.evaluations();
  }
  template <motion::Polynomial A>
  void arc(const A& arc, double, double length) {
    if (!(length > 0)) return;
    const double part = arc.length() > 0 ? length / arc.length() : 0.0;
    Bernstein<double> offset = arc.offset(), velocity = arc.velocity();
    offset = split_off(offset, part), velocity = split_off(velocity, part);
    include_polynomial(x_, offset, arc.anchor());
    include_polynomial(v_, velocity);
    ++evaluations_;
  }
  /// Adds ranges that were found elsewhere.
  void include(const Range& x, const Range& v) {
    x_.include(x.low), x_.include(x.high), v_.include(v.low), v_.include(v.high);
  }
  /// The ranges of the steady response to the force.
  bool response(const ObservedSpan& span, double) {
    const Oscillator& o = span.scene.oscillator;
    const double amplitude = steady_response(o).amplitude, v = o.frequency * amplitude, middle = equilibrium_of(o);
    include({middle - amplitude, middle + amplitude}, {-v, v});
    return true;
  }
  void rest(const motion::Rest& rest) { x_.include(rest.position), v_.include(0.0); }
  void impact(const motion::Impact& impact) {
    x_.include(impact.position), v_.include(impact.before), v_.include(impact.after);
  }

  /// Cut at the stops, which the end of an arc meets only to rounding, or by time stepping to the length of a step.
  [[nodiscard]] Range displacement(const Stops& stops) const {
    return {std::max(x_.low, stops.lower), std::min(x_.high, stops.upper)};
  }
  [[nodiscard]] const Range& velocity() const { return v_; }
  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    const Range x = displacement(rigid_ones(span.scene.stops));
    return {x.low, x.high, v_.low, v_.high};
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  Range x_, v_;
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
