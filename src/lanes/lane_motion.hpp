#pragma once

#include "lanes/block_state.hpp"
#include "lanes/functions.hpp"
#include "lanes/vector.hpp"
#include "math/bernstein.hpp"
#include "motion/equation_of_motion.hpp"
#include "scene/response.hpp"

namespace clatter::lanes {

/// Motion at an instant: free part, forcing phase, and the displacement y, velocity and acceleration that follow.
template <class V>
struct LaneMotion {
  motion::FreeMotion<V> free;
  SineCosine<V> phase;
  V y, v, a;
};

template <class Mask, class V>
[[nodiscard, gnu::always_inline]] inline LaneMotion<V> select(const Mask& m, const LaneMotion<V>& x,
                                                              const LaneMotion<V>& y) {
  return {{select(m, x.free.x, y.free.x), select(m, x.free.v, y.free.v)},
          {select(m, x.phase.sine, y.phase.sine), select(m, x.phase.cosine, y.phase.cosine)},
          select(m, x.y, y.y),
          select(m, x.v, y.v),
          select(m, x.a, y.a)};
}

/// Error bounds of a step.
template <class V>
struct ErrorBound {
  V free;             ///< bound of the free motion over the step
  V error, rounding;  ///< of the enclosure's middle coefficient (eq. 13); of displacements
};

/// The oscillators of some lanes, and their motion in closed form. E: the effects of their steps.
template <class V, Effects E>
class LaneOscillators {
  static constexpr bool any_spring = E.stiffness && !E.soft;  ///< none, or an unstable one

 public:
  using Derivatives = motion::HigherDerivatives<V>;

  LaneOscillators(BlockState& lanes, std::size_t first) : lanes_(lanes), first_(first) {}

  [[nodiscard]] BlockState& lanes() const { return lanes_; }
  [[nodiscard]] V row(const LaneArray& r) const { return V::load(r.lane + first_); }
  void put(LaneArray& r, const V& y) const { y.store(r.lane + first_); }

  [[nodiscard]] Response<V> response() const {
    return {row(lanes_.in_phase), row(lanes_.quadrature), row(lanes_.amplitude)};
  }
  [[nodiscard]] motion::EquationOfMotion<V, E> equation() const {
    if constexpr (E.soft)
      return {row(lanes_.twice_h), row(lanes_.f), row(lanes_.nu), row(lanes_.cushioned.k)};
    else if constexpr (E.stiffness)
      return {row(lanes_.twice_h), row(lanes_.f), row(lanes_.nu), row(lanes_.unsprung.k), row(lanes_.unsprung.pull)};
    return {row(lanes_.twice_h), row(lanes_.f), row(lanes_.nu)};
  }

  /// The instant a step later.
  [[nodiscard]] LaneMotion<V> step(const LaneMotion<V>& m) const {
    const motion::Propagator<V> free{row(lanes_.free_a), row(lanes_.free_b), row(lanes_.free_c), {}, {}};
    return at(advance_by_step(free, m.free),
              motion::turned(m.phase, {row(lanes_.turn_sine), row(lanes_.turn_cosine_minus_one)}));
  }
  /// The instant a time 0 <= s <= step later.
  [[nodiscard]] LaneMotion<V> after(const LaneMotion<V>& m, const V& s) const {
    return at(free_after(m.free, s), phase_after(m.phase, s));
  }
  [[nodiscard]] motion::FreeMotion<V> free_after(const motion::FreeMotion<V>& from, const V& s) const {
    if constexpr (any_spring) {
      const V pull = row(lanes_.unsprung.pull);
      const motion::Propagator<V> p = short_propagator(s, row(lanes_.h), row(lanes_.unsprung.root_square));
      const V pulled = s * s * short_second_divided_decay(row(lanes_.twice_h) * s);
      return {mul_add(p.a, from.x, mul_add(p.b, from.v, pull * pulled)),
              mul_add(p.c, from.v, p.b * neg_mul_add(row(lanes_.unsprung.k), from.x, pull))};
    }
    const motion::Turn<V> turn = short_turn(row(lanes_.root) * s);
    const motion::Propagator<V> p =
        motion::light_propagator(short_decay(row(lanes_.h) * s), V(1.0) + turn.cosine_minus_one,
                                 turn.sine * row(lanes_.inverse_root), row(lanes_.h));
    if constexpr (E.soft) return advance(p, from, row(lanes_.cushioned.k) * p.b);
    return p.advance(from);
  }
  [[nodiscard]] SineCosine<V> phase_after(const SineCosine<V>& from, const V& s) const {
    return motion::turned(from, short_turn(row(lanes_.nu) * s));
  }
  /// The free part of a motion with displacement y and velocity v at a phase (eq. 5).
  [[nodiscard]] motion::FreeMotion<V> free_part(const V& y, const V& v, const SineCosine<V>& phase) const {
    const Response<V> forced = response();
    return {y - forced.displacement(phase.sine, phase.cosine),
            v - forced.velocity(row(lanes_.nu), phase.sine, phase.cosine)};
  }

  [[nodiscard]] V acceleration(const V& y, const V& v, const SineCosine<V>& phase) const {
    return equation().acceleration(y, v, phase.sine);
  }
  [[nodiscard]] V jerk(const V& v, const V& a, const V& cosine) const { return equation().jerk(v, a, cosine); }
  [[nodiscard]] Derivatives derivatives(const LaneMotion<V>& m) const {
    return equation().derivatives(m.v, m.a, m.phase.sine, m.phase.cosine);
  }

  /// The quantity that a lane's bounds hold, and its first two derivatives: the displacement, in contact with a soft
  /// stop y + 2 h_s/kappa y', which tells the stop's force (eq. 50).
  struct Watched {
    V value, rate, bend;
  };
  [[nodiscard, gnu::always_inline]] inline Watched watched(const LaneMotion<V>& m) const {
    if constexpr (!E.soft) return {m.y, m.v, m.a};
    const V r = row(lanes_.cushioned.relaxation);
    return {mul_add(r, m.v, m.y), mul_add(r, m.a, m.v), mul_add(r, jerk(m.v, m.a, m.phase.cosine), m.a)};
  }
  /// The displacement at which the quantity comes to a bound.
  [[nodiscard]] V displacement_at(const V& bound, const V& v) const {
    if constexpr (E.soft) return neg_mul_add(row(lanes_.cushioned.relaxation), v, bound);
    return bound;
  }
  /// The time in which the quantity that the bounds hold comes to one of them.
  [[nodiscard, gnu::always_inline]] inline motion::TimeOver<V> time_to(const V& bound, const LaneMotion<V>& at,
                                                                       const Derivatives& d) const {
    if constexpr (!E.soft) return {bound - at.y, at.v, at.a, d};
    const V r = row(lanes_.cushioned.relaxation);
    return {bound - mul_add(r, at.v, at.y),
            mul_add(r, at.a, at.v),
            mul_add(r, d.d3, at.a),
            {mul_add(r, d.d4, d.d3), mul_add(r, d.d5, d.d4), mul_add(r, d.d6, d.d5), d.d6}};
  }

  /// The quantity over a flight.
  [[nodiscard, gnu::always_inline]] inline HermiteData<V> ends(const LaneMotion<V>& from, const LaneMotion<V>& to,
                                                               const V& length) const {
    const Watched w = watched(from), z = watched(to);
    return HermiteData<V>::over(length, {w.value, w.rate, w.bend, z.value, z.rate, z.bend});
  }

  /// The error bounds of a step that begins with this free motion (eqs. 13 and 14).
  [[nodiscard]] ErrorBound<V> uncertainty(const motion::FreeMotion<V>& m) const {
    V free = size(m), rounding(0x1p-49);
    if constexpr (any_spring) free = free + row(lanes_.unsprung.reach_of_pull);
    if constexpr (E.soft) rounding = row(lanes_.cushioned.rounding_of_free);
    return {free, mul_add(row(lanes_.bound), free, row(lanes_.bound_forced)),
            mul_add(rounding, free, row(lanes_.rounding))};
  }
  /// Bound of the displacement and of the velocity of a free motion, or of the difference of two motions, over a step:
  /// the energy norm never grows under a spring (eq. 14), and modes do without one (eq. 47).
  [[nodiscard]] V size(const motion::FreeMotion<V>& m) const {
    if constexpr (E.soft) return mul_add(row(lanes_.cushioned.natural), abs(m.x), abs(m.v));
    if constexpr (any_spring)
      return mul_add(row(lanes_.unsprung.reach_x), abs(m.x), row(lanes_.unsprung.reach_v) * abs(m.v));
    return abs(m.x) + abs(m.v);
  }
  /// The error bound of the velocity's enclosure.
  [[nodiscard]] V error_v(const ErrorBound<V>& u) const {
    return mul_add(row(lanes_.bound_v), u.free, row(lanes_.bound_forced_v));
  }

 private:
  /// Free motion with any k, from k times the propagator's b (eq. 42).
  [[nodiscard]] static motion::FreeMotion<V> advance(const motion::Propagator<V>& p, const motion::FreeMotion<V>& from,
                                                     const V& kb) {
    return {mul_add(p.a, from.x, p.b * from.v), mul_sub(p.c, from.v, kb * from.x)};
  }
  [[nodiscard]] motion::FreeMotion<V> advance_by_step(const motion::Propagator<V>& p,
                                                      const motion::FreeMotion<V>& from) const {
    if constexpr (E.soft) return advance(p, from, row(lanes_.cushioned.free_kb));
    if constexpr (any_spring)
      return {mul_add(p.a, from.x, mul_add(p.b, from.v, row(lanes_.unsprung.pulled_x))),
              mul_add(p.c, from.v, neg_mul_add(row(lanes_.unsprung.free_kb), from.x, row(lanes_.unsprung.pulled_v)))};
    return p.advance(from);
  }
  [[nodiscard]] LaneMotion<V> at(const motion::FreeMotion<V>& free, const SineCosine<V>& phase) const {
    const Response<V> forced = response();
    const V y = forced.displacement(phase.sine, phase.cosine) + free.x;
    const V v = forced.velocity(row(lanes_.nu), phase.sine, phase.cosine) + free.v;
    return {free, phase, y, v, acceleration(y, v, phase)};
  }

  BlockState& lanes_;
  std::size_t first_;
};

}  // namespace clatter::lanes
