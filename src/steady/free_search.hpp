#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/displacement_bound.hpp"
#include "steady/free_period.hpp"
#include "steady/observed_time.hpp"
#include "steady/return_observer.hpp"
#include "steady/time_settings.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// Runs unforced motion until it returns to the same speed on the same stop, rotates freely, or stands still. If no
/// energy is lost, a method in closed form has its period from the start.
template <stepping::Integrator I>
class FreeSearch {
 public:
  FreeSearch(I& integrator, const Scene& scene, const TimeSettings& time, bool all_effects)
      : integrator_(integrator),
        scene_(scene),
        time_(time),
        all_effects_(all_effects),
        returns_(scene, time.tolerance) {}

  [[nodiscard]] ObservedTime run(motion::State<double> state) {
    const motion::State<double> start = state;
    const std::int64_t most = time_.max_periods;
    for (std::int64_t section = 0;; ++section) {
      const auto settled = static_cast<double>(section);
      if (escapes(scene_, state.x, state.v, {0.0, 1.0})) return escape(state, settled);
      if constexpr (I::effects.soft)
        if (const auto found = integrator_.is_rough() ? std::nullopt : pressed(state, settled)) return *found;
      if (stands_still(state)) return {Status::periodic, state, 1.0, settled, FoundBy::standstill, settled};
      if (I::in_closed_form && !all_effects_ && !integrator_.is_rough()) {
        const double turns = section == 0 && conservative() ? free_turns(start) : 0.0;
        if (turns > shortest) return {Status::periodic, start, turns, 0.0, FoundBy::energy, 0.0};
        if (const auto found = closed_form(state, section)) return *found;
      }
      if (section == most)
        return {Status::aperiodic, state, static_cast<double>(time_.window), settled, FoundBy::nothing};
      returns_.begin_period(integrator_.period());
      const stepping::Outcome outcome = advance_to_section(integrator_, state, state.periods, returns_);
      if (outcome != stepping::Outcome::completed) return {status_of(outcome), state, 0.0, settled, FoundBy::nothing};
      if (integrator_.holding_stop(state) || integrator_.is_rough() || (all_effects_ && section + 1 < most)) continue;
      const bool rotates = returns_.free_rotation() && state.within == Side::none;
      const double turns = rotates ? 1.0 : returns_.period() / integrator_.period();
      if (turns > 0)
        return {Status::periodic, returns_.conserved() ? start : state, turns, settled + 1, FoundBy::repetition,
                settled + 1};
    }
  }

 private:
  [[nodiscard]] bool stands_still(const motion::State<double>& state) const {
    const bool is_held = integrator_.holding_stop(state) || integrator_.sticks_for_good(state);
    return integrator_.is_rough() ? is_held : returns_.stands_still(state.x, state.v, is_held);
  }

  [[nodiscard]] bool conservative() const {
    const Stops& stops = integrator_.stops();
    if (I::effects.soft) return false;  // its period is no angle between two contacts
    const auto loses = [&](Side side) {
      const auto stop = motion::stop_at<double>(stops, side);
      return std::isfinite(stop.position) && stop.law.takes_energy();
    };
    return scene_.oscillator.damping == 0 && !loses(Side::lower) && !loses(Side::upper);
  }
  [[nodiscard]] double free_turns(const motion::State<double>& start) const {
    const Oscillator& o = scene_.oscillator;
    if (!(o.stiffness > 0)) return 0;
    const double rate = natural_frequency(o);  // 1 at k = 1
    return free_period<double>(equilibrium_of(o), integrator_.stops(), start.x, start.v / rate) /
           (rate * integrator_.period());
  }

  /// The final form of a motion that never leaves a soft stop any more: undamped, it goes round the equilibrium that it
  /// has there; damped, it comes to a standstill there.
  [[nodiscard]] std::optional<ObservedTime> pressed(const motion::State<double>& state, double settled) const {
    if (!state.pressed) return std::nullopt;
    return integrator_.in_contact(state.within, [&](const auto& constants) -> std::optional<ObservedTime> {
      const double y = state.offset - constants.balance;
      if (!(constants.k > 0 && norm(y, state.v / constants.natural) < std::abs(constants.balance))) return std::nullopt;
      if (constants.h == 0) {
        const double turns = 2 * pi<double>() / constants.natural / integrator_.period();
        return ObservedTime{Status::periodic, state, turns, settled, FoundBy::closed_form, settled};
      }
      if (!(std::max(std::abs(y), std::abs(state.v)) <= returns_.least())) return std::nullopt;
      return ObservedTime{Status::periodic, state, 1.0, settled, FoundBy::standstill, settled};
    });
  }

  /// The final form of a motion once no stop is in reach: free vibration, or the equilibrium if damping brings the
  /// motion there in time.
  [[nodiscard]] std::optional<ObservedTime> closed_form(const motion::State<double>& state,
                                                        std::int64_t section) const {
    const Oscillator& o = scene_.oscillator;
    if (!(o.stiffness > 0)) return std::nullopt;
    const PhaseState now{state.x - equilibrium_of(o), state.v, 0.0, 1.0};
    if (I::effects.stops() && !out_of_reach(o, now, integrator_.stops())) return std::nullopt;
    const auto settled = static_cast<double>(section);
    if (o.damping == 0) return ObservedTime{Status::periodic, state, 1.0, settled, FoundBy::closed_form, settled};
    const double end_at = settled + fading_time(o, transient_of(o, now), returns_.least()) / integrator_.period();
    if (!(end_at <= static_cast<double>(time_.max_periods))) return std::nullopt;
    motion::State<double> end = state;
    end.x = equilibrium_of(o), end.v = 0, end.from_stop = Side::none;
    return ObservedTime{Status::periodic, end, 1.0, settled, FoundBy::standstill, end_at};
  }

  static constexpr double shortest =
      16 * std::numeric_limits<double>::epsilon();  ///< period that time can resolve, in turns
  I& integrator_;
  const Scene& scene_;
  const TimeSettings& time_;
  bool all_effects_;  ///< takes no shortcut
  ReturnObserver returns_;
};

}  // namespace clatter::steady
