#pragma once

#include <algorithm>
#include <cmath>

#include "math/number.hpp"
#include "motion/derivative_bounds.hpp"
#include "motion/divided_exponentials.hpp"
#include "motion/equation_of_motion.hpp"
#include "motion/propagation.hpp"
#include "motion/ramp.hpp"
#include "motion/smooth_propagator.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "scene/effects.hpp"
#include "scene/force_shape.hpp"
#include "scene/oscillator.hpp"
#include "scene/response.hpp"

namespace clatter::motion {

/// The constants of an oscillator that all its arcs share, and its free motion; `arc_bounds.hpp` bounds its arcs.
template <class Number, Effects E>
class ArcConstants {
  static_assert(E == E.arc());  // the other effects don't change an arc, so they mustn't compile it again

 public:
  static constexpr Effects effects = E;
  using Equation = EquationOfMotion<Number, E>;

  template <class Other = double>
  explicit ArcConstants(const BasicOscillator<Other>& oscillator)
      : ArcConstants(Coefficients{}, Number(oscillator.damping), Number(oscillator.forcing),
                     counting_frequency_of(oscillator), Number(oscillator.load), Number(oscillator.stiffness),
                     with_numbers<Number>(oscillator.shape)) {}

  /// From the coefficients of eq. 3, which may be of a type that carries derivatives.
  [[nodiscard]] static ArcConstants of(const Number& h, const Number& f, const Number& nu, const Number& load,
                                       const Number& k = Number(1), const BasicForceShape<Number>& shape = {}) {
    return {Coefficients{}, h, f, nu, load, k, shape};
  }

  /// Of motion in contact with a soft stop (eq. 51). The equilibrium counts from the stop, or its digits would be lost
  /// to those of the stop's position.
  template <Effects Free>
  [[nodiscard]] static ArcConstants in_contact(const ArcConstants<Number, Free>& free,
                                               const SoftStop<Number>& stop) requires(E.stiffness) {
    ArcConstants pressed = of(free.h + stop.damping, free.f, free.nu, free.load + stop.stiffness * stop.position,
                              free.k + stop.stiffness, free.shape);
    pressed.stop = stop, pressed.friction = free.friction, pressed.carried = free.carried;
    pressed.rubbing = free.rubbing;
    if (pressed.natural > 0) {
      pressed.origin = stop.position, pressed.balance = (free.load - free.k * stop.position) / pressed.k;
      pressed.equilibrium = pressed.origin + pressed.balance;
    }
    return pressed;
  }

  /// Free motion over s >= 0, without cancellation for every h (eqs. 8 and 9).
  [[nodiscard]] Propagator<Number> propagator(const Number& s) const;

  /// Free motion advanced by a propagator.
  [[nodiscard]] FreeMotion<Number> advanced(const Propagator<Number>& p, const FreeMotion<Number>& from) const {
    if constexpr (E.stiffness) return {mul_add(p.a, from.x, p.b * from.v), mul_sub(p.c, from.v, k * p.b * from.x)};
    return p.advance(from);
  }

  /// Whether the force is in pieces. Then the phase of a motion, its sine and cosine, stands for s and ds/dtheta.
  [[nodiscard]] bool is_in_pieces() const {
    if constexpr (E.stiffness && E.forcing != Forcing::none) return shape.is_in_pieces();
    return false;
  }
  /// Whether the force is a sum of sines.
  [[nodiscard]] bool has_orders() const {
    if constexpr (E.stiffness && E.forcing != Forcing::none) return shape.has_orders();
    return false;
  }
  /// Whether arcs form response and transient together: near resonance, that of one of several orders, and in pieces.
  [[nodiscard]] bool forms_together() const {
    if constexpr (E.stiffness && E.forcing != Forcing::none) return is_together_;
    return E.forcing == Forcing::secular;
  }
  /// s and ds/dtheta of the force at the phase of a motion.
  [[nodiscard]] SineCosine<Number> drive(const SineCosine<Number>& phase) const {
    if (!has_orders()) return phase;
    const auto s = shape.orders.derivatives(phase);
    return {s[0], s[1]};
  }
  [[nodiscard]] SineCosine<Number> drive(const Motion<Number>& m) const {
    return drive(SineCosine<Number>{m.sine, m.cosine});
  }

  /// w^2 of the shape of the force: unless that is a sum of sines, its second derivative by the phase is -w^2 times it.
  [[nodiscard]] Number curl() const { return swing * swing; }
  /// Bound of |d^2 s/dtheta^2| of the force within a piece.
  [[nodiscard]] Number sharpest() const { return has_orders() ? shape.orders.most_of(2) : curl(); }
  /// Turn of the phase by a time s, within a piece.
  [[nodiscard]] Turn<Number> turn(const Number& s) const {
    if (!is_in_pieces()) return turn_by(Number(nu * s));
    if (swing == 0) return {nu * s, Number(0)};
    const Turn<Number> by_swing = turn_by(Number(swing * nu * s));
    return {by_swing.sine / swing, by_swing.cosine_minus_one};
  }
  /// Change of the phase by a turn.
  [[nodiscard]] SineCosine<Number> change(const Turn<Number>& turn, const SineCosine<Number>& from) const {
    SineCosine<Number> change = change_by(turn, from);
    if (is_in_pieces()) change.cosine = mul_sub(from.cosine, turn.cosine_minus_one, curl() * from.sine * turn.sine);
    return change;
  }
  /// The phase a time s after another one.
  [[nodiscard]] SineCosine<Number> phase_after(const SineCosine<Number>& from, const Number& s) const {
    const SineCosine<Number> by = change(turn(s), from);
    return {from.sine + by.sine, from.cosine + by.cosine};
  }
  /// The phase, from turns.
  [[nodiscard]] SineCosine<Number> phase_at(const Number& turns) const {
    return is_in_pieces() ? shape_at(shape, turns) : sine_cosine_of_turns(turns);
  }
  /// Whether only a jump of the force can let a mass go that friction holds there: its instant depends on no state.
  [[nodiscard]] bool is_let_go_by_jump(const Motion<Number>& m) const {
    if (!is_in_pieces()) return false;
    return m.cosine == 0 || jumps_to(shape, m.sine);
  }
  /// Bound of |ds/dtheta| of the force.
  [[nodiscard]] Number steepest() const { return is_in_pieces() || has_orders() ? steepest_of(shape) : Number(1); }
  /// Bounds of s and ds/dtheta from `m` on for a time `span`, within a piece: 0 where there is no force.
  [[nodiscard]] SineCosine<Number> most_of_shape(const Motion<Number>& m, const Number& span) const;
  /// Bounds of the sixth and the next derivatives of arcs.
  template <std::size_t count = 2>
  [[nodiscard]] DerivativeBounds<Number, count> bounds() const;
  /// The size of the part of the force whose response isn't apart.
  [[nodiscard]] Number together() const {
    using std::abs;
    return has_orders() ? Number(resonant > 0 ? abs(f) * shape.orders.size(resonant) : Number(0)) : Number(abs(f));
  }
  /// The steady response to a piece of a force, as if that lasted for ever; of k > 0.
  [[nodiscard]] FreeMotion<Number> response_in_piece(const Motion<Number>& m) const;
  /// Bound of the force's part of a derivative that is bounded, likewise; 0 if arcs have the response apart.
  template <std::size_t count>
  [[nodiscard]] Number force_together(const DerivativeBounds<Number, count>& bounds, const Motion<Number>& m,
                                      const Number& span, int derivative) const {
    if (!forms_together()) return Number(0);
    const auto i = static_cast<std::size_t>(derivative);
    if (!is_in_pieces()) return bounds.forced[i];
    const auto [s, slope] = most_of_shape(m, span);
    return bounds.by_value[i] * s + bounds.by_slope[i] * slope;
  }

  /// All coefficients of a step by a time s >= 0 (`Arc::moved`).
  [[nodiscard]] Step<Number> step(const Number& s) const;

  /// Displacement and velocity of the steady forced response at a phase (eq. 5); 0 if arcs form response and transient
  /// together.
  [[nodiscard]] FreeMotion<Number> response_at(const SineCosine<Number>& phase) const {
    if (has_orders()) return response_of_orders(phase);
    return {response_displacement(phase.sine, phase.cosine), response_velocity(phase.sine, phase.cosine)};
  }
  /// The same of a sine alone.
  [[nodiscard]] Number response_displacement(const Number& sine, const Number& cosine) const {
    if constexpr (may_respond) return response.displacement(sine, cosine);
    return Number(0);
  }
  [[nodiscard]] Number response_velocity(const Number& sine, const Number& cosine) const {
    if constexpr (may_respond) return response.velocity(nu, sine, cosine);
    return Number(0);
  }

  /// Displacement and velocity a step after rest at a phase, by that part of the force whose response isn't apart.
  [[nodiscard]] FreeMotion<Number> from_rest(const SineCosine<Number>& from, const Step<Number>& step) const {
    if (has_orders()) return resonant_order_from_rest(from, step);
    return {f * (from.cosine * step.displacement.cosine + from.sine * step.displacement.sine),
            f * (from.cosine * step.velocity.cosine + from.sine * step.velocity.sine)};
  }

  /// Displacement from the load's equilibrium of a mass at x = anchor + offset, by whichever of the two forms of x
  /// keeps more digits.
  [[nodiscard]] Number from_equilibrium(const Number& x, const Number& anchor, const Number& offset) const {
    using std::abs;
    Number from = anchor - equilibrium;
    if constexpr (E.stiffness) from = (anchor - origin) - balance;
    return abs(from) + abs(offset) < abs(x) ? from + offset : x - equilibrium;
  }

  /// k y: the force of the spring at a displacement, or any other product with its stiffness.
  [[nodiscard]] Number spring(const Number& y) const {
    if constexpr (E.stiffness) return k * y;
    return y;
  }
  /// The force on a mass at x = 0, at a forcing phase.
  [[nodiscard]] Number force(const SineCosine<Number>& phase) const {
    if constexpr (E.forcing == Forcing::none) return load;
    return load + f * drive(phase).sine;
  }
  /// The constant part of the force on a mass at x.
  [[nodiscard]] Number constant_force(const Number& x) const { return load - spring(x); }

  /// Eq. 3, for displacements from the load's equilibrium.
  [[nodiscard]] Equation equation() const {
    if constexpr (E.stiffness) return {2 * h, f, nu, k, unbalanced, curl()};
    return {2 * h, f, nu};
  }
  [[nodiscard]] Number acceleration(const Number& displacement, const Number& v,
                                    const SineCosine<Number>& phase) const {
    return equation().acceleration(displacement, v, drive(phase).sine);
  }
  [[nodiscard]] Number jerk(const Motion<Number>& m) const { return equation().jerk(m.v, m.a, drive(m).cosine); }
  [[nodiscard]] HigherDerivatives<Number> derivatives(const Motion<Number>& m) const {
    if (has_orders()) return equation().derivatives(m.v, m.a, shape.orders.derivatives({m.sine, m.cosine}));
    return equation().derivatives(m.v, m.a, m.sine, m.cosine);
  }

  /// Speed at the soft stop in contact of a free undamped motion that is `offset` beyond it with velocity v, by its
  /// energy.
  [[nodiscard]] Number speed_at_stop(const Number& offset, const Number& v) const {
    using std::max, std::sqrt;
    const Number force = natural > 0 ? Number(k * balance) : unbalanced;
    return sqrt(max(Number(0), Number(v * v + offset * (k * offset - 2 * force))));
  }

  /// Displacement of the fast mode of heavy damping in a free motion (x, v); infinite or NaN at h^2 = k, which has no
  /// two modes.
  [[nodiscard]] Number fast_mode(const Number& x, const Number& v) const { return -(slow * x + v) / (2 * root); }

  /// Whether free motion is a decaying rotation.
  [[nodiscard]] bool rotates() const {
    if constexpr (E.stiffness) return h * h < k;
    return h < 1;
  }

  Number h, f, nu, load;       ///< of the oscillator; without forcing nu is that of `counting_frequency`
  Number carried{};            ///< a loose mass that a wall presses, over the main mass; 0: none
  Number friction{};           ///< the part of the load that is dry friction, against the velocity of a slip
  Number rubbing{};            ///< the part of the load that is the friction of a loose mass that slides in its housing
  Number k;                    ///< stiffness; 1 unless it is an effect
  Number equilibrium;          ///< the displacement at which the spring balances the load; 0 without a spring
  Number unbalanced;           ///< the load, if no spring balances it, else 0
  Number origin{}, balance{};  ///< the equilibrium is their sum; in contact with a soft stop the first is its position
  SoftStop<Number> stop{};     ///< the one in contact; side none: none is
  BasicForceShape<Number> shape{};  ///< of the force
  Number swing{1};                  ///< w of that
  Number natural;                   ///< |k|^(1/2)
  Number root;                      ///< lambda = |k - h^2|^(1/2)
  Number slow, fast;                ///< decay rates of heavy damping; slow < 0 with an unstable spring
  Response<Number> response;        ///< eq. 6; 0 if arcs form it together with the free motion
  Number detuning;                  ///< nu - lambda, without cancellation
  Number rate;                      ///< the fastest of the motion's frequencies and decay rates
  Number period;                    ///< of the force; without forcing 2 pi
  DerivativeBounds<Number> derivative_bounds;
  Number response_speed{};                                                ///< largest velocity of that
  std::array<ForceOrder<Number>, ForceOrders<Number>::most> responses{};  ///< P and Q of orders; 0 of the resonant one
  std::array<Number, 3> order_bounds{};  ///< of the sixth and the next derivatives of their sum, over nu^6
  Response<Number> of_swing{};           ///< to a half-sine that went on for ever
  std::size_t resonant = 0;              ///< the order near resonance, whose response a step has; 0: none is

 private:
  /// Whether the set has arcs that don't form response and transient together; those of any stiffness have both kinds.
  static constexpr bool may_respond = E.forcing == Forcing::regular || (E.stiffness && E.forcing == Forcing::secular);

  struct Coefficients {};  ///< tells the numbers of eq. 3 from those of an oscillator in braces
  ArcConstants(Coefficients, const Number& damping, const Number& forcing, const Number& frequency,
               const Number& constant_force, const Number& stiffness, const BasicForceShape<Number>& force_shape);
  /// The period of `counting_frequency`, to the digits of the number type.
  template <class Other>
  [[nodiscard]] static Number counting_frequency_of(const BasicOscillator<Other>& oscillator) {
    using std::sqrt;
    if constexpr (E.stiffness)
      if (!is_driven(oscillator) && oscillator.stiffness > 0) return sqrt(Number(oscillator.stiffness));
    return Number(counting_frequency(oscillator));
  }
  void set_stiffness(const Number& stiffness);
  [[nodiscard]] Number short_a_minus_one(const Number& s) const;
  [[nodiscard]] bool is_short(const Number& s) const;
  [[nodiscard]] Number pulled(const Number& s) const;
  /// A frequency, its distance from lambda, and the turn of its phase in a step.
  struct Beat {
    Number frequency, detuning;
    Turn<Number> turn;
  };
  void respond_from_rest(const Number& s, const Beat& beat, Step<Number>& step) const;
  void respond_away_from_resonance(const Beat& beat, Step<Number>& step) const;
  void respond_in_piece(const Number& s, Step<Number>& step) const;
  void respond_to_orders();
  [[nodiscard, gnu::noinline]] FreeMotion<Number> response_of_orders(const SineCosine<Number>& phase) const;
  [[nodiscard, gnu::noinline]] FreeMotion<Number> resonant_order_from_rest(const SineCosine<Number>& from,
                                                                           const Step<Number>& step) const;
  [[nodiscard]] Beat beat_of(const Number& frequency, const Number& s) const {
    return {frequency, detuning_of(frequency), turn_by(Number(frequency * s))};
  }
  [[nodiscard]] Number detuning_of(const Number& frequency) const {
    return (frequency - natural) + h * h / (natural + root);
  }
  /// Whether a frequency is so near resonance that its response cancels with the transient.
  [[nodiscard]] bool is_resonant(const Number& off) const {
    const Number least = secular_distance * natural;
    return E.damping != Damping::heavy && h * h + off * off < least * least;
  }
  [[nodiscard]] Ramp<Number> ramp(const Number& s, const Propagator<Number>& free) const;

  bool is_together_ = false;
  Number coarse_root_{}, spare_root_{};  ///< light damping: root is their difference; the first is 1 if h < 1/2
};

}  // namespace clatter::motion

#include "motion/arc_force.hpp"
#include "motion/arc_steps.hpp"
