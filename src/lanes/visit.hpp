#pragma once

#include "lanes/watch.hpp"

namespace clatter {

/// Takes the lanes of a vector on: each to its next contact, past its next section, or by a few steps. Everything here
/// is a template on the vector's type V, so that no code of one instruction set is ever merged with that of another.
///
/// What happens to a lane depends on that lane alone; how far it gets in a visit depends on its neighbours, since those
/// that have come to a contact wait until half of them have, and are then taken through it together.
template <class V, bool observes>
class Visit {
  using Mask = typename V::Mask;

 public:
  Visit(Lanes& lanes, std::size_t first)
      : lanes_(lanes),
        first_(first),
        motions_(lanes, first),
        watch_(lanes, first, motions_),
        here_{row(lanes.p), row(lanes.w), row(lanes.sine), row(lanes.cosine), row(lanes.y), row(lanes.v), row(lanes.a)},
        to_(here_),
        section_from_(here_),
        left_(row(lanes.left)),
        trace_(row(lanes.trace)),
        section_time_(0.0),
        arrived_(V(1.0) < V(0.0)),
        touched_(arrived_),
        stuck_(arrived_) {}

  void run() {
    step();
    motions_.put(lanes_.section_trace, trace_);
    trace_ = select(arrived_, V(0.0), trace_);
    if (any(touched_)) contact();
    if (any(arrived_)) section();
    store();
  }

 private:
  static constexpr int most_steps = 6;

  V row(const Row& r) const { return motions_.row(r); }

  /// Steps that are proved free of contact, until at most half of the lanes can go on.
  void step() {
    const V one(1.0);
    Mask stepping = !arrived_;
    for (int steps = 1;; ++steps) {
      lanes_.proved += static_cast<double>(V::size);
      const Instant<V> next = motions_.step(here_);
      const Uncertainty<V> uncertainty = motions_.uncertainty(here_);
      Range<V> range = enclosure(ends(next), uncertainty.error);
      range.include(next.y);
      const Mask touches = stepping & !proved(range, uncertainty.rounding);
      touched_ = touched_ | touches, to_ = select(touches, next, to_);
      stepping = stepping & !touches;
      if constexpr (observes) {
        const Mask seen = watch_.flight(stepping & !clipped(one), here_, next, one, uncertainty);
        stuck_ = stuck_ | (stepping & !seen), stepping = seen;
      }
      const Mask arrives = stepping & (left_ <= one);
      pass_section(arrives);
      here_ = select(stepping, next, here_), left_ = select(stepping, left_ - one, left_);
      stepping = stepping & !arrives;  // a lane is always at the same place when its section is looked at
      if (steps == most_steps || 2 * count(stepping) <= static_cast<int>(V::size)) return;
    }
  }

  Ends<V> ends(const Instant<V>& to) const { return {here_.y, here_.v, here_.a, to.y, to.v, to.a}; }
  Mask proved(const Range<V>& range, const V& rounding) const {
    return (range.low >= row(lanes_.lower) + rounding) & (range.high <= row(lanes_.upper) - rounding);
  }
  /// Lanes whose observed time ends within a time from here, which the scalar kernel has to take there.
  Mask clipped(const V& time) const { return (row(lanes_.clips) > V(0.0)) & (left_ <= time); }

  /// Takes note of lanes that pass a section on a flight from here.
  void pass_section(const Mask& arrives) {
    section_from_ = select(arrives, here_, section_from_), section_time_ = select(arrives, left_, section_time_);
    left_ = select(arrives, left_ + row(lanes_.period), left_);
    arrived_ = arrived_ | arrives;
  }

  /// A place of a flight from here, at a part of a step: the contact, or where the lane waits short of one.
  struct Goal {
    Mask upper, crosses, good;
    V sign, stop, time;
  };

  /// The touched lanes' first contact in the quintic, or where it has none the turning point.
  Goal goal(const Uncertainty<V>& uncertainty) const {
    const V zero(0.0), one(1.0);
    Range<V> range = enclosure(ends(to_), uncertainty.error);
    range.include(to_.y);
    const Mask up = !(range.high <= row(lanes_.upper) - uncertainty.rounding);
    const Mask down = !(range.low >= row(lanes_.lower) + uncertainty.rounding);
    Goal g;
    g.upper = up & ((!down) | (here_.v > zero));
    g.sign = select(g.upper, one, V(-1.0)), g.stop = select(g.upper, row(lanes_.upper), row(lanes_.lower));
    const V back = -g.sign;
    const Ends<V> gap{g.sign * (g.stop - here_.y), back * here_.v, back * here_.a,
                      g.sign * (g.stop - to_.y),   back * to_.v,   back * to_.a};
    const Quintic<V> quintic(gap);
    g.crosses = gap.y1 < zero;
    g.time = quintic.root();
    if (any(touched_ & !g.crosses)) {
      const V turning = quintic.least(), least = quintic.value(turning), part = turning * (one - turning);
      const V uncertain = uncertainty.error * (part * part * part * 20.0);
      const Mask misses = (!g.crosses) & (least >= -uncertain);
      // where the error doesn't tell, only half of the way: a shorter flight has far less of it
      g.time = select(misses, select(least > uncertain, turning, turning * 0.5), g.time);
      g.crosses = !misses;
    }
    g.good = touched_ & (g.time > zero) & (g.time < one);
    g.time = min(max(g.time, zero), one);
    return g;
  }

  /// The instant of the goal to rounding, by Newton's method on the motion itself and Taylor's series.
  Instant<V> reach(Goal& g) const {
    const V zero(0.0), one(1.0);
    for (int pass = 0;; ++pass) {
      Instant<V> at = motions_.after(here_, g.time);
      const Jet<V> jet = motions_.jet(at);
      const V more = select(g.crosses, time_to(g.stop, at, jet), zero);
      const Mask far = g.good & !(abs(more) <= V(0x1p-10));
      if (pass == 2 || !any(far)) {
        g.good = g.good & !far;
        motions_.shift(at, jet, more);
        g.time = g.time + more;
        at.y = select(g.crosses, g.stop, at.y);
        return at;
      }
      g.time = select(far, min(max(g.time + more, zero), one), g.time);
    }
  }
  /// The time from `m` to a stop nearby.
  static V time_to(const V& stop, const Instant<V>& m, const Jet<V>& jet) {
    const V missing = stop - m.y, inverse = V(1.0) / m.v, curve = m.a * inverse;
    V t = missing * inverse;
    t = fnma(curve * t * 0.5, t, t);
    const V speed = fma(t, fma(t, fma(t, jet.fourth * (1.0 / 24), jet.third * (1.0 / 6)), m.a * 0.5), m.v);
    return fma(fnma(t, speed, missing) * inverse, fnma(curve, t, V(1.0)), t);
  }

  /// Takes the touched lanes to their goal, proves the flight up to there, and reverses their velocity in a contact.
  void contact() {
    lanes_.refined += static_cast<double>(V::size);
    const V zero(0.0), one(1.0);
    const Uncertainty<V> uncertainty = motions_.uncertainty(here_);
    Goal g = goal(uncertainty);
    Instant<V> at = reach(g);
    Range<V> range = enclosure(Ends<V>::scaled(ends(at), g.time), uncertainty.error * sixth_power(g.time));
    range = {select(g.crosses, range.low, min(range.low, at.y)), select(g.crosses, range.high, max(range.high, at.y))};
    g.good = g.good & (g.time > zero) & (g.time < one) & proved(range, uncertainty.rounding);
    const V keep = select(g.upper, row(lanes_.keep_upper), row(lanes_.keep_lower)), speed = g.sign * at.v;
    const V before = at.v, jump = select(g.crosses, -(one + keep) * at.v, zero);
    const V after = select(g.crosses, -keep * at.v, at.v), a = fnma(row(lanes_.damping), jump, at.a);
    const Mask bounces = (speed > abs(at.a) * grazing) & (keep * speed > g.sign * a * shortest_flight);
    g.good = g.good & ((!g.crosses) | bounces);
    if constexpr (observes) g.good = watch_.flight(g.good & !clipped(g.time), here_, at, g.time, uncertainty);
    at.v = after, at.a = a;
    motions_.divide(at);
    const Mask arrives = g.good & (left_ <= g.time), met = g.good & g.crosses;
    if constexpr (observes) {
      const Mask over = arrives & (row(lanes_.ends) > zero);
      watch_.impact(met, met & !over, g.upper, at, before, jump);
    }
    pass_section(arrives);
    here_ = select(g.good, at, here_), left_ = select(g.good, left_ - g.time, left_);
    motions_.put(lanes_.impacts, row(lanes_.impacts) + select(met, one, zero));
    trace_ = select(arrives, zero, trace_);
    trace_ = select(met, fma(trace_, V(3.0), select(g.upper, V(2.0), one)), trace_);
    stuck_ = stuck_ | (touched_ & !g.good);
  }

  /// Displacement and velocity at the section that was passed. There the phase is known: it sets the clock, and the
  /// length of its sine and cosine, right again.
  void section() {
    const Instant<V> m = motions_.parts_after(section_from_, section_time_);
    const V sine = row(lanes_.start_sine), cosine = row(lanes_.start_cosine);
    motions_.put(lanes_.section_y, m.p + motions_.response(sine, cosine));
    motions_.put(lanes_.section_v, m.w + motions_.response_velocity(sine, cosine));
    const V ahead = fms(m.sine, cosine, m.cosine * sine) / row(lanes_.angle);
    const V longer = fma(m.sine, m.sine, m.cosine * m.cosine) - V(1.0);
    left_ = select(arrived_, left_ - ahead, left_);
    here_.sine = select(arrived_, fnma(longer * 0.5, here_.sine, here_.sine), here_.sine);
    here_.cosine = select(arrived_, fnma(longer * 0.5, here_.cosine, here_.cosine), here_.cosine);
  }

  void store() {
    motions_.put(lanes_.p, here_.p), motions_.put(lanes_.w, here_.w);
    motions_.put(lanes_.sine, here_.sine), motions_.put(lanes_.cosine, here_.cosine);
    motions_.put(lanes_.y, here_.y), motions_.put(lanes_.v, here_.v), motions_.put(lanes_.a, here_.a);
    motions_.put(lanes_.left, left_), motions_.put(lanes_.trace, trace_);
    if constexpr (observes) watch_.store();
    lanes_.arrived |= bits(arrived_) << first_, lanes_.stuck |= bits(stuck_) << first_;
  }

  static constexpr double grazing =
      0x1p-12;  ///< speed over acceleration below which a contact is left to the scalar kernel
  static constexpr double shortest_flight = 0x1p-5;  ///< in half steps: a shorter one is left to it, too

  Lanes& lanes_;
  std::size_t first_;
  Motions<V> motions_;
  Watch<V> watch_;
  Instant<V> here_, to_, section_from_;
  V left_, trace_, section_time_;
  Mask arrived_, touched_, stuck_;
};

/// Takes every lane on.
template <class A, bool observes>
void visit_all(Lanes& lanes) {
  using V = Pair<A>;
  for (std::size_t first = 0; first < Row::width; first += V::size) Visit<V, observes>(lanes, first).run();
}

}  // namespace clatter
