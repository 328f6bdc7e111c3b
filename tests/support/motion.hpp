#pragma once

#include "motion/state.hpp"
#include "scene/oscillator.hpp"

namespace clatter::support {

/// The start of an arc: displacement, velocity, forcing phase in turns.
struct ArcStart {
  double x, v, turns;
};

/// Motion a time s after the start of an arc, computed in `Number` (double or FiftyDigits).
template <class Number>
[[nodiscard]] motion::Motion<Number> motion_after(const Oscillator& oscillator, const ArcStart& start, double s);

/// The same by Taylor steps of eq. 3 alone, in 50 digits: shares no formula with the closed form.
template <class Number>
[[nodiscard]] motion::Motion<Number> motion_by_taylor(const Oscillator& oscillator, const ArcStart& start, double s);

}  // namespace clatter::support
