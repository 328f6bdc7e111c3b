#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include "motion/contact_force.hpp"
#include "motion/dry_friction.hpp"
#include "motion/state.hpp"
#include "scene/scene.hpp"

namespace clatter::stepping {

/// The main mass: its oscillator, the stops in reach, soft ones with their own oscillators, and dry friction with those
/// of its slips. With a loose mass there are two: the main mass alone, and with what a wall of its housing presses.
template <class N, Effects E>
class MainMass {
 public:
  using Number = N;
  static constexpr Effects effects = E;
  using Constants = motion::ArcConstants<Number, E.arc()>;

  /// `start_turns`: the forcing phase at tau = 0.
  MainMass(const Constants& constants, const BasicStops<Number>& in_reach, const BasicFriction<Number>& friction,
           const Number& start_turns)
      : constants_(constants),
        stops_(in_reach),
        soft_(constants_, stops_),
        slips_(constants_, friction, stops_),
        has_soft_stops_(has_soft_stop(in_reach)),
        start_turns_(start_turns) {}

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] const BasicStops<Number>& stops() const { return stops_; }  ///< the stops in reach
  [[nodiscard]] bool has_soft_stops() const { return has_soft_stops_; }
  /// Forcing period in tau; without forcing 2 pi.
  [[nodiscard]] const Number& period() const { return constants_.period; }
  [[nodiscard]] const Number& start_turns() const { return start_turns_; }  ///< forcing phase at tau = 0

  /// The stop that holds a mass at rest, if one does; `push` is the force of a soft wall on it.
  [[nodiscard]] std::optional<motion::Stop<Number>> holding_stop(const motion::State<Number>& state,
                                                                 const Number& push = Number(0)) const {
    if (!E.rest || state.v != 0 || state.released) return std::nullopt;
    if constexpr (E.friction)
      if (is_rough()) {
        const auto holding = held(state, push);
        if (!holding || holding->stop == Side::none) return std::nullopt;
        return motion::stop_at<Number>(stops_, holding->stop);
      }
    for (const Side side : {Side::lower, Side::upper}) {
      if (E.soft && is_soft(stops_, side)) continue;
      const auto stop = motion::stop_at<Number>(stops_, side);
      if (state.x != stop.position) continue;
      if (push != 0 ? stop.into(push) + contact_force(constants_, stop, phase(state)).force > 0
                    : holds(constants_, stop, phase(state)))
        return stop;
    }
    return std::nullopt;
  }

  /// Whether an impact on a stop, or friction, takes energy.
  [[nodiscard]] bool loses() const {
    const auto at = [&](Side side) {
      const auto stop = motion::stop_at<Number>(stops_, side);
      return is_finite(stop.position) && !is_soft(stops_, side) && stop.law.loses();
    };
    return is_rough() || at(Side::lower) || at(Side::upper);
  }

  /// Whether there is dry friction.
  [[nodiscard]] bool is_rough() const { return slips_.is_rough(); }
  /// The static level of the friction.
  [[nodiscard]] Number static_level() const requires(E.friction) { return slips_.static_level; }
  /// The friction, and the stop if there is one, that holds a mass at x' = 0; nothing: it moves on.
  [[nodiscard]] std::optional<motion::Holding<Number>> held(const motion::State<Number>& state,
                                                            const Number& push = Number(0)) const requires(E.friction) {
    if (state.v != 0 || state.released) return std::nullopt;
    const motion::Holding<Number> holding = holding_at(state, push);
    return holding.holds(constants_, phase(state)) ? std::optional(holding) : std::nullopt;
  }
  /// Whether friction holds a mass for good, away from rigid stops.
  [[nodiscard]] bool sticks_for_good(const motion::State<Number>& state) const {
    if constexpr (E.friction) {
      if (!is_rough()) return false;
      const auto holding = held(state);
      if (constants_.is_in_pieces())  // a jump may let it go
        return holding && holding->stop == Side::none &&
               holds_throughout(holding->level, holding->constant, constants_.f, constants_.shape);
      return holding && holding->stop == Side::none && !holding->release_phase(constants_, Side::lower) &&
             !holding->release_phase(constants_, Side::upper);
    }
    return false;
  }

  /// Calls `function(constants)` with those of motion in contact with a soft stop.
  template <class Function>
  decltype(auto) in_contact(Side side, Function&& function) const {
    return soft_.with_constants(side, std::forward<Function>(function));
  }

  /// The forcing phase.
  [[nodiscard]] SineCosine<Number> phase(const motion::State<Number>& state) const {
    return constants_.phase_at(Number(start_turns_ + state.phase_turns));
  }
  /// Whether a phase, in turns since the section, is that of a knot of the force, to rounding.
  [[nodiscard]] bool is_at_knot(const Number& phase_turns) const {
    if (!constants_.is_in_pieces()) return false;
    const ForcePieces<Number> pieces(constants_.shape);
    return pieces.at(part_of_turn(Number(start_turns_ + phase_turns))).since == 0;
  }
  /// The first knot of the force after a phase, in turns since the section, 0 ... 1; beyond 1 if there is none.
  [[nodiscard]] Number next_knot(const Number& phase_turns) const {
    const Number none(2);
    if (!constants_.is_in_pieces()) return none;
    const ForcePieces<Number> pieces(constants_.shape);
    std::size_t piece = pieces.at(part_of_turn(Number(start_turns_ + phase_turns))).piece;
    for (const bool may_be_here : {true, false}) {
      const Number ahead = part_of_turn(Number(pieces.end_of(piece) - start_turns_)) - phase_turns;
      if (ahead > knot_rounding<Number>()) return phase_turns + ahead;
      if (!may_be_here || ahead < -knot_rounding<Number>()) break;
      piece = piece + 1 < pieces.size() ? piece + 1 : 0;
    }
    return none;
  }

  /// What may hold a mass at x' = 0: the constant forces there, those of a soft stop included, and the static level.
  [[nodiscard]] motion::Holding<Number> holding_at(const motion::State<Number>& state,
                                                   const Number& push = Number(0)) const requires(E.friction) {
    motion::Holding<Number> holding{Side::none, constants_.constant_force(state.x) + push, slips_.static_level};
    for (const Side side : {Side::lower, Side::upper}) {
      const auto stop = motion::stop_at<Number>(stops_, side);
      const bool just_off = state.from_stop == side && state.offset != 0;  // by less than x can tell
      if (!is_soft(stops_, side) && state.x == stop.position && !just_off) holding.stop = side;
    }
    Side within = state.within;
    Number depth = state.offset;
    if (within == Side::none) {
      const auto around = motion::soft_stop_around(stops_, state.x, state.v);
      within = around.side, depth = around.offset;
    }
    if (within != Side::none) holding.constant -= motion::soft_stop_at<Number>(stops_, within).stiffness * depth;
    return holding;
  }
  [[nodiscard]] const auto& slips() const { return slips_; }
  /// The position that the offset of the present flight counts from.
  [[nodiscard]] Number anchor(const motion::State<Number>& state) const {
    return state.from_stop == Side::none ? state.x : motion::stop_at<Number>(stops_, state.from_stop).position;
  }
  /// The beginning of a flight; `released`: the acceleration if it begins with a release.
  template <class Of>
  [[nodiscard]] motion::Motion<Number> motion(const Of& constants, const motion::State<Number>& state,
                                              const Number& released = Number(0)) const {
    const SineCosine<Number> phase = this->phase(state);
    const Number offset = state.from_stop == Side::none ? Number(0) : state.offset;
    const Number displacement = constants.from_equilibrium(state.x, anchor(state), offset);
    const Number a = state.released ? released : constants.acceleration(displacement, state.v, phase);
    return {offset, state.x, state.v, a, phase.sine, phase.cosine};
  }
  /// The longest time after which a mass that a stop or a wall lets go, and that is back, may never have been let go:
  /// a force that touches zero differs from zero so long by no more than the rounding of its parts, some ulps of each.
  [[nodiscard]] Number shortest_hop() const {
    using std::sqrt;
    return 4 * sqrt(epsilon<Number>()) * 2 * pi<Number>() / constants_.rate;
  }

 private:
  Constants constants_;
  BasicStops<Number> stops_;
  [[no_unique_address]] std::conditional_t<E.soft, motion::SoftContact<Number>, motion::NoSoftContact> soft_;
  [[no_unique_address]] std::conditional_t<E.friction, motion::Slips<Number, E.arc()>, motion::NoSlips> slips_;
  bool has_soft_stops_;  ///< asked at each arc: general methods have one set of effects for soft and rigid stops
  Number start_turns_;
};

}  // namespace clatter::stepping
