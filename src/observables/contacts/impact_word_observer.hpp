#pragma once

#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/state.hpp"
#include "observables/contacts/impact_word.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::observables {

class ImpactWord::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : periodic_(span.periodic),
        shows_sticks_(settings.word_sticks),
        tells_walls_(settings.word_walls),
        half_(span.total / 2) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    moves_ = moves_ || length > 0;
    if constexpr (motion::Housed<A>) see_place(arc.loose, begin, length);
    if (!periodic_ || !(begin <= half_ && half_ <= begin + length)) return;
    const motion::Motion<double> m = arc.at(half_ - begin);
    halfway_ = {m.x, m.v};
  }
  /// The touch of a soft stop has the letter of an impact, and the walls of a loose mass have the letters of stops, or
  /// small ones beside them. That friction holds it in its housing has none.
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const bool has_letter = event.lasts() || event.kind == Kind::impact || event.kind == Kind::touch ||
                            event.kind == Kind::strike || event.kind == Kind::wall_touch;
    if (event.is_stick()) return stick(event);
    const bool is_of_wall = event.kind == Kind::strike || event.kind == Kind::hold || event.is_of_soft_wall();
    if (is_of_wall && event.side == Side::none) return;
    if (has_letter) see(event.time, event.side, event.velocity(), tells_walls_ && is_of_wall);
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
  template <class Loose>
  void see_place(const Loose& loose, double begin, double length) {
    if (!periodic_) return;
    if (begin <= half_ && half_ <= begin + length) halfway_z_ = motion::place_at(loose, half_ - begin);
    last_z_ = motion::place_at(loose, length);
  }
  /// One that a section cuts is one stick.
  void stick(const motion::Event& stick) {
    if (stick.time <= half_ && half_ <= stick.end()) halfway_ = {stick.place, 0.0};
    const bool goes_on = stick.time <= stuck_until_ * (1 + same_instant);
    stuck_until_ = stick.end();
    if (shows_sticks_ && !goes_on) see(stick.time, Side::none, 0.0);
  }
  void see(double time, Side side, double before, bool is_of_wall = false) {
    if (periodic_) contacts_.push_back({time, before, side, is_of_wall});
  }
  /// A stick that the beginning of the period cuts is one.
  [[nodiscard]] std::vector<Contact> whole_contacts(double total) const;
  [[nodiscard]] bool is_stuck() const { return !moves_ && stuck_until_ >= 0; }
  [[nodiscard]] bool is_mirrored(const ObservedSpan& span, double x, double v) const;

  bool periodic_, shows_sticks_, tells_walls_;
  double stuck_until_ = -1.0;              ///< end of the last stick, tau
  double half_;                            ///< of the period, in tau
  std::vector<Contact> contacts_{};        ///< in order
  std::optional<PhasePoint> halfway_{};    ///< half a period after its beginning, in flight
  bool moves_ = false;                     ///< at some time of the period
  bool is_response_ = false;               ///< the steady response without impacts
  double halfway_z_ = 0.0, last_z_ = 0.0;  ///< of a loose mass: its place half a period after the beginning, and last
};

}  // namespace clatter::observables
