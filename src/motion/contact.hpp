#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "motion/first_crossing.hpp"

namespace clatter::motion {

/// Whether motion stays between two places for a time from an instant of an arc on (eq. 16).
template <class Number, Effects E>
[[nodiscard]] bool stays_between(const Arc<Number, E>& arc, const Motion<Number>& here, const Number& time,
                                 const Number& lower, const Number& upper) {
  const Number far = reach(arc.constants(), here, time), middle = arc.constants().equilibrium;
  return lower < middle - far && middle + far < upper;
}

/// Whether a force in pieces is constant on an arc.
template <class Number, Effects E>
[[nodiscard]] bool has_constant_force(const Arc<Number, E>& arc) {
  return arc.constants().is_in_pieces() && arc.constants().swing == 0 && arc.start().cosine == 0;
}
/// Whether the energy of a flight is conserved.
template <class Number, Effects E>
[[nodiscard]] bool conserves_energy(const Arc<Number, E>& arc) {
  if constexpr (E.stiffness) return arc.constants().h == 0 && (arc.constants().f == 0 || has_constant_force(arc));
  return E.damping == Damping::none && E.forcing == Forcing::none;
}

/// The gaps to the lower and the upper stop, margins without a share of the velocity. The speed of a contact in free
/// undamped flight is that of its energy. An arc is one of a mass between stops, or of a loose mass in its housing.
template <class A>
class GapRule {
 public:
  using Number = typename A::Number;
  static constexpr std::size_t count = 2;
  static constexpr bool alike = true;

  template <class Given = double>
  GapRule(const A& arc, const BasicStops<Given>& stops)
      : arc_(arc), lower_(stops.lower), upper_(stops.upper), gaps_{arc.anchor() - lower_, upper_ - arc.anchor()} {}

  /// Exact if the arc is anchored on the stop.
  [[nodiscard]] Number of(std::size_t i, const Motion<Number>& m) const {
    return gaps_[i] + signed_change(i, m.offset);
  }
  [[nodiscard]] Number slope(std::size_t i, const Motion<Number>& m) const { return signed_change(i, m.v); }
  [[nodiscard]] static Number signed_change(std::size_t i, const Number& y) { return i == upper ? Number(-y) : y; }

  [[nodiscard]] bool stays_clear(const Motion<Number>& here, const Number& time) const {
    return stays_between(arc_, here, time, lower_, upper_);
  }
  /// Whether the distance of the stops is so small that products of lengths vanish.
  [[nodiscard]] bool vanishes() const {
    return upper_ - lower_ < std::numeric_limits<Number>::min() / (epsilon<Number>() * epsilon<Number>());
  }

  /// The width that an enclosure has to resolve.
  [[nodiscard]] Number width(std::size_t, const Motion<Number>& here) const {
    using std::abs, std::min;
    return min(Number(upper_ - lower_), Number(abs(here.x) + abs(here.v) + arc_.constants().response.amplitude));
  }
  [[nodiscard]] Number error(std::size_t, const Motion<Number>& here, const Number& step) const {
    return hermite_error(sixth_bound(arc_.constants(), here, step, 0));
  }
  [[nodiscard]] Bernstein<Number> change(std::size_t, const Motion<Number>& here, const Motion<Number>& there,
                                         const Number& step) const {
    return hermite(
        HermiteData<Number>::over(step, {Number(0), here.v, here.a, there.offset - here.offset, there.v, there.a}));
  }

  /// A step a little longer than the time to the stop, if the present motion would reach it; else a quarter.
  [[nodiscard]] Number next_step(std::size_t i, const Motion<Number>& here, const Number& step) const {
    using std::min, std::sqrt;
    const Number g = of(i, here), v = closing(i, here.v), a = closing(i, here.a), square = v * v + 2 * a * g;
    if (g > 0 && square >= 0 && v + sqrt(square) > 0) return min(Number(step / 2), Number(4 * g / (v + sqrt(square))));
    return step / 4;
  }

  /// One Newton correction takes out the rounding that a long step leaves; not in a graze, where an ulp of displacement
  /// is far in time and the speed vanishes before.
  [[nodiscard]] Crossing<Number> refined(std::size_t i, const Motion<Number>& here, Motion<Number> m,
                                         Number elapsed) const {
    using std::abs;
    const Number speed = closing(i, m.v), missing = of(i, here) - closing(i, m.offset - here.offset);
    if (2 * abs(missing * m.a) <= speed * speed && abs(missing) <= speed * abs(elapsed) * Number(1e-6) && speed > 0) {
      const Number more = missing / speed;
      elapsed += more, m.v += m.a * more;
    }
    return at(i, elapsed, m);
  }
  [[nodiscard]] Crossing<Number> at(std::size_t i, const Number& elapsed, Motion<Number> m) const {
    m.x = i == upper ? upper_ : lower_;
    if (conserves_energy(arc_)) m.v = closing(i, conserved_speed(m.x));
    return {i, i == upper ? Side::upper : Side::lower, elapsed, m};
  }
  /// A contact within rounding of the horizon happens at it, so that it is neither lost nor taken twice.
  [[nodiscard]] Crossing<Number> at_horizon(const Number& horizon, const Motion<Number>& there) const {
    using std::abs;
    for (std::size_t i = 0; i < count; ++i) {
      const Number gap = of(i, there);
      const Number flown = abs(gap + closing(i, there.offset)) + abs(there.offset) + abs(there.v) * horizon;
      if (gap < 8 * epsilon<Number>() * flown && closing(i, there.v) > 0)
        return at(i, horizon, there);  // never if there is no such stop
    }
    return {count, Side::none, horizon, there};
  }

 private:
  static constexpr std::size_t upper = 1;

  [[nodiscard]] static Number closing(std::size_t i, const Number& y) { return i == upper ? y : Number(-y); }

  /// Speed at a position by the energy of free undamped motion (eq. 17): exact however softly the mass touches.
  [[nodiscard]] Number conserved_speed(const Number& x) const {
    using std::abs, std::max, std::sqrt;
    const Motion<Number>& from = arc_.start();
    const Number fall = (arc_.anchor() - x) + from.offset,
                 middle = arc_.constants().spring(from.x + x) - 2 * constant_load();
    const Number scale = max(max(Number(abs(fall)), Number(abs(middle))), Number(abs(from.v)));
    if (!(scale > 0)) return Number(0);
    return scale *
           sqrt(max(Number(0), Number((from.v / scale) * (from.v / scale) + (fall / scale) * (middle / scale))));
  }

  /// The load, and a force that is constant in a piece.
  [[nodiscard]] Number constant_load() const {
    const auto& c = arc_.constants();
    return c.is_in_pieces() ? Number(c.load + c.f * arc_.start().sine) : c.load;
  }

  const A& arc_;
  Number lower_, upper_;
  std::array<Number, count> gaps_;  ///< of the anchor
};

/// The first contact of an arc with a stop within a time `horizon` > 0.
template <class A, class Given = double>
[[nodiscard]] Crossing<typename A::Number> next_contact(const A& arc, const BasicStops<Given>& stops,
                                                        const typename A::Number& horizon) {
  return CrossingSearch<A, GapRule<A>>(arc, GapRule<A>(arc, stops), horizon).run();
}

}  // namespace clatter::motion
