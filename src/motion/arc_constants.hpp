#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/number.hpp"
#include "model/effects.hpp"
#include "model/oscillator.hpp"
#include "model/response.hpp"
#include "motion/equation_of_motion.hpp"
#include "motion/propagation.hpp"
#include "motion/state.hpp"

namespace clatter::motion {

/// The coefficients that advance every motion of an oscillator by a time s.
template <class Number>
struct Step {
  Propagator<Number> free;
  Turn<Number> turn{};                            ///< by nu s
  SineCosine<Number> displacement{}, velocity{};  ///< secular: response from rest to a unit force (eq. 11)
  Number fast_decay{};                            ///< heavy damping: e^(-fast s)
};

/// (e^z - 1)/z for z = re + i im with re <= 0, the divided difference of the exponential (eq. 11), to relative accuracy
/// for every z.
template <class Number>
[[nodiscard]] std::array<Number, 2> divided_exponential(const Number& re, const Number& im) {
  using std::cos, std::exp, std::expm1, std::sin, std::sqrt;
  const Number square = re * re + im * im;
  if (square < sqrt(epsilon<Number>())) {  // 1 + z/2 + z^2/6 + z^3/24: the next term is below rounding
    const Number re2 = (re - im) * (re + im), im2 = 2 * re * im;
    return {1 + re / 2 + re2 / 6 + (re * re2 - im * im2) / 24, im / 2 + im2 / 6 + (re * im2 + im * re2) / 24};
  }
  const Number half = sin(im / 2), u = expm1(re) * cos(im) - 2 * half * half, w = exp(re) * sin(im);
  return {(u * re + w * im) / square, (w * re - u * im) / square};
}

/// y z^6, one factor at a time, so that 0 meets infinity only if y or z is not finite.
template <class Number>
[[nodiscard]] Number times_sixth_power(const Number& y, const Number& z) {
  return y * z * z * z * z * z * z;
}

/// The constants of an oscillator that all its arcs share, its free motion and its bounds.
template <class Number, Effects E>
class ArcConstants {
  static_assert(E == E.arc());  // the other effects don't change an arc, so they mustn't compile it again

 public:
  using Equation = EquationOfMotion<Number, E>;

  explicit ArcConstants(const Oscillator& oscillator)
      : ArcConstants(Coefficients{}, Number(oscillator.damping), Number(oscillator.forcing),
                     Number(counting_frequency(oscillator)), Number(oscillator.load)) {}

  /// From the coefficients of eq. 3, which may be of a type that carries derivatives.
  [[nodiscard]] static ArcConstants of(const Number& h, const Number& f, const Number& nu, const Number& load) {
    return {Coefficients{}, h, f, nu, load};
  }

  /// Free motion over s >= 0, without cancellation for every h (eqs. 8 and 9).
  [[nodiscard]] Propagator<Number> propagator(const Number& s) const;

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
    const Number from = anchor - load;
    return abs(from) + abs(offset) < abs(x) ? from + offset : x - load;
  }

  /// Eq. 3, for displacements from the load's equilibrium.
  [[nodiscard]] Equation equation() const { return {2 * h, f, nu}; }
  [[nodiscard]] Number acceleration(const Number& displacement, const Number& v, const Number& sine) const {
    return equation().acceleration(displacement, v, sine);
  }
  [[nodiscard]] Number jerk(const Motion<Number>& m) const { return equation().jerk(m.v, m.a, m.cosine); }

  /// Bound of span^6 |y^(6)| from `m` on for a time `span`, for y = x (derivative 0) or y = x' (derivative 1), by
  /// eq. 14; under heavy damping the smaller of that and the bound mode by mode, since the fast mode dies out.
  [[nodiscard]] Number sixth_bound(const Motion<Number>& m, const Number& span, int derivative) const;

  /// Bound of |x - load| from `m` on for a time `span` (eq. 16); at resonance the force may raise the energy norm by
  /// |f| in a unit of time.
  [[nodiscard]] Number reach(const Motion<Number>& m, const Number& span) const;

  /// Displacement of the fast mode of heavy damping in a free motion (x, v); infinite or NaN at h = 1, which has no two
  /// modes.
  [[nodiscard]] Number fast_mode(const Number& x, const Number& v) const { return -(slow * x + v) / (2 * root); }

  Number h, f, nu, load;      ///< of the oscillator; without forcing nu = 1, so that a period is 2 pi
  Number root;                ///< lambda = |1 - h^2|^(1/2)
  Number slow, fast;          ///< decay rates of heavy damping
  Response<Number> response;  ///< eq. 6; 0 if arcs form it together with the free motion (secular)
  Number detuning;            ///< nu - lambda, without cancellation
  Number rate;                ///< the fastest of the motion's frequencies and decay rates
  Number period;              ///< of the force; without forcing 2 pi
 private:
  struct Coefficients {};  ///< tells the numbers of eq. 3 from those of an oscillator in braces
  ArcConstants(Coefficients, const Number& damping, const Number& forcing, const Number& frequency,
               const Number& constant_force);
  void bound_derivatives();
  [[nodiscard]] Number short_a_minus_one(const Number& s) const;
  void respond_from_rest(const Number& s, Step<Number>& step) const;

  Number coarse_root_{}, spare_root_{};   ///< light damping: root is their difference; the first is 1 if h < 1/2
  std::array<Number, 2> free_bound_{};    ///< of |x^(6)| and |x^(7)| over the energy norm
  std::array<Number, 2> forced_bound_{};  ///< secular: of the force's part of the same derivatives
};

template <class Number, Effects E>
ArcConstants<Number, E>::ArcConstants(Coefficients, const Number& damping, const Number& forcing,
                                      const Number& frequency, const Number& constant_force)
    : h(damping), f(forcing), nu(frequency), load(constant_force) {
  using std::abs, std::max, std::sqrt;
  root = sqrt(abs((1 - h) * (1 + h)));
  coarse_root_ = select<Number>(h < Number(0.5), Number(1), root);
  spare_root_ = select<Number>(h < Number(0.5), Number(h * h / (1 + root)), Number(0));
  fast = h + root;
  slow = 1 / fast;
  if constexpr (E.forcing == Forcing::regular) response = steady_response(h, f, nu);
  detuning = (nu - 1) + h * h / (1 + root);
  rate = max(nu, max(Number(1), Number(2 * h)));
  period = 2 * pi<Number>() / nu;
  bound_derivatives();
}

template <class Number, Effects E>
void ArcConstants<Number, E>::bound_derivatives() {
  using std::abs;
  Number x_part = 1, v_part = 0;  // x^(k) = x_part x + v_part v + f Im(e^{i theta} (re + i im))
  Number re = 0, im = 0, next_re = 0, next_im = 0;
  Number power_re = 1, power_im = 0;  // (i nu)^k
  for (std::size_t k = 0; k < 8; ++k) {
    if (k >= 6) free_bound_[k - 6] = norm(x_part, v_part), forced_bound_[k - 6] = abs(f) * norm(re, im);
    const Number x_next = -v_part, v_next = x_part - 2 * h * v_part;
    x_part = x_next, v_part = v_next;
    const Number after_re = -2 * h * next_re - re + power_re, after_im = -2 * h * next_im - im + power_im;
    re = next_re, im = next_im, next_re = after_re, next_im = after_im;
    const Number turned = -nu * power_im;
    power_im = nu * power_re, power_re = turned;
  }
}

template <class Number, Effects E>
Propagator<Number> ArcConstants<Number, E>::propagator(const Number& s) const {
  using std::cos, std::exp, std::expm1, std::sin;
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
    free.a_minus_one = s <= Number(0.25) ? short_a_minus_one(s)
                                         : expm1(-h * s) * (1 + cosine_minus_one) + cosine_minus_one + h * free.b;
    return free;
  } else {
    const Number slow_decay = exp(-slow * s), fast_decay = exp(-fast * s), spread = 2 * root * s;
    const Number b =
        slow_decay * select<Number>(spread > 0, -expm1(-spread) / (2 * root), s);  // root = 0: critical damping
    const Number d = 2 * h * fast_decay - slow * slow * b;                         // 2 h slow - 1 = slow^2
    const Number a_minus_one = 8 * h * s <= 1 ? short_a_minus_one(s) : Number(expm1(-slow * s) + slow * b);
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
  return step;
}

/// Displacement and velocity a time s after rest under a unit force sin(phase): Im(e^{i phase} w(s)) with w of eq. 11,
/// which has no difference of large numbers.
template <class Number, Effects E>
void ArcConstants<Number, E>::respond_from_rest(const Number& s, Step<Number>& step) const {
  using std::cos, std::exp, std::sin;
  const Number& lambda = root;
  const Number c = cos(nu * s), d = sin(nu * s);
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

/// A(s) - 1 for a time that is short for the oscillator, though perhaps not for a fast force, by the Taylor series: the
/// closed form is a difference of terms 1/s times larger.
template <class Number, Effects E>
Number ArcConstants<Number, E>::short_a_minus_one(const Number& s) const {
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 13 : 36;  // (1/4)^n / n! below rounding
  Number before = 0, last = -s * s / 2, sum = last;                           // of s^k A^(k)(0) / k!
  for (int k = 3; k < terms; ++k) {
    const Number next = -(s * s * before + 2 * h * s * (k - 1) * last) / (k * (k - 1));
    sum += next, before = last, last = next;
  }
  return sum;
}

template <class Number, Effects E>
Number ArcConstants<Number, E>::sixth_bound(const Motion<Number>& m, const Number& span, int derivative) const {
  using std::abs;
  const auto i = static_cast<std::size_t>(derivative);
  const auto times = [derivative](const Number& y, const Number& z) { return derivative == 0 ? y : Number(y * z); };
  Number energy_norm = abs(m.free_x) + abs(m.free_v);
  if constexpr (E.forcing == Forcing::secular) energy_norm += abs(f) * span;
  Number bound = times_sixth_power(Number(free_bound_[i] * energy_norm), span);
  if constexpr (E.damping == Damping::heavy) {
    const Number slow_part = times(abs(m.free_x - m.fast_x), slow), fast_part = times(abs(m.fast_x), fast);
    const Number modal =
        times_sixth_power(slow_part, Number(slow * span)) + times_sixth_power(fast_part, Number(fast * span));
    bound = select<Number>(modal < bound, modal, bound);  // root = 0: modal is infinite or NaN, so not taken
  }
  if constexpr (E.forcing == Forcing::regular)
    bound += times_sixth_power(times(response.amplitude, nu), Number(nu * span));
  if constexpr (E.forcing == Forcing::secular) bound += times_sixth_power(forced_bound_[i], span);
  return bound;
}

template <class Number, Effects E>
Number ArcConstants<Number, E>::reach(const Motion<Number>& m, const Number& span) const {
  using std::abs;
  Number bound = response.amplitude + norm(m.free_x, m.free_v);
  if constexpr (E.forcing == Forcing::secular) bound += abs(f) * span;
  return bound * (1 + 16 * epsilon<Number>());
}

}  // namespace clatter::motion
