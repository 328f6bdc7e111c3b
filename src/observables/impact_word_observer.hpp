#pragma once

#include <optional>
#include <vector>

#include "motion/state.hpp"
#include "observables/impact_word.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::observables {

class ImpactWord::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : periodic_(span.periodic), shows_sticks_(settings.word_sticks), half_(span.total / 2) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    moves_ = moves_ || length > 0;
    if (!periodic_ || !(begin <= half_ && half_ <= begin + length)) return;
    const motion::Motion<double> m = arc.at(half_ - begin);
    halfway_ = {m.x, m.v};
  }
  void rest(const motion::Rest& rest) {
    if (rest.is_stick()) return stick(rest);
    see(rest.time, rest.side, 0.0);
  }
  void impact(const motion::Impact& impact) { see(impact.time, impact.side, impact.before); }
  /// The touch of a soft stop has the letter of an impact.
  void touch(const motion::Touch& touch) {
    if (touch.from_outside) see(touch.time, touch.side, touch.velocity);
  }
  /// The walls of a loose mass have the letters of stops.
  void strike(const motion::Strike& strike) { see(strike.time, strike.side, strike.before); }
  template <class A>
  void hold(const A&, const motion::Rest& hold) {
    see(hold.time, hold.side, 0.0);
    place(hold.time, hold.length, [&](double) { return hold.position; });
  }
  template <class A>
  void in_housing(const A& arc, double begin, double length) {
    place(begin, length, [&](double s) { return arc.at(s).x; });
  }
  /// The response has no impacts, and turns into its mirror whenever the force does.
  bool response(const ObservedSpan&, double) {
    is_response_ = true;
    return true;
  }

  /// x and v end the period, and so begin it.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const;

 private:
  static constexpr double same_instant = 1e-12;
  static constexpr double same = 1e-6;  ///< relative difference of what counts as the mirror image

  /// Keeps the place of a loose mass halfway, and where it was seen last.
  template <class At>
  void place(double begin, double length, const At& at) {
    if (!periodic_) return;
    if (begin <= half_ && half_ <= begin + length) halfway_z_ = at(half_ - begin);
    last_z_ = at(length);
  }
  /// One that a section cuts is one stick.
  void stick(const motion::Rest& rest) {
    if (rest.time <= half_ && half_ <= rest.time + rest.length) halfway_ = {rest.position, 0.0};
    const bool goes_on = rest.time <= stuck_until_ * (1 + same_instant);
    stuck_until_ = rest.time + rest.length;
    if (shows_sticks_ && !goes_on) see(rest.time, Side::none, 0.0);
  }
  void see(double time, Side side, double before) {
    if (periodic_) contacts_.push_back({time, before, side});
  }
  /// A stick that the beginning of the period cuts is one.
  [[nodiscard]] std::vector<Contact> whole_contacts(double total) const;
  [[nodiscard]] bool is_stuck() const { return !moves_ && stuck_until_ >= 0; }
  [[nodiscard]] bool is_mirrored(const ObservedSpan& span, double x, double v) const;

  bool periodic_, shows_sticks_;
  double stuck_until_ = -1.0;              ///< end of the last stick, tau
  double half_;                            ///< of the period, in tau
  std::vector<Contact> contacts_{};        ///< in order
  std::optional<PhasePoint> halfway_{};    ///< half a period after its beginning, in flight
  bool moves_ = false;                     ///< at some time of the period
  bool is_response_ = false;               ///< the steady response without impacts
  double halfway_z_ = 0.0, last_z_ = 0.0;  ///< of a loose mass: its place half a period after the beginning, and last
};

}  // namespace clatter::observables
