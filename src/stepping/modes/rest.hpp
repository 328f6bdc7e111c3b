#pragma once

#include "stepping/laws.hpp"
#include "stepping/modes/friction.hpp"
#include "stepping/modes/mode.hpp"
#include "stepping/modes/release.hpp"

namespace clatter::stepping {

/// A rigid stop holds the mass.
template <class Loop>
struct AtRest {
  static constexpr Row row{"at rest", "held by a stop", "its force", Search::closed_form, "release"};
  static constexpr bool called_for = Loop::effects.rest;
  using Number = typename Loop::Number;

  [[nodiscard]] static auto has(const Loop& loop, const motion::State<Number>& state) {
    return loop.holding_stop(state);
  }
  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage, const motion::Stop<Number>& stop) {
    auto& state = stage.state;
    state.from_stop = stop.side, state.offset = 0;
    if constexpr (modes::may_meet_soft_walls<Loop>)
      if (state.loose.within) {
        const Number constant = loop.constants().constant_force(stop.position) + loop.push(state);
        const motion::Holding<Number> holding{stop.side, constant, Number(0)};
        return modes::stay_at_wall(loop, stage, stop.side, std::optional(holding), stage.end, true);
      }
    return laws::hold(
        loop, stage, stop.side,
        modes::upcoming(modes::release_turns(loop, stop, state.phase_turns), state.phase_turns, stage.end));
  }
};

/// A chatter that is summed but goes on beyond the end of the stage: its flights are flown until it is complete, or up
/// to that end. A section neither begins a sum nor shows impacts of it. With a loose mass none is summed.
template <class Loop>
struct InChatter {
  static constexpr Row row{"in chatter", "free, or that of the slip", "as before it", Search::gaps, "its end, in rest"};
  static constexpr bool called_for = AtRest<Loop>::called_for && !Loop::effects.loose;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  using Crossing = motion::Crossing<Number>;

  [[nodiscard]] static bool has(const Loop&, const State& state) { return state.chatters; }

  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage) {
    State& state = stage.state;
    const auto stop = motion::stop_at<Number>(loop.stops(), state.from_stop);
    const State begin = state;
    while (state.chatters && stage.end - state.phase_turns > 2 * epsilon<Number>()) {
      if (state.offset == 0) {
        const auto left = loop.chatter_time(state, stop);
        if (left && state.phase_turns + *left / loop.period() <= stage.end) {
          laws::complete_chatter(loop, state, *left);
          break;
        }
      }
      const Number horizon = stage.time_left();
      const Crossing contact = next_contact(loop, state, horizon);
      if (!contact.resolved) return loop.outcome_at(contact);
      stage.pass(contact.elapsed);
      state.x = contact.motion.x, state.v = contact.motion.v, state.offset = contact.motion.offset;
      if (contact.side == Side::none && contact.elapsed == horizon) state.phase_turns = stage.end;
      if (contact.side == Side::none) continue;
      state.x = stop.position, laws::reverse(state, stop);  // under friction x was an ulp off
      if (state.v == 0) state.chatters = false;
    }
    stage.show_chatter(begin, stop, Number(state.phase_turns - begin.phase_turns), state.v);
    return Outcome::completed;
  }

 private:
  /// The next contact of a flight of a chatter; under friction, which divides it, perhaps the peak before.
  [[nodiscard]] static Crossing next_contact(Loop& loop, const State& state, const Number& horizon) {
    const Number anchor = loop.anchor(state);
    if constexpr (Loop::effects.friction)
      if (loop.is_rough()) {
        const Side ahead = modes::heading(loop, state);
        const auto& slip = loop.slips().towards(ahead);
        const std::array margins{modes::gap_ahead(loop, state, ahead), modes::speed_towards<Number>(ahead)};
        Crossing crossing =
            loop.method().fly_within(slip, state, loop.motion(slip, state), anchor, margins, horizon).crossing;
        if (crossing.margin == 0) crossing.side = ahead;
        if (crossing.margin == 1) crossing.motion.v = 0;
        return crossing;
      }
    return loop.method().fly(loop.constants(), state, loop.motion(loop.constants(), state), anchor, horizon).crossing;
  }
};

}  // namespace clatter::stepping
