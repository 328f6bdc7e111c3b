#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "motion/arc_constants.hpp"
#include "motion/force_terms.hpp"

namespace clatter::motion {

/// Motion without impact from a given instant on, in closed form (eqs. 5 ... 11).
template <class N, Effects E>
class Arc {
 public:
  using Number = N;
  static constexpr Effects effects = E;

  /// Starts at displacement x, velocity v, phase (sine, cosine) and acceleration a: that of eq. 3, or 0 at a release.
  Arc(const ArcConstants<Number, E>& constants, const Motion<Number>& start) : Arc(constants, start, start.x) {}

  /// Starts `start.offset` away from a position, the anchor.
  Arc(const ArcConstants<Number, E>& constants, const Motion<Number>& start, const Number& anchor)
      : constants_(&constants), anchor_(anchor), start_(with_free_part(start)) {}

  [[nodiscard]] const ArcConstants<Number, E>& constants() const { return *constants_; }
  [[nodiscard]] const Motion<Number>& start() const { return start_; }
  [[nodiscard]] const Number& anchor() const { return anchor_; }  ///< the position that `offset` counts from

  /// Motion a time s >= 0 after the start; for short times by the Taylor series, which keeps the relative accuracy of
  /// `offset`.
  [[nodiscard]] Motion<Number> at(const Number& s) const {
    return s * constants_->rate <= Number(0.25) ? near(start_, s) : moved(start_, constants_->step(s));
  }

  /// The forcing phase a time s after the start.
  [[nodiscard]] SineCosine<Number> phase_after(const Number& s) const {
    return advanced(start_, constants_->turn(s)).phase;
  }

  /// Motion a step of any length after `m`, an instant of this arc, in closed form; inlined, so that a caller that
  /// needs only displacement and velocity, as samples do, computes only those.
  [[nodiscard, gnu::always_inline]] inline Motion<Number> moved(const Motion<Number>& m,
                                                                const Step<Number>& step) const;

  /// Motion a short time d after `m` (d * constants().rate <= 1/4), an instant of this arc, by the Taylor series of
  /// eq. 3.
  [[nodiscard]] Motion<Number> near(const Motion<Number>& m, const Number& d) const;

  /// The change of displacement and velocity in a short time d after `m` beyond that of a constant acceleration, to
  /// relative accuracy.
  [[nodiscard]] FreeMotion<Number> bend(const Motion<Number>& m, const Number& d) const;

 private:
  static constexpr std::size_t terms =
      std::numeric_limits<Number>::digits <= 64 ? 13 : 36;  ///< of the series: (1/4)^n / n! below rounding
  /// The terms x^(k) d^k / k! of the Taylor series of eq. 3, the first of which is left 0.
  [[nodiscard, gnu::always_inline]] inline std::array<Number, terms> series(const Motion<Number>& m,
                                                                            const Number& d) const;
  [[nodiscard]] Motion<Number> with_free_part(Motion<Number> m) const {
    const FreeMotion<Number> forced = constants_->response_at({m.sine, m.cosine});
    m.free_x = constants_->from_equilibrium(m.x, anchor_, m.offset) - forced.x, m.free_v = m.v - forced.v;
    if constexpr (E.damping == Damping::heavy) m.fast_x = constants_->fast_mode(m.free_x, m.free_v);
    return m;
  }
  /// Acceleration of the free part of a motion a step after m, and of the load if no spring balances it.
  [[nodiscard]] Number free_acceleration(const Propagator<Number>& p, const Motion<Number>& m) const {
    if constexpr (E.stiffness) return constants_->unbalanced * p.c - (constants_->k * p.c * m.free_x + p.d * m.free_v);
    return -(p.c * m.free_x + p.d * m.free_v);
  }
  /// A forcing phase, and its sine and cosine less those of the phase before.
  struct AdvancedPhase {
    SineCosine<Number> phase, change;
  };
  [[nodiscard]] AdvancedPhase advanced(const Motion<Number>& m, const Turn<Number>& turn) const;

  const ArcConstants<Number, E>* constants_;
  Number anchor_;
  Motion<Number> start_;
};

template <class Number, Effects E>
auto Arc<Number, E>::advanced(const Motion<Number>& m, const Turn<Number>& turn) const -> AdvancedPhase {
  if constexpr (E.forcing == Forcing::none) return {{m.sine, m.cosine}, {Number(0), Number(0)}};
  const SineCosine<Number> change = constants_->change(turn, {m.sine, m.cosine});
  return {{m.sine + change.sine, m.cosine + change.cosine}, change};
}

template <class Number, Effects E>
Motion<Number> Arc<Number, E>::moved(const Motion<Number>& m, const Step<Number>& step) const {
  using std::abs;
  const Propagator<Number>& p = step.free;
  const auto [phase, change] = advanced(m, step.turn);
  const FreeMotion<Number> response = constants_->response_at(phase);
  // eq. 10: no difference of positions, so that a short flight keeps its digits; the response is linear in sine, cosine
  Number offset = p.a_minus_one * m.free_x + p.b * m.free_v +
                  (constants_->has_orders() ? response.x - constants_->response_at({m.sine, m.cosine}).x
                                            : constants_->response_displacement(change.sine, change.cosine));
  auto [free_x, free_v] = constants_->advanced(p, {m.free_x, m.free_v});
  if (constants_->forms_together()) {
    const FreeMotion<Number> forced = constants_->from_rest({m.sine, m.cosine}, step);
    offset += forced.x, free_x += forced.x, free_v += forced.v;
  }
  if constexpr (E.stiffness) {
    const Number& pull = constants_->unbalanced;
    offset += pull * step.pulled, free_x += pull * step.pulled, free_v += pull * p.b;
  }
  offset += m.offset;
  // of two sums for x the one with the smaller terms: between close stops that is anchor + offset
  const Number whole = abs(constants_->equilibrium) + abs(response.x) + abs(free_x);
  const bool rises = abs(anchor_) + abs(offset) < whole;
  const Number x = rises ? anchor_ + offset : constants_->equilibrium + response.x + free_x;
  const Number v = response.v + free_v;
  const bool by_equation = constants_->forms_together() || constants_->has_orders();
  const Number from_equilibrium =
      rises ? constants_->from_equilibrium(x, anchor_, offset) : Number(response.x + free_x);
  const Number a = by_equation ? constants_->acceleration(from_equilibrium, v, phase)
                               : free_acceleration(p, m) - constants_->nu * constants_->nu * response.x;
  Number fast_x = 0;
  if constexpr (E.damping == Damping::heavy) fast_x = m.fast_x * step.fast_decay;
  return {offset, x, v, a, phase.sine, phase.cosine, free_x, free_v, fast_x};
}

template <class Number, Effects E>
auto Arc<Number, E>::series(const Motion<Number>& m, const Number& d) const -> std::array<Number, terms> {
  const Number square = d * d;
  const auto of_force = [&](auto&& force) {
    std::array<Number, terms> t;  // t[k] = x^(k) d^k / k!
    t[0] = 0, t[1] = m.v * d, t[2] = m.a * square / 2;
    for (std::size_t k = 1; k + 2 < terms; ++k) {
      Number sum = -square * constants_->spring(t[k]);
      if constexpr (E.damping != Damping::none) sum -= 2 * constants_->h * d * (static_cast<double>(k) + 1) * t[k + 1];
      if constexpr (E.forcing != Forcing::none) sum += force(k);
      t[k + 2] = sum / static_cast<double>((k + 1) * (k + 2));
    }
    return t;
  };
  return with_force_terms<terms - 2>(*constants_, Number(constants_->f * square), {m.sine, m.cosine}, d, of_force);
}

template <class Number, Effects E>
FreeMotion<Number> Arc<Number, E>::bend(const Motion<Number>& m, const Number& d) const {
  if (!(d > 0)) return {Number(0), Number(0)};
  const std::array<Number, terms> t = series(m, d);
  Number offset = 0, gain = 0;
  for (std::size_t k = terms - 1; k >= 3; --k) offset += t[k], gain += static_cast<double>(k) * t[k];
  return {offset, gain / d};
}

template <class Number, Effects E>
Motion<Number> Arc<Number, E>::near(const Motion<Number>& m, const Number& d) const {
  using std::exp;
  if (!(d > 0)) return m;
  const std::array<Number, terms> t = series(m, d);
  Number offset = 0, gain = 0;  // from the small terms up
  for (std::size_t k = terms - 1; k >= 1; --k) {
    offset += t[k];
    if (k >= 2) gain += static_cast<double>(k) * t[k];
  }
  const SineCosine<Number> phase = advanced(m, constants_->turn(d)).phase;
  const Number x = m.x + offset, v = m.v + gain / d;
  offset += m.offset;
  const Number a = constants_->acceleration(constants_->from_equilibrium(x, anchor_, offset), v, phase);
  Motion<Number> end = with_free_part({offset, x, v, a, phase.sine, phase.cosine});
  if constexpr (E.damping == Damping::heavy) end.fast_x = m.fast_x * exp(-constants_->fast * d);
  return end;
}

}  // namespace clatter::motion
