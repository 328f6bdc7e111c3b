#pragma once

#include "lanes/lane_motion.hpp"
#include "math/quintic.hpp"
#include "observables/harmonics/velocity_jumps.hpp"

namespace clatter::lanes {

/// A flight of some lanes within a step: its beginning, its end, and its time.
template <class V>
struct LaneFlight {
  struct End {
    V y, v, a, cosine;  ///< the motion, and the cosine of the forcing phase
  };
  LaneMotion<V> from;
  End to;
  V length;
};

template <class V>
[[nodiscard]] V sixth_power(const V& y) {
  const V square = y * y;
  return square * square * square;
}

/// The observers of flights and impacts for the lanes of a vector, as those of the scalar loop.
template <class V, Effects E>
class LaneObservers {
  using Mask = clatter::Mask<V>;

 public:
  explicit LaneObservers(const LaneOscillators<V, E>& oscillators)
      : oscillators_(oscillators), lanes_(oscillators.lanes()) {}

  /// Observes a flight. Returns the lanes for which its extrema are certain; for the others nothing is recorded. Most
  /// flights stay within the extrema found so far, so that is all that is looked at first.
  [[gnu::always_inline]] inline Mask flight(const Mask& active, const LaneMotion<V>& from, const LaneMotion<V>& to,
                                            const V& length, const V& error, const Bernstein<V>& y,
                                            const Interval<V>& range) {
    if (!lanes_.extrema) return active;
    const Interval<V> slope = slope_enclosure(y, error);
    const V v_low = row(lanes_.v_low), v_high = row(lanes_.v_high);
    const Mask y_inside = (range.low >= row(lanes_.y_low)) & (range.high <= row(lanes_.y_high));
    const Mask v_inside =
        (slope.low >= v_low * length) & (slope.high <= v_high * length) & (to.v >= v_low) & (to.v <= v_high);
    const Mask open = active - (y_inside & v_inside);
    if (!any(open)) return active;
    const LaneFlight<V> flight{from, {to.y, to.v, to.a, to.phase.cosine}, length};
    return active & ((!open) | look_closer(oscillators_, open, flight));
  }

  /// Observes an impact of the lanes `met`, with their motion `at` just after it; those that are `counted` are within
  /// the observed time.
  void impact(const Mask& met, const Mask& counted, const Mask& upper, const LaneMotion<V>& at, const V& before,
              const V& jump) {
    Interval<V> v{row(lanes_.v_low), row(lanes_.v_high)};
    if (any(met & ((at.v < v.low) | (at.v > v.high)))) {
      v.include(at.v);
      keep(met, v, lanes_.v_low, lanes_.v_high);
    }
    if (lanes_.harmonics > 0) add_jump(counted, jump, at.phase);
    if (lanes_.counts) count(counted, upper, before, at.v);
  }

 private:
  V row(const LaneArray& r) const { return oscillators_.row(r); }
  void put(LaneArray& r, const V& y) const { oscillators_.put(r, y); }
  void keep(const Mask& m, const Interval<V>& range, LaneArray& low, LaneArray& high) {
    put(low, select(m, range.low, row(low))), put(high, select(m, range.high, row(high)));
  }

  static Interval<V> inside(const Interval<V>& range, const V& most) {
    return {greater(range.low, -most), lesser(range.high, most)};
  }
  static Mask within(const Interval<V>& part, const Interval<V>& whole, const V& slack) {
    return (part.low >= whole.low - slack) & (part.high <= whole.high + slack);
  }

  /// A function at an instant, and its first four derivatives.
  struct FourDerivatives {
    V value, slope, curvature, third, fourth;
  };

  /// Widens the ranges of the open lanes by a flight that may exceed them; returns those for which that is certain.
  [[gnu::noinline]] static Mask look_closer(LaneOscillators<V, E> oscillators, Mask open, LaneFlight<V> flight) {
    return LaneObservers(oscillators).widen(open, flight);
  }
  Mask widen(const Mask& open, const LaneFlight<V>& flight) {
    const LaneMotion<V>& from = flight.from;
    const typename LaneFlight<V>::End& to = flight.to;
    const ErrorBound<V> bound = oscillators_.uncertainty(from.free);
    const V change = sixth_power(flight.length * row(lanes_.inverse_step));  // of the bounds, to those of this flight
    const V error = bound.error * change, error_v = oscillators_.error_v(bound) * change;
    Interval<V> y{row(lanes_.y_low), row(lanes_.y_high)}, v{row(lanes_.v_low), row(lanes_.v_high)};
    y.include(to.y), v.include(to.v);
    const V slack = bound.rounding * V(0.5), slack_v = slack * row(lanes_.inverse_step);
    const HermiteData<V> y_ends = HermiteData<V>::over(flight.length, {from.y, from.v, from.a, to.y, to.v, to.a});
    const HermiteData<V> v_ends =
        HermiteData<V>::over(flight.length, {from.v, from.a, oscillators_.jerk(from.v, from.a, from.phase.cosine), to.v,
                                             to.a, oscillators_.jerk(to.v, to.a, to.cosine)});
    // the flight can't exceed response plus free part at their largest
    const V forced = row(lanes_.amplitude), forced_v = forced * row(lanes_.nu);
    const Mask open_y = open - within(inside(enclosure(hermite(y_ends), error), forced + bound.free), y, slack);
    const Mask open_v = open - within(inside(enclosure(hermite(v_ends), error_v), forced_v + bound.free), v, slack_v);
    Mask sure = open;
    if (any(open_y)) {
      const auto jet = [](const LaneMotion<V>& m, const auto& d) { return FourDerivatives{m.y, m.v, m.a, d.d3, d.d4}; };
      sure = sure & search(open_y, y, y_ends, flight, error, slack, lanes_.reference_y, jet);
    }
    if (any(open_v)) {
      const auto jet = [](const LaneMotion<V>& m, const auto& d) {
        return FourDerivatives{m.v, m.a, d.d3, d.d4, d.d5};
      };
      sure = sure & search(open_v, v, v_ends, flight, error_v, slack_v, lanes_.reference_v, jet);
    }
    keep(sure, y, lanes_.y_low, lanes_.y_high), keep(sure, v, lanes_.v_low, lanes_.v_high);
    return sure;
  }

  /// Widens a range, in the open lanes, by the extremum of a flight whose enclosure exceeds it; returns the lanes whose
  /// enclosure is then within it, and all that were not open. `ends` has the searched function over the flight,
  /// `derivatives` at an instant. A flight equal, to rounding, to the one in which the extremum was found isn't
  /// searched again.
  template <class Derivatives>
  Mask search(const Mask& open, Interval<V>& range, const HermiteData<V>& ends, const LaneFlight<V>& flight,
              const V& error, const V& slack, BlockState::Reference* references, const Derivatives& derivatives) {
    const V zero(0.0), one(1.0), &length = flight.length;
    const Bernstein<V> inner = hermite(ends);
    const Interval<V> bounds = enclosure(inner, error);
    const V over = bounds.high - range.high, under = range.low - bounds.low;
    const Mask high = !(over <= slack), low = !(under <= slack), upward = over > under;  // the farther one first
    const Mask known =
        (!(high & low)) & (like(references[0], flight, slack) | !low) & (like(references[1], flight, slack) | !high);
    const Mask left = open - known;
    if (!any(left)) return (!open) | known;
    const V sign = select(upward, -one, one);  // a greatest value is a least one of the negative
    Bernstein<V> below;
    for (std::size_t i = 0; i < below.size(); ++i) below[i] = sign * inner[i];
    const Quintic<V> quintic(below);
    V part = lesser(greater(quintic.least(below), zero), one), more;
    FourDerivatives at;
    for (int pass = 0; pass < 3; ++pass) {
      const LaneMotion<V> near = oscillators_.after(flight.from, part * length);
      at = derivatives(near, oscillators_.derivatives(near));
      more = -at.slope / at.curvature;
      more = neg_mul_add(at.third / at.curvature * V(0.5), more * more, more);
      const Mask far = left - (abs(more) <= row(lanes_.step) * V(longest_shift));
      if (!any(far)) break;
      part = select(far, lesser(greater(part + more / length, zero), one), part);
    }
    part = part + more / length;
    const V cubic = mul_add(more, at.fourth * V(1.0 / 24), at.third * V(1.0 / 6));
    const V extremum = mul_add(more, mul_add(more, mul_add(more, cubic, at.curvature * V(0.5)), at.slope), at.value);
    const V bend = mul_add(more, at.third, at.curvature) * (length * length), rest = one - part;
    Interval<V> wider = range;
    wider.include(extremum);
    const auto before = HermiteData<V>::over(part, {ends.y0, ends.v0, ends.a0, extremum, zero, bend});
    const auto after = HermiteData<V>::over(rest, {extremum, zero, bend, ends.y1, ends.v1, ends.a1});
    const Mask found = left & (abs(more) <= row(lanes_.step) * V(longest_shift)) & (part > zero) & (part < one) &
                       within(enclosure(hermite(before), error * sixth_power(part)), wider, slack) &
                       within(enclosure(hermite(after), error * sixth_power(rest)), wider, slack);
    refer(references[0], found - upward, flight), refer(references[1], found & upward, flight);
    range = {select(found, wider.low, range.low), select(found, wider.high, range.high)};
    return (!open) | known | found;
  }
  static constexpr double longest_shift = 0x1p-10;  ///< of an extremum, in steps

  /// Whether a flight begins as the reference did, and lasts no longer: then it stays as close to the reference as the
  /// bound says, since their difference is a free motion and a constant shift of the forcing phase.
  Mask like(const BlockState::Reference& r, const LaneFlight<V>& flight, const V& slack) const {
    const LaneMotion<V>& from = flight.from;
    const V free = oscillators_.size({from.free.x - row(r.free_x), from.free.v - row(r.free_v)});
    const V phase = abs(from.phase.sine - row(r.sine)) + abs(from.phase.cosine - row(r.cosine));
    return (mul_add(phase, row(lanes_.forced_size), free) <= slack * V(0.5)) &
           (flight.length <= row(r.length) * V(1 + 0x1p-44));
  }
  void refer(BlockState::Reference& r, const Mask& m, const LaneFlight<V>& flight) const {
    const LaneMotion<V>& from = flight.from;
    put(r.free_x, select(m, from.free.x, row(r.free_x))), put(r.free_v, select(m, from.free.v, row(r.free_v)));
    put(r.sine, select(m, from.phase.sine, row(r.sine))), put(r.cosine, select(m, from.phase.cosine, row(r.cosine)));
    put(r.length, select(m, flight.length, row(r.length)));
  }

  /// Adds jumps of the velocity to the sums of the harmonics.
  void add_jump(const Mask& counted, const V& jump, const SineCosine<V>& at) const {
    const V s0 = row(lanes_.start_sine), c0 = row(lanes_.start_cosine), zero(0.0);
    const SineCosine<V> since{select(counted, mul_sub(at.sine, c0, at.cosine * s0), zero),
                              select(counted, mul_add(at.cosine, c0, at.sine * s0), zero)};
    observables::over_harmonics(select(counted, jump, zero), since, lanes_.harmonics,
                                [&](std::size_t k, const V& real, const V& imaginary) {
                                  put(lanes_.jump_real[k], row(lanes_.jump_real[k]) + real);
                                  put(lanes_.jump_imaginary[k], row(lanes_.jump_imaginary[k]) + imaginary);
                                });
  }

  /// Counts impacts, and notes the first and the fastest one on each stop.
  void count(const Mask& counted, const Mask& upper, const V& before, const V& after) const {
    const V zero(0.0);
    const Mask first = counted & (row(lanes_.count[0]) + row(lanes_.count[1]) <= zero);
    put(lanes_.first_before, select(first, before, row(lanes_.first_before)));
    for (const std::size_t stop : {0u, 1u}) {
      const Mask here = stop == 1 ? counted & upper : counted - upper;
      const V so_far = row(lanes_.count[stop]);
      const Mask first_here = here & (so_far <= zero);
      put(lanes_.before[stop], select(first_here, before, row(lanes_.before[stop])));
      put(lanes_.after[stop], select(first_here, after, row(lanes_.after[stop])));
      put(lanes_.fastest[stop], greater(row(lanes_.fastest[stop]), select(here, abs(before), zero)));
      put(lanes_.count[stop], so_far + select(here, V(1.0), zero));
    }
  }

  LaneOscillators<V, E> oscillators_;
  BlockState& lanes_;
};

}  // namespace clatter::lanes
