#pragma once

#include <cmath>
#include <cstddef>

#include "motion/arc_constants.hpp"

namespace clatter::motion {

namespace detail {

/// `y`, or its first or second derivative of a motion at the rate `z`.
template <class Number>
[[nodiscard]] Number derived(const Number& y, const Number& z, int derivative) {
  return derivative == 0 ? y : derivative == 1 ? Number(y * z) : Number(y * z * z);
}

/// Of the steady response.
template <class Number, Effects E>
[[nodiscard]] Number response_sixth_bound(const ArcConstants<Number, E>& c, const Number& span, int derivative) {
  const Number turn = c.nu * span;
  if (c.has_orders()) return times_sixth_power(c.order_bounds[static_cast<std::size_t>(derivative)], turn);
  return times_sixth_power(derived(c.response.amplitude, c.nu, derivative), turn);
}

/// With k <= 0 by modes (eq. 46): a slow one that grows or stays, and a fast one that decays.
template <class Number, Effects E>
[[nodiscard]] Number unsprung_sixth_bound(const ArcConstants<Number, E>& c, const Motion<Number>& m, const Number& span,
                                          int derivative) {
  using std::abs, std::exp;
  const Number creep = -c.slow, growth = exp(creep * span);
  Number bound = response_sixth_bound(c, span, derivative);
  if (c.root > 0)
    bound +=
        times_sixth_power(derived(Number(abs(m.free_x - m.fast_x) * growth), creep, derivative), Number(creep * span)) +
        times_sixth_power(derived(Number(abs(m.fast_x)), c.fast, derivative), Number(c.fast * span));
  const Number decay = 2 * c.h * span, square = decay * decay;  // of the pull of the load, which has k = 0
  return bound + derived(Number(abs(c.unbalanced)), Number(2 * c.h), derivative) * span * span * square * square;
}

/// Of the response to a force in pieces, with k <= 0: it grows from rest to a velocity of at most |f| S span and a
/// displacement of at most half of that times the span, times the growth of what departs.
template <class Number, Effects E, std::size_t count>
[[nodiscard]] Number grown_sixth_bound(const ArcConstants<Number, E>& c, const DerivativeBounds<Number, count>& bounds,
                                       const Motion<Number>& m, const Number& span, int derivative) {
  using std::abs, std::exp;
  if (!c.forms_together()) return Number(0);
  const Number speed = c.together() * c.most_of_shape(m, span).sine * span * exp(-c.slow * span);
  const Number response = bounds.free[static_cast<std::size_t>(derivative)] * speed * (1 + c.natural * span / 2);
  return times_sixth_power(Number(response + c.force_together(bounds, m, span, derivative)), span);
}

/// Of motion in a piece of the force, with k > 0, by what it has beside the steady response to that, which fades: under
/// a slow force that alone lets steps grow. A steep ramp has a response so large that this bound is none.
template <class Number, Effects E, std::size_t count>
[[nodiscard]] Number transient_sixth_bound(const ArcConstants<Number, E>& c,
                                           const DerivativeBounds<Number, count>& bounds, const Motion<Number>& m,
                                           const Number& span, int derivative) {
  using std::abs;
  const FreeMotion<Number> response = c.response_in_piece(m);
  const Number energy_norm = c.natural * abs(m.free_x - response.x) + abs(m.free_v - response.v);
  const Number bound = times_sixth_power(Number(bounds.free[static_cast<std::size_t>(derivative)] * energy_norm), span);
  if (!(c.swing > 0)) return bound;
  const Number frequency = c.swing * c.nu, size = norm(m.sine, Number(m.cosine / c.swing));
  return bound + times_sixth_power(derived(Number(c.of_swing.amplitude * size), frequency, derivative),
                                   Number(frequency * span));
}

}  // namespace detail

/// Bound of span^6 |y^(6)| from `m` on for a time `span`, for y = x (derivative 0), x' (1) or x'' (2, if `bounds` has
/// it), by eq. 14; under heavy damping the smaller of that and the bound mode by mode, since the fast mode dies out.
template <class Number, Effects E, std::size_t count>
[[nodiscard]] Number sixth_bound(const ArcConstants<Number, E>& c, const DerivativeBounds<Number, count>& bounds,
                                 const Motion<Number>& m, const Number& span, int derivative) {
  using std::abs, detail::derived;
  const auto i = static_cast<std::size_t>(derivative);
  if constexpr (E.stiffness && E.damping == Damping::heavy)
    if (!(c.k > 0))
      return detail::unsprung_sixth_bound(c, m, span, derivative) +
             detail::grown_sixth_bound(c, bounds, m, span, derivative);
  Number energy_norm = abs(m.free_x) + abs(m.free_v);
  if constexpr (E.stiffness) energy_norm = c.natural * abs(m.free_x) + abs(m.free_v);
  if (c.is_in_pieces())
    energy_norm += abs(c.f) * c.most_of_shape(m, span).sine * span;
  else if (c.forms_together())
    energy_norm += c.together() * span;
  Number bound = times_sixth_power(Number(bounds.free[i] * energy_norm), span);
  if constexpr (E.damping == Damping::heavy) {
    const Number slow_part = derived(Number(abs(m.free_x - m.fast_x)), c.slow, derivative),
                 fast_part = derived(Number(abs(m.fast_x)), c.fast, derivative);
    const Number modal =
        times_sixth_power(slow_part, Number(c.slow * span)) + times_sixth_power(fast_part, Number(c.fast * span));
    if (!c.forms_together())  // in which free_x has the response, too, and fast_x isn't the fast mode of both
      bound = select<Number>(modal < bound, modal, bound);  // root = 0: modal is infinite or NaN, so not taken
  }
  if constexpr (E.forcing != Forcing::none) bound += detail::response_sixth_bound(c, span, derivative);
  if (c.forms_together()) bound += times_sixth_power(c.force_together(bounds, m, span, derivative), span);
  if (c.is_in_pieces() && span * c.natural > 2) {  // longer than the usual step
    const Number other = detail::transient_sixth_bound(c, bounds, m, span, derivative);
    bound = select<Number>(other < bound, other, bound);
  }
  return bound;
}
template <class Number, Effects E>
[[nodiscard]] Number sixth_bound(const ArcConstants<Number, E>& c, const Motion<Number>& m, const Number& span,
                                 int derivative) {
  return sixth_bound(c, c.derivative_bounds, m, span, derivative);
}

/// Bound of |x - equilibrium| from `m` on for a time `span` (eq. 16); at resonance the force may raise the energy norm
/// by |f| in a unit of time. Without a spring the motion may drift, with an unstable one it departs: eq. 47.
template <class Number, Effects E>
[[nodiscard]] Number reach(const ArcConstants<Number, E>& c, const Motion<Number>& m, const Number& span) {
  using std::abs, std::exp;
  Number bound = c.response.amplitude + norm(m.free_x, m.free_v);
  if (c.forms_together()) bound += c.together() * span;
  if constexpr (E.stiffness) {
    Number free = c.k > 0 ? norm(m.free_x, Number(m.free_v / c.natural))
                          : Number((abs(m.free_x) + abs(m.free_v) * span) * exp(-c.slow * span));
    if (c.forms_together())
      free += c.together() * span * (c.k > 0 ? Number(1 / c.natural) : Number(span * exp(-c.slow * span)));
    bound = c.response.amplitude + free + abs(c.unbalanced) * span * span / 2;
  }
  return bound * (1 + 16 * epsilon<Number>());
}

}  // namespace clatter::motion
