#pragma once

#include "lanes/lane_observers.hpp"
#include "model/restitution.hpp"

namespace clatter::lanes {

/// Advances the lanes of a vector: each to its next contact, past its next stroboscopic section, or by a few steps.
/// Everything here is a template on the vector's type V, so that no code of one instruction set is ever merged with
/// that of another.
///
/// The motion of a lane depends on that lane alone. How far it advances in a call depends on its neighbours, since
/// lanes at a contact wait until half of the vector has come to one, and then pass it together.
template <class V, bool observes>
class StepBlock {
  using Mask = typename V::Mask;

 public:
  StepBlock(BlockState& lanes, std::size_t first)
      : lanes_(lanes),
        first_(first),
        motions_(lanes, first),
        watch_(lanes, first, motions_),
        here_{row(lanes.p), row(lanes.w), row(lanes.sine), row(lanes.cosine), row(lanes.y), row(lanes.v), row(lanes.a)},
        left_(row(lanes.time_to_section)),
        itinerary_(row(lanes.itinerary)),
        from_{here_},
        time_(0.0),
        none_(V(1.0) < V(0.0)),
        arrived_(none_),
        reported_(none_),
        unproved_(none_),
        upper_(none_),
        to_scalar_(none_) {}

  void run() {
    motions_.put(lanes_.section_itinerary, itinerary_), motions_.put(lanes_.section_impacts, row(lanes_.impacts));
    step();
    if (any(unproved_)) contact();
    if (any(arrived_)) sections();
    store();
  }

 private:
  static constexpr int most_steps = 6;
  /// Speed over acceleration below which a contact is left to the scalar loop.
  static constexpr double grazing = 0x1p-12;
  /// In half steps: a contact that a shorter flight would follow is left to the scalar loop, too.
  static constexpr double shortest_flight = 0x1p-5;

  V row(const LaneArray& r) const { return motions_.row(r); }

  /// Takes steps that are proved free of contact (eq. 15), until at most half of the lanes can go on.
  void step() {
    const V one(1.0);
    Mask stepping = !none_;
    for (int steps = 1;; ++steps) {
      lanes_.proved += static_cast<double>(V::size);
      LaneMotion<V> next = motions_.step(here_);
      const ErrorBound<V> uncertainty = motions_.uncertainty(here_);
      Interval<V> range = enclosure(ends(next), uncertainty.error);
      range.include(next.y);
      const Mask above = stepping & !(range.high <= row(lanes_.upper) - uncertainty.rounding);
      const Mask below = stepping & !(range.low >= row(lanes_.lower) + uncertainty.rounding);
      unproved_ = unproved_ | above | below, upper_ = upper_ | (above & ((!below) | (here_.v > V(0.0))));
      const Mask passes = left_ <= one;
      stepping = stepping & !(above | below | (passes & arrived_));  // a second section waits for the next call
      if constexpr (observes) {
        const Mask seen = watch_.flight(stepping & !clipped(one), here_, next, one, uncertainty, range);
        to_scalar_ = to_scalar_ | (stepping & !seen), stepping = seen;
      }
      const Mask arrives = stepping & passes;
      pass_sections(arrives, next);
      here_ = select(stepping, next, here_), left_ = select(stepping, left_ - one, left_);
      if constexpr (observes) stepping = stepping & !(arrives & (row(lanes_.ends_here) > V(0.0)));
      if (steps == most_steps || 2 * count(stepping) <= static_cast<int>(V::size)) return;
    }
  }

  HermiteData<V> ends(const LaneMotion<V>& to) const { return {here_.y, here_.v, here_.a, to.y, to.v, to.a}; }

  /// Lanes whose observed time ends within a time from here; the scalar loop has to take them there.
  Mask clipped(const V& time) const { return (row(lanes_.stop_short) > V(0.0)) & (left_ <= time); }

  /// The end of a flight from here: the contact, or an instant short of one.
  struct ContactGuess {
    LaneMotion<V> at;
    V time;              ///< of the flight, a part of a step
    Mask crosses, good;  ///< there is a contact; the guess can be used
  };

  /// A guess of the first contact of the unproved lanes, by the quintic; if it has none, its nearest approach to the
  /// stop.
  ContactGuess guess_contact(const LaneMotion<V>& to, const V& error, const V& sign, const V& stop) const {
    const V zero(0.0), one(1.0), back = -sign;
    const QuinticHermite<V> gap(HermiteData<V>{sign * (stop - here_.y), back * here_.v, back * here_.a,
                                               sign * (stop - to.y), back * to.v, back * to.a});
    ContactGuess g;
    g.crosses = sign * (stop - to.y) < zero;
    g.time = gap.root(unproved_);
    if (any(unproved_ & !g.crosses)) {
      const V place = gap.least();
      // a lane has to advance: only one that moves to the stop can turn back at once
      const V soonest = select(sign * here_.v > zero, V(0x1p-40), V(0x1p-4));
      const V turning = select((place > soonest) & (place < one), place, V(0.5));
      const V least = gap.at(turning).value, part = turning * (one - turning);
      const V uncertain = error * (part * part * part * 20.0);
      const Mask misses = (!g.crosses) & (least >= -uncertain);
      // if the error leaves it open, only half of the way: a shorter flight has a far smaller error
      g.time = select(misses, select(least > uncertain, turning, turning * 0.5), g.time);
      g.crosses = !misses;
    }
    g.good = unproved_ & (g.time > zero) & (g.time < one);
    g.time = min(max(g.time, zero), one);
    return g;
  }

  /// Refines the guess to rounding, by the closed form and the Taylor series.
  void refine_contact(const V& stop, ContactGuess& g) const {
    const V zero(0.0), one(1.0), longest(ClosedForm<V>::longest_shift);
    for (int pass = 0;; ++pass) {
      g.at = motions_.after(here_, g.time);
      const Jet<V> jet = motions_.jet(g.at);
      const V more = select(g.crosses, ClosedForm<V>::time_to(stop, g.at, jet), zero);
      const Mask far = g.good & !((abs(more) <= longest) & (abs(more * g.at.a) <= abs(g.at.v) * 0x1p-5));
      if (pass == 2 || !any(far)) {
        g.good = g.good & !far;
        motions_.shift(g.at, jet, more);
        g.time = g.time + more;
        g.at.y = select(g.crosses, stop, g.at.y);
        return;
      }
      g.time = select(far, min(max(g.time + more, zero), one), g.time);
    }
  }

  /// Takes the unproved lanes to their contact, or short of it, proves the flight up to there, and reverses the
  /// velocity in a contact (eq. 4).
  void contact() {
    lanes_.refined += static_cast<double>(V::size);
    const V zero(0.0), one(1.0);
    const ErrorBound<V> uncertainty = motions_.uncertainty(here_);
    const V sign = select(upper_, one, V(-1.0)), stop = select(upper_, row(lanes_.upper), row(lanes_.lower));
    ContactGuess g = guess_contact(motions_.step(here_), uncertainty.error, sign, stop);
    refine_contact(stop, g);
    LaneMotion<V>& at = g.at;
    const Interval<V> range =
        enclosure(HermiteData<V>::scaled(ends(at), g.time), uncertainty.error * sixth_power(g.time));
    Interval<V> with_end = range;
    with_end.include(at.y);
    const V low = select(g.crosses, range.low, with_end.low), high = select(g.crosses, range.high, with_end.high);
    g.good = g.good & (g.time > zero) & (g.time < one) & (low >= row(lanes_.lower) + uncertainty.rounding) &
             (high <= row(lanes_.upper) - uncertainty.rounding);
    const Restitution<V> law{select(upper_, row(lanes_.restitution_upper), row(lanes_.restitution_lower))};
    const V speed = sign * at.v;
    const V before = at.v, jump = select(g.crosses, law.jump(at.v), zero);
    const V after = select(g.crosses, law.after(at.v), at.v), a = fnma(row(lanes_.damping), jump, at.a);
    const Mask bounces = (speed > abs(at.a) * grazing) & (law.after(-speed) > sign * a * shortest_flight);
    g.good = g.good & ((!g.crosses) | bounces);
    const Mask passes = left_ <= g.time, waits = unproved_ & passes & arrived_;
    g.good = g.good & !waits;
    if constexpr (observes) g.good = watch_.flight(g.good & !clipped(g.time), here_, at, g.time, uncertainty, range);
    at.v = after, at.a = a;
    const Mask met = g.good & g.crosses;
    if constexpr (observes) {
      const Mask over = (passes | arrived_) & (row(lanes_.ends_here) > zero);  // its period is over already
      watch_.impact(met, met & !over, upper_, at, before, jump);
    }
    pass_sections(g.good & passes, at);
    motions_.divide(at);
    here_ = select(g.good, at, here_), left_ = select(g.good, left_ - g.time, left_);
    itinerary_ = select(met, fma(itinerary_, V(3.0), select(upper_, V(2.0), one)), itinerary_);
    motions_.put(lanes_.impacts, row(lanes_.impacts) + select(met, one, zero));
    to_scalar_ = to_scalar_ | (unproved_ & !(g.good | waits));
  }

  /// Records the lanes that pass a section on their flight from here to `to`, and corrects the clock, and the length of
  /// sine and cosine, by the errors that were found at the section before.
  void pass_sections(const Mask& arrives, LaneMotion<V>& to) {
    if (!any(arrives)) return;
    from_.p = select(arrives, here_.p, from_.p), from_.w = select(arrives, here_.w, from_.w);
    from_.sine = select(arrives, here_.sine, from_.sine), from_.cosine = select(arrives, here_.cosine, from_.cosine);
    time_ = select(arrives, left_, time_);
    left_ = select(arrives, left_ + row(lanes_.to_next), left_);
    const V excess = select(arrives, row(lanes_.excess), V(0.0));
    to.sine = fnma(excess, to.sine, to.sine), to.cosine = fnma(excess, to.cosine, to.cosine);
    itinerary_ = select(arrives, V(0.0), itinerary_);
    arrived_ = arrived_ | arrives;
  }

  /// Computes the difference of clock and phase at the sections that were passed, and displacement and velocity at
  /// those that are reported.
  void sections() {
    reported_ = arrived_;
    if constexpr (observes) {
      const V skip_sections = row(lanes_.skip_sections), zero(0.0);
      reported_ = arrived_ & (skip_sections <= zero);
      motions_.put(lanes_.skip_sections, select(arrived_, max(skip_sections - V(1.0), zero), skip_sections));
    }
    const V sine = row(lanes_.start_sine), cosine = row(lanes_.start_cosine);
    LaneMotion<V> m;
    motions_.move_phase(m, from_, time_);
    const V ahead = fms(m.sine, cosine, m.cosine * sine) * row(lanes_.inverse_angle);
    const V excess = fma(m.sine, m.sine, fms(m.cosine, m.cosine, V(1.0))) * 0.5;
    // half of the difference, since the correction comes one section later
    motions_.put(lanes_.to_next, select(arrived_, fnma(V(0.5), ahead, row(lanes_.period)), row(lanes_.to_next)));
    motions_.put(lanes_.excess, select(arrived_, excess * 0.5, row(lanes_.excess)));
    if (!any(reported_)) return;
    motions_.move_free(m, from_, time_);
    motions_.put(lanes_.section_y, m.p + motions_.response(sine, cosine));
    motions_.put(lanes_.section_v, m.w + motions_.response_velocity(sine, cosine));
  }

  void store() const {
    motions_.put(lanes_.p, here_.p), motions_.put(lanes_.w, here_.w);
    motions_.put(lanes_.sine, here_.sine), motions_.put(lanes_.cosine, here_.cosine);
    motions_.put(lanes_.y, here_.y), motions_.put(lanes_.v, here_.v), motions_.put(lanes_.a, here_.a);
    motions_.put(lanes_.time_to_section, left_), motions_.put(lanes_.itinerary, itinerary_);
    if constexpr (observes) watch_.store();
    lanes_.arrived |= bits(reported_) << first_, lanes_.to_scalar |= bits(to_scalar_) << first_;
  }

  BlockState& lanes_;
  std::size_t first_;
  ClosedForm<V> motions_;
  LaneObservers<V> watch_;
  LaneMotion<V> here_;
  V left_, itinerary_;
  LaneMotion<V> from_;  ///< beginning of the flight across a section: free part and phase only
  V time_;              ///< from there to the section
  Mask none_, arrived_, reported_, unproved_, upper_, to_scalar_;
};

/// Makes numbers below 1e-308 count as 0 while lanes run: a free motion that has died out would else cost a hundred
/// times as much as a live one.
template <class A>
class FlushToZero {
 public:
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }  // flush to zero, denormals are zeros
  ~FlushToZero() { _mm_setcsr(before_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned before_;
};

/// Advances every lane.
template <class A, bool observes>
void step_all(BlockState& lanes) {
  using V = Pair<A>;
  const FlushToZero<A> flush;
  for (std::size_t first = 0; first < LaneArray::width; first += V::size) StepBlock<V, observes>(lanes, first).run();
}

}  // namespace clatter::lanes
