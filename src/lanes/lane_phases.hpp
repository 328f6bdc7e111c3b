#pragma once

#include <limits>

#include "lanes/lane_motion.hpp"
#include "math/bernstein.hpp"

namespace clatter::lanes {

/// The phases of a motion between soft stops, for the lanes of a vector: between the stops, in contact with one, or
/// beyond one's position without contact. A lane in a phase has that phase's constants in its rows.
template <class V, Effects E>
class LanePhases {
  using Mask = clatter::Mask<V>;

 public:
  explicit LanePhases(const LaneOscillators<V, E>& oscillators)
      : oscillators_(oscillators), rows_(oscillators.lanes().cushioned) {}

  [[nodiscard]] V phase() const { return row(rows_.phase); }
  [[nodiscard]] Mask between_stops() const { return phase() * phase() < V(1.0); }
  /// Lanes beyond the position of a stop that doesn't push them.
  [[nodiscard]] Mask outrunning() const { return phase() * phase() > V(2.0); }

  /// Lanes whose next step may come to their upper bound first, from those of which that holds between the stops.
  [[nodiscard]] Mask nearer_upper(const Mask& between) const {
    return (between & between_stops()) | (phase() < V(0.0));
  }
  /// Lanes that go over to another phase, and keep their velocity, where they come to their upper bound, or lower one.
  [[nodiscard]] Mask change_at(const Mask& upper) const {
    return (!between_stops()) | (select(upper, row(rows_.soft[1]), row(rows_.soft[0])) > V(0.0));
  }

  /// Whether a stop that the mass outruns stays behind on a flight: its force is negative all the way. Holds, too, of
  /// lanes in other phases.
  [[nodiscard]] Mask keeps_ahead(const LaneMotion<V>& from, const LaneMotion<V>& to, const V& length,
                                 const ErrorBound<V>& bound, const V& change) const {
    const Mask looked_at = outrunning();
    if (!any(looked_at)) return !looked_at;
    const BlockState& lanes = oscillators_.lanes();
    const Mask of_upper = phase() > V(0.0);
    const V stop = select(of_upper, row(lanes.lower), row(lanes.upper));
    const V r = select(of_upper, row(rows_.relaxation_of[1]), row(rows_.relaxation_of[0]));
    const V sign = select(of_upper, V(1.0), V(-1.0)), sign_r = sign * r;
    const auto force = [&](const LaneMotion<V>& m) {
      const V jerk = oscillators_.jerk(m.v, m.a, m.phase.cosine);
      return
          typename LaneOscillators<V, E>::Watched{mul_add(sign_r, m.v, sign * (m.y - stop)),
                                                  mul_add(sign_r, m.a, sign * m.v), mul_add(sign_r, jerk, sign * m.a)};
    };
    const auto begin = force(from), end = force(to);
    const auto path =
        hermite(HermiteData<V>::over(length, {begin.value, begin.rate, begin.bend, end.value, end.rate, end.bend}));
    const V error = mul_add(r, oscillators_.error_v(bound), bound.error) * change;
    const V rounding = bound.rounding * mul_add(r, V(4.0) * (V(1.0) + row(lanes.nu)), V(1.0));
    return (!looked_at) | ((enclosure(path, error).high < -rounding) & (end.value < -rounding));
  }

  /// Takes lanes to their next phase: a touch begins a contact, and the end of its force is the end of the contact,
  /// beyond the stop's position if the stop is damped. `at` has their motion, which ends with the one after it.
  void change(const Mask& changing, const Mask& upper, LaneMotion<V>& at) const {
    BlockState& lanes = oscillators_.lanes();
    const V zero(0.0), before = phase(), r = row(rows_.relaxation);
    const Mask touches = between_stops(), of_upper = (touches & upper) | (before > zero);
    const Mask stays_beyond = (before * before < V(2.0)) & (r > zero);
    const V next = select(touches, select(upper, V(1.0), V(-1.0)), select(stays_beyond, before + before, zero));
    oscillators_.put(rows_.phase, select(changing, next, before));
    const V depth = zero - r * at.v;  // where the force is 0
    load(changing, touches, of_upper);
    // between the stops the bounds are their positions; in contact it is the opposite bound that lies there
    const Mask at_upper = (of_upper - touches) | (touches - of_upper), outruns = changing & stays_beyond;
    const V infinity(std::numeric_limits<double>::infinity()), lowest = row(lanes.lower), highest = row(lanes.upper);
    const V stop = select(at_upper, highest, lowest);
    oscillators_.put(lanes.lower, select(outruns, select(of_upper, stop, -infinity), lowest));
    oscillators_.put(lanes.upper, select(outruns, select(of_upper, infinity, stop), highest));
    at.y = select(changing, stop + depth, at.y);
    at.a = select(changing, oscillators_.acceleration(at.y, at.v, at.phase), at.a);
  }

 private:
  V row(const LaneArray& r) const { return oscillators_.row(r); }

  /// Loads the constants of the contact that lanes go over to, or those of motion between the stops.
  void load(const Mask& changing, const Mask& touches, const Mask& of_upper) const {
    const auto present = rows_of_phase(oscillators_.lanes());
    for (std::size_t i = 0; i < present.size(); ++i) {
      const V contact = select(of_upper, row(rows_.of_phase[2][i]), row(rows_.of_phase[1][i]));
      const V next = select(touches, contact, row(rows_.of_phase[0][i]));
      oscillators_.put(*present[i], select(changing, next, row(*present[i])));
    }
  }

  LaneOscillators<V, E> oscillators_;
  BlockState::Cushioned& rows_;
};

}  // namespace clatter::lanes
