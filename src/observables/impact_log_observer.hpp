#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "math/number.hpp"
#include "motion/state.hpp"
#include "observables/impact_log.hpp"

namespace clatter::observables {

class ImpactLog::Observer {
 public:
  Observer() = default;
  Observer(const Settings& settings, const ObservedSpan& span)
      : full_(settings.full_log),
        drive_(span.scene.oscillator.forcing != 0 ? Drive::force
               : is_shaken(span.scene.shaking)    ? Drive::shaking
                                                  : Drive::none),
        shaking_(span.scene.shaking),
        frequency_(span.scene.oscillator.frequency),
        begin_(turns_of(span.theta)) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) {
    if (full_) values_.rests.push_back(rest);
  }
  void impact(const motion::Impact& impact) { log(impact, impact.before, impact.after); }
  void impact_at_start(const motion::Impact& at_start) {
    if (full_) impact(at_start);
  }
  /// A contact with a soft stop is logged with the velocities at its beginning and where the stop's force first falls
  /// to 0, NaN if that isn't observed: beyond the stop's position the contact may be renewed after that.
  void touch(const motion::Touch& touch) {
    if (touch.from_outside) log(touch, touch.velocity, no_value);
  }
  void separate(const motion::Separation& separation) {
    if (!values_.log.empty() && values_.log.back().side == separation.side && std::isnan(values_.log.back().after))
      values_.log.back().after = separation.velocity;
  }
  /// Of a loose mass z' is logged, and the velocity y' as seen from the ground, on which its motion is computed.
  void strike(const motion::Strike& strike) {
    log(strike.in_housing(), strike.before, strike.after);
    values_.log.back().absolute = strike.v_before + strike.before;
  }
  void strike_at_start(const motion::Strike& at_start) {
    if (full_) strike(at_start);
  }
  /// The time for which a wall presses a loose mass is its rest in the housing.
  template <class A>
  void hold(const A&, const motion::Rest& hold) {
    rest(hold);
  }
  /// The response meets no stop.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] const std::vector<LoggedImpact>& impacts() const { return values_.log; }
  [[nodiscard]] Values finish(const ObservedSpan&, double, double) { return std::move(values_); }

 private:
  /// The forcing phase is counted by periods of the force, if one is left in the moving frame, else by time.
  enum class Drive : std::uint8_t { none, force, shaking };

  template <class Contact>
  void log(const Contact& contact, double before, double after) {
    LoggedImpact logged{
        .time = contact.time, .before = before, .after = after, .absolute = before, .side = contact.side};
    if (drive_ != Drive::none) {
      const double since = drive_ == Drive::force ? contact.turns : frequency_ * contact.time / (2 * pi<double>());
      const double turns = part_of_turn(begin_ + since);
      logged.phase = 2 * pi<double>() * turns;
      if (is_shaken(shaking_)) logged.absolute += velocity_of_stops(turns);
    }
    values_.log.push_back(logged);
  }
  /// At a forcing phase, in turns.
  [[nodiscard]] double velocity_of_stops(double turns) const {
    const double amplitude = shaking_.stops + shaking_.base;
    return amplitude * frequency_ * sine_cosine_of_turns(turns + turns_of(shaking_.phase)).cosine;
  }

  bool full_ = false;
  Drive drive_ = Drive::none;
  Shaking shaking_{};
  double frequency_ = 0.0;  ///< nu
  double begin_ = 0.0;      ///< forcing phase at the beginning of the observed time, turns
  Values values_;
};

}  // namespace clatter::observables
