#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "motion/event.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/soft_stop.hpp"
#include "observables/energy/energy.hpp"
#include "observables/energy/quadrature.hpp"
#include "scene/phased_force.hpp"

namespace clatter::observables {

/// The ledger beside stops that move by themselves, in the frame of the base (eq. 93): a stop that moves works on the
/// mass, by its force times its velocity, and what impacts and its damper take counts by velocities relative to it.
class MovingStopsEnergy {
 public:
  explicit MovingStopsEnergy(const ObservedSpan& span)
      : oscillator_(span.scene.oscillator), stops_(span.scene.stops), phase_(span.scene.start.phase) {}

  template <class A>
  void arc(const A& arc, double begins, double length) {
    const Side held = std::exchange(held_, Side::none);
    if (!(length > 0)) return;
    const Oscillator& o = oscillator_;
    const motion::Motion<double> first = arc.start(), last = arc.at(length);
    see(first.x, first.v, begins);
    Side side = held;
    double damper = 0.0;
    if constexpr (A::effects.stiffness)
      if (const auto& stop = arc.constants().stop; stop.side != Side::none) side = stop.side, damper = stop.damping;
    double force_work = 0, squares = 0, stop_work = 0, impulse = 0, relative_squares = 0;
    evaluations_ +=
        over_panels<20>(length, pace_of(arc.constants()).with(o.frequency), 2, [&](double s, double weight) {
          const motion::Motion<double> m = arc.at(s);
          const double force = force_at(o.forcing, o.shape, phase_ + o.frequency * (begins + s)).value;
          force_work += weight * force * m.v, squares += weight * m.v * m.v;
          if (side == Side::none) return;
          const double carried = velocity_of(side, begins + s),
                       push = m.a + 2 * o.damping * m.v - constant_force(o, m.x) - force;
          stop_work += weight * push * carried, impulse += weight * std::abs(push);
          relative_squares += weight * (m.v - carried) * (m.v - carried);
        });
    work_ += force_work + stop_work, loss_damping_ += 2 * o.damping * squares;
    if (side != Side::none) impulse_[index_of(side)] += impulse;
    if (damper > 0) loss_impact_[index_of(side)] += 2 * damper * relative_squares;
    if (side == Side::none) lose_stored(first.x, begins, last.x, begins + length);
  }
  void event(const motion::Event& event) {
    if (event.lasts()) held_ = event.side;
    if (!event.lasts() && event.kind != motion::Event::Kind::impact) return;
    if (!event.lasts()) see(event.place, event.before + event.stop.velocity, event.time);
    const std::size_t stop = index_of(event.side);
    const double change = event.after - event.before;
    loss_impact_[stop] -= change * (event.before + event.after) / 2;
    work_ += event.stop.velocity * change;
    impulse_[stop] += event.lasts() ? -sign_of(event.side) * change : std::abs(change);  // a chatter gives it back
  }

  [[nodiscard]] Energy::Values finish(const ObservedSpan& span, double x, double v) const {
    const Start begin = begin_.value_or(Start{x, v, 0.0});
    const double load_work = oscillator_.load * (x - begin.x), lost = loss_impact_[0] + loss_impact_[1];
    Energy::Values values{.work_in = work_ + (span.periodic ? 0.0 : load_work), .loss_damping = loss_damping_};
    values.loss_impact = loss_impact_, values.impulse = impulse_, values.loss_friction = 0.0;
    const double growth = (v - begin.v) * (v + begin.v) / 2 +
                          oscillator_.stiffness * (x - begin.x) * (x + begin.x) / 2 + stored(x, span.total) -
                          stored(begin.x, begin.time);
    values.energy_residual = work_ + load_work - loss_damping_ - lost - growth;
    values.impact_power = lost / span.total;
    return values;
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  struct Start {
    double x, v, time;
  };
  void see(double x, double v, double time) {
    if (!begin_) begin_ = Start{x, v, time};
  }
  [[nodiscard]] StopsNow stops_at(double time) const {
    return {stops_, oscillator_.frequency, phase_ + oscillator_.frequency * time};
  }
  [[nodiscard]] double velocity_of(Side side, double time) const {
    const StopsNow stops = stops_at(time);
    return side == Side::upper ? stops.velocity_upper : stops.velocity_lower;
  }
  /// The energy of the spring of a soft stop beyond whose place a mass is.
  [[nodiscard]] double stored(double x, double time) const {
    const StopsNow stops = stops_at(time);
    const Side side = soft_stop_beyond(stops, x);
    if (side == Side::none) return 0.0;
    const auto stop = motion::soft_stop_at<double>(stops, side);
    return stop.stiffness * (x - stop.position) * (x - stop.position) / 2;
  }
  /// A stop that the mass outruns loses that energy as it relaxes.
  void lose_stored(double x, double time, double to, double end) {
    const double before = stored(x, time), after = stored(to, end);
    for (const auto& [place, at, energy, sign] : {std::tuple{x, time, before, 1}, std::tuple{to, end, after, -1}})
      if (const Side side = soft_stop_beyond(stops_at(at), place); side != Side::none)
        loss_impact_[index_of(side)] += sign * energy;
  }

  Oscillator oscillator_;
  Stops stops_;
  double phase_;            ///< of the force at the beginning of the observed time
  Side held_ = Side::none;  ///< the stop on which the next arc shows the mass
  std::optional<Start> begin_{};
  double work_ = 0, loss_damping_ = 0;
  std::array<double, 2> loss_impact_{}, impulse_{};  ///< [stop]
  double evaluations_ = 0;
};

}  // namespace clatter::observables
