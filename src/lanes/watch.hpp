#pragma once

#include "lanes/motion.hpp"

namespace clatter {

/// What is observed of the flights and impacts of some lanes: the observers of the scalar kernel, in lanes.
template <class V>
class Watch {
  using Mask = typename V::Mask;

 public:
  Watch(Lanes& lanes, std::size_t first, const Motions<V>& motions)
      : lanes_(lanes),
        motions_(motions),
        y_{V::load(lanes.y_low.lane + first), V::load(lanes.y_high.lane + first)},
        v_{V::load(lanes.v_low.lane + first), V::load(lanes.v_high.lane + first)} {}

  /// A flight from one instant to another; of a step it is the part `length`. Returns the lanes for which its extrema
  /// are sure; of the others nothing is noted.
  Mask flight(const Mask& active, const Instant<V>& from, const Instant<V>& to, const V& length,
              const Uncertainty<V>& uncertainty) {
    if (!lanes_.extrema) return active;
    const V part = sixth_power(length);
    const Ends<V> y{from.y, from.v, from.a, to.y, to.v, to.a};
    const Ends<V> v{from.v, from.a, motions_.jerk(from), to.v, to.a, motions_.jerk(to)};
    Range<V> new_y = y_, new_v = v_;
    new_y.include(to.y), new_v.include(to.v);
    const auto displacement = [](const Instant<V>& m, const Jet<V>& jet) { return Course{m.y, m.v, m.a, jet.d3}; };
    const auto velocity = [](const Instant<V>& m, const Jet<V>& jet) {
      return Course{m.v, m.a, jet.d3, jet.d4};
    };
    const Mask sure =
        active & search(active, new_y, y, from, length, uncertainty.error * part, uncertainty.rounding, displacement) &
        search(active, new_v, v, from, length, motions_.error_v(uncertainty) * part, uncertainty.rounding * 2.0, velocity);
    take(sure, new_y, new_v);
    return sure;
  }

  /// An impact of the lanes `met` at an instant after it; those that are `counted` are in the observed time.
  void impact(const Mask& met, const Mask& counted, const Mask& upper, const Instant<V>& at, const V& before,
              const V& jump) {
    Range<V> with_after = v_;
    with_after.include(at.v);
    take(met, y_, with_after);
    const V zero(0.0);
    const V earlier = row(lanes_.count[0]) + row(lanes_.count[1]);
    const Mask first = counted & (earlier <= zero);
    put(lanes_.first_before, select(first, before, row(lanes_.first_before)));
    for (const std::size_t stop : {0, 1}) {
      const Mask here = stop == 1 ? counted & upper : counted & !upper;
      const V count = row(lanes_.count[stop]);
      const Mask first_here = here & (count <= zero);
      put(lanes_.before[stop], select(first_here, before, row(lanes_.before[stop])));
      put(lanes_.after[stop], select(first_here, at.v, row(lanes_.after[stop])));
      put(lanes_.count[stop], count + select(here, V(1.0), zero));
    }
    add_jump(counted, jump, at);
  }

  void store() const {
    put(lanes_.y_low, y_.low), put(lanes_.y_high, y_.high), put(lanes_.v_low, v_.low), put(lanes_.v_high, v_.high);
  }

 private:
  /// A function at an instant, and its first three derivatives.
  struct Course {
    V value, slope, curvature, third;
  };

  V row(const Row& r) const { return motions_.row(r); }
  void put(Row& r, const V& y) const { motions_.put(r, y); }

  void take(const Mask& m, const Range<V>& y, const Range<V>& v) {
    y_ = {select(m, y.low, y_.low), select(m, y.high, y_.high)};
    v_ = {select(m, v.low, v_.low), select(m, v.high, v_.high)};
  }

  static Mask within(const Range<V>& part, const Range<V>& whole, const V& slack) {
    return (part.low >= whole.low - slack) & (part.high <= whole.high + slack);
  }

  /// Widens a range by the extremum of a flight where its enclosure passes that; sure are the lanes in which then
  /// nothing does. `derivatives` tells value, slope and curvature of what is searched, and one derivative more.
  template <class Derivatives>
  Mask search(const Mask& active, Range<V>& range, const Ends<V>& ends, const Instant<V>& from, const V& length,
              const V& error, const V& slack, const Derivatives& derivatives) {
    const Ends<V> scaled = Ends<V>::scaled(ends, length);
    const Range<V> bounds = enclosure(scaled, error);
    const Mask sure = within(bounds, range, slack);
    const Mask open = active & !sure;
    if (!any(open)) return sure;
    const V sign = select(bounds.high > range.high + slack, V(-1.0), V(1.0));  // of a greatest or a least value
    const Ends<V> below{sign * scaled.y0, sign * scaled.v0, sign * scaled.a0,
                        sign * scaled.y1, sign * scaled.v1, sign * scaled.a1};
    V there = min(max(Quintic<V>(below).least(), V(0.0)), V(1.0)) * length, more;
    Course at;
    for (int pass = 0; pass < 3; ++pass) {
      const Instant<V> near = motions_.after(from, there);
      at = derivatives(near, motions_.jet(near));
      more = -at.slope / at.curvature;
      const Mask far = open & !(abs(more) <= V(0x1p-10));
      if (!any(far)) break;
      there = select(far, min(max(there + more, V(0.0)), length), there);
    }
    there = there + more;
    const V extremum = fma(more, fma(more, fma(more, at.third * (1.0 / 6), at.curvature * 0.5), at.slope), at.value);
    const Mask turns = (abs(more) <= V(0x1p-10)) & (there > V(0.0)) & (there < length);
    Range<V> wider = range;
    wider.include(extremum);
    const V zero(0.0), bend = fma(more, at.third, at.curvature), rest = length - there, part = there / length,
                       rest_part = rest / length;
    const Ends<V> before = Ends<V>::scaled({ends.y0, ends.v0, ends.a0, extremum, zero, bend}, there);
    const Ends<V> after = Ends<V>::scaled({extremum, zero, bend, ends.y1, ends.v1, ends.a1}, rest);
    const Mask found = open & turns & within(enclosure(before, error * sixth_power(part)), wider, slack) &
                       within(enclosure(after, error * sixth_power(rest_part)), wider, slack);
    range = {select(found, wider.low, range.low), select(found, wider.high, range.high)};
    return sure | found;
  }

  /// Adds jumps of the velocity times e^{-ik nu tau} to the sums that make the harmonics.
  void add_jump(const Mask& counted, const V& jump, const Instant<V>& at) const {
    const V s0 = row(lanes_.start_sine), c0 = row(lanes_.start_cosine), zero(0.0);
    const V cosine = select(counted, fma(at.cosine, c0, at.sine * s0), zero);
    const V sine = select(counted, fms(at.sine, c0, at.cosine * s0), zero);
    V real = select(counted, jump, zero), imaginary = zero;
    for (std::size_t k = 0; k <= lanes_.harmonics; ++k) {
      put(lanes_.jump_real[k], row(lanes_.jump_real[k]) + real);
      put(lanes_.jump_imaginary[k], row(lanes_.jump_imaginary[k]) + imaginary);
      const V turned = fma(real, cosine, imaginary * sine);
      imaginary = fms(imaginary, cosine, real * sine);
      real = turned;
    }
  }

  Lanes& lanes_;
  const Motions<V>& motions_;
  Range<V> y_, v_;
};

}  // namespace clatter
