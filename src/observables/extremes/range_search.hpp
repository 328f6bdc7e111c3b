#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "math/bernstein.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "observables/extremes/range.hpp"

namespace clatter::observables {

/// Includes a polynomial over a step, which lies within the range of its coefficients; halved at most so many times.
template <std::size_t size>
void include_polynomial(Range& range, std::array<double, size> y, double offset = 0.0, int halvings = 52) {
  range.include(offset + y.front()), range.include(offset + y.back());
  const auto [least, greatest] = std::ranges::minmax(y);
  const double low = offset + least, high = offset + greatest;
  const double rounding = 4 * epsilon<double>() * std::max(std::abs(low), std::abs(high));
  if (!(high > range.high + rounding || low < range.low - rounding) || halvings == 0) return;
  const auto left = split_off(y, 0.5);
  include_polynomial(range, left, offset, halvings - 1);
  include_polynomial(range, y, offset, halvings - 1);
}

// Quantities along an arc: value and first two derivatives, and a bound of step^6 times the sixth derivative from an
// instant on.

struct DisplacementOnArc {
  template <class A>
  [[nodiscard]] std::array<double, 3> jet(const A&, const motion::Motion<double>& m) const {
    return {m.x, m.v, m.a};
  }
  template <class A>
  [[nodiscard]] double bound_along(const A& arc, const motion::Motion<double>& m, double step) const {
    return sixth_bound(arc.constants(), m, step, 0);
  }
  /// Of a part that the rest may cancel, so that its rounding stays.
  template <class A>
  [[nodiscard]] double size(const A& arc) const requires requires {
    arc.size(0);
  }
  { return arc.size(0); }
};

struct VelocityOnArc {
  template <class A>
  [[nodiscard]] std::array<double, 3> jet(const A& arc, const motion::Motion<double>& m) const {
    return {m.v, m.a, arc.constants().jerk(m)};
  }
  template <class A>
  [[nodiscard]] double bound_along(const A& arc, const motion::Motion<double>& m, double step) const {
    return sixth_bound(arc.constants(), m, step, 1);
  }
  /// Of a part that the rest may cancel, so that its rounding stays.
  template <class A>
  [[nodiscard]] double size(const A& arc) const requires requires {
    arc.size(1);
  }
  { return arc.size(1); }
};

/// The force of the soft stop that the arc is in contact with (eq. 50); arcs are anchored on it.
struct StopForceOnArc {
  template <class A>
  [[nodiscard]] std::array<double, 3> jet(const A& arc, const motion::Motion<double>& m) const {
    const auto& stop = arc.constants().stop;
    return {stop.force(stop.into(m.offset), stop.into(m.v)), stop.force(stop.into(m.v), stop.into(m.a)),
            stop.force(stop.into(m.a), stop.into(arc.constants().jerk(m)))};
  }
  template <class A>
  [[nodiscard]] double bound_along(const A& arc, const motion::Motion<double>& m, double step) const {
    const auto& stop = arc.constants().stop;
    const auto weighed = [&](double factor, int derivative) {
      return factor == 0 ? 0.0 : factor * sixth_bound(arc.constants(), m, step, derivative);
    };
    return weighed(stop.stiffness, 0) + weighed(2 * stop.damping, 1);
  }
};

/// Visits an arc of positive length wherever a quantity may exceed its range: every stretch is either proved not to, by
/// the enclosure that finds contacts (eq. 13), or split, at the quantity's turning point if it has one. `see(motion)`,
/// or `see(motion, s)` with the time since the start, gets both ends and every instant visited, and widens the ranges.
template <class A, class See>
class RangeSearch {
 public:
  RangeSearch(const A& arc, double length, const See& see)
      : arc_(arc), see_(see), from_{0.0, arc.start()}, to_{length, at(length)} {
    show(from_), show(to_);
  }

  template <class Quantity>
  void exceed(const Quantity& quantity, const Range& range) {
    exceed(quantity, range, from_, to_);
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of the arc

 private:
  static constexpr int max_splits = 1 << 22;  ///< only an arc whose bounds overflow needs so many

  struct Place {
    double s;
    motion::Motion<double> motion;
  };

  void show(const Place& place) const {
    if constexpr (std::is_invocable_v<const See&, const motion::Motion<double>&, double>)
      see_(place.motion, place.s);
    else
      see_(place.motion);
  }

  [[nodiscard]] motion::Motion<double> at(double s) {
    ++evaluations_;
    return arc_.at(s);
  }

  template <class Quantity>
  void exceed(const Quantity& quantity, const Range& range, const Place& from, const Place& to) {
    const double step = to.s - from.s;
    const auto left = quantity.jet(arc_, from.motion), right = quantity.jet(arc_, to.motion);
    const double error = hermite_error(quantity.bound_along(arc_, from.motion, step));
    const Bernstein<double> c =
        hermite(HermiteData<double>::over(step, {0.0, left[1], left[2], right[0] - left[0], right[1], right[2]}));
    const Interval<double> inner = enclosure(c, error);  // the ends are included already
    const double low = left[0] + inner.low, high = left[0] + inner.high;
    double size = std::max(std::abs(left[0]), std::abs(right[0]));
    if constexpr (requires { quantity.size(arc_); }) size += 2 * quantity.size(arc_);
    const double rounding = 4 * epsilon<double>() * size;
    if (!(high > range.high + rounding || low < range.low - rounding) || ++splits_ > max_splits) return;
    const Place middle = split(quantity, from, to);
    if (!(middle.s > from.s && middle.s < to.s)) return;
    show(middle);
    exceed(quantity, range, from, middle);
    exceed(quantity, range, middle, to);
  }

  /// The turning point where the slope changes sign between two places, by Newton's iteration within a bracket; else
  /// the middle.
  template <class Quantity>
  [[nodiscard]] Place split(const Quantity& quantity, const Place& from, const Place& to) {
    double low = from.s, high = to.s, s = (low + high) / 2;
    const double slope_before = quantity.jet(arc_, from.motion)[1], slope_after = quantity.jet(arc_, to.motion)[1];
    motion::Motion<double> m = at(s);
    const bool turns_once = slope_before * slope_after < 0 && (to.s - from.s) * arc_.constants().rate < 4;
    if (!turns_once) return {s, m};
    for (int iteration = 0; iteration < 60; ++iteration) {
      const auto [value, slope, curvature] = quantity.jet(arc_, m);
      if (slope == 0) break;
      ((slope > 0) == (slope_before > 0) ? low : high) = s;
      double next = s - slope / curvature;
      if (!(next > low && next < high)) next = (low + high) / 2;
      const bool settled = std::abs(next - s) <= 1e-9 * (to.s - from.s);  // the extremum's error is the square of this
      s = next;
      m = at(s);
      if (settled) break;
    }
    return {s, m};
  }

  const A& arc_;
  const See& see_;
  double evaluations_ = 0.0;
  int splits_ = 0;
  Place from_, to_;
};

}  // namespace clatter::observables
