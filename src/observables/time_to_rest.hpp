#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The time from which on a stop or dry friction holds the mass for good; of transients. A mass at rest that no force
/// moves stays there, and so does one that the force doesn't move in a whole period of its own. A loose mass has to be
/// at rest in its housing, too: pressed by a wall, or where it stands without a load.
struct TimeToRest {
  struct Settings {
    bool time_to_rest = false;
  };
  struct Values {
    double time_to_rest = no_value;  ///< tau; NaN: steady motion, or it isn't at rest for good at its end
  };
  static constexpr std::string_view transient = "[time]\nmode = \"transient\"\nduration = 63.0\n\n[observe]\n";
  static constexpr std::tuple fields{
      Field{with(transient, Key{"observe", "time_to_rest", Kind::flag, "false", "true",
                                "transient: time after which a stop or dry friction holds the mass for good"}),
            &Settings::time_to_rest}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.time_to_rest; }
  [[nodiscard]] static std::string description(const Settings&) { return "time to rest"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    return {missing_if(
        "it is no transient, or the mass isn't at rest for good at its end: with a force it must have "
        "rested for a forcing period",
        scalar("time_to_rest", "time after which the mass rests for good", &Values::time_to_rest, Quantity::time))};
  }

  class Observer;
};

class TimeToRest::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  /// With a loose mass, or on a stop that moves, an arc shows a time for which the main mass is held, too.
  template <class A>
  void arc(const A& arc, double begin, double length) {
    const bool is_held = std::exchange(is_held_, false);
    if (!(length > 0)) return;
    if constexpr (motion::Housed<A>) {
      if (is_held && stands(arc.loose)) return rest(begin, begin + length);
    } else if (is_held) {
      return rest(begin, begin + length);
    }
    since_.reset();
  }
  /// A time in which the mass isn't held is the end of a chatter, which is motion, or that of a force too low to be
  /// told from rest.
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.has_arc) {
      is_held_ = is_held_ || (event.kind != Kind::hold && event.held);
      return;
    }
    if (event.kind == Kind::impact || event.kind == Kind::touch || event.kind == Kind::renewal) since_.reset();
    if (event.lasts() && (event.held || since_)) rest(event.time, event.end());
  }
  /// The steady response moves.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    constexpr double rounding = 1e-9;
    if (!span.transient || !since_ || until_ < span.total * (1 - rounding)) return {};
    const double period = is_driven(span.scene.oscillator) ? span.total / span.turns : 0.0;
    const bool is_for_good = until_ - *since_ >= period * (1 - rounding) && (period > 0 || until_ > *since_);
    return {is_for_good ? *since_ : no_value};
  }

 private:
  void rest(double begin, double end) {
    if (!since_) since_ = begin;
    until_ = end;
  }
  [[nodiscard]] static bool stands(const motion::Pressed&) { return true; }
  /// A loose mass in flight.
  template <class Flight>
  [[nodiscard]] static bool stands(const Flight& flight) {
    return flight.start().v == 0 && flight.start().a == 0;
  }

  bool is_held_ = false;           ///< the main mass, by what the next arc shows
  std::optional<double> since_{};  ///< the beginning of the rest that goes on; nothing: the mass moves
  double until_ = 0.0;
};

}  // namespace clatter::observables
