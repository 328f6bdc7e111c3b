#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/effects.hpp"
#include "dynamics/oscillator.hpp"
#include "dynamics/state.hpp"
#include "numbers/number.hpp"

namespace clatter {

/// Free motion over a time s: x(s) = A x + B v, v(s) = -B x + C v.
template <class Number>
struct Propagator {
  Number a, b, c;
};

/// The constants of an oscillator that all its arcs share, and its free motion and bounds.
template <class Number, Effects E>
class Flow {
 public:
  explicit Flow(const Oscillator& oscillator);

  /// Free motion over s >= 0, without cancellation for every h (physics.md, "Motion").
  [[nodiscard]] Propagator<Number> propagator(const Number& s) const;

  /// Steady forced displacement and velocity at a phase, `load` included; the secular kernel leaves the forced part to
  /// its arcs.
  [[nodiscard]] Number steady_displacement(const Number& sine, const Number& cosine) const {
    if constexpr (E.forcing == Forcing::regular) return load + (in_phase * sine + quadrature * cosine);
    return load;
  }
  [[nodiscard]] Number steady_velocity(const Number& sine, const Number& cosine) const {
    if constexpr (E.forcing == Forcing::regular) return nu * (in_phase * cosine - quadrature * sine);
    return Number(0);
  }

  /// Acceleration from the equation of motion (eq. 3).
  [[nodiscard]] Number acceleration(const Number& x, const Number& v, const Number& sine) const {
    Number sum = load - x;
    if constexpr (E.forcing != Forcing::none) sum += f * sine;
    if constexpr (E.damping != Damping::none) sum -= 2 * h * v;
    return sum;
  }

  /// Derivative of the acceleration.
  [[nodiscard]] Number jerk(const Motion<Number>& m) const {
    Number sum = -m.v;
    if constexpr (E.forcing != Forcing::none) sum += f * nu * m.cosine;
    if constexpr (E.damping != Damping::none) sum -= 2 * h * m.a;
    return sum;
  }

  /// Bound of |x^(order)|, order 6 or 7, from `m` on for a time `span`. The energy norm of free motion never grows, so
  /// its derivatives are bounded by the row of the companion matrix' power; heavy damping is also bounded mode by mode,
  /// since its fast one dies out.
  [[nodiscard]] Number derivative_bound(const Motion<Number>& m, const Number& span, int order) const;

  /// Bound of |x - load| from `m` on, for ever; infinite where resonance may raise it.
  [[nodiscard]] Number reach(const Motion<Number>& m) const;

  Number h, f, nu, load;
  Number root;                  ///< lambda = |1 - h^2|^(1/2)
  Number slow, fast;            ///< decay rates of heavy damping
  Number in_phase, quadrature;  ///< P and Q of the steady response P sin + Q cos
  Number amplitude;             ///< (P^2 + Q^2)^(1/2)
  Number detuning;              ///< nu - lambda, without cancellation
  Number rate;                  ///< the fastest of the motion's frequencies and decay rates
 private:
  void bound_derivatives();

  std::array<Number, 8> free_bound_{};    ///< of |x^(k)| over the energy norm
  std::array<Number, 8> forced_bound_{};  ///< of the steady response's k-th derivative (secular: of what the force adds
                                          ///< to the free one's)
};

template <class Number, Effects E>
Flow<Number, E>::Flow(const Oscillator& o) : h(o.damping), f(o.forcing), nu(o.frequency), load(o.load) {
  using std::abs, std::max, std::sqrt;
  root = sqrt(abs((1 - h) * (1 + h)));
  fast = h + root;
  slow = 1 / fast;
  const Number stiffness = (1 - nu) * (1 + nu), friction = 2 * h * nu;
  const Number size =
      max(Number(abs(stiffness)), friction);  // divided out first, so that its square can't overflow or vanish
  const Number p = stiffness / size, q = friction / size, determinant = size * (p * p + q * q);
  in_phase = E.forcing == Forcing::regular ? Number(f * p / determinant) : Number(0);
  quadrature = E.forcing == Forcing::regular ? Number(-f * q / determinant) : Number(0);
  amplitude = norm(in_phase, quadrature);
  detuning = (nu - 1) + h * h / (1 + root);
  rate = max(Number(1), Number(2 * h));
  if constexpr (E.forcing != Forcing::none) rate = max(rate, nu);
  bound_derivatives();
}

template <class Number, Effects E>
void Flow<Number, E>::bound_derivatives() {
  using std::abs, std::sqrt;
  Number x_part = 1, v_part = 0;  // x^(k) = x_part x + v_part v + f Im(e^{i theta} (re + i im))
  Number re = 0, im = 0, next_re = 0, next_im = 0;
  Number power_re = 1, power_im = 0, power = 1;  // (i nu)^k and nu^k
  for (std::size_t k = 0; k < free_bound_.size(); ++k) {
    free_bound_[k] = sqrt(x_part * x_part + v_part * v_part);
    forced_bound_[k] =
        E.forcing == Forcing::secular ? Number(abs(f) * sqrt(re * re + im * im)) : Number(power * amplitude);
    const Number x_next = -v_part, v_next = x_part - 2 * h * v_part;
    x_part = x_next, v_part = v_next;
    const Number after_re = -2 * h * next_re - re + power_re, after_im = -2 * h * next_im - im + power_im;
    re = next_re, im = next_im, next_re = after_re, next_im = after_im;
    const Number turned = -nu * power_im;
    power_im = nu * power_re, power_re = turned, power *= nu;
  }
}

template <class Number, Effects E>
Propagator<Number> Flow<Number, E>::propagator(const Number& s) const {
  using std::cos, std::exp, std::expm1, std::sin;
  if constexpr (E.damping == Damping::none) {
    const Number c = cos(s);
    return {c, sin(s), c};
  } else if constexpr (E.damping == Damping::light) {
    const Number decay = exp(-h * s), c = decay * cos(root * s), b = decay * sin(root * s) / root;
    return {c + h * b, b, c - h * b};
  } else {
    const Number slow_decay = exp(-slow * s), fast_decay = exp(-fast * s), spread = 2 * root * s;
    const Number b =
        slow_decay * select<Number>(spread > 0, -expm1(-spread) / (2 * root), s);  // root = 0: critical damping
    return {slow_decay + slow * b, b, fast_decay - slow * b};
  }
}

template <class Number, Effects E>
Number Flow<Number, E>::derivative_bound(const Motion<Number>& m, const Number& span, int order) const {
  using std::abs, std::min;
  const auto k = static_cast<std::size_t>(order);
  const Number x = m.x - steady_displacement(m.sine, m.cosine), v = m.v - steady_velocity(m.sine, m.cosine);
  Number energy_norm = abs(x) + abs(v);
  if constexpr (E.forcing == Forcing::secular) energy_norm += abs(f) * span;
  Number free = free_bound_[k] * energy_norm;
  if constexpr (E.damping == Damping::heavy) {
    const auto power = [order](const Number& base) {
      Number product = base;
      for (int i = 1; i < order; ++i) product *= base;
      return product;
    };
    const Number modal = (abs(fast * x + v) * power(slow) + abs(slow * x + v) * power(fast)) / (2 * root);
    free = select<Number>(modal < free, modal, free);  // root = 0: modal is infinite or NaN and is left aside
  }
  return free + forced_bound_[k];
}

template <class Number, Effects E>
Number Flow<Number, E>::reach(const Motion<Number>& m) const {
  if constexpr (E.forcing == Forcing::secular) return std::numeric_limits<Number>::infinity();
  const Number x = m.x - steady_displacement(m.sine, m.cosine), v = m.v - steady_velocity(m.sine, m.cosine);
  return (amplitude + norm(x, v)) * (1 + 16 * epsilon<Number>());
}

}  // namespace clatter
