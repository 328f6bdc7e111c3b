#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/soft_stop.hpp"
#include "motion/walls.hpp"
#include "scene/displacement_bound.hpp"
#include "steady/observed_time.hpp"
#include "steady/time_settings.hpp"

namespace clatter::steady {

/// The end of motion with a loose mass that no force keeps up. What can't lose energy may go on for ever; all other
/// motion comes to a standstill, or comes ever closer to one.
class LooseStandstill {
 public:
  LooseStandstill(const Scene& scene, const TimeSettings& time)
      : scene_(scene),
        both_(as_one(scene)),
        period_(period_of(scene.oscillator)),
        most_(static_cast<double>(time.max_periods)),
        is_due_(loses(scene)) {
    const double speed = std::max(std::abs(scene.start.velocity), std::abs(scene.loose.velocity));
    least_ = time.tolerance *
             std::max({std::abs(scene.start.displacement), speed, std::abs(equilibrium_of(both_.oscillator))});
  }

  /// Whether something takes energy from motion.
  [[nodiscard]] bool is_due() const { return is_due_; }

  /// The final form of the motion, if it has it at a section, after so many: nothing moves, or is within the tolerance
  /// of it; or, by closed forms, both masses move as one for ever, which ends at their equilibrium if it is damped.
  [[nodiscard]] std::optional<ObservedTime> from(const motion::State<double>& state, double settled,
                                                 bool by_closed_forms) const {
    const motion::PlaceInHousing<double> loose = motion::place_in_housing(state, scene_.loose);
    const double hold = hold_at(loose.z);
    if (!(hold >= 0) || state.released || state.loose.released) return std::nullopt;
    const ObservedTime still{Status::periodic, state, 1.0, settled, FoundBy::standstill, settled};
    if (state.v == 0 && loose.w == 0 && is_held(state.x)) return still;
    if (has_friction(scene_.friction)) return std::nullopt;  // which holds it in the end
    const Oscillator o = around(state);
    const double y = state.x - equilibrium_of(o);
    if (is_due_ && is_below(o, y, std::max(std::abs(state.v), std::abs(loose.w)))) return still;
    if (!by_closed_forms || !state.loose.pressed || !(o.stiffness > 0)) return std::nullopt;
    return as_one_for_ever(state, settled, o, y, hold);
  }

 private:
  /// The main mass with the loose one that moves with it (eq. 71).
  [[nodiscard]] static Scene as_one(Scene scene) {
    const double eps = scene.loose.ratio, both = 1 + eps;
    Oscillator& o = scene.oscillator;
    o = {o.damping / both, 0.0, o.frequency, (o.load + eps * scene.loose.load) / both, o.stiffness / both};
    scene.stops = motion::stops_of_both(scene.stops, eps);
    scene.friction = motion::friction_of_both(scene.friction, eps);
    return scene;
  }
  [[nodiscard]] static bool loses(const Scene& scene) {
    const Stops& stops = scene.stops;
    const LooseMass& loose = scene.loose;
    const auto at = [&](Side side) {
      const auto takes = [side](const Stops& of) {
        return std::isfinite(side == Side::upper ? of.upper : of.lower) && takes_energy_at_rest(of, side);
      };
      return takes(stops) || takes(walls_of(loose));
    };
    return scene.oscillator.damping != 0 || has_friction(scene.friction) || has_loose_friction(loose) ||
           at(Side::lower) || at(Side::upper);
  }

  /// By how much wall and friction together can hold the loose mass at z, on a main mass that stands, more than they
  /// have to (eqs. 72 and 81), as an acceleration of it. A soft wall alone holds it at one place: how much nearer it is
  /// to that than what counts.
  [[nodiscard]] double hold_at(double z) const {
    const LooseMass& loose = scene_.loose;
    const double friction = loose.friction_static / loose.ratio;
    double load = loose.load;
    for (const Side side : {Side::lower, Side::upper}) {
      const auto wall = motion::soft_wall_at<double>(loose, side);
      const double place = side == Side::upper ? loose.upper : loose.lower;
      if (wall.side == Side::none && z == place) return friction + sign_of(side) * loose.load;
      if (wall.side == Side::none || !(sign_of(side) * (z - place) >= 0)) continue;
      const double rests_at = place + loose.ratio * loose.load / wall.stiffness;
      if (!has_loose_friction(loose) && sign_of(side) * loose.load > 0) return least_ - std::abs(z - rests_at);
      load -= wall.stiffness * (z - place) / loose.ratio;
    }
    return friction - std::abs(load);
  }
  /// Whether nothing moves a main mass that stands at x, with the loose one.
  [[nodiscard]] bool is_held(double x) const {
    const Stops& stops = both_.stops;
    const double force = constant_force(both_.oscillator, x);
    const auto by = [&](Side side, double stop) {
      return x == stop && !is_soft(stops, side) && sign_of(side) * force + both_.friction.static_level >= 0;
    };
    return by(Side::lower, stops.lower) || by(Side::upper, stops.upper) || sticks_for_good(both_, x) ||
           (force == 0 && soft_stop_beyond(stops, x) == Side::none);
  }
  /// Both masses as one, in contact with a soft stop or not.
  [[nodiscard]] Oscillator around(const motion::State<double>& state) const {
    Oscillator o = both_.oscillator;
    if (state.within == Side::none) return o;
    const auto stop = motion::soft_stop_at<double>(both_.stops, state.within);
    o.damping += stop.damping, o.load += stop.stiffness * stop.position, o.stiffness += stop.stiffness;
    return o;
  }
  /// Whether all that is left of a motion is too small to count.
  [[nodiscard]] bool is_below(const Oscillator& o, double y, double speed) const {
    if (o.stiffness < 0 || (o.stiffness == 0 && o.load != 0)) return false;
    return std::max(o.stiffness == 0 ? 0.0 : std::abs(y), speed) <= least_;
  }
  /// Motion of both as one, from y beside its equilibrium, that meets no stop, leaves no soft one, and is too slow to
  /// tear the loose mass off.
  [[nodiscard]] std::optional<ObservedTime> as_one_for_ever(const motion::State<double>& state, double settled,
                                                            const Oscillator& o, double y, double hold) const {
    constexpr double rounding = 1e-9;
    const double natural = natural_frequency(o), reach = norm(y, state.v / natural) * (1 + rounding);
    if (!((o.stiffness + 2 * o.damping * natural) * reach < hold)) return std::nullopt;
    const PhaseState now{y, state.v, 0.0, 1.0};
    if (state.within == Side::none) {
      if (!out_of_reach(o, now, both_.stops)) return std::nullopt;
    } else {
      const double stop = state.within == Side::upper ? both_.stops.upper : both_.stops.lower;
      if (o.damping != 0 || !state.pressed || !(reach < std::abs(equilibrium_of(o) - stop))) return std::nullopt;
    }
    if (o.damping == 0)
      return ObservedTime{Status::periodic, state, period_of(o) / period_, settled, FoundBy::closed_form, settled};
    const double end_at = settled + fading_time(o, transient_of(o, now), least_) / period_;
    if (!(end_at <= most_)) return std::nullopt;
    motion::State<double> end = state;
    end.x = equilibrium_of(o), end.v = 0, end.from_stop = Side::none, end.loose.may_part = false;
    return ObservedTime{Status::periodic, end, 1.0, settled, FoundBy::standstill, end_at};
  }

  const Scene& scene_;
  Scene both_;     ///< with the masses as one
  double period_;  ///< in which runs are counted
  double most_;    ///< such periods
  bool is_due_;
  double least_ = 0;  ///< displacements and velocities up to this size count as 0
};

}  // namespace clatter::steady
