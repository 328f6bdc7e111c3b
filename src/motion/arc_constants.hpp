#pragma once

#include <algorithm>
#include <cmath>

#include "math/number.hpp"
#include "motion/derivative_bounds.hpp"
#include "motion/divided_exponentials.hpp"
#include "motion/equation_of_motion.hpp"
#include "motion/propagation.hpp"
#include "motion/smooth_propagator.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "scene/effects.hpp"
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
                     counting_frequency_of(oscillator), Number(oscillator.load), Number(oscillator.stiffness)) {}

  /// From the coefficients of eq. 3, which may be of a type that carries derivatives.
  [[nodiscard]] static ArcConstants of(const Number& h, const Number& f, const Number& nu, const Number& load,
                                       const Number& k = Number(1)) {
    return {Coefficients{}, h, f, nu, load, k};
  }

  /// Of motion in contact with a soft stop (eq. 51). The equilibrium counts from the stop, or its digits would be lost
  /// to those of the stop's position.
  template <Effects Free>
  [[nodiscard]] static ArcConstants in_contact(const ArcConstants<Number, Free>& free,
                                               const SoftStop<Number>& stop) requires(E.stiffness) {
    ArcConstants pressed =
        of(free.h + stop.damping, free.f, free.nu, free.load + stop.stiffness * stop.position, free.k + stop.stiffness);
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
    if constexpr (E.stiffness) return {2 * h, f, nu, k, unbalanced};
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
  Number natural;              ///< |k|^(1/2)
  Number root;                 ///< lambda = |k - h^2|^(1/2)
  Number slow, fast;           ///< decay rates of heavy damping; slow < 0 with an unstable spring
  Response<Number> response;   ///< eq. 6; 0 if arcs form it together with the free motion (secular)
  Number detuning;             ///< nu - lambda, without cancellation
  Number rate;                 ///< the fastest of the motion's frequencies and decay rates
  Number period;               ///< of the force; without forcing 2 pi
  DerivativeBounds<Number> derivative_bounds;

 private:
  struct Coefficients {};  ///< tells the numbers of eq. 3 from those of an oscillator in braces
  ArcConstants(Coefficients, const Number& damping, const Number& forcing, const Number& frequency,
               const Number& constant_force, const Number& stiffness);
  /// The period of `counting_frequency`, to the digits of the number type.
  template <class Other>
  [[nodiscard]] static Number counting_frequency_of(const BasicOscillator<Other>& oscillator) {
    using std::sqrt;
    if constexpr (E.stiffness)
      if (oscillator.forcing == 0 && oscillator.stiffness > 0) return sqrt(Number(oscillator.stiffness));
    return Number(counting_frequency(oscillator));
  }
  void set_stiffness(const Number& stiffness);
  [[nodiscard]] Number short_a_minus_one(const Number& s) const;
  [[nodiscard]] bool is_short(const Number& s) const;
  [[nodiscard]] Number pulled(const Number& s) const;
  void respond_from_rest(const Number& s, Step<Number>& step) const;
  void respond_away_from_resonance(Step<Number>& step) const;

  Number coarse_root_{}, spare_root_{};  ///< light damping: root is their difference; the first is 1 if h < 1/2
};

template <class Number, Effects E>
ArcConstants<Number, E>::ArcConstants(Coefficients, const Number& damping, const Number& forcing,
                                      const Number& frequency, const Number& constant_force, const Number& stiffness)
    : h(damping), f(forcing), nu(frequency), load(constant_force), k(1), equilibrium(load), unbalanced(0), natural(1) {
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
  if constexpr (E.forcing == Forcing::regular) response = response_to(Number(k - nu * nu), h, f, nu);
  rate = max(nu, max(natural, Number(k > 0 ? 2 * h : fast)));
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

template <class Number, Effects E>
Step<Number> ArcConstants<Number, E>::step(const Number& s) const {
  using std::exp;
  Step<Number> step{propagator(s)};
  if constexpr (E.forcing != Forcing::none) step.turn = turn_by(Number(nu * s));
  if constexpr (E.forcing == Forcing::secular) respond_from_rest(s, step);
  if constexpr (E.damping == Damping::heavy) step.fast_decay = exp(-fast * s);
  if constexpr (E.stiffness)
    if (!is_always_zero(unbalanced)) step.pulled = pulled(s);
  return step;
}

/// Displacement a time s after rest under a unit force that no spring balances (eq. 45).
template <class Number, Effects E>
Number ArcConstants<Number, E>::pulled(const Number& s) const {
  if constexpr (CarriesDerivatives<Number>)
    if (!is_always_zero(k)) return pulled_by_no_spring(h, k, s);
  return s * s * second_divided_decay(Number(2 * h * s));
}

/// Displacement and velocity a time s after rest under a unit force sin(phase): Im(e^{i phase} w(s)) with w of eq. 11,
/// which has no difference of large numbers.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_from_rest(const Number& s, Step<Number>& step) const {
  using std::cos, std::exp, std::sin;
  const Number least = secular_distance * natural;  // sets of all effects serve scenes away from resonance, too
  if (!(h * h + detuning * detuning < least * least)) return respond_away_from_resonance(step);
  const Number lambda = root, c = cos(nu * s), d = sin(nu * s);
  const auto [q_re, q_im] = divided_exponential<Number>(-h * s, -detuning * s);
  const Number near_re = s * (c * q_re - d * q_im), near_im = s * (c * q_im + d * q_re);  // E(mu)
  const Number decay = exp(-h * s), top_re = c - decay * cos(lambda * s), top_im = d + decay * sin(lambda * s);
  const Number sum = nu + lambda, square = h * h + sum * sum;
  const Number far_re = (top_re * h + top_im * sum) / square, far_im = (top_im * h - top_re * sum) / square;  // E(mu*)
  const Number minus_re = near_re - far_re, minus_im = near_im - far_im, plus_re = near_re + far_re,
               plus_im = near_im + far_im;
  const Number w_re = minus_im / (2 * lambda), w_im = -minus_re / (2 * lambda);
  step.displacement = {w_re, w_im};
  step.velocity = {plus_re / 2 - h * w_re, plus_im / 2 - h * w_im};  // [mu E(mu) - mu* E(mu*)]/(2 i lambda)
}

/// The same by the steady response and the free motion that it leaves, w = (P + iQ)(e^{i nu s} - A - i nu B) with eqs.
/// 7 and 44: eq. 11 is a difference of numbers 1/lambda times larger, which is much near critical damping.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_away_from_resonance(Step<Number>& step) const {
  const Propagator<Number>& free = step.free;
  const Turn<Number>& turn = step.turn;
  const Response<Number> unit = response_to(Number(k - nu * nu), h, Number(1), nu);
  const auto times_unit = [&](const Number& re, const Number& im) -> SineCosine<Number> {
    return {unit.in_phase * re - unit.quadrature * im, unit.in_phase * im + unit.quadrature * re};
  };
  step.displacement = times_unit(turn.cosine_minus_one - free.a_minus_one, turn.sine - nu * free.b);
  step.velocity = times_unit(k * free.b - nu * turn.sine, nu * (1 + turn.cosine_minus_one - free.c));
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
