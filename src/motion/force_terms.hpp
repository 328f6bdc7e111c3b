#pragma once

#include <array>
#include <cstddef>

#include "motion/arc_constants.hpp"

namespace clatter::motion {

namespace detail {

/// Calls `function(term)` with the terms of a sum of sines; apart, so that they don't weigh on all other forces.
template <std::size_t count, class Number, class Function>
[[gnu::noinline]] auto with_terms_of_orders(const ForceOrders<Number>& orders, const Number& f,
                                            const SineCosine<Number>& phase, const Number& turn,
                                            const Function& function) {
  std::array<Number, count> terms{};
  orders.each(phase, [&](int j, const Number& value, const Number& slope) {
    const std::array<Number, 4> derivatives{value, slope, -value, -slope};
    Number power = f;
    for (std::size_t k = 0; k < count; ++k) {
      terms[k] += power * derivatives[k % 4];
      power *= j * turn / static_cast<double>(k + 1);
    }
  });
  return function([&terms](std::size_t k) { return terms[k]; });
}

}  // namespace detail

/// Calls `function(term)`; `term(k)`, to be asked for k = 1, 2, ... in turn, is f (nu d)^k s^(k)/k!, of the Taylor
/// series of a force f s over a time d from a phase on, k < count.
template <std::size_t count, class Number, Effects E, class Function>
[[gnu::always_inline]] inline auto with_force_terms(const ArcConstants<Number, E>& constants, const Number& f,
                                                    const SineCosine<Number>& phase, const Number& d,
                                                    const Function& function) {
  if (constants.has_orders())
    return detail::with_terms_of_orders<count>(constants.shape.orders, f, phase, Number(constants.nu * d), function);
  Number power = f, drive = phase.sine, next = phase.cosine;
  return function([&](std::size_t k) {
    power *= constants.nu * d / static_cast<double>(k);
    const Number term = power * next;
    Number turned = -drive;
    if constexpr (E.stiffness) turned = constants.curl() * turned;
    drive = next, next = turned;
    return term;
  });
}

}  // namespace clatter::motion
