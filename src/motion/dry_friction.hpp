#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "motion/contact_force.hpp"
#include "motion/soft_contact.hpp"
#include "scene/friction.hpp"

namespace clatter::motion {

/// A mass at x' = 0 that dry friction holds, at any place or on a rigid stop: the other forces on it (per unit mass)
/// are `constant` + f sin(theta). It is let go towards a side once they push it there harder than `level`; never into a
/// rigid stop.
template <class Number>
struct Holding {
  Side stop = Side::none;  ///< the rigid stop that it is on; none: friction alone holds it
  Number constant, level;

  [[nodiscard]] bool may_go(Side side) const { return stop != side; }

  /// Whether it is held from this instant on. Where |f| decides alone, no rounding of the phase does.
  template <Effects E>
  [[nodiscard]] bool holds(const ArcConstants<Number, E>& constants, const SineCosine<Number>& phase) const {
    return holds_against(Side::lower, constants, phase) && holds_against(Side::upper, constants, phase);
  }

  /// Phase in turns, 0 ... 1, at which it is let go towards a side; nothing if it never is (eq. 26 with the level); by
  /// the phase `from` as `phase_of_force`.
  template <Effects E>
  [[nodiscard]] std::optional<Number> release_phase(const ArcConstants<Number, E>& constants, Side side,
                                                    const Number& from = Number(0)) const {
    if (!may_go(side)) return std::nullopt;
    return phase_of_force(constants, Number(sign_of(side) * level - constant), side, from);
  }

 private:
  template <Effects E>
  [[nodiscard]] bool holds_against(Side side, const ArcConstants<Number, E>& constants,
                                   const SineCosine<Number>& phase) const {
    using std::abs;
    if (!may_go(side)) return true;
    const Number left = level - sign_of(side) * constant, most = abs(constants.f);
    if (left >= most) return true;
    if (left <= -most) return false;
    const auto [s, slope] = constants.drive(phase);
    const Number now = left - sign_of(side) * constants.f * s;
    return now > 0 || (now == 0 && sign_of(side) * constants.f * slope < 0);
  }
};

/// The oscillators of a mass that slips: friction moves the load of the free one, and of those in contact with soft
/// stops, against the velocity.
template <class Number, Effects E>
class Slips {
 public:
  template <class Given>
  Slips(const ArcConstants<Number, E>& still, const BasicFriction<Given>& friction, const BasicStops<Given>& stops)
      : kinetic(friction.kinetic),
        static_level(friction.static_level),
        free_{moved(still, kinetic), moved(still, -kinetic)},
        pressed_{SoftContact<Number>(free_[0], stops), SoftContact<Number>(free_[1], stops)} {}

  [[nodiscard]] bool is_rough() const { return static_level > 0; }

  /// Of a slip towards a side.
  [[nodiscard]] const ArcConstants<Number, E>& towards(Side side) const { return free_[index_of(side)]; }
  /// Calls `function(constants)` with those in contact with a soft stop.
  template <class Function>
  decltype(auto) in_contact(Side stop, Side side, Function&& function) const {
    return pressed_[index_of(side)].with_constants(stop, std::forward<Function>(function));
  }

  /// Acceleration at the instant at which friction lets the mass go towards a side.
  [[nodiscard]] Number release_acceleration(Side side) const { return sign_of(side) * (static_level - kinetic); }

  Number kinetic, static_level;  ///< of the friction, the second no less than the first

 private:
  [[nodiscard]] static ArcConstants<Number, E> moved(const ArcConstants<Number, E>& still, const Number& force) {
    auto slip = ArcConstants<Number, E>::of(still.h, still.f, still.nu, still.load + force, still.k, still.shape);
    slip.friction = force, slip.carried = still.carried, slip.rubbing = still.rubbing;
    return slip;
  }

  std::array<ArcConstants<Number, E>, 2> free_;  ///< [side that the mass moves to]
  std::array<SoftContact<Number>, 2> pressed_;   ///< [side that the mass moves to]
};

/// In place of it without friction.
struct NoSlips {
  template <class Constants, class Given>
  NoSlips(const Constants&, const BasicFriction<Given>&, const BasicStops<Given>&) {}
  [[nodiscard]] static constexpr bool is_rough() { return false; }
};

}  // namespace clatter::motion
