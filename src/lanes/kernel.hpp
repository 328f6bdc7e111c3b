#pragma once

#include "lanes/functions.hpp"
#include "lanes/lanes.hpp"
#include "lanes/vector.hpp"

namespace clatter {

/// Takes the lanes of a vector on to their next contact, or by two steps. Everything here is a template on the vector's
/// type, so that no code of one instruction set is ever merged with that of another.
template <class V, class Mask>
class Visit {
 public:
  Visit(Lanes& lanes, std::size_t first) : lanes_(lanes), first_(first) {}

  void run() {
    const V zero(0.0), one(1.0);
    here_ = {row(lanes_.p), row(lanes_.w), row(lanes_.sine), row(lanes_.cosine),
             row(lanes_.y), row(lanes_.v), row(lanes_.a)};
    left_ = row(lanes_.left), trace_ = row(lanes_.trace);
    Mask stepping = zero<one, touched = zero> one;
    arrived_ = touched;
    section_time_ = zero;
    section_from_ = to_ = here_;
    for (int steps = 1;; ++steps) {
      lanes_.proved += static_cast<double>(V::size);
      const Instant next = step(here_);
      bound(here_);
      const Mask free = proved(hull(here_, next, one, error_, next.y, next.y));
      const Mask touches = stepping & !free;
      touched = touched | touches;
      to_ = choose(touches, next, to_);
      stepping = stepping & free;
      const Mask arrives = stepping & (left_ <= one);
      pass_section(arrives);
      here_ = choose(stepping, next, here_), left_ = select(stepping, left_ - one, left_);
      stepping = stepping & !arrives;  // so that a lane is always at the same place when its section is looked at
      if (steps == most_steps || 2 * __builtin_popcount(bits(stepping)) <= static_cast<int>(V::size)) break;
    }
    Mask stuck = zero > one;
    put(lanes_.section_trace, trace_);
    trace_ = select(arrived_, zero, trace_);
    if (any(touched)) stuck = contact(touched);
    if (any(arrived_)) section();
    const auto keep = [&](Row& r, const V& is) { put(r, is); };
    keep(lanes_.left, left_);
    keep(lanes_.trace, trace_);
    keep(lanes_.p, here_.p), keep(lanes_.w, here_.w), keep(lanes_.sine, here_.sine), keep(lanes_.cosine, here_.cosine);
    keep(lanes_.y, here_.y), keep(lanes_.v, here_.v), keep(lanes_.a, here_.a);
    lanes_.arrived |= bits(arrived_) << first_, lanes_.stuck |= bits(stuck) << first_;
  }

 private:
  struct Instant {
    V p, w, sine, cosine, y, v, a;
  };
  struct Range {
    V low, high;
  };
  /// Third to fifth derivative.
  struct Jet {
    V third, fourth, fifth;
  };
  /// Sine and cosine of the free rotation, decayed.
  struct Rotation {
    V sine, cosine;
  };

  static Instant choose(const Mask& m, const Instant& x, const Instant& y) {
    return {select(m, x.p, y.p), select(m, x.w, y.w), select(m, x.sine, y.sine), select(m, x.cosine, y.cosine),
            select(m, x.y, y.y), select(m, x.v, y.v), select(m, x.a, y.a)};
  }

  /// The distance to a stop as a quintic of the part t of a step.
  struct Gap {
    V g0, q1, q2, q3, q4, q5, r1, r2, g1;

    Gap(const V& sign, const V& stop, const Instant& from, const Instant& to) {
      const V half = sign * -0.5;
      g0 = sign * (stop - from.y), g1 = sign * (stop - to.y);
      q1 = -sign * from.v, r1 = -sign * to.v, q2 = half * from.a, r2 = half * to.a;
      const V D = g1 - g0;
      q3 = fma(V(10.0), D, r2 - fma(V(6.0), q1, fma(V(4.0), r1, q2 * 3.0)));
      q4 = fma(V(-15.0), D, fma(V(8.0), q1, fma(V(7.0), r1, fma(V(3.0), q2, r2 * -2.0))));
      q5 = fma(V(6.0), D, r2 - fma(V(3.0), q1 + r1, q2));
    }
    V value(const V& t) const { return fma(fma(fma(fma(fma(q5, t, q4), t, q3), t, q2), t, q1), t, g0); }
    V slope(const V& t) const { return fma(fma(fma(fma(q5 * 5.0, t, q4 * 4.0), t, q3 * 3.0), t, q2 + q2), t, q1); }
    /// Half the second derivative.
    V bend(const V& t) const { return fma(fma(fma(q5 * 10.0, t, q4 * 6.0), t, q3 * 3.0), t, q2); }
    /// Where it is least: the turning point of a motion that approaches the stop and leaves it again.
    V turning_point() const {
      V t = min(max(q1 / (q1 - r1), V(0.0)), V(1.0));
      for (int i = 0; i < 3; ++i) t = fnma(V(0.5), slope(t) / bend(t), t);
      return t;
    }
    /// The first root: from the first crossing of the control polygon by Halley's iteration.
    V root() const {
      const V b1 = fma(V(0.2), q1, g0), b2 = fma(V(0.1), q2, fma(V(0.4), q1, g0));
      const V b4 = fnma(V(0.2), r1, g1), b3 = fma(V(0.1), r2, fnma(V(0.4), r1, g1));
      V from = b4, to = g1, t = V(0.8);
      const auto consider = [&](const V& before, const V& at, double place) {
        const Mask beyond = at < V(0.0);
        from = select(beyond, before, from), to = select(beyond, at, to), t = select(beyond, V(place), t);
      };
      consider(b3, b4, 0.6), consider(b2, b3, 0.4), consider(b1, b2, 0.2), consider(g0, b1, 0.0);
      t = fma(V(0.2), from / (from - to), t);
      for (int i = 0; i < 2; ++i) {
        const V f = value(t), s = slope(t);
        t = t - f * s / fms(s, s, f * bend(t));
      }
      return t;
    }
  };

  V row(const Row& r) const { return V::load(r.lane + first_); }
  void put(Row& r, const V& b) const { b.store(r.lane + first_); }

  Instant step(const Instant& m) const {
    Instant end;
    end.p = fma(row(lanes_.free_pp), m.p, row(lanes_.free_pw) * m.w);
    end.w = fnma(row(lanes_.free_wp), m.p, row(lanes_.free_ww) * m.w);
    turn(end, m, row(lanes_.turn_sine), row(lanes_.turn_cosine));
    move(end);
    return end;
  }
  static void turn(Instant& m, const Instant& from, const V& sine, const V& cosine) {
    m.sine = fma(from.sine, cosine, from.cosine * sine);
    m.cosine = fnma(from.sine, sine, from.cosine * cosine);
  }
  V response(const V& sine, const V& cosine) const {
    return fma(row(lanes_.in_phase), sine, row(lanes_.quadrature) * cosine);
  }
  V response_velocity(const V& sine, const V& cosine) const {
    return row(lanes_.angle) * fms(row(lanes_.in_phase), cosine, row(lanes_.quadrature) * sine);
  }
  /// Displacement, velocity and acceleration from the free part and the phase.
  void move(Instant& m) const {
    const V x = response(m.sine, m.cosine), angle = row(lanes_.angle);
    m.y = x + m.p, m.v = response_velocity(m.sine, m.cosine) + m.w;
    m.a = -fma(angle * angle, x, fma(row(lanes_.stiffness), m.p, row(lanes_.damping) * m.w));
  }
  /// The free part from displacement, velocity and phase.
  void part(Instant& m) const {
    m.p = m.y - response(m.sine, m.cosine), m.w = m.v - response_velocity(m.sine, m.cosine);
  }

  void bound(const Instant& m) {
    const V free = fma(abs(m.w), row(lanes_.rate), abs(m.p));
    error_ = fma(row(lanes_.bound), free, row(lanes_.bound_forced));
    margin_ = fma(V(0x1p-49), free, row(lanes_.rounding));
  }

  /// Range of a flight: of the Bernstein coefficients of degree 6 of its quintic, the middle one widened by the error;
  /// the first is left out, and the last is what is given for it.
  static Range hull(const Instant& from, const Instant& to, const V& length, const V& error, const V& last_low,
                    const V& last_high) {
    const V square = length * length;
    const V V0 = from.v * length, A0 = from.a * square, V1 = to.v * length, A1 = to.a * square;
    const V b1 = fma(V(1.0 / 6), V0, from.y), b2 = fma(V(1.0 / 30), A0, fma(V(1.0 / 3), V0, from.y));
    const V b5 = fnma(V(1.0 / 6), V1, to.y), b4 = fma(V(1.0 / 30), A1, fnma(V(1.0 / 3), V1, to.y));
    const V b3 = fma(V(1.0 / 40), A0 + A1, fma(V(0.2), V0 - V1, (from.y + to.y) * 0.5));
    return {min(min(min(b1, b2), min(b4, b5)), min(b3 - error, last_low)),
            max(max(max(b1, b2), max(b4, b5)), max(b3 + error, last_high))};
  }
  Mask proved(const Range& range) const {
    return (range.low >= row(lanes_.lower) + margin_) & (range.high <= row(lanes_.upper) - margin_);
  }

  Rotation rotation_over(const V& d) const {
    const auto [sine, cosine] = short_sine_cosine(row(lanes_.rotation) * d);
    const V e = short_decay(row(lanes_.decay) * d);
    return {sine * e, cosine * e};
  }
  void move_free(Instant& m, const Instant& from, const V& d) const {
    const Rotation free = rotation_over(d);
    const V skew = row(lanes_.skew), b = free.sine * row(lanes_.slowness);
    m.p = fma(fma(skew, free.sine, free.cosine), from.p, b * from.w);
    m.w = fms(fnma(skew, free.sine, free.cosine), from.w, b * row(lanes_.stiffness) * from.p);
  }
  Instant after(const Instant& from, const V& d) const {
    Instant m;
    move_free(m, from, d);
    const auto [sine, cosine] = short_sine_cosine(row(lanes_.angle) * d);
    turn(m, from, sine, cosine);
    move(m);
    return m;
  }
  Jet jet(const Instant& m) const {
    const V angle = row(lanes_.angle), push = row(lanes_.push), push2 = push * angle, damping = row(lanes_.damping),
            stiffness = row(lanes_.stiffness);
    const V third = fms(push, m.cosine, fma(damping, m.a, stiffness * m.v));
    const V fourth = -fma(push2, m.sine, fma(damping, third, stiffness * m.a));
    const V fifth = -fma(push2 * angle, m.cosine, fma(damping, fourth, stiffness * third));
    return {third, fourth, fifth};
  }

  /// The time from `m` to the stop, which is near: two corrections of Newton's step by the Taylor series.
  static V time_to(const V& stop, const Instant& m, const Jet& jet) {
    const V missing = stop - m.y, inverse = V(1.0) / m.v, curve = m.a * inverse;
    V t = missing * inverse;
    t = fnma(curve * t * 0.5, t, t);
    const V rest =
        fnma(t, fma(t, fma(t, fma(t, jet.fourth * (1.0 / 24), jet.third * (1.0 / 6)), m.a * 0.5), m.v), missing);
    return fma(rest * inverse, fnma(curve, t, V(1.0)), t);
  }
  /// A short time later; y is left to the caller.
  void shift(Instant& m, const Jet& jet, const V& t) const {
    m.v = fma(t, fma(t, fma(t, fma(t, jet.fifth * (1.0 / 24), jet.fourth * (1.0 / 6)), jet.third * 0.5), m.a), m.v);
    m.a = fma(t, fma(t, fma(t, jet.fifth * (1.0 / 6), jet.fourth * 0.5), jet.third), m.a);
    const V angle = row(lanes_.angle) * t, square = angle * angle;
    const V cosine = square * -0.5 * fnma(V(1.0 / 12), square, V(1.0));  // minus 1
    const V sine = angle * fnma(square * (1.0 / 6), fnma(V(0.05), square, V(1.0)), V(1.0));
    const V before = m.sine;
    m.sine = before + fma(before, cosine, m.cosine * sine);
    m.cosine = m.cosine + fms(m.cosine, cosine, before * sine);
  }
  static V sixth_power(const V& y) {
    const V square = y * y;
    return square * square * square;
  }

  /// Takes note of lanes that pass a section on a flight from here.
  void pass_section(const Mask& arrives) {
    section_from_ = choose(arrives, here_, section_from_);
    section_time_ = select(arrives, left_, section_time_);
    left_ = select(arrives, left_ + row(lanes_.period), left_);
    arrived_ = arrived_ | arrives;
  }

  /// Takes the touched lanes to their contact between `here_` and `to_`, or to the turning point short of it: proves
  /// the flight up to there and reverses the velocity. Returns the lanes for which that can't be done.
  Mask contact(const Mask& touched) {
    lanes_.refined += static_cast<double>(V::size);
    const V upper = row(lanes_.upper), lower = row(lanes_.lower), zero(0.0), one(1.0);
    bound(here_);
    const Range range = hull(here_, to_, one, error_, to_.y, to_.y);
    const Mask up = !(range.high <= upper - margin_), down = !(range.low >= lower + margin_);
    const Mask high = up & ((!down) | (here_.v > zero));
    const V sign = select(high, one, V(-1.0)), stop = select(high, upper, lower);
    const Gap gap(sign, stop, here_, to_);
    Mask crosses = gap.g1 < zero;
    V t = gap.root();
    if (any(touched & !crosses)) {
      const V turning = gap.turning_point();
      const V least = gap.value(turning), part = turning * (one - turning);
      const V uncertain = error_ * (part * part * part * 20.0);
      const Mask misses = (!crosses) & (least >= -uncertain);
      // where the error doesn't tell, only half of the way: a shorter flight has far less of it
      t = select(misses, select(least > uncertain, turning, turning * 0.5), t);
      crosses = !misses;
    }
    Mask good = touched & (t > zero) & (t < one);
    V reached = min(max(t, zero), one), more;
    Jet rates;
    Instant at;
    for (int pass = 0;; ++pass) {
      at = after(here_, reached);
      rates = jet(at);
      more = select(crosses, time_to(stop, at, rates), zero);
      const Mask far = good & !(abs(more) <= V(0x1p-10));
      if (!any(far)) break;
      if (pass == 2) {
        good = good & !far;
        break;
      }
      reached = select(far, min(max(reached + more, zero), one), reached);
    }
    shift(at, rates, more);
    reached = reached + more;
    at.y = select(crosses, stop, at.y);
    const V nowhere(1e300);
    good = good & (reached > zero) & (reached < one) &
           proved(hull(here_, at, reached, error_ * sixth_power(reached), select(crosses, nowhere, at.y),
                       select(crosses, -nowhere, at.y)));
    const V keep = select(high, row(lanes_.keep_upper), row(lanes_.keep_lower)), speed = sign * at.v;
    const V jump = select(crosses, -(one + keep) * at.v, zero);
    good = good & ((!crosses) | (speed > abs(at.a) * 0x1p-12));
    at.v = select(crosses, -keep * at.v, at.v), at.a = fnma(row(lanes_.damping), jump, at.a);
    good = good & ((!crosses) | (keep * speed > sign * at.a * 0x1p-5));
    const Mask arrives = good & (left_ <= reached);
    pass_section(arrives);
    trace_ = select(arrives, zero, trace_);
    part(at);
    here_ = choose(good, at, here_), left_ = select(good, left_ - reached, left_);
    const Mask met = good & crosses;
    put(lanes_.impacts, row(lanes_.impacts) + select(met, one, zero));
    trace_ = select(met, fma(trace_, V(3.0), select(high, V(2.0), one)), trace_);
    return touched & !good;
  }

  /// Displacement and velocity at the section that was passed. There the phase is known: it sets the clock, and the
  /// length of its sine and cosine, right again.
  void section() {
    Instant m;
    move_free(m, section_from_, section_time_);
    const auto [turn_sine, turn_cosine] = short_sine_cosine(row(lanes_.angle) * section_time_);
    turn(m, section_from_, turn_sine, turn_cosine);
    const V sine = row(lanes_.start_sine), cosine = row(lanes_.start_cosine);
    put(lanes_.section_y, m.p + response(sine, cosine)), put(lanes_.section_v, m.w + response_velocity(sine, cosine));
    const V ahead = fms(m.sine, cosine, m.cosine * sine) / row(lanes_.angle);
    const V longer = fma(m.sine, m.sine, m.cosine * m.cosine) - V(1.0);
    left_ = select(arrived_, left_ - ahead, left_);
    here_.sine = select(arrived_, fnma(longer * 0.5, here_.sine, here_.sine), here_.sine);
    here_.cosine = select(arrived_, fnma(longer * 0.5, here_.cosine, here_.cosine), here_.cosine);
  }

  static constexpr int most_steps = 6;

  Lanes& lanes_;
  std::size_t first_;
  Instant here_, to_, section_from_;
  V left_, trace_, section_time_, error_, margin_;
  Mask arrived_;
};

/// Takes every lane on.
template <class A>
void visit_all(Lanes& lanes) {
  using V = Pair<A>;
  lanes.arrived = lanes.stuck = 0;
  for (std::size_t first = 0; first < Row::width; first += V::size) Visit<V, PairMask<A>>(lanes, first).run();
}

}  // namespace clatter
