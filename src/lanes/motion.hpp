#pragma once

#include "lanes/enclosure.hpp"
#include "lanes/functions.hpp"
#include "lanes/lanes.hpp"

namespace clatter {

/// Motion at an instant: the free part, the forcing phase, and the place, velocity and acceleration that they make.
template <class V>
struct Instant {
  V p, w, sine, cosine, y, v, a;
};

template <class Mask, class V>
[[nodiscard]] Instant<V> select(const Mask& m, const Instant<V>& x, const Instant<V>& y) {
  return {select(m, x.p, y.p), select(m, x.w, y.w), select(m, x.sine, y.sine), select(m, x.cosine, y.cosine),
          select(m, x.y, y.y), select(m, x.v, y.v), select(m, x.a, y.a)};
}

/// Third to fifth derivative of the displacement.
template <class V>
struct Jet {
  V third, fourth, fifth;
};

/// What an enclosure of a step is uncertain by, and what places are rounded by.
template <class V>
struct Uncertainty {
  V error, error_v, rounding;
};

/// The closed forms of the motion of some lanes; time counts in their steps.
template <class V>
class Motions {
 public:
  Motions(Lanes& lanes, std::size_t first) : lanes_(lanes), first_(first) {}

  [[nodiscard]] V row(const Row& r) const { return V::load(r.lane + first_); }
  void put(Row& r, const V& y) const { y.store(r.lane + first_); }

  /// The instant a step later.
  [[nodiscard]] Instant<V> step(const Instant<V>& m) const {
    Instant<V> end;
    end.p = fma(row(lanes_.free_pp), m.p, row(lanes_.free_pw) * m.w);
    end.w = fnma(row(lanes_.free_wp), m.p, row(lanes_.free_ww) * m.w);
    turn(end, m, row(lanes_.turn_sine), row(lanes_.turn_cosine));
    complete(end);
    return end;
  }
  /// The instant a time 0 <= d <= 1 later.
  [[nodiscard]] Instant<V> after(const Instant<V>& m, const V& d) const {
    Instant<V> end;
    move_free(end, m, d);
    const auto [sine, cosine] = short_sine_cosine(row(lanes_.angle) * d);
    turn(end, m, sine, cosine);
    complete(end);
    return end;
  }
  /// Free part and phase of it alone.
  [[nodiscard]] Instant<V> parts_after(const Instant<V>& m, const V& d) const {
    Instant<V> end{};
    move_free(end, m, d);
    const auto [sine, cosine] = short_sine_cosine(row(lanes_.angle) * d);
    turn(end, m, sine, cosine);
    return end;
  }
  /// Free part from displacement, velocity and phase.
  void divide(Instant<V>& m) const {
    m.p = m.y - response(m.sine, m.cosine), m.w = m.v - response_velocity(m.sine, m.cosine);
  }
  [[nodiscard]] V response(const V& sine, const V& cosine) const {
    return fma(row(lanes_.in_phase), sine, row(lanes_.quadrature) * cosine);
  }
  [[nodiscard]] V response_velocity(const V& sine, const V& cosine) const {
    return row(lanes_.angle) * fms(row(lanes_.in_phase), cosine, row(lanes_.quadrature) * sine);
  }

  [[nodiscard]] V jerk(const Instant<V>& m) const {
    return fms(row(lanes_.push), m.cosine, fma(row(lanes_.damping), m.a, row(lanes_.stiffness) * m.v));
  }
  [[nodiscard]] Jet<V> jet(const Instant<V>& m) const {
    const V angle = row(lanes_.angle), push = row(lanes_.push) * angle, damping = row(lanes_.damping),
            stiffness = row(lanes_.stiffness);
    const V third = jerk(m), fourth = -fma(push, m.sine, fma(damping, third, stiffness * m.a));
    return {third, fourth, -fma(push * angle, m.cosine, fma(damping, fourth, stiffness * third))};
  }

  /// Moves an instant by a time |t| <= 2^-10, by Taylor's series; its displacement and free part are left to the
  /// caller.
  void shift(Instant<V>& m, const Jet<V>& jet, const V& t) const {
    m.v = fma(t, fma(t, fma(t, fma(t, jet.fifth * (1.0 / 24), jet.fourth * (1.0 / 6)), jet.third * 0.5), m.a), m.v);
    m.a = fma(t, fma(t, fma(t, jet.fifth * (1.0 / 6), jet.fourth * 0.5), jet.third), m.a);
    const V angle = row(lanes_.angle) * t, square = angle * angle;
    const V cosine = square * -0.5 * fnma(V(1.0 / 12), square, V(1.0));  // minus 1
    const V sine = angle * fnma(square * (1.0 / 6), fnma(V(0.05), square, V(1.0)), V(1.0));
    const V before = m.sine;
    m.sine = before + fma(before, cosine, m.cosine * sine);
    m.cosine = m.cosine + fms(m.cosine, cosine, before * sine);
  }

  /// For a step that begins at m.
  [[nodiscard]] Uncertainty<V> uncertainty(const Instant<V>& m) const {
    const V free = fma(abs(m.w), row(lanes_.rate), abs(m.p));
    return {fma(row(lanes_.bound), free, row(lanes_.bound_forced)),
            fma(row(lanes_.bound_v), free, row(lanes_.bound_forced_v)), fma(V(0x1p-49), free, row(lanes_.rounding))};
  }

 private:
  static void turn(Instant<V>& m, const Instant<V>& from, const V& sine, const V& cosine) {
    m.sine = fma(from.sine, cosine, from.cosine * sine);
    m.cosine = fnma(from.sine, sine, from.cosine * cosine);
  }
  void move_free(Instant<V>& m, const Instant<V>& from, const V& d) const {
    const auto [turned, cosine] = short_sine_cosine(row(lanes_.rotation) * d);
    const V e = short_decay(row(lanes_.decay) * d), s = turned * e, c = cosine * e;
    const V skew = row(lanes_.skew), b = s * row(lanes_.slowness);
    m.p = fma(fma(skew, s, c), from.p, b * from.w);
    m.w = fms(fnma(skew, s, c), from.w, b * row(lanes_.stiffness) * from.p);
  }
  void complete(Instant<V>& m) const {
    const V x = response(m.sine, m.cosine), angle = row(lanes_.angle);
    m.y = x + m.p, m.v = response_velocity(m.sine, m.cosine) + m.w;
    m.a = -fma(angle * angle, x, fma(row(lanes_.stiffness), m.p, row(lanes_.damping) * m.w));
  }

  Lanes& lanes_;
  std::size_t first_;
};

}  // namespace clatter
