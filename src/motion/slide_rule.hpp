#pragma once

#include <array>
#include <cmath>

#include "motion/first_crossing.hpp"
#include "motion/relative_arc.hpp"

namespace clatter::motion {

/// The speed at which a loose mass slides in its housing towards a side, until friction has stopped it. It is a margin
/// in z', whose derivatives beyond the first are those of x' with the other sign, so the bounds of arcs hold.
template <class Number, Effects E>
class SlideRule : public SlopedRule<SlideRule<Number, E>, Number> {
 public:
  static constexpr std::size_t count = 1;
  static constexpr bool alike = true;

  SlideRule(const RelativeArc<Number, E>& arc, Side towards) : arc_(arc), sign_(sign_of(towards)) {}

  [[nodiscard]] Number of(std::size_t, const Motion<Number>& m) const { return sign_ * m.v; }
  [[nodiscard]] Number slope(std::size_t, const Motion<Number>& m) const { return sign_ * m.a; }

  /// Whether y' keeps ahead of every velocity that the main mass can have.
  [[nodiscard]] bool stays_clear(const Motion<Number>& here, const Number& time) const {
    using std::min;
    const auto& c = arc_.constants();
    if (!(c.k > 0)) return false;
    const Number far = reach(c, here, time);
    const Number fast = c.response_speed + c.natural * (far - c.response.amplitude);
    const Number now = sign_ * (here.v + arc_.main_at(here).v), end = now + sign_ * arc_.load() * time;
    return fast < min(now, end);
  }
  [[nodiscard]] Number width(std::size_t, const Motion<Number>& here) const {
    using std::abs;
    const auto& c = arc_.constants();
    return abs(here.v) + abs(here.a) / c.rate + c.response_speed;
  }
  [[nodiscard]] Number error(std::size_t, const Motion<Number>& here, const Number& step) const {
    return hermite_error(sixth_bound(arc_.constants(), here, step, 1));
  }
  [[nodiscard]] Bernstein<Number> change(std::size_t, const Motion<Number>& here, const Motion<Number>& there,
                                         const Number& step) const {
    return hermite(HermiteData<Number>::over(
        step, {Number(0), sign_ * here.a, bend(here), sign_ * (there.v - here.v), sign_ * there.a, bend(there)}));
  }
  [[nodiscard]] static Crossing<Number> at(std::size_t i, const Number& elapsed, const Motion<Number>& m) {
    return {i, Side::none, elapsed, m};
  }

 private:
  /// Second derivative of the speed.
  [[nodiscard]] Number bend(const Motion<Number>& m) const { return -sign_ * arc_.constants().jerk(arc_.main_at(m)); }

  const RelativeArc<Number, E>& arc_;
  Number sign_;
};

/// Where a loose mass that slides to a side comes to a stop in its housing, or the horizon.
template <class Number, Effects E>
[[nodiscard]] Crossing<Number> end_of_slide(const RelativeArc<Number, E>& arc, Side towards, const Number& horizon) {
  const SlideRule<Number, E> rule(arc, towards);
  return CrossingSearch<RelativeArc<Number, E>, SlideRule<Number, E>>(arc, rule, horizon).run();
}

}  // namespace clatter::motion
