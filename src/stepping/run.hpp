#pragma once

#include <cmath>
#include <cstdint>

#include "stepping/integrator.hpp"

namespace clatter::stepping {

/// Runs to the next stroboscopic section.
template <Integrator I, class Observer>
[[nodiscard]] Outcome advance_to_section(I& integrator, motion::State<typename I::Number>& state, std::int64_t origin,
                                         Observer& observer) {
  const Outcome outcome = integrator.advance(state, typename I::Number(1), origin, observer);
  state.phase_turns = 0;
  ++state.periods;
  return outcome;
}

/// Runs for a time given in forcing periods, starting at a section, reporting to an observer.
template <Integrator I, class Observer>
[[nodiscard]] Outcome run_for(I& integrator, motion::State<typename I::Number>& state, const typename I::Number& turns,
                              Observer& observer) {
  using Number = typename I::Number;
  using std::floor;
  const std::int64_t origin = state.periods;
  Number left = floor(turns);
  const Number part = turns - left;
  while (left > 0) {
    const Outcome outcome = advance_to_section(integrator, state, origin, observer);
    if (outcome != Outcome::completed) return outcome;
    left -= 1;
  }
  return integrator.advance(state, part, origin, observer);
}

}  // namespace clatter::stepping
