#pragma once

#include <array>

#include "stepping/laws.hpp"
#include "stepping/modes/friction.hpp"
#include "stepping/modes/mode.hpp"

namespace clatter::stepping {

/// In contact with a soft stop until its force falls to 0 (eqs. 50 and 51).
template <class Loop>
struct InContact {
  static constexpr Row row{"in contact", "with the soft stop", "its force", Search::margins, "separation"};
  static constexpr bool called_for = Loop::effects.soft;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;

  const Loop& loop;
  State& state;
  motion::SoftStop<Number> stop = motion::soft_stop_at<Number>(loop.stops(), state.within);

  [[nodiscard]] static bool has(const Loop&, const State& state) { return state.within != Side::none; }

  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return loop.in_contact(stop.side, function);
  }
  [[nodiscard]] auto margins() const { return std::array{modes::force_of(stop)}; }

  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    if (flown.crossing.margin != 0) return Outcome::completed;
    if (flown.constants.h == 0 && flown.constants.f == 0)  // by its energy
      state.v = stop.into(-flown.constants.speed_at_stop(flown.start.offset, flown.start.v));
    laws::separate(stage, stop);
    return Outcome::completed;
  }
};

/// Free beyond a soft stop's position until the mass comes back to that, or the stop, which relaxes at once, pushes
/// again.
template <class Loop>
struct Beyond {
  static constexpr Row row{"beyond a stop", "free", "depth; pull of the soft stop", Search::margins,
                           "back between the stops; renewal"};
  static constexpr bool called_for = InContact<Loop>::called_for;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;

  Loop& loop;
  State& state;
  motion::SoftStop<Number> stop = motion::soft_stop_at<Number>(loop.stops(), state.within);

  [[nodiscard]] static bool has(const Loop&, const State& state) {
    return state.within != Side::none && !state.pressed;
  }

  /// With friction that of the slip.
  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    if constexpr (Loop::effects.friction)
      if (loop.is_rough()) return function(loop.slips().towards(modes::heading(loop, state)));
    return function(loop.constants());
  }
  [[nodiscard]] auto margins() const {
    const Number one = stop.into(Number(1));
    return std::array{motion::Margin<Number>{Number(0), one, Number(0)},
                      motion::Margin<Number>{Number(0), -one, -stop.into(stop.relaxation())}};
  }

  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    if (flown.crossing.margin == 1) return laws::renew(loop, stage, stop.side);
    if (flown.crossing.margin == 0) laws::leave(state, stop);
    return Outcome::completed;
  }
};

}  // namespace clatter::stepping
