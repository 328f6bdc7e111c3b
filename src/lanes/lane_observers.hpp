#pragma once

#include "lanes/lane_motion.hpp"

namespace clatter::lanes {

/// The observers of flights and impacts for the lanes of a vector, as those of the scalar loop.
template <class V>
class LaneObservers {
  using Mask = typename V::Mask;

 public:
  LaneObservers(BlockState& lanes, std::size_t first, const ClosedForm<V>& motions)
      : lanes_(lanes),
        motions_(motions),
        y_{V::load(lanes.y_low.lane + first), V::load(lanes.y_high.lane + first)},
        v_{V::load(lanes.v_low.lane + first), V::load(lanes.v_high.lane + first)} {}

  /// Observes a flight of `length` steps whose displacement lies within `range`. Returns the lanes for which its
  /// extrema are certain; for the others nothing is recorded.
  [[gnu::always_inline]] Mask flight(const Mask& active, const LaneMotion<V>& from, const LaneMotion<V>& to,
                                     const V& length, const ErrorBound<V>& uncertainty, const Interval<V>& range) {
    if (!lanes_.extrema) return active;
    const V slack = uncertainty.rounding * 0.5, part = sixth_power(length),
            error_v = motions_.error_v(uncertainty) * part;
    const HermiteData<V> v =
        HermiteData<V>::scaled({from.v, from.a, motions_.jerk(from), to.v, to.a, motions_.jerk(to)}, length);
    Interval<V> new_y = y_, new_v = v_;
    new_y.include(to.y), new_v.include(to.v);
    const V forced = row(lanes_.amplitude);  // the flight can't exceed response plus free part at their largest
    const Mask open_y = active & !within(inside(range, forced + uncertainty.free), new_y, slack);
    const Mask open_v = active & !within(inside(enclosure(v, error_v),
                                                fma(uncertainty.free, row(lanes_.step), forced * row(lanes_.angle))),
                                         new_v, slack);
    Mask sure = active;
    if (any(open_y)) {
      const HermiteData<V> y = HermiteData<V>::scaled({from.y, from.v, from.a, to.y, to.v, to.a}, length);
      const auto jet = [](const LaneMotion<V>& m, const Jet<V>& j) {
        return FourDerivatives{m.y, m.v, m.a, j.d3, j.d4};
      };
      sure = sure & search(open_y, new_y, y, from, length, uncertainty.error * part, slack, lanes_.reference_y, jet);
    }
    if (any(open_v)) {
      const auto jet = [](const LaneMotion<V>& m, const Jet<V>& j) {
        return FourDerivatives{m.v, m.a, j.d3, j.d4, j.d5};
      };
      sure = sure & search(open_v, new_v, v, from, length, error_v, slack, lanes_.reference_v, jet);
    }
    take(sure, new_y, new_v);
    return sure;
  }

  /// Observes an impact of the lanes `met`, with their motion `at` just after it; those that are `counted` are within
  /// the observed time.
  void impact(const Mask& met, const Mask& counted, const Mask& upper, const LaneMotion<V>& at, const V& before,
              const V& jump) {
    Interval<V> with_after = v_;
    with_after.include(at.v);
    take(met, y_, with_after);
    if (lanes_.harmonics > 0) add_jump(counted, jump, at);
    if (!lanes_.counts) return;
    const V zero(0.0);
    const V earlier = row(lanes_.count[0]) + row(lanes_.count[1]);
    const Mask first = counted & (earlier <= zero);
    put(lanes_.first_before, select(first, before, row(lanes_.first_before)));
    for (const std::size_t stop : {0u, 1u}) {
      const Mask here = stop == 1 ? counted & upper : counted & !upper;
      const V count = row(lanes_.count[stop]);
      const Mask first_here = here & (count <= zero);
      put(lanes_.before[stop], select(first_here, before, row(lanes_.before[stop])));
      put(lanes_.after[stop], select(first_here, at.v, row(lanes_.after[stop])));
      put(lanes_.count[stop], count + select(here, V(1.0), zero));
    }
  }

  void store() const {
    put(lanes_.y_low, y_.low), put(lanes_.y_high, y_.high), put(lanes_.v_low, v_.low), put(lanes_.v_high, v_.high);
  }

 private:
  /// A function at an instant, and its first four derivatives.
  struct FourDerivatives {
    V value, slope, curvature, third, fourth;
  };

  V row(const LaneArray& r) const { return motions_.row(r); }
  void put(LaneArray& r, const V& y) const { motions_.put(r, y); }

  void take(const Mask& m, const Interval<V>& y, const Interval<V>& v) {
    y_ = {select(m, y.low, y_.low), select(m, y.high, y_.high)};
    v_ = {select(m, v.low, v_.low), select(m, v.high, v_.high)};
  }

  static Interval<V> inside(const Interval<V>& range, const V& most) {
    return {max(range.low, -most), min(range.high, most)};
  }
  static Mask within(const Interval<V>& part, const Interval<V>& whole, const V& slack) {
    return (part.low >= whole.low - slack) & (part.high <= whole.high + slack);
  }

  /// Widens a range, in the open lanes, by the extremum of a flight whose enclosure exceeds it; returns the lanes whose
  /// enclosure is then within it, and all that were not open. `ends` has the searched function over the flight,
  /// `derivatives` at an instant. A flight equal, to rounding, to the one in which the extremum was found isn't
  /// searched again.
  template <class Derivatives>
  [[gnu::noinline]] Mask search(const Mask& open, Interval<V>& range, const HermiteData<V>& ends,
                                const LaneMotion<V>& from, const V& length, const V& error, const V& slack,
                                BlockState::Reference* references, const Derivatives& derivatives) {
    const V zero(0.0), one(1.0);
    const Interval<V> bounds = enclosure(ends, error);
    const V over = bounds.high - range.high, under = range.low - bounds.low;
    const Mask high = !(over <= slack), low = !(under <= slack), upward = over > under;  // the farther one first
    const Mask known = (!(high & low)) & (like(references[0], from, length, slack) | !low) &
                       (like(references[1], from, length, slack) | !high);
    const Mask left = open & !known;
    if (!any(left)) return (!open) | known;
    const V sign = select(upward, -one, one);  // a greatest value is a least one of the negative
    const HermiteData<V> below{sign * ends.y0, sign * ends.v0, sign * ends.a0,
                               sign * ends.y1, sign * ends.v1, sign * ends.a1};
    V part = min(max(QuinticHermite<V>(below).least(), zero), one), more;
    FourDerivatives at;
    for (int pass = 0; pass < 3; ++pass) {
      const LaneMotion<V> near = motions_.after(from, part * length);
      at = derivatives(near, motions_.jet(near));
      more = -at.slope / at.curvature;
      more = fnma(at.third / at.curvature * 0.5, more * more, more);
      const Mask far = left & !(abs(more) <= V(0x1p-10));
      if (!any(far)) break;
      part = select(far, min(max(part + more / length, zero), one), part);
    }
    part = part + more / length;
    const V cubic = fma(more, at.fourth * (1.0 / 24), at.third * (1.0 / 6));
    const V extremum = fma(more, fma(more, fma(more, cubic, at.curvature * 0.5), at.slope), at.value);
    const V bend = fma(more, at.third, at.curvature) * (length * length), rest = one - part;
    Interval<V> wider = range;
    wider.include(extremum);
    const HermiteData<V> before = HermiteData<V>::scaled({ends.y0, ends.v0, ends.a0, extremum, zero, bend}, part);
    const HermiteData<V> after = HermiteData<V>::scaled({extremum, zero, bend, ends.y1, ends.v1, ends.a1}, rest);
    const Mask found = left & (abs(more) <= V(0x1p-10)) & (part > zero) & (part < one) &
                       within(enclosure(before, error * sixth_power(part)), wider, slack) &
                       within(enclosure(after, error * sixth_power(rest)), wider, slack);
    refer(references[0], found & !upward, from, length), refer(references[1], found & upward, from, length);
    range = {select(found, wider.low, range.low), select(found, wider.high, range.high)};
    return (!open) | known | found;
  }

  /// Whether a flight begins as the reference did, and lasts no longer: then it stays as close to the reference as it
  /// began, since their difference is a free motion and a constant shift of the forcing phase.
  Mask like(const BlockState::Reference& r, const LaneMotion<V>& from, const V& length, const V& slack) const {
    const V free = fma(abs(from.w - row(r.w)), row(lanes_.rate), abs(from.p - row(r.p)));
    const V phase = abs(from.sine - row(r.sine)) + abs(from.cosine - row(r.cosine));
    return (fma(phase, row(lanes_.forced_size), free) <= slack * 0.5) & (length <= row(r.length) + V(0x1p-44));
  }
  void refer(BlockState::Reference& r, const Mask& m, const LaneMotion<V>& from, const V& length) const {
    put(r.p, select(m, from.p, row(r.p))), put(r.w, select(m, from.w, row(r.w)));
    put(r.sine, select(m, from.sine, row(r.sine))), put(r.cosine, select(m, from.cosine, row(r.cosine)));
    put(r.length, select(m, length, row(r.length)));
  }

  /// Adds jumps of the velocity times e^{-ik nu tau} to the sums of the harmonics (eq. 38).
  void add_jump(const Mask& counted, const V& jump, const LaneMotion<V>& at) const {
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

  BlockState& lanes_;
  const ClosedForm<V>& motions_;
  Interval<V> y_, v_;
};

}  // namespace clatter::lanes
