#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "math/bernstein.hpp"
#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "scene/stops.hpp"

namespace clatter::motion {

/// A condition on a motion: constant + place * offset + speed * v stays positive, `offset` being that from the arc's
/// anchor.
template <class Number>
struct Margin {
  Number constant, place, speed;

  [[nodiscard]] Number of(const Motion<Number>& m) const { return constant + place * m.offset + speed * m.v; }
  [[nodiscard]] Number slope(const Motion<Number>& m) const { return place * m.v + speed * m.a; }
};

/// The end of an arc: the first margin that falls to 0, or the horizon if none does.
template <class Number>
struct Crossing {
  std::size_t margin = 0;   ///< which one; the number of margins if none does
  Side side = Side::none;   ///< of the stop that is met, if the margin is the gap to one
  Number elapsed{};         ///< time since the arc began
  Motion<Number> motion{};  ///< there; at a stop with the velocity before the impact
  int evaluations = 0;      ///< instants at which the arc was evaluated
  bool resolved = true;     ///< false: a bound overflows, or the step that can be proved has fallen below rounding
};

/// The usual length of a step that is proved free of events, by the frequencies of the spring and of the force.
template <class Number>
[[nodiscard]] Number usual_step(const Number& natural, const Number& nu) {
  using std::max;
  return Number(1.6) / max(natural, nu);
}

/// Searches an arc for the first of some margins that falls to 0. An enclosure of each margin proves a step free of
/// events (eqs. 12 to 15), or proves it up to some instant; a shorter step begins there, until the width of the
/// enclosure is below rounding. A margin that begins at 0 must increase, or the event happens at once.
///
/// A rule says what the margins are, how wide enclosures may be, and what becomes of a crossing that was found:
/// `GapRule` of rigid stops and walls, `PullRule` of a wall that presses, `MarginRule` of all else. Margins that are
/// `alike` differ by sign and constant alone, so that one enclosure does for all.
template <class A, class Rule>
class CrossingSearch {
 public:
  using Number = typename A::Number;

  CrossingSearch(const A& arc, const Rule& rule, const Number& horizon)
      : arc_(arc), rule_(rule), horizon_(horizon), here_(arc.start()) {}

  [[nodiscard]] Crossing<Number> run() {
    Crossing<Number> crossing = found();
    crossing.evaluations = evaluations_;
    return crossing;
  }

 private:
  static constexpr int max_attempts = 200;
  static constexpr std::size_t count = Rule::count, enclosures = Rule::alike ? 1 : count;

  /// The first margin that may fall below 0 in a step.
  struct First {
    std::size_t margin = count;
    Number fraction{};     ///< of the step: none does before it
    bool certain = false;  ///< and this one does there, to rounding
  };

  [[nodiscard]] Crossing<Number> found() {
    using std::isfinite;
    if (!(isfinite(here_.x) && isfinite(here_.v) && isfinite(here_.a))) return unresolved();
    for (std::size_t i = 0; i < count; ++i)
      if (falls(i)) return rule_.at(i, Number(0), here_);
    Number step = first_step();
    for (int attempts = 0; attempts < max_attempts;) {
      if (rule_.stays_clear(here_, Number(horizon_ - elapsed_))) return rule_.at_horizon(horizon_, evaluate(horizon_));
      if (!(step > 0)) return unresolved();
      const Number remaining = horizon_ - elapsed_;
      const bool last = !(step < remaining);
      if (last) step = remaining;
      const Motion<Number> there = last ? evaluate(horizon_) : step_from_here(step);
      const First first = first_below(there, step);
      if (first.margin == count) {
        if (last) return rule_.at_horizon(horizon_, there);
        here_ = there, elapsed_ += step, step = longer(step), attempts = 0;
        continue;
      }
      ++attempts;
      if (first.certain) {
        const Crossing<Number> crossing = refined(first.margin, first.fraction * step);
        if (rule_.slope(first.margin, crossing.motion) <= 0) return crossing;
        here_ = crossing.motion,
        elapsed_ = crossing.elapsed;  // rounding put it at 0, from which it rises
        continue;
      }
      if (first.fraction > 0) {
        const Number passed = first.fraction * step;
        elapsed_ += passed;
        here_ = evaluate(elapsed_);
        if (passed > usual_length() / 1024) attempts = 0;  // it gets on
        if (falls(first.margin)) return refined(first.margin, Number(0));
      }
      step = rule_.next_step(first.margin, here_, step);
    }
    return unresolved();
  }
  /// Whether a margin is 0 at the present position, or below, and falls.
  [[nodiscard]] bool falls(std::size_t i) const { return rule_.of(i, here_) <= 0 && rule_.slope(i, here_) < 0; }

  [[nodiscard]] Number usual_length() const { return usual_step(arc_.constants().natural, arc_.constants().nu); }

  /// The longest step with enclosures no wider than a twentieth of what they resolve; 0 if lengths are so small that
  /// their products vanish.
  [[nodiscard]] Number first_step() const {
    using std::min, std::pow;
    const Number usual = usual_length();
    if (rule_.vanishes()) return Number(0);
    Number step = usual;
    for (std::size_t i = 0; i < enclosures; ++i) {
      const Number error = rule_.error(i, here_, usual), aim = rule_.width(i, here_) / 20;
      if (aim > 0 && error > aim) step = min(step, Number(usual * pow(aim / error, Number(1) / 6)));
    }
    return step;
  }

  /// The step after one that was proved: twice as long, but beyond the usual length only if the enclosures stay sharp,
  /// as they do under a slow force once the transient has faded.
  [[nodiscard]] Number longer(const Number& step) const {
    using std::min;
    const Number twice = 2 * step;
    bool sharp = twice > usual_length();
    for (std::size_t i = 0; sharp && i < enclosures; ++i)
      sharp = rule_.error(i, here_, twice) <= rule_.width(i, here_) / 20000;
    return sharp ? twice : min(twice, usual_length());
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
    Number error{};
    Bernstein<Number> change{};
    for (std::size_t i = 0; i < count; ++i) {
      if (i < enclosures) error = rule_.error(i, here_, step), change = rule_.change(i, here_, there, step);
      const First other = below(i, change, error);
      if (other.margin == count) continue;
      if (first.margin == count || other.fraction < first.fraction) first = other;
    }
    return first;
  }
  [[nodiscard]] First below(std::size_t i, const Bernstein<Number>& change, const Number& error) const {
    using std::abs, std::max;
    Bernstein<Number> c;
    const Number from = max(Number(0), rule_.of(i, here_));
    if (from > std::numeric_limits<double>::max()) return {};  // no such stop
    bool clear = true;
    for (std::size_t k = 0; k < c.size(); ++k) {
      c[k] = from + rule_.signed_change(i, change[k]) - (k == 3 ? error : Number(0));
      clear = clear && c[k] >= 0;
    }
    if (clear) return {};
    if (!(error < std::numeric_limits<double>::max())) return {i, Number(0), false};
    const auto root = FirstRoot<Number>::of(c);
    if (!root) return {};
    const Number& u = *root;
    if (u == 0) {  // it seems to cross at once, as a release does while the error outweighs its small jerk
      Number largest = 0;
      for (const Number& y : c) largest = max(largest, Number(abs(y)));
      return {i, u, error <= epsilon<Number>() * largest};
    }
    const Number size = abs(from) + 6 * abs(c[0] - c[1]) * u;  // the margin's scale at the crossing
    return {i, u, 2 * error * middle_function(u) <= 4 * epsilon<Number>() * size};
  }

  /// The crossing a time d from here, less the rounding that a long step leaves.
  [[nodiscard]] Crossing<Number> refined(std::size_t i, const Number& d) {
    const Motion<Number> m = d > 0 ? step_from_here(d) : here_;
    return rule_.refined(i, here_, m, Number(elapsed_ + d));
  }
  [[nodiscard]] Crossing<Number> unresolved() const { return {count, Side::none, elapsed_, here_, 0, false}; }

  const A& arc_;
  Rule rule_;
  Number horizon_;
  Motion<Number> here_;  ///< no margin has fallen to 0 up to here
  Number elapsed_ = 0;   ///< time of `here_` since the arc began
  int evaluations_ = 0;
};

/// How a search goes on at a margin of which a rule tells the value and the slope, and that is no gap to a stop.
template <class Rule, class Number>
class SlopedRule {
 public:
  [[nodiscard]] static bool vanishes() { return false; }
  [[nodiscard]] static const Number& signed_change(std::size_t, const Number& change) { return change; }

  /// A step a little longer than the margin would take to 0 at its present slope; at most half of it.
  [[nodiscard]] Number next_step(std::size_t i, const Motion<Number>& here, const Number& step) const {
    using std::clamp;
    const Number left = rule().of(i, here), falls = -rule().slope(i, here);
    if (!(left > 0 && falls > 0)) return step / 4;
    return clamp(Number(2 * left / falls), Number(step / 16), Number(step / 2));
  }

  /// One Newton correction takes out the rounding that a long step leaves.
  [[nodiscard]] Crossing<Number> refined(std::size_t i, const Motion<Number>&, Motion<Number> m, Number elapsed) const {
    using std::abs;
    const Number left = rule().of(i, m), rate = rule().slope(i, m);
    if (rate < 0 && abs(left) <= -rate * abs(elapsed) * Number(1e-6)) {
      const Number more = -left / rate;
      elapsed += more, m.offset += m.v * more, m.x += m.v * more, m.v += m.a * more;
    }
    return rule().at(i, elapsed, m);
  }
  [[nodiscard]] Crossing<Number> at_horizon(const Number& horizon, const Motion<Number>& there) const {
    return rule().at(Rule::count, horizon, there);
  }

 private:
  [[nodiscard]] const Rule& rule() const { return static_cast<const Rule&>(*this); }
};

/// Margins of any kind. The sixth derivative of each is bounded by those of displacement and velocity.
template <class Number, Effects E, std::size_t margins>
class MarginRule : public SlopedRule<MarginRule<Number, E, margins>, Number> {
 public:
  static constexpr std::size_t count = margins;
  static constexpr bool alike = false;

  MarginRule(const Arc<Number, E>& arc, const std::array<Margin<Number>, count>& all) : arc_(arc), margins_(all) {}

  [[nodiscard]] Number of(std::size_t i, const Motion<Number>& m) const { return margins_[i].of(m); }
  [[nodiscard]] Number slope(std::size_t i, const Motion<Number>& m) const { return margins_[i].slope(m); }

  /// Whether no margin falls to 0 within a time, by the deviation of each from that of a mass at the equilibrium, if a
  /// spring holds it there.
  [[nodiscard]] bool stays_clear(const Motion<Number>& here, const Number& time) const {
    using std::abs;
    const auto& c = arc_.constants();
    if (!(c.k > 0)) return false;
    const Number far = reach(c, here, time);
    const Number fast = c.response_speed + c.natural * (far - c.response.amplitude);
    for (const Margin<Number>& margin : margins_) {
      const Number middle = margin.constant + margin.place * (c.balance - (arc_.anchor() - c.origin));
      if (!(abs(margin.place) * far + abs(margin.speed) * fast < middle)) return false;
    }
    return true;
  }

  /// The width that an enclosure has to resolve: the margin's own size.
  [[nodiscard]] Number width(std::size_t i, const Motion<Number>& here) const {
    using std::abs;
    const auto& c = arc_.constants();
    return abs(margins_[i].place) * (abs(here.offset) + c.response.amplitude + abs(here.v) / c.rate) +
           abs(margins_[i].speed) * (abs(here.v) + abs(here.a) / c.rate + c.response_speed);
  }
  /// Of the enclosure of a margin over a step.
  [[nodiscard]] Number error(std::size_t i, const Motion<Number>& here, const Number& step) const {
    using std::abs;
    const auto bound = [&](const Number& factor, int derivative) {
      return factor == 0 ? Number(0) : Number(abs(factor) * sixth_bound(arc_.constants(), here, step, derivative));
    };
    return hermite_error(Number(bound(margins_[i].place, 0) + bound(margins_[i].speed, 1)));
  }
  /// The change of a margin over a step, as the Hermite polynomial of its ends.
  [[nodiscard]] Bernstein<Number> change(std::size_t i, const Motion<Number>& here, const Motion<Number>& there,
                                         const Number& step) const {
    const Margin<Number>& margin = margins_[i];
    const auto bend = [&](const Motion<Number>& m) {
      return margin.place * m.a + (margin.speed == 0 ? Number(0) : Number(margin.speed * arc_.constants().jerk(m)));
    };
    const Number total = margin.place * (there.offset - here.offset) + margin.speed * (there.v - here.v);
    return hermite(HermiteData<Number>::over(
        step, {Number(0), margin.slope(here), bend(here), total, margin.slope(there), bend(there)}));
  }
  [[nodiscard]] Crossing<Number> at(std::size_t i, const Number& elapsed, const Motion<Number>& m) const {
    return {i, Side::none, elapsed, m};
  }

 private:
  const Arc<Number, E>& arc_;
  std::array<Margin<Number>, count> margins_;
};

/// The first of some margins of an arc that falls to 0 within a time `horizon` > 0.
template <class Number, Effects E, std::size_t count>
[[nodiscard]] Crossing<Number> first_crossing(const Arc<Number, E>& arc,
                                              const std::array<Margin<Number>, count>& margins, const Number& horizon) {
  const MarginRule<Number, E, count> rule(arc, margins);
  return CrossingSearch<Arc<Number, E>, MarginRule<Number, E, count>>(arc, rule, horizon).run();
}

}  // namespace clatter::motion
