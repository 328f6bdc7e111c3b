#pragma once

#include <optional>
#include <vector>

#include "motion/state.hpp"
#include "observables/impact_word.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::observables {

class ImpactWord::Observer {
 public:
  Observer(const Settings&, const ObservedSpan& span) : periodic_(span.periodic), half_(span.total / 2) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (!periodic_ || !(begin <= half_ && half_ <= begin + length)) return;
    const motion::Motion<double> m = arc.at(half_ - begin);
    halfway_ = {m.x, m.v};
  }
  void rest(const motion::Rest& rest) { see(rest.time, rest.side, 0.0); }
  void impact(const motion::Impact& impact) { see(impact.time, impact.side, impact.before); }
  /// The touch of a soft stop has the letter of an impact.
  void touch(const motion::Touch& touch) {
    if (touch.from_outside) see(touch.time, touch.side, touch.velocity);
  }
  /// The response has no impacts, and turns into its mirror whenever the force does.
  bool response(const ObservedSpan&, double) {
    is_response_ = true;
    return true;
  }

  /// x and v end the period, and so begin it.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const;

 private:
  static constexpr double same = 1e-6;  ///< relative difference of what counts as the mirror image

  void see(double time, Side side, double before) {
    if (periodic_) contacts_.push_back({time, before, side});
  }
  [[nodiscard]] bool is_mirrored(const ObservedSpan& span, double x, double v) const;

  bool periodic_;
  double half_;                          ///< of the period, in tau
  std::vector<Contact> contacts_{};      ///< in order
  std::optional<PhasePoint> halfway_{};  ///< half a period after its beginning, in flight
  bool is_response_ = false;             ///< the steady response without impacts
};

}  // namespace clatter::observables
