#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "math/number.hpp"
#include "motion/event.hpp"
#include "observables/contacts/impact_log.hpp"

namespace clatter::observables {

class ImpactLog::Observer {
 public:
  Observer() = default;
  Observer(const Settings& settings, const ObservedSpan& span)
      : full_(settings.full_log),
        tells_walls_(settings.wall_log),
        drive_(is_driven(span.scene.oscillator) ? Drive::force
               : is_shaken(span.scene.shaking)  ? Drive::shaking
                                                : Drive::none),
        shaking_(span.scene.shaking),
        frequency_(span.scene.oscillator.frequency),
        begin_(turns_of(span.theta)) {}

  template <class A>
  void arc(const A&, double, double) {}
  /// A contact with a soft stop is logged with the velocities at its beginning and where the stop's force first falls
  /// to 0, NaN if that isn't observed: beyond the stop's position the contact may be renewed after that. Of a loose
  /// mass z' is logged, and the velocity y' as seen from the ground, on which its motion is computed; the time for
  /// which a wall presses it is its rest in the housing.
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.lasts() && full_) values_.rests.push_back(event.in_housing());
    if (event.kind == Kind::impact || event.kind == Kind::strike) log(event, event.after);
    if (event.kind == Kind::touch || event.kind == Kind::wall_touch) log(event, no_value);
    if (event.kind == Kind::strike || event.kind == Kind::wall_touch)
      values_.log.back().absolute = event.main.before + event.before;
    if (event.kind == Kind::separation || event.kind == Kind::wall_separation) end_contact(event);
  }
  void event_at_start(const motion::Event& at_start) {
    const bool is_impact = at_start.kind == motion::Event::Kind::impact || at_start.kind == motion::Event::Kind::strike;
    if (full_ && is_impact) event(at_start);
  }
  /// The response meets no stop.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] const std::vector<LoggedImpact>& impacts() const { return values_.log; }
  [[nodiscard]] Values finish(const ObservedSpan&, double, double) { return std::move(values_); }

 private:
  /// The forcing phase is counted by periods of the force, if one is left in the moving frame, else by time.
  enum class Drive : std::uint8_t { none, force, shaking };

  void end_contact(const motion::Event& separation) {
    const auto touched =
        std::ranges::find_if(values_.log.rbegin(), values_.log.rend(),
                             [&](const LoggedImpact& impact) { return impact.stop == stop_of(separation); });
    if (touched != values_.log.rend() && std::isnan(touched->after)) touched->after = separation.after;
  }
  void log(const motion::Event& contact, double after) {
    LoggedImpact logged{.time = contact.time,
                        .before = contact.before,
                        .after = after,
                        .absolute = contact.before + contact.stop.velocity,
                        .stop = stop_of(contact)};
    if (drive_ != Drive::none) {
      const double since = drive_ == Drive::force ? contact.turns : frequency_ * contact.time / (2 * pi<double>());
      const double turns = part_of_turn(begin_ + since);
      logged.phase = 2 * pi<double>() * turns;
      if (is_shaken(shaking_)) logged.absolute += velocity_of_stops(turns);
    }
    values_.log.push_back(logged);
  }
  [[nodiscard]] std::int8_t stop_of(const motion::Event& contact) const {
    const bool is_wall = tells_walls_ && (contact.kind == motion::Event::Kind::strike || contact.is_of_soft_wall());
    return static_cast<std::int8_t>((is_wall ? 2 : 1) * sign_of(contact.side));
  }
  /// At a forcing phase, in turns.
  [[nodiscard]] double velocity_of_stops(double turns) const {
    const double amplitude = shaking_.stops + shaking_.base;
    return amplitude * frequency_ * sine_cosine_of_turns(turns + turns_of(shaking_.phase)).cosine;
  }

  bool full_ = false, tells_walls_ = false;
  Drive drive_ = Drive::none;
  Shaking shaking_{};
  double frequency_ = 0.0;  ///< nu
  double begin_ = 0.0;      ///< forcing phase at the beginning of the observed time, turns
  Values values_;
};

}  // namespace clatter::observables
