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
#include "motion/arc.hpp"
#include "motion/polynomial_arc.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// Least and greatest displacement and velocity, between the ends of arcs too: every stretch of an arc is either proved
/// not to exceed the extrema found so far, by the enclosure that finds contacts (eq. 13), or split, at its turning
/// point if it has one. An arc without length takes no time, so the speed of a start into a stop doesn't count.
class Extrema {
 public:
  struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(double y) { low = std::min(low, y), high = std::max(high, y); }
  };

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
    splits_ = 0;
    const Place from{0.0, arc.start()}, to{length, at(arc, length)};
    include(from.motion);
    include(to.motion);
    search<0>(arc, from, to);
    search<1>(arc, from, to);
  }
  template <motion::Polynomial A>
  void arc(const A& arc, double, double length) {
    if (!(length > 0)) return;
    const double part = arc.length() > 0 ? length / arc.length() : 0.0;
    Bernstein<double> offset = arc.offset(), velocity = arc.velocity();
    offset = split_off(offset, part), velocity = split_off(velocity, part);
    include(x_, offset, arc.anchor(), most_halvings);
    include(v_, velocity, 0.0, most_halvings);
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
    const Range x = displacement(span.scene.stops);
    return {x.low, x.high, v_.low, v_.high};
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  static constexpr int max_splits = 1 << 22;  ///< of an arc; only an arc whose bounds overflow needs so many
  static constexpr int most_halvings = 52;    ///< of a polynomial's step

  struct Place {
    double s;
    motion::Motion<double> motion;
  };

  template <Effects E>
  motion::Motion<double> at(const motion::Arc<double, E>& arc, double s) {
    ++evaluations_;
    return arc.at(s);
  }
  void include(const motion::Motion<double>& m) { x_.include(m.x), v_.include(m.v); }

  /// A polynomial over a step, which lies within the range of its coefficients.
  static void include(Range& range, Bernstein<double> y, double offset, int halvings) {
    range.include(offset + y.front()), range.include(offset + y.back());
    const auto [least, greatest] = std::ranges::minmax(y);
    const double low = offset + least, high = offset + greatest;
    const double rounding = 4 * epsilon<double>() * std::max(std::abs(low), std::abs(high));
    if (!(high > range.high + rounding || low < range.low - rounding) || halvings == 0) return;
    const Bernstein<double> left = split_off(y, 0.5);
    include(range, left, offset, halvings - 1);
    include(range, y, offset, halvings - 1);
  }

  /// The quantity that is searched (order 0: displacement, 1: velocity) with its first two derivatives.
  template <int order, Effects E>
  static std::array<double, 3> jet(const motion::Arc<double, E>& arc, const motion::Motion<double>& m) {
    if constexpr (order == 0) return {m.x, m.v, m.a};
    return {m.v, m.a, arc.constants().jerk(m)};
  }

  template <int order, Effects E>
  void search(const motion::Arc<double, E>& arc, const Place& from, const Place& to) {
    const Range& range = order == 0 ? x_ : v_;
    const double step = to.s - from.s;
    const auto left = jet<order>(arc, from.motion), right = jet<order>(arc, to.motion);
    const double error = hermite_error(arc.constants().sixth_bound(from.motion, step, order));
    const Bernstein<double> c =
        hermite(HermiteData<double>::over(step, {0.0, left[1], left[2], right[0] - left[0], right[1], right[2]}));
    const Interval<double> inner = enclosure(c, error);  // the ends are included already
    const double low = left[0] + inner.low, high = left[0] + inner.high;
    const double rounding = 4 * epsilon<double>() * std::max(std::abs(left[0]), std::abs(right[0]));
    if (!(high > range.high + rounding || low < range.low - rounding) || ++splits_ > max_splits) return;
    const Place middle_place = split<order>(arc, from, to);
    if (!(middle_place.s > from.s && middle_place.s < to.s)) return;
    include(middle_place.motion);
    search<order>(arc, from, middle_place);
    search<order>(arc, middle_place, to);
  }

  /// The turning point where the slope changes sign between two places, by Newton's iteration within a bracket; else
  /// the middle.
  template <int order, Effects E>
  Place split(const motion::Arc<double, E>& arc, const Place& from, const Place& to) {
    double low = from.s, high = to.s, s = (low + high) / 2;
    const double slope_before = jet<order>(arc, from.motion)[1], slope_after = jet<order>(arc, to.motion)[1];
    motion::Motion<double> m = at(arc, s);
    const bool turns_once = slope_before * slope_after < 0 && (to.s - from.s) * arc.constants().rate < 4;
    if (!turns_once) return {s, m};
    for (int iteration = 0; iteration < 60; ++iteration) {
      const auto [value, slope, curvature] = jet<order>(arc, m);
      if (slope == 0) break;
      ((slope > 0) == (slope_before > 0) ? low : high) = s;
      double next = s - slope / curvature;
      if (!(next > low && next < high)) next = (low + high) / 2;
      const bool settled = std::abs(next - s) <= 1e-9 * (to.s - from.s);  // the extremum's error is the square of this
      s = next;
      m = at(arc, s);
      if (settled) break;
    }
    return {s, m};
  }

  Range x_, v_;
  int splits_ = 0;
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
