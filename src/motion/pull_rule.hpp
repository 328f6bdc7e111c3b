#pragma once

#include <array>
#include <cmath>

#include "motion/first_crossing.hpp"

namespace clatter::motion {

/// The force with which a wall presses a loose mass that moves with the main mass, over the loose mass: the difference
/// of its own acceleration and x'' (eq. 72). It is a margin in the acceleration, so bounds go two derivatives higher
/// than those of displacements.
template <class Number, Effects E>
class PullRule : public SlopedRule<PullRule<Number, E>, Number> {
 public:
  static constexpr std::size_t count = 1;
  static constexpr bool alike = true;

  PullRule(const Arc<Number, E>& arc, Side wall, const Number& load)
      : arc_(arc), load_(load), sign_(sign_of(wall)), bounds_(arc.constants().template bounds<3>()) {}

  [[nodiscard]] Number of(std::size_t, const Motion<Number>& m) const { return sign_ * (load_ - m.a); }
  [[nodiscard]] Number slope(std::size_t, const Motion<Number>& m) const { return -sign_ * arc_.constants().jerk(m); }

  /// Whether no acceleration that the mass can have lets the loose mass go.
  [[nodiscard]] bool stays_clear(const Motion<Number>& here, const Number& time) const {
    using std::abs;
    const auto& c = arc_.constants();
    if (!(c.k > 0)) return false;  // nothing bounds the speed of the transient
    const Number far = reach(c, here, time);
    const Number fast = c.response_speed + c.natural * (far - c.response.amplitude);
    return abs(c.f) + abs(c.unbalanced) + abs(c.k) * far + 2 * c.h * fast < sign_ * load_;
  }
  [[nodiscard]] Number width(std::size_t, const Motion<Number>& here) const {
    using std::abs;
    const auto& c = arc_.constants();
    return abs(here.a) + abs(c.jerk(here)) / c.rate + abs(c.f);
  }
  [[nodiscard]] Number error(std::size_t, const Motion<Number>& here, const Number& step) const {
    return hermite_error(sixth_bound(arc_.constants(), bounds_, here, step, 2));
  }
  [[nodiscard]] Bernstein<Number> change(std::size_t, const Motion<Number>& here, const Motion<Number>& there,
                                         const Number& step) const {
    const auto [jerk0, snap0] = higher(here);
    const auto [jerk1, snap1] = higher(there);
    return hermite(HermiteData<Number>::over(step, {Number(0), -sign_ * jerk0, -sign_ * snap0,
                                                    -sign_ * (there.a - here.a), -sign_ * jerk1, -sign_ * snap1}));
  }
  [[nodiscard]] Crossing<Number> at(std::size_t i, const Number& elapsed, Motion<Number> m) const {
    if (i < count) m.a = load_;
    return {i, Side::none, elapsed, m};
  }

 private:
  /// Third and fourth derivative of the displacement.
  [[nodiscard]] std::array<Number, 2> higher(const Motion<Number>& m) const {
    const auto d = arc_.constants().derivatives(m);
    return {d.d3, d.d4};
  }

  const Arc<Number, E>& arc_;
  Number load_, sign_;
  DerivativeBounds<Number, 3> bounds_;
};

/// The end of a time in which a wall presses a loose mass: where it would have to pull, or the horizon.
template <class Number, Effects E>
[[nodiscard]] Crossing<Number> end_of_press(const Arc<Number, E>& arc, Side wall, const Number& load,
                                            const Number& horizon) {
  const PullRule<Number, E> rule(arc, wall, load);
  return CrossingSearch<Arc<Number, E>, PullRule<Number, E>>(arc, rule, horizon).run();
}

}  // namespace clatter::motion
