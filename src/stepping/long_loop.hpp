#pragma once

#include "stepping/event_driven.hpp"

/// The loop of machines with more than rigid stops, for files that compile it. Each takes seconds, so those of the
/// compiled sets of effects, and of the reference in 50 digits, are compiled in `*_loops*.cpp` alone.
namespace clatter::stepping {

template <class Method, class Arcs, class N, Effects E>
Outcome EventDriven<Method, Arcs, N, E>::advance_long(State& state, const Number& end, std::int64_t origin,
                                                      Any& observer) {
  if constexpr (E.own_motion && Method::in_closed_form)
    if (frames_) return advance_in_frames(state, end, origin, observer);
  if constexpr (E.stiffness)
    for (Number knot = this->next_knot(state.phase_turns); knot + knot_rounding<Number>() < end;
         knot = this->next_knot(state.phase_turns)) {
      const Outcome outcome = advance_in_piece(state, knot, origin, observer);
      if (outcome != Outcome::completed) return outcome;
    }
  return advance_in_piece(state, end, origin, observer);
}

/// Compiles the loop of a method, once it is instantiated by name.
template <class Method>
struct CompiledLoop {
  static constexpr auto advance = &Method::advance_long;
};

}  // namespace clatter::stepping
