#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "math/bernstein.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "motion/contact.hpp"

namespace clatter::motion {

/// A condition on a motion: place * offset + speed * v stays positive, `offset` being that from the arc's anchor.
template <class Number>
struct Margin {
  Number place, speed;

  [[nodiscard]] Number of(const Motion<Number>& m) const { return place * m.offset + speed * m.v; }
  [[nodiscard]] Number slope(const Motion<Number>& m) const { return place * m.v + speed * m.a; }
};

/// The first margin of an arc that falls to 0, or the horizon if none does.
template <class Number>
struct Crossing {
  std::size_t margin = 0;   ///< which one; the number of margins if none does
  Number elapsed{};         ///< time since the arc began
  Motion<Number> motion{};  ///< there
  int evaluations = 0;      ///< instants at which the arc was evaluated
  bool resolved = true;     ///< false: the step that can be proved has fallen below rounding
};

/// Searches an arc for the first margin that falls to 0. Like a contact (eqs. 12 to 15), the margin is enclosed over
/// each step: its sixth derivative is bounded by those of displacement and velocity. One that is 0 at the beginning has
/// to rise from there.
template <class Number, Effects E, std::size_t count>
class CrossingSearch {
 public:
  CrossingSearch(const Arc<Number, E>& arc, const std::array<Margin<Number>, count>& margins, const Number& horizon)
      : arc_(arc), margins_(margins), horizon_(horizon), here_(arc.start()) {}

  [[nodiscard]] Crossing<Number> run() {
    for (std::size_t i = 0; i < count; ++i)
      if (margins_[i].of(here_) <= 0 && margins_[i].slope(here_) < 0) return at(i, Number(0), here_);
    Number step = first_step();
    for (int attempts = 0; attempts < max_attempts;) {
      if (stays_clear()) return at(count, horizon_, evaluate(horizon_));
      if (!(step > 0)) break;
      const Number remaining = horizon_ - elapsed_;
      const bool last = !(step < remaining);
      if (last) step = remaining;
      const Motion<Number> there = last ? evaluate(horizon_) : step_from_here(step);
      const First first = first_below(there, step);
      if (first.margin == count) {
        if (last) return at(count, horizon_, there);
        here_ = there, elapsed_ += step, step = longer(step), attempts = 0;
        continue;
      }
      ++attempts;
      if (first.certain) {
        const Crossing<Number> crossing = refined(first.margin, first.fraction * step);
        if (margins_[first.margin].slope(crossing.motion) <= 0) return crossing;
        here_ = crossing.motion, elapsed_ = crossing.elapsed;  // rounding put it at 0, from which it rises
        continue;
      }
      if (first.fraction > 0) {
        elapsed_ += first.fraction * step;
        here_ = evaluate(elapsed_);
        if (margins_[first.margin].of(here_) <= 0 && margins_[first.margin].slope(here_) < 0)
          return refined(first.margin, Number(0));
      }
      step = next_step(first.margin, step);
    }
    return {count, elapsed_, here_, evaluations_, false};
  }

 private:
  static constexpr int max_attempts = 200;

  /// The first margin that may fall below 0 in a step.
  struct First {
    std::size_t margin = count;
    Number fraction{};     ///< of the step: none does before it
    bool certain = false;  ///< and this one does there, to rounding
  };

  /// Bound of a margin's deviation from that of a mass at the equilibrium, from here on, if a spring holds it there.
  [[nodiscard]] bool stays_clear() const {
    const auto& c = arc_.constants();
    if (!(c.k > 0)) return false;
    const Number far = reach(c, here_, horizon_ - elapsed_);
    const Number fast = c.nu * c.response.amplitude + c.natural * (far - c.response.amplitude);
    using std::abs;
    for (const Margin<Number>& margin : margins_) {
      const Number middle = margin.place * (c.balance - (arc_.anchor() - c.origin));
      if (!(abs(margin.place) * far + abs(margin.speed) * fast < middle)) return false;
    }
    return true;
  }

  /// The width that an enclosure has to resolve: the margin's own size.
  [[nodiscard]] Number width(const Margin<Number>& margin) const {
    using std::abs;
    const auto& c = arc_.constants();
    return abs(margin.place) * (abs(here_.offset) + c.response.amplitude + abs(here_.v) / c.rate) +
           abs(margin.speed) * (abs(here_.v) + abs(here_.a) / c.rate + c.nu * c.response.amplitude);
  }
  [[nodiscard]] Number error_of(const Margin<Number>& margin, const Number& step) const {
    using std::abs;
    const auto bound = [&](const Number& factor, int derivative) {
      return factor == 0 ? Number(0) : Number(abs(factor) * sixth_bound(arc_.constants(), here_, step, derivative));
    };
    return hermite_error(Number(bound(margin.place, 0) + bound(margin.speed, 1)));
  }
  [[nodiscard]] Number usual_length() const { return usual_step(arc_.constants().natural, arc_.constants().nu); }

  /// The longest step with enclosures no wider than a twentieth of what they resolve.
  [[nodiscard]] Number first_step() const {
    using std::min, std::pow;
    const Number usual = usual_length();
    Number step = usual;
    for (const Margin<Number>& margin : margins_) {
      const Number error = error_of(margin, usual), aim = width(margin) / 20;
      if (aim > 0 && error > aim) step = min(step, Number(usual * pow(aim / error, Number(1) / 6)));
    }
    return step;
  }
  [[nodiscard]] Number longer(const Number& step) const {
    using std::min;
    const Number twice = 2 * step;
    const auto sharp = [&](const Margin<Number>& margin) { return error_of(margin, twice) <= width(margin) / 20000; };
    if (twice > usual_length() && std::ranges::all_of(margins_, sharp)) return twice;
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

  [[nodiscard]] First first_below(const Motion<Number>& there, const Number& step) const {
    First first;
    for (std::size_t i = 0; i < count; ++i) {
      const First other = below(i, there, step);
      if (other.margin == count) continue;
      if (first.margin == count || other.fraction < first.fraction) first = other;
    }
    return first;
  }
  [[nodiscard]] First below(std::size_t i, const Motion<Number>& there, const Number& step) const {
    using std::abs, std::max;
    const Margin<Number>& margin = margins_[i];
    const auto bend = [&](const Motion<Number>& m) {
      return margin.place * m.a + (margin.speed == 0 ? Number(0) : Number(margin.speed * arc_.constants().jerk(m)));
    };
    const Number change = margin.place * (there.offset - here_.offset) + margin.speed * (there.v - here_.v);
    const Number error = error_of(margin, step), from = max(Number(0), margin.of(here_));
    Bernstein<Number> c = hermite(HermiteData<Number>::over(
        step, {Number(0), margin.slope(here_), bend(here_), change, margin.slope(there), bend(there)}));
    bool clear = true;
    for (std::size_t k = 0; k < c.size(); ++k) {
      c[k] = from + c[k] - (k == 3 ? error : Number(0));
      clear = clear && c[k] >= 0;
    }
    if (clear) return {};
    if (!(error < std::numeric_limits<double>::max())) return {i, Number(0), false};
    const auto root = FirstRoot<Number>::of(c);
    if (!root) return {};
    const Number& u = *root;
    Number size = abs(from) + 6 * abs(c[0] - c[1]) * u;  // the margin's scale at the crossing
    if (u == 0)
      for (const Number& y : c) size = max(size, Number(abs(y)));
    return {i, u, 2 * error * (u == 0 ? Number(1) : middle_function(u)) <= 4 * epsilon<Number>() * size};
  }

  /// A step a little longer than the margin would take to 0 at its present slope; at most half of it.
  [[nodiscard]] Number next_step(std::size_t i, const Number& step) const {
    using std::clamp;
    const Number left = margins_[i].of(here_), falls = -margins_[i].slope(here_);
    if (!(left > 0 && falls > 0)) return step / 4;
    return clamp(Number(2 * left / falls), Number(step / 16), Number(step / 2));
  }

  /// The crossing a time d from here; one Newton correction takes out the rounding that a long step leaves.
  [[nodiscard]] Crossing<Number> refined(std::size_t i, const Number& d) {
    using std::abs;
    Motion<Number> m = d > 0 ? step_from_here(d) : here_;
    Number elapsed = elapsed_ + d;
    const Number left = margins_[i].of(m), slope = margins_[i].slope(m);
    if (slope < 0 && abs(left) <= -slope * abs(elapsed) * Number(1e-6)) {
      const Number more = -left / slope;
      elapsed += more, m.offset += m.v * more, m.x += m.v * more, m.v += m.a * more;
    }
    return at(i, elapsed, m);
  }
  [[nodiscard]] Crossing<Number> at(std::size_t i, const Number& elapsed, const Motion<Number>& m) const {
    return {i, elapsed, m, evaluations_, true};
  }

  const Arc<Number, E>& arc_;
  std::array<Margin<Number>, count> margins_;
  Number horizon_;
  Motion<Number> here_;  ///< no margin has fallen to 0 up to here
  Number elapsed_ = 0;   ///< time of `here_` since the arc began
  int evaluations_ = 0;
};

/// The first of some margins of an arc that falls to 0 within a time `horizon` > 0.
template <class Number, Effects E, std::size_t count>
[[nodiscard]] Crossing<Number> first_crossing(const Arc<Number, E>& arc,
                                              const std::array<Margin<Number>, count>& margins, const Number& horizon) {
  return CrossingSearch<Number, E, count>(arc, margins, horizon).run();
}

}  // namespace clatter::motion
