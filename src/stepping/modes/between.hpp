#pragma once

#include <cmath>

#include "motion/contact.hpp"
#include "stepping/laws.hpp"
#include "stepping/modes/mode.hpp"

namespace clatter::stepping {

/// Between the stops, or without any.
template <class Loop>
struct Between {
  static constexpr Row row{"between stops", "free", "gaps to both stops", Search::gaps,
                           "impact, rest; touch of a soft stop"};
  static constexpr bool called_for = true;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  using Crossing = motion::Crossing<Number>;

  Loop& loop;
  State& state;

  [[nodiscard]] static bool has(const Loop&, const State&) { return true; }

  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return function(loop.constants());
  }

  [[nodiscard]] bool is_none(const Crossing& contact) const {
    return contact.side != Side::none && (is_hop(contact) || (contact.elapsed == 0 && state.v == 0));
  }
  /// Presses the mass into the soft stop that it is on, if the force does so; else it waits.
  template <class Stage>
  [[nodiscard]] Outcome wait(Stage& stage, const Crossing& contact) const {
    if constexpr (Loop::effects.soft)
      if (is_soft(loop.stops(), contact.side)) {
        const auto stop = motion::soft_stop_at<Number>(loop.stops(), contact.side);
        if (stop.into(contact.motion.a) > 0) {
          state.x = stop.position, laws::enter(state, stop.side);
          return Outcome::completed;
        }
      }
    return laws::wait(loop, stage, contact.side);
  }
  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    const Crossing& contact = flown.crossing;
    state.released = false;
    if (contact.side != Side::none) return laws::meet(loop, stage, motion::stop_at<Number>(loop.stops(), contact.side));
    if (contact.elapsed == flown.horizon) state.phase_turns = stage.end;
    return Outcome::completed;
  }

 private:
  /// Whether a mass that a rigid stop lets go is back at once: the pressing force touches zero, and has lost its digits
  /// in the difference of the load and the spring.
  [[nodiscard]] bool is_hop(const Crossing& contact) const {
    using std::abs, std::sqrt;
    constexpr Effects E = Loop::effects;
    if (E.forcing == Forcing::none || !E.rest || state.v != 0 || state.offset != 0) return false;
    if (state.from_stop != contact.side || is_soft(loop.stops(), contact.side)) return false;
    const auto& c = loop.constants();
    const Number of_all = abs(c.f) + abs(c.load) + abs(c.spring(state.x)), hop = loop.shortest_hop();
    const Number most = Number(1024);  // a force that hardly changes beside the others touches zero nowhere
    return contact.elapsed <= most * hop && contact.elapsed * sqrt(abs(c.f)) <= hop * sqrt(of_all);
  }
};

}  // namespace clatter::stepping
