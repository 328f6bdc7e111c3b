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
    if constexpr (E.stiffness && E.forcing != Forcing::none) return !shape.is_sine();
    return false;
  }
  /// Whether arcs form response and transient together: at resonance, and in pieces of a force.
  [[nodiscard]] bool forms_together() const { return E.forcing == Forcing::secular || is_in_pieces(); }

  /// w^2 of the shape of the force: its second derivative by the phase is -w^2 times itself.
  [[nodiscard]] Number curl() const { return swing * swing; }
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
  /// Largest |ds/dtheta| of the force.
  [[nodiscard]] Number steepest() const { return is_in_pieces() ? steepest_of(shape) : Number(1); }
  /// Bounds of s and ds/dtheta from `m` on for a time `span` within a piece: 0 where there is no force.
  [[nodiscard]] SineCosine<Number> most_of_shape(const Motion<Number>& m, const Number& span) const {
    using std::abs;
    if (swing == 0) return {abs(m.sine) + abs(m.cosine) * nu * span, abs(m.cosine)};
    const Number size = norm(m.sine, Number(m.cosine / swing));
    return {size, swing * size};
  }
  /// Bound of the force's part of a derivative that is bounded, likewise.
  template <std::size_t count>
  [[nodiscard]] Number force_in_pieces(const DerivativeBounds<Number, count>& bounds, const Motion<Number>& m,
                                       const Number& span, int derivative) const {
    if (!is_in_pieces()) return Number(0);
    const auto i = static_cast<std::size_t>(derivative);
    const auto [s, slope] = most_of_shape(m, span);
    return bounds.by_value[i] * s + bounds.by_slope[i] * slope;
  }

  /// All coefficients of a step by a time s >= 0 (`Arc::moved`).
  [[nodiscard]] Step<Number> step(const Number& s) const;

  /// Displacement and velocity of the steady forced response at a phase (eq. 5); 0 if the forcing is secular, as arcs
  /// then form response and transient together.
  [[nodiscard]] Number response_displacement(const Number& sine, const Number& cosine) const {
    if constexpr (E.forcing == Forcing::regular) return response.displacement(sine, cosine);
    return Number(0);
  }
  [[nodiscard]] Number response_velocity(const Number& sine, const Number& cosine) const {
    if constexpr (E.forcing == Forcing::regular) return response.velocity(nu, sine, cosine);
    return Number(0);
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
  [[nodiscard]] Number force(const Number& sine) const {
    if constexpr (E.forcing == Forcing::none) return load;
    return load + f * sine;
  }
  /// The constant part of the force on a mass at x.
  [[nodiscard]] Number constant_force(const Number& x) const { return load - spring(x); }

  /// Eq. 3, for displacements from the load's equilibrium.
  [[nodiscard]] Equation equation() const {
    if constexpr (E.stiffness) return {2 * h, f, nu, k, unbalanced, curl()};
    return {2 * h, f, nu};
  }
  [[nodiscard]] Number acceleration(const Number& displacement, const Number& v, const Number& sine) const {
    return equation().acceleration(displacement, v, sine);
  }
  [[nodiscard]] Number jerk(const Motion<Number>& m) const { return equation().jerk(m.v, m.a, m.cosine); }

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
  Response<Number> response;        ///< eq. 6; 0 if arcs form it together with the free motion (secular)
  Number detuning;                  ///< nu - lambda, without cancellation
  Number rate;                      ///< the fastest of the motion's frequencies and decay rates
  Number period;                    ///< of the force; without forcing 2 pi
  DerivativeBounds<Number> derivative_bounds;

 private:
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
  [[nodiscard]] Ramp<Number> ramp(const Number& s, const Propagator<Number>& free) const;

  Number coarse_root_{}, spare_root_{};  ///< light damping: root is their difference; the first is 1 if h < 1/2
};

template <class Number, Effects E>
ArcConstants<Number, E>::ArcConstants(Coefficients, const Number& damping, const Number& forcing,
                                      const Number& frequency, const Number& constant_force, const Number& stiffness,
                                      const BasicForceShape<Number>& force_shape)
    : h(damping),
      f(forcing),
      nu(frequency),
      load(constant_force),
      k(1),
      equilibrium(load),
      unbalanced(0),
      shape(force_shape),
      swing(swing_of(shape)),
      natural(1) {
  using std::abs, std::max, std::sqrt;
  if constexpr (E.stiffness) {
    set_stiffness(stiffness);
  } else {
    root = sqrt(abs((1 - h) * (1 + h)));
    fast = h + root;
    slow = 1 / fast;
    if constexpr (E.forcing == Forcing::regular) response = steady_response(h, f, nu);
    rate = max(nu, max(Number(1), Number(2 * h)));
  }
  coarse_root_ = select<Number>(h < natural / 2, natural, root);
  spare_root_ = select<Number>(h < natural / 2, Number(h * h / (natural + root)), Number(0));
  detuning = (nu - natural) + h * h / (natural + root);
  period = 2 * pi<Number>() / nu;
  derivative_bounds = motion::derivative_bounds(equation(), natural);
}

template <class Number, Effects E>
void ArcConstants<Number, E>::set_stiffness(const Number& stiffness) {
  using std::abs, std::max, std::sqrt;
  k = stiffness;
  const bool sprung = k < 0 || k > 0;
  natural = sprung ? Number(sqrt(abs(k))) : Number(0);
  equilibrium = sprung ? Number(load / k) : Number(0);
  unbalanced = sprung ? Number(0) : load;
  balance = equilibrium;
  root = k > 0 ? Number(sqrt(abs((natural - h) * (natural + h)))) : norm(h, natural);
  if (!sprung && h > 0 && !is_always_zero(k)) root = sqrt(h * h - k);  // of k only the derivatives count
  if (E.damping == Damping::light && !(root > 0)) root = epsilon<Number>() * natural;  // h^2 < k by rounding alone
  fast = h + root;
  slow = sprung || (fast > 0 && !is_always_zero(k)) ? Number(k / fast) : Number(0);
  if constexpr (E.forcing == Forcing::regular)
    if (!is_in_pieces()) response = response_to(Number(k - nu * nu), h, f, nu);
  rate = max(Number(is_in_pieces() ? max(nu, Number(swing * nu)) : nu), max(natural, Number(k > 0 ? 2 * h : fast)));
}

template <class Number, Effects E>
Propagator<Number> ArcConstants<Number, E>::propagator(const Number& s) const {
  using std::abs, std::cos, std::exp, std::expm1, std::sin;
  if constexpr (CarriesDerivatives<Number> && E.damping != Damping::none) {
    const Number square = (k > 0 ? (h - natural) * (h + natural) : h * h - k) * s * s;
    if (abs(square) <= Number(near_critical)) {
      Propagator<Number> free = near_critical_propagator(h, k, s, square);
      free.a_minus_one = is_short(s) ? short_a_minus_one(s) : Number(free.a - 1);
      return free;
    }
  }
  if constexpr (E.damping == Damping::none) {
    const Number half = sin(s / 2), b = 2 * half * cos(s / 2), a_minus_one = -2 * half * half;
    return {1 + a_minus_one, b, 1 + a_minus_one, b, a_minus_one};
  } else if constexpr (E.damping == Damping::light) {
    // a long arc turns by more than one angle can hold, so the digits that the difference of the two products loses are
    // added again
    const Number coarse = coarse_root_ * s, spare = spare_root_ * s;
    const Number angle = coarse - spare, lost = (coarse - angle) - spare;
    const Number sine = sin(angle / 2), cosine = cos(angle / 2);
    const Number half = sine + lost / 2 * cosine, other = cosine - lost / 2 * sine;
    const Number cosine_minus_one = -2 * half * half;
    Propagator<Number> free = light_propagator<Number>(exp(-h * s), 1 + cosine_minus_one, 2 * half * other / root, h);
    if constexpr (E.stiffness) free.d = mul_add(h + h, free.c, k * free.b);
    free.a_minus_one = s * natural <= Number(0.25)
                           ? short_a_minus_one(s)
                           : expm1(-h * s) * (1 + cosine_minus_one) + cosine_minus_one + h * free.b;
    return free;
  } else {
    const Number slow_decay = exp(-slow * s), fast_decay = exp(-fast * s), spread = 2 * root * s;
    const Number b =
        slow_decay * select<Number>(spread > 0, -expm1(-spread) / (2 * root), s);  // root = 0: critical damping
    const Number d = 2 * h * fast_decay - slow * slow * b;                         // 2 h slow - k = slow^2
    const Number a_minus_one = is_short(s) ? short_a_minus_one(s) : Number(expm1(-slow * s) + slow * b);
    return {slow_decay + slow * b, b, fast_decay - slow * b, d, a_minus_one};
  }
}

/// Whether a time is short for the oscillator of heavy damping.
template <class Number, Effects E>
bool ArcConstants<Number, E>::is_short(const Number& s) const {
  return 8 * h * s <= 1 && (!E.stiffness || 4 * natural * s <= 1);
}

/// A(s) - 1 for a time that is short for the oscillator, though perhaps not for a fast force, by the Taylor series: the
/// closed form is a difference of terms 1/s times larger.
template <class Number, Effects E>
Number ArcConstants<Number, E>::short_a_minus_one(const Number& s) const {
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 13 : 36;  // (1/4)^n / n! below rounding
  Number before = 0, last = -spring(s * s) / 2, sum = last;                   // of s^n A^(n)(0) / n!
  for (int n = 3; n < terms; ++n) {
    const Number next = -(spring(s * s * before) + 2 * h * s * (n - 1) * last) / (n * (n - 1));
    sum += next, before = last, last = next;
  }
  return sum;
}

}  // namespace clatter::motion

#include "motion/arc_steps.hpp"
