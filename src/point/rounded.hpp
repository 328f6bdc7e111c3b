#pragma once

#include <type_traits>

#include "motion/arc.hpp"
#include "motion/dry_friction.hpp"
#include "motion/state.hpp"
#include "motion/walls.hpp"

namespace clatter::point {

/// A state in more digits, rounded to double.
template <class Number>
[[nodiscard]] motion::State<double> rounded(const motion::State<Number>& state) {
  return {.x = static_cast<double>(state.x),
          .v = static_cast<double>(state.v),
          .phase_turns = static_cast<double>(state.phase_turns),
          .periods = state.periods,
          .released = state.released,
          .from_stop = state.from_stop,
          .offset = static_cast<double>(state.offset),
          .within = state.within,
          .pressed = state.pressed,
          .chatters = state.chatters,
          .loose = {state.loose.wall, static_cast<double>(state.loose.place), static_cast<double>(state.loose.speed),
                    state.loose.pressed}};
}

/// Shows the arcs of a run in more digits in double, each rounded at its start: an error of a few roundings, which
/// doesn't grow. E is the set of effects of the run.
template <Effects E>
class InDouble {
 public:
  explicit InDouble(const Scene& scene)
      : stops_(scene.stops),
        constants_(scene.oscillator),
        slips_(constants_, scene.friction, scene.stops),
        walls_(constants_, scene.loose) {}

  /// Calls `function(arc)` with an arc in double.
  template <class Number, Effects Of, class Function>
  void show(const motion::Arc<Number, Of>& arc, Function&& function) const {
    if constexpr (E.soft) {
      const Side side = arc.constants().stop.side;
      if (side != Side::none) {
        const auto stop = motion::soft_stop_at<double>(stops_, side);
        return show_with(arc, motion::ArcConstants<double, Of>::in_contact(free(arc), stop), function);
      }
    }
    if constexpr (E.loose) {
      if (arc.constants().carried != 0)
        return walls_.carrying.with_constants([&]<Effects Both>(const motion::ArcConstants<double, Both>& both) {
          if constexpr (Both == Of) show_with(arc, both, function);
        });
    }
    if constexpr (Of == E.arc()) show_with(arc, free(arc), function);
  }

 private:
  /// The constants of a free mass, in the direction of an arc's slip if friction acts on it.
  template <class A>
  [[nodiscard]] const motion::ArcConstants<double, E.arc()>& free(const A& arc) const {
    if constexpr (E.friction)
      if (arc.constants().friction != 0)
        return slips_.towards(arc.constants().friction < 0 ? Side::upper : Side::lower);
    return constants_;
  }
  template <class Number, Effects Of, class Function>
  static void show_with(const motion::Arc<Number, Of>& arc, const motion::ArcConstants<double, Of>& constants,
                        Function& function) {
    const auto d = [](const Number& y) { return static_cast<double>(y); };
    const motion::Motion<Number>& start = arc.start();
    const motion::Motion<double> in_double{d(start.offset), d(start.x),    d(start.v),
                                           d(start.a),      d(start.sine), d(start.cosine)};
    function(motion::Arc<double, Of>(constants, in_double, d(arc.anchor())));
  }

  Stops stops_;
  motion::ArcConstants<double, E.arc()> constants_;
  [[no_unique_address]] std::conditional_t<E.friction, motion::Slips<double, E.arc()>, motion::NoSlips> slips_;
  [[no_unique_address]] std::conditional_t<E.loose, motion::Walls<double>, motion::NoWalls> walls_;
};

}  // namespace clatter::point
