#pragma once

#include <array>
#include <limits>

#include "lanes/lane_effects.hpp"
#include "lanes/lane_observers.hpp"
#include "lanes/lane_phases.hpp"
#include "scene/stops.hpp"

namespace clatter::lanes {

/// Advances the lanes of a vector: each to its next contact, past its next stroboscopic section, or by a few steps.
/// Everything here is a template on the vector's type V, so that no code of one instruction set is ever merged with
/// that of another. E: the effects of the lanes' steps.
///
/// The motion of a lane depends on that lane alone. How far it advances in a call depends on its neighbours, since
/// lanes at a contact wait until half of the vector has come to one, and then pass it together.
template <class V, Effects E, bool observes>
class StepBlock {
  using Mask = clatter::Mask<V>;

 public:
  StepBlock(BlockState& lanes, std::size_t first)
      : lanes_(lanes),
        first_(first),
        oscillators_(lanes, first),
        observers_(oscillators_),
        phases_(oscillators_),
        here_{{row(lanes.free_x), row(lanes.free_v)},
              {row(lanes.sine), row(lanes.cosine)},
              row(lanes.y),
              row(lanes.v),
              row(lanes.a)},
        left_(row(lanes.time_to_section)),
        itinerary_(row(lanes.itinerary)),
        log_area_(E.soft ? row(lanes.cushioned.log_area) : V(0.0)),
        from_free_(here_.free),
        from_phase_(here_.phase),
        time_(0.0),
        active_(left_ < V(std::numeric_limits<double>::infinity())),
        none_(V(1.0) < V(0.0)),
        arrived_(none_),
        to_scalar_(none_),
        unproved_(none_),
        ending_(none_),
        reported_(none_),
        stops_short_(row(lanes.stop_short) > V(0.0)) {}

  [[gnu::always_inline]] inline void run() {
    if (!any(active_)) return;
    for (int contacts = 1;; ++contacts) {
      unproved_ = ending_ = none_;
      step();
      if (any(unproved_)) contact();
      if (contacts >= lanes_.most_contacts || any(to_scalar_) || 2 * count(arrived_) >= count(active_)) break;
    }
    if (any(arrived_)) sections(E.soft ? arrived_ - reported_ : arrived_);
    store();
  }

 private:
  static constexpr int most_steps = 6;
  /// Speed over the acceleration in a step, below which a contact is left to the scalar loop.
  static constexpr double grazing = 0x1p-12;
  /// In half steps: a contact that a shorter flight would follow is left to the scalar loop, too.
  static constexpr double shortest_flight = 0x1p-5;
  static constexpr double longest_shift = 0x1p-9;  ///< in steps: the series around a guessed contact are then exact

  V row(const LaneArray& r) const { return oscillators_.row(r); }

  /// Takes steps that are proved free of contact (eq. 15), until at most half of the lanes can go on.
  [[gnu::always_inline]] inline void step() {
    const V length = row(lanes_.step);
    Mask stepping = active_;
    if constexpr (observes) stepping = stepping - (arrived_ & (row(lanes_.ends_here) > V(0.0)));
    for (int steps = 1;; ++steps) {
      lanes_.proved += static_cast<double>(V::size);
      LaneMotion<V> next = oscillators_.step(here_);
      path_ = hermite(oscillators_.ends(here_, next, length));
      bound_ = oscillators_.uncertainty(here_.free);
      Interval<V> range = enclosure(path_, bound_.error);
      range.include(path_[6]);
      below_upper_ = range.high <= row(lanes_.upper) - bound_.rounding;
      above_lower_ = range.low >= row(lanes_.lower) + bound_.rounding;
      Mask inside = below_upper_ & above_lower_;
      if constexpr (E.soft) inside = inside - phases_.outrunning();  // whose flight has more to be proved
      unproved_ = unproved_ | (stepping - inside);
      const Mask passes = left_ <= length;
      stepping = (stepping & inside) - (passes & arrived_);  // a second section waits for the next call
      if constexpr (observes) {
        const Mask ends = stepping & passes & stops_short_;
        ending_ = ending_ | ends, unproved_ = unproved_ | ends;
        stepping = stepping - ends;
        const Mask seen = observers_.flight(stepping, here_, next, length, bound_.error, path_, range);
        to_scalar_ = to_scalar_ | (stepping - seen);
        stepping = seen;
      }
      const Mask arrives = stepping & passes;
      const bool some_arrive = any(arrives);
      if (some_arrive) pass_sections(arrives, next.phase);
      here_ = select(stepping, next, here_);
      left_ = select(stepping, left_ - length, left_);
      if constexpr (E.soft) shrink(stepping, length);
      if (observes && some_arrive) stepping = stepping - (arrived_ & (row(lanes_.ends_here) > V(0.0)));
      if (steps == most_steps || 2 * count(stepping) <= static_cast<int>(V::size)) return;
    }
  }

  /// Lanes whose next step may come to the upper bound first.
  Mask nearer_upper() const {
    const Mask upper = (above_lower_ | (here_.v > V(0.0))) - below_upper_;
    if constexpr (E.soft) return phases_.nearer_upper(upper);
    return upper;
  }

  /// The end of a flight from here: the contact, or an instant short of one.
  struct ContactGuess {
    V time;              ///< of the flight
    Mask crosses, good;  ///< there is a contact; the guess can be used
  };

  /// A guess of the first contact of the unproved lanes, by the quintic of the step from here; if it has none, its
  /// nearest approach to the stop.
  [[gnu::always_inline]] inline ContactGuess guess_contact(const V& error, const V& sign, const V& stop,
                                                           const V& length) const {
    const V zero(0.0), one(1.0), from = sign * stop;
    Bernstein<V> gap;
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] = neg_mul_add(sign, path_[i], from);
    const Quintic<V> quintic(gap);
    ContactGuess g;
    g.crosses = gap[6] < zero;
    g.time = quintic.root(polygon_root(gap), unproved_ & g.crosses);
    if (any(unproved_ - g.crosses)) {
      const V place = quintic.least(gap);
      // a lane has to advance: only one that moves to the stop can turn back at once
      const V soonest = select(sign * oscillators_.watched(here_).rate > zero, V(0x1p-40), V(0x1p-4));
      const V turning = select((place > soonest) & (place < one), place, V(0.5));
      const V least = quintic.at(turning).value;
      const V uncertain = error * middle_function(turning);
      const Mask misses = (least >= -uncertain) - g.crosses;
      // if the error leaves it open, only half of the way: a shorter flight has a far smaller error
      g.time = select(misses, select(least > uncertain, turning, turning * V(0.5)), g.time);
      g.crosses = !misses;
    }
    g.good = unproved_ & (g.time > zero) & (g.time < one);
    g.time = lesser(greater(g.time, zero), one) * length;
    return g;
  }

  /// Ends flights with the observed time, if no contact is guessed before.
  void end_flights(ContactGuess& g) const {
    const Mask ends = ending_ | (unproved_ & stops_short_ & (left_ <= g.time));
    if (!any(ends)) return;
    g.time = select(ends, left_, g.time);
    g.crosses = g.crosses - ends, g.good = g.good | ends;
  }

  /// Refines the guess to rounding, by the closed form and the Taylor series; the motion at the end of the flight.
  [[gnu::always_inline]] inline LaneMotion<V> refine_contact(const V& stop, const V& length, ContactGuess& g) const {
    const V zero(0.0);
    for (int pass = 0;; ++pass) {
      LaneMotion<V> at = oscillators_.after(here_, g.time);
      const auto d = oscillators_.derivatives(at);
      const motion::TimeOver<V> to_stop = oscillators_.time_to(stop, at, d);
      const V more = select(g.crosses, to_stop.time, zero);
      const Mask far = g.good - ((abs(more) <= length * V(longest_shift)) & ((!g.crosses) | to_stop.converged()));
      if (pass == 2 || !any(far)) {
        g.good = g.good - far;
        g.time = g.time + more;
        at.v = motion::velocity_after(more, at.v, at.a, d);
        at.y = select(g.crosses, oscillators_.displacement_at(stop, at.v), at.y);
        at.phase = motion::turned(at.phase, tiny_turn(row(lanes_.nu) * more));
        at.a = oscillators_.acceleration(at.y, at.v, at.phase);
        return at;
      }
      g.time = select(far, lesser(greater(g.time + more, zero), length), g.time);
    }
  }

  /// Takes the unproved lanes to their contact, or short of it, proves the flight up to there, and reverses the
  /// velocity in a contact (eq. 4), or goes over to contact with a soft stop or to the motion after it.
  [[gnu::always_inline]] inline void contact() {
    lanes_.refined += static_cast<double>(V::size);
    const V zero(0.0), one(1.0), length = row(lanes_.step);
    const Mask upper = nearer_upper();
    const V sign = select(upper, one, V(-1.0)), stop = select(upper, row(lanes_.upper), row(lanes_.lower));
    ContactGuess g = guess_contact(bound_.error, sign, stop, length);
    if constexpr (observes) end_flights(g);
    LaneMotion<V> at = refine_contact(stop, length, g);
    const V change = sixth_power(g.time * row(lanes_.inverse_step)), error = bound_.error * change;
    const Bernstein<V> path = hermite(oscillators_.ends(here_, at, g.time));
    Interval<V> range = enclosure(path, error);
    const V low = select(g.crosses, range.low, lesser(path[6], range.low));
    const V high = select(g.crosses, range.high, greater(path[6], range.high));
    g.good = g.good & (g.time > zero) & (g.time < length) & (low >= row(lanes_.lower) + bound_.rounding) &
             (high <= row(lanes_.upper) - bound_.rounding);
    if constexpr (E.soft) g.good = g.good & phases_.keeps_ahead(here_, at, g.time, bound_, change);
    const ConstantRestitution<V> law{select(upper, row(lanes_.restitution_upper), row(lanes_.restitution_lower))};
    Mask reverses = g.crosses;
    if constexpr (E.soft) reverses = reverses - phases_.change_at(upper);
    const V before = at.v, jump = select(reverses, law.jump(before), zero);
    const V after = select(reverses, law.after(before), before);
    const V a = neg_mul_add(row(lanes_.twice_h), jump, at.a);
    V away = law.after(-sign * before), back = sign * a;  // speed and acceleration after the contact
    if constexpr (E.soft) away = select(reverses, away, sign * before), back = select(reverses, back, -back);
    const Mask bounces =
        (sign * before > abs(at.a * length) * V(grazing)) & (away > back * length * V(shortest_flight));
    const Mask passes = left_ <= g.time, waits = unproved_ & passes & arrived_;
    g.good = (g.good & ((!g.crosses) | bounces)) - waits;
    range.include(at.y);
    if constexpr (observes)
      g.good = observers_.flight(g.good - (g.crosses & passes & stops_short_), here_, at, g.time, error, path, range);
    at.v = after, at.a = a;
    const Mask met = g.good & g.crosses;
    if constexpr (observes) {
      const Mask over = (passes | arrived_) & (row(lanes_.ends_here) > zero);  // its period is over already
      observers_.impact(met, met - over, upper, at, before, jump);
    }
    if (any(g.good & passes)) pass_sections(g.good & passes, at.phase);
    Mask hits = met;
    if constexpr (E.soft) {
      shrink(g.good, g.time);
      hits = met & (reverses | phases_.between_stops());
      if (any(met - reverses)) change_phase(met - reverses, upper, at);
    }
    at.free = oscillators_.free_part(at.y, at.v, at.phase);
    here_ = select(g.good, at, here_);
    left_ = select(g.good, left_ - g.time, left_);
    itinerary_ = select(hits, mul_add(itinerary_, V(3.0), select(upper, V(2.0), one)), itinerary_);
    oscillators_.put(lanes_.impacts, row(lanes_.impacts) + select(hits, one, zero));
    to_scalar_ = to_scalar_ | (unproved_ - (g.good | waits));
  }

  /// Records the lanes that pass a section on their flight from here to a phase, and corrects the clock, and the length
  /// of sine and cosine, by the errors that were found at the section before.
  void pass_sections(const Mask& arrives, SineCosine<V>& phase) {
    from_free_ = {select(arrives, here_.free.x, from_free_.x), select(arrives, here_.free.v, from_free_.v)};
    from_phase_ = {select(arrives, here_.phase.sine, from_phase_.sine),
                   select(arrives, here_.phase.cosine, from_phase_.cosine)};
    time_ = select(arrives, left_, time_);
    left_ = select(arrives, left_ + row(lanes_.to_next), left_);
    const V excess = select(arrives, row(lanes_.excess), V(0.0));
    phase = {neg_mul_add(excess, phase.sine, phase.sine), neg_mul_add(excess, phase.cosine, phase.cosine)};
    put_of(arrives, lanes_.section_itinerary, itinerary_);
    put_of(arrives, lanes_.section_impacts, row(lanes_.impacts));
    itinerary_ = select(arrives, V(0.0), itinerary_);
    if constexpr (E.soft) {
      put_of(arrives, lanes_.cushioned.section_log_area, log_area_);
      log_area_ = select(arrives, V(0.0), log_area_);
    }
    arrived_ = arrived_ | arrives;
  }

  /// Takes lanes to their next phase, once the sections that they have passed in the present one are reported.
  void change_phase(const Mask& changing, const Mask& upper, LaneMotion<V>& at) {
    const Mask unreported = changing & (arrived_ - reported_);
    if (any(unreported)) sections(unreported);
    reported_ = reported_ | unreported;
    phases_.change(changing, upper, at);
  }
  /// Counts the areas that soft stops shrink in a flight.
  void shrink(const Mask& flies, const V& time) {
    log_area_ = select(flies, neg_mul_add(row(lanes_.cushioned.shrinks), time, log_area_), log_area_);
  }

  void put_of(const Mask& m, LaneArray& r, const V& y) const { oscillators_.put(r, select(m, y, row(r))); }

  /// Reports displacement and velocity at the sections that some lanes have passed, and finds the errors of the clock
  /// and of the length of sine and cosine. The phase says when a section was passed.
  void sections(const Mask& of) {
    const V sine = row(lanes_.start_sine), cosine = row(lanes_.start_cosine);
    const SineCosine<V> phase = oscillators_.phase_after(from_phase_, time_);
    const V late = mul_sub(phase.sine, cosine, phase.cosine * sine) / row(lanes_.nu);
    const motion::FreeMotion<V> free = oscillators_.free_after(from_free_, time_ - late);
    V y = free.x + oscillators_.response().displacement(sine, cosine);
    V v = free.v + oscillators_.response().velocity(row(lanes_.nu), sine, cosine);
    if constexpr (E.soft)
      y = select(of, y + row(lanes_.cushioned.shift), row(lanes_.section_y)), v = select(of, v, row(lanes_.section_v));
    oscillators_.put(lanes_.section_y, y), oscillators_.put(lanes_.section_v, v);
    // half of an error, since the correction comes a section later
    const V half_excess = mul_add(phase.sine, phase.sine, mul_sub(phase.cosine, phase.cosine, V(1.0))) * V(0.25);
    const V to_next = neg_mul_add(V(0.5), late, row(lanes_.period));
    put_of(of, lanes_.to_next, to_next), put_of(of, lanes_.excess, half_excess);
  }

  void store() const {
    oscillators_.put(lanes_.free_x, here_.free.x), oscillators_.put(lanes_.free_v, here_.free.v);
    oscillators_.put(lanes_.sine, here_.phase.sine), oscillators_.put(lanes_.cosine, here_.phase.cosine);
    oscillators_.put(lanes_.y, here_.y), oscillators_.put(lanes_.v, here_.v), oscillators_.put(lanes_.a, here_.a);
    oscillators_.put(lanes_.time_to_section, left_), oscillators_.put(lanes_.itinerary, itinerary_);
    if constexpr (E.soft) oscillators_.put(lanes_.cushioned.log_area, log_area_);
    lanes_.arrived |= bits(arrived_) << first_, lanes_.to_scalar |= bits(to_scalar_) << first_;
  }

  BlockState& lanes_;
  std::size_t first_;
  LaneOscillators<V, E> oscillators_;
  LaneObservers<V, E> observers_;
  LanePhases<V, E> phases_;
  LaneMotion<V> here_;
  Bernstein<V> path_;  ///< the quantity that the bounds hold, in the step from here
  ErrorBound<V> bound_;
  V left_, itinerary_, log_area_;
  motion::FreeMotion<V> from_free_;  ///< beginning of the flight across a section
  SineCosine<V> from_phase_;
  V time_;       ///< from there to the section
  Mask active_;  ///< lanes that are not idle
  Mask none_, arrived_, to_scalar_;
  Mask below_upper_, above_lower_;
  Mask unproved_;     ///< lanes to be taken to a contact, or short of one
  Mask ending_;       ///< lanes whose observed time ends before
  Mask reported_;     ///< lanes whose section is reported already
  Mask stops_short_;  ///< lanes whose next section ends the observed time, and may not be overshot
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
template <class A, Effects E, bool observes>
void step_all(BlockState& lanes) {
  using V = Pair<A>;
  const FlushToZero<A> flush;
  for (std::size_t first = 0; first < LaneArray::width; first += V::size)
    StepBlock<V, step_effects(E), observes>(lanes, first).run();
}

}  // namespace clatter::lanes
