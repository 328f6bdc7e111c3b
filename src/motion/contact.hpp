#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/bernstein.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "scene/stops.hpp"

namespace clatter::motion {

/// The end of an arc: the first contact, or the horizon if there is none (side none).
template <class Number>
struct Contact {
  Side side = Side::none;
  Number elapsed{};         ///< time since the arc began
  Motion<Number> motion{};  ///< at the end, with the velocity before the impact
  int evaluations = 0;      ///< instants at which the arc was evaluated
  bool resolved = true;     ///< false: a bound overflows, or the step that can be proved has fallen below rounding
};

/// The usual length of a step that is proved free of contact, by the frequencies of the spring and of the force.
template <class Number>
[[nodiscard]] Number usual_step(const Number& natural, const Number& nu) {
  using std::max;
  return Number(1.6) / max(natural, nu);
}

/// Searches an arc for its first contact. An enclosure of the arc proves each step free of impacts (eq. 15), or proves
/// it up to some instant; a shorter step begins there, until the width of the enclosure is below rounding.
template <class Number, Effects E>
class ContactSearch {
 public:
  ContactSearch(const Arc<Number, E>& arc, const Stops& stops, const Number& horizon)
      : arc_(arc), lower_(stops.lower), upper_(stops.upper), horizon_(horizon), here_(arc.start()) {}

  [[nodiscard]] Contact<Number> run() {
    using std::isfinite;
    if (!(isfinite(here_.x) && isfinite(here_.v) && isfinite(here_.a))) return unresolved();
    for (const Side side : {Side::lower, Side::upper})
      if (gap(side) <= 0 && closing(side, here_.v) > 0) return at(side, Number(0), here_);
    Number step = first_step();
    for (int attempts = 0; attempts < max_attempts;) {
      if (out_of_reach()) return end(evaluate(horizon_));
      if (!(step > 0)) return unresolved();
      const Number remaining = horizon_ - elapsed_;
      const bool last = !(step < remaining);
      if (last) step = remaining;
      const Motion<Number> there = last ? evaluate(horizon_) : step_from_here(step);
      const Crossing crossing = first_crossing(there, step);
      if (crossing.side == Side::none) {
        if (last) return end(there);
        here_ = there, elapsed_ += step, step = longer(step), attempts = 0;
        continue;
      }
      ++attempts;
      if (crossing.certain) {
        const Contact<Number> contact = touch(crossing.side, crossing.fraction * step);
        if (closing(crossing.side, contact.motion.v) >= 0) return contact;
        here_ = contact.motion, elapsed_ = contact.elapsed;  // rounding put it on the stop, which it is leaving
        continue;
      }
      if (crossing.fraction > 0) {
        elapsed_ += crossing.fraction * step;
        here_ = evaluate(elapsed_);
        if (gap(crossing.side) <= 0 && closing(crossing.side, here_.v) > 0) return touch(crossing.side, Number(0));
      }
      step = next_step(crossing.side, step);
    }
    return unresolved();
  }

 private:
  static constexpr int max_attempts = 200;

  struct Crossing {
    Side side = Side::none;
    Number fraction{};     ///< of the step: no contact before it
    bool certain = false;  ///< and the contact is there, to rounding
  };

  /// Gap between the mass and a stop at the search's present position; exact if the arc is anchored on the stop.
  [[nodiscard]] Number gap(Side side) const {
    const Number& anchor = arc_.anchor();
    return side == Side::upper ? (upper_ - anchor) - here_.offset : (anchor - lower_) + here_.offset;
  }
  [[nodiscard]] static Number closing(Side side, const Number& y) { return side == Side::upper ? y : Number(-y); }

  [[nodiscard]] bool out_of_reach() const {
    const Number far = reach(arc_.constants(), here_, horizon_ - elapsed_), middle = arc_.constants().equilibrium;
    return lower_ < middle - far && middle + far < upper_;
  }

  /// The width that an enclosure has to resolve.
  [[nodiscard]] Number width() const {
    using std::abs, std::min;
    return min(Number(upper_ - lower_), Number(abs(here_.x) + abs(here_.v) + arc_.constants().response.amplitude));
  }
  [[nodiscard]] Number usual_length() const { return usual_step(arc_.constants().natural, arc_.constants().nu); }
  [[nodiscard]] Number error_of(const Number& step) const {
    return hermite_error(sixth_bound(arc_.constants(), here_, step, 0));
  }

  /// The longest step with an enclosure no wider than a twentieth of the gap; 0 if lengths are so small that their
  /// products vanish.
  [[nodiscard]] Number first_step() const {
    using std::pow;
    const Number step = usual_length(), error = error_of(step), aim = width() / 20;
    if (upper_ - lower_ < std::numeric_limits<Number>::min() / (epsilon<Number>() * epsilon<Number>()))
      return Number(0);
    return aim > 0 && error > aim ? Number(step * pow(aim / error, Number(1) / 6)) : step;
  }

  /// The step after one that was proved: twice as long, but beyond the usual length only if the enclosure stays sharp,
  /// as it does under a slow force once the transient has faded.
  [[nodiscard]] Number longer(const Number& step) const {
    using std::min;
    const Number twice = 2 * step;
    if (twice > usual_length() && error_of(twice) <= width() / 20000) return twice;
    return min(twice, usual_length());
  }

  [[nodiscard]] Motion<Number> evaluate(const Number& s) {
    ++evaluations_;
    return arc_.at(s);
  }
  [[nodiscard]] Motion<Number> step_from_here(const Number& step) {
    ++evaluations_;
    return step * arc_.constants().rate <= Number(0.25) ? arc_.near(here_, step) : arc_.at(elapsed_ + step);
  }

  [[nodiscard]] Crossing first_crossing(const Motion<Number>& there, const Number& step) const {
    const Number error = error_of(step);
    const Bernstein<Number> offset = hermite(
        HermiteData<Number>::over(step, {Number(0), here_.v, here_.a, there.offset - here_.offset, there.v, there.a}));
    const Crossing low = crossing_of(Side::lower, offset, error), high = crossing_of(Side::upper, offset, error);
    if (low.side == Side::none) return high;
    return high.side != Side::none && high.fraction < low.fraction ? high : low;
  }

  [[nodiscard]] Crossing crossing_of(Side side, const Bernstein<Number>& offset, const Number& error) const {
    using std::abs, std::max;
    Bernstein<Number> c;
    const Number from = max(Number(0), gap(side));
    if (from > std::numeric_limits<double>::max()) return {};  // no such stop
    bool inside = true;
    for (std::size_t i = 0; i < c.size(); ++i) {
      c[i] = from - closing(side, offset[i]) - (i == 3 ? error : Number(0));
      inside = inside && c[i] >= 0;
    }
    if (inside) return {};
    if (!(error < std::numeric_limits<double>::max())) return {side, Number(0), false};
    const auto root = FirstRoot<Number>::of(c);
    if (!root) return {};
    const Number& u = *root;
    if (u == 0) {  // it seems to cross at once, as a release does while the error outweighs its small jerk
      Number largest = 0;
      for (const Number& y : c) largest = max(largest, Number(abs(y)));
      return {side, u, error <= epsilon<Number>() * largest};
    }
    const Number size = abs(from) + 6 * abs(c[0] - c[1]) * u;  // the gap's scale at the crossing
    return {side, u, 2 * error * middle_function(u) <= 4 * epsilon<Number>() * size};
  }

  /// A step a little longer than the time to the stop, if the present motion would reach it; else a quarter.
  [[nodiscard]] Number next_step(Side side, const Number& step) const {
    using std::min, std::sqrt;
    const Number g = gap(side), v = closing(side, here_.v), a = closing(side, here_.a), square = v * v + 2 * a * g;
    if (g > 0 && square >= 0 && v + sqrt(square) > 0) return min(Number(step / 2), Number(4 * g / (v + sqrt(square))));
    return step / 4;
  }

  /// The contact a time d from here; one Newton correction takes out the rounding that a long step leaves.
  [[nodiscard]] Contact<Number> touch(Side side, const Number& d) {
    using std::abs;
    Motion<Number> m = d > 0 ? step_from_here(d) : here_;
    Number elapsed = elapsed_ + d;
    const Number speed = closing(side, m.v), missing = gap(side) - closing(side, m.offset - here_.offset);
    // not in a graze, where an ulp of displacement is far in time and the speed vanishes before
    if (2 * abs(missing * m.a) <= speed * speed && abs(missing) <= speed * abs(elapsed) * Number(1e-6) && speed > 0) {
      const Number more = missing / speed;
      elapsed += more, m.v += m.a * more;
    }
    return at(side, elapsed, m);
  }

  /// Whether the energy of the flight is conserved.
  [[nodiscard]] bool conserves() const {
    if constexpr (E.stiffness) return arc_.constants().h == 0 && arc_.constants().f == 0;
    return E.damping == Damping::none && E.forcing == Forcing::none;
  }
  /// Speed at a position by the energy of free undamped motion (eq. 17): exact however softly the mass touches.
  [[nodiscard]] Number conserved_speed(const Number& x) const {
    using std::abs, std::max, std::sqrt;
    const Motion<Number>& from = arc_.start();
    const Number fall = (arc_.anchor() - x) + from.offset,
                 middle = arc_.constants().spring(from.x + x) - 2 * arc_.constants().load;
    const Number scale = max(max(Number(abs(fall)), Number(abs(middle))), Number(abs(from.v)));
    if (!(scale > 0)) return Number(0);
    return scale *
           sqrt(max(Number(0), Number((from.v / scale) * (from.v / scale) + (fall / scale) * (middle / scale))));
  }

  [[nodiscard]] Contact<Number> at(Side side, const Number& elapsed, Motion<Number> m) const {
    m.x = side == Side::upper ? upper_ : lower_;
    if (conserves()) m.v = closing(side, conserved_speed(m.x));
    return {side, elapsed, m, evaluations_, true};
  }

  /// Ends at the horizon; a contact within rounding of it happens at it, so that it is neither lost nor taken twice.
  [[nodiscard]] Contact<Number> end(const Motion<Number>& there) {
    using std::abs;
    here_ = there, elapsed_ = horizon_;
    for (const Side side : {Side::lower, Side::upper}) {
      const Number flown = abs(gap(side) + closing(side, there.offset)) + abs(there.offset) + abs(there.v) * horizon_;
      if (gap(side) < 8 * epsilon<Number>() * flown && closing(side, there.v) > 0)
        return at(side, horizon_, there);  // never if there is no such stop
    }
    return {Side::none, horizon_, there, evaluations_, true};
  }

  [[nodiscard]] Contact<Number> unresolved() const { return {Side::none, elapsed_, here_, evaluations_, false}; }

  const Arc<Number, E>& arc_;
  Number lower_, upper_;
  Number horizon_;
  Motion<Number> here_;  ///< proved free of contact up to here
  Number elapsed_ = 0;   ///< time of `here_` since the arc began
  int evaluations_ = 0;
};

/// The first contact of an arc with a stop within a time `horizon` > 0.
template <class Number, Effects E>
[[nodiscard]] Contact<Number> next_contact(const Arc<Number, E>& arc, const Stops& stops, const Number& horizon) {
  return ContactSearch<Number, E>(arc, stops, horizon).run();
}

}  // namespace clatter::motion
