#pragma once

#include "lanes/block_state.hpp"
#include "lanes/enclosure.hpp"
#include "lanes/functions.hpp"

namespace clatter::lanes {

/// Motion at an instant: free part (p, w), forcing phase, and the displacement y, velocity and acceleration that
/// follow.
template <class V>
struct LaneMotion {
  V p, w, sine, cosine, y, v, a;
};

template <class Mask, class V>
[[nodiscard, gnu::always_inline]] inline LaneMotion<V> select(const Mask& m, const LaneMotion<V>& x,
                                                              const LaneMotion<V>& y) {
  return {select(m, x.p, y.p), select(m, x.w, y.w), select(m, x.sine, y.sine), select(m, x.cosine, y.cosine),
          select(m, x.y, y.y), select(m, x.v, y.v), select(m, x.a, y.a)};
}

/// Third to seventh derivative of the displacement.
template <class V>
struct Jet {
  V d3, d4, d5, d6, d7;
};

/// Error bounds of a step.
template <class V>
struct ErrorBound {
  V free;             ///< size of the free motion
  V error, rounding;  ///< of the enclosure's middle coefficient (eq. 13); of displacements
};

/// The closed forms of the motion of some lanes; time counts in their steps.
template <class V>
class ClosedForm {
 public:
  ClosedForm(BlockState& lanes, std::size_t first) : lanes_(lanes), first_(first) {}

  [[nodiscard]] V row(const LaneArray& r) const { return V::load(r.lane + first_); }
  void put(LaneArray& r, const V& y) const { y.store(r.lane + first_); }

  /// The instant a step later.
  [[nodiscard]] LaneMotion<V> step(const LaneMotion<V>& m) const {
    LaneMotion<V> end;
    end.p = fma(row(lanes_.free_pp), m.p, row(lanes_.free_pw) * m.w);
    end.w = fnma(row(lanes_.free_wp), m.p, row(lanes_.free_ww) * m.w);
    turn(end, m, row(lanes_.turn_sine), row(lanes_.turn_cosine));
    complete(end);
    return end;
  }
  /// The instant a time 0 <= d <= 1 later.
  [[nodiscard]] LaneMotion<V> after(const LaneMotion<V>& m, const V& d) const {
    LaneMotion<V> end;
    move_free(end, m, d), move_phase(end, m, d);
    complete(end);
    return end;
  }
  /// The free part a time 0 <= d <= 1 after `from`.
  void move_free(LaneMotion<V>& m, const LaneMotion<V>& from, const V& d) const {
    const auto [turned, cosine] = short_sine_cosine(row(lanes_.rotation) * d);
    const V e = short_decay(row(lanes_.decay) * d), s = turned * e, c = cosine * e;
    const V skew = row(lanes_.skew), b = s * row(lanes_.inverse_rotation);
    m.p = fma(fma(skew, s, c), from.p, b * from.w);
    m.w = fms(fnma(skew, s, c), from.w, b * row(lanes_.stiffness) * from.p);
  }
  /// The forcing phase a time 0 <= d <= 1 after `from`.
  void move_phase(LaneMotion<V>& m, const LaneMotion<V>& from, const V& d) const {
    const auto [sine, cosine] = short_sine_cosine(row(lanes_.angle) * d);
    turn(m, from, sine, cosine);
  }
  /// Sets the free part from displacement, velocity and phase (eq. 5).
  void divide(LaneMotion<V>& m) const {
    m.p = m.y - response(m.sine, m.cosine), m.w = m.v - response_velocity(m.sine, m.cosine);
  }
  [[nodiscard]] V response(const V& sine, const V& cosine) const {
    return fma(row(lanes_.in_phase), sine, row(lanes_.quadrature) * cosine);
  }
  [[nodiscard]] V response_velocity(const V& sine, const V& cosine) const {
    return row(lanes_.angle) * fms(row(lanes_.in_phase), cosine, row(lanes_.quadrature) * sine);
  }

  [[nodiscard]] V jerk(const LaneMotion<V>& m) const {
    return fms(row(lanes_.forced_jerk), m.cosine, fma(row(lanes_.damping), m.a, row(lanes_.stiffness) * m.v));
  }
  [[nodiscard]] Jet<V> jet(const LaneMotion<V>& m) const {
    const V angle = row(lanes_.angle), square = -angle * angle, damping = row(lanes_.damping),
            stiffness = row(lanes_.stiffness);
    const auto next = [&](const V& force, const V& last, const V& before) {
      return force - fma(damping, last, stiffness * before);
    };
    const V push3 = row(lanes_.forced_jerk) * m.cosine, push4 = -row(lanes_.forced_jerk) * angle * m.sine;
    Jet<V> jet;
    jet.d3 = next(push3, m.a, m.v), jet.d4 = next(push4, jet.d3, m.a);
    jet.d5 = next(push3 * square, jet.d4, jet.d3), jet.d6 = next(push4 * square, jet.d5, jet.d4);
    jet.d7 = next(push3 * square * square, jet.d6, jet.d5);
    return jet;
  }

  static constexpr double longest_shift = 0x1p-7;  ///< below it the series of `shift` is exact to rounding

  /// Moves an instant by a time |t| <= longest_shift, by the Taylor series; its displacement and free part are left to
  /// the caller.
  void shift(LaneMotion<V>& m, const Jet<V>& j, const V& t) const {
    m.v = fma(
        t,
        fma(t,
            fma(t, fma(t, fma(t, fma(t, j.d7 * (1.0 / 720), j.d6 * (1.0 / 120)), j.d5 * (1.0 / 24)), j.d4 * (1.0 / 6)),
                j.d3 * 0.5),
            m.a),
        m.v);
    m.a = fma(t,
              fma(t, fma(t, fma(t, fma(t, j.d7 * (1.0 / 120), j.d6 * (1.0 / 24)), j.d5 * (1.0 / 6)), j.d4 * 0.5), j.d3),
              m.a);
    const V angle = row(lanes_.angle) * t, square = angle * angle, one(1.0);
    const V cosine = square * -0.5 * fnma(square * (1.0 / 12), fnma(V(1.0 / 30), square, one), one);  // minus 1
    const V sine = angle * fnma(square * (1.0 / 6), fnma(square * 0.05, fnma(V(1.0 / 42), square, one), one), one);
    const V before = m.sine;
    m.sine = before + fma(before, cosine, m.cosine * sine);
    m.cosine = m.cosine + fms(m.cosine, cosine, before * sine);
  }

  /// The time, at most about longest_shift, from `m` to a displacement nearby: Newton's method on the Taylor series.
  [[nodiscard]] static V time_to(const V& place, const LaneMotion<V>& m, const Jet<V>& j) {
    const V missing = place - m.y, inverse = V(1.0) / m.v, half = m.a * 0.5;
    V t = missing * inverse;
    t = fnma(half * inverse * t, t, t);
    const V c4 = j.d4 * (1.0 / 24), c3 = j.d3 * (1.0 / 6), c5 = fma(t, j.d6 * (1.0 / 720), j.d5 * (1.0 / 120));
    for (int i = 0; i < 2; ++i) {
      const V left = fnma(t, fma(t, fma(t, fma(t, fma(t, c5, c4), c3), half), m.v), missing);
      const V bend = t * fma(t, fma(t, c4 * 4.0, c3 * 3.0), m.a) * inverse;  // of the slope from that at m
      t = fma(left * inverse, fma(bend, bend, V(1.0) - bend), t);
    }
    return t;
  }

  /// The error bounds of a step that begins at m (eqs. 13 and 14).
  [[nodiscard]] ErrorBound<V> uncertainty(const LaneMotion<V>& m) const {
    const V free = fma(abs(m.w), row(lanes_.rate), abs(m.p));
    return {free, fma(row(lanes_.bound), free, row(lanes_.bound_forced)), fma(V(0x1p-49), free, row(lanes_.rounding))};
  }
  /// The error bound of the velocity's enclosure.
  [[nodiscard]] V error_v(const ErrorBound<V>& u) const {
    return fma(row(lanes_.bound_v), u.free, row(lanes_.bound_forced_v));
  }

 private:
  static void turn(LaneMotion<V>& m, const LaneMotion<V>& from, const V& sine, const V& cosine) {
    m.sine = fma(from.sine, cosine, from.cosine * sine);
    m.cosine = fnma(from.sine, sine, from.cosine * cosine);
  }
  void complete(LaneMotion<V>& m) const {
    const V x = response(m.sine, m.cosine), angle = row(lanes_.angle);
    m.y = x + m.p, m.v = response_velocity(m.sine, m.cosine) + m.w;
    m.a = -fma(angle * angle, x, fma(row(lanes_.stiffness), m.p, row(lanes_.damping) * m.w));
  }

  BlockState& lanes_;
  std::size_t first_;
};

}  // namespace clatter::lanes
