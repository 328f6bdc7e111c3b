#pragma once

#include "math/fifty_digits.hpp"
#include "motion/arc.hpp"
#include "motion/state.hpp"

namespace clatter::point {

/// A state in 50 digits, rounded to double.
[[nodiscard]] inline motion::State<double> rounded(const motion::State<FiftyDigits>& state) {
  return {.x = static_cast<double>(state.x),
          .v = static_cast<double>(state.v),
          .phase_turns = static_cast<double>(state.phase_turns),
          .periods = state.periods,
          .released = state.released,
          .from_stop = state.from_stop,
          .offset = static_cast<double>(state.offset),
          .within = state.within,
          .pressed = state.pressed,
          .chatters = state.chatters};
}

/// Shows the arcs of a run in 50 digits in double, each rounded at its start: an error of a few roundings, which
/// doesn't grow. E is the set of effects of the run.
template <Effects E>
class InDouble {
 public:
  explicit InDouble(const Scene& scene) : stops_(scene.stops), constants_(scene.oscillator) {}

  /// Calls `function(arc)` with an arc in double.
  template <class Number, Effects Of, class Function>
  void show(const motion::Arc<Number, Of>& arc, Function&& function) const {
    if constexpr (E.soft) {
      const Side side = arc.constants().stop.side;
      if (side != Side::none) {
        const auto stop = motion::soft_stop_at<double>(stops_, side);
        return show_with(arc, motion::ArcConstants<double, Of>::in_contact(constants_, stop), function);
      }
    }
    if constexpr (Of == E.arc()) show_with(arc, constants_, function);
  }

 private:
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
};

}  // namespace clatter::point
