#pragma once

#include <utility>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/state.hpp"

namespace clatter::observables {

/// Shows an observer of a mass between stops what a loose mass does between its walls: its place z in the housing, and
/// z'.
template <class Observer>
class InHousing {
 public:
  template <class... Arguments>
  explicit InHousing(std::in_place_t, Arguments&&... arguments) : of_(std::forward<Arguments>(arguments)...) {}

  /// Of the arc of a main mass, what the loose one does meanwhile; a time for which a wall presses it is an event.
  template <motion::Housed A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (requires { arc.loose.at(length); }) {
      of_.arc(arc.loose, begin, length);
      const motion::Motion<double> end = arc.loose.at(length);
      z_ = end.x, w_ = end.v;
    }
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind != Kind::strike && event.kind != Kind::hold) return;
    of_.event(event.in_housing());
    z_ = event.place, w_ = event.after;
  }

  [[nodiscard]] Observer& of() { return of_; }
  [[nodiscard]] const Observer& of() const { return of_; }
  [[nodiscard]] double last_z() const { return z_; }  ///< where it was seen last
  [[nodiscard]] double last_w() const { return w_; }

 private:
  Observer of_;
  double z_ = 0.0, w_ = 0.0;
};

}  // namespace clatter::observables
