#pragma once

#include <cmath>
#include <optional>

#include "ball.hpp"

namespace verify {

/// What a map makes of a box of states.
template <class Vector, class Matrix>
struct Passage {
  Vector image;       ///< of the middle of the box, in bounds
  Matrix derivative;  ///< on all of the box
};

/// A box of states in which a map has one fixed point, and no other.
template <class Vector>
struct FixedBox {
  Vector start, width;
  Vector first;  ///< bounds of the fixed point

  /// Whether a state is in the box.
  [[nodiscard]] bool holds(const Vector& state) const {
    const Vector box = start + width.each([](const Ball& w) { return Ball::around_zero(w); });
    return box.all(state, [](const Ball& side, const Ball& x) { return side.holds_inside(x); });
  }
};

/// Krawczyk's operator on a box about a start; nothing if it doesn't map the box into itself, and then a wider box.
template <class Vector, class Matrix>
std::optional<FixedBox<Vector>> krawczyk(const Vector& start, Vector& width, const Passage<Vector, Matrix>& passage) {
  const Matrix slope = passage.derivative.less_identity(), inverse = slope.middle().inverse().middle();
  const Vector from = -(inverse * (passage.image - start));
  const Matrix rest = -(inverse * slope).less_identity();
  const Vector box = width.each([](const Ball&w) { return Ball::around_zero(w); }), image = from + rest * box;
  if (!image.all(image, [](const Ball& x, const Ball&) { return x.is_finite(); }))
    throw Undecided("Krawczyk's operator");
  if (box.all(image, [](const Ball& side, const Ball& x) { return side.holds_inside(x); }))
    return FixedBox<Vector>{start, width, start + image};
  width = image.each([](const Ball& x) { return Ball(4) * abs(x).upper(); });
  return std::nullopt;
}

/// The fixed point near a start of a map that `pass(start, width)` follows. At first the box of `claimed` half widths
/// is tried, since a claim is mostly much better than its error, and then one about the end of Newton's steps.
template <class Vector, class Pass>
FixedBox<Vector> fixed_point(Vector start, const Vector& claimed, const Pass& pass) {
  if (bits == 64) {
    Vector width = claimed;
    try {
      if (const auto found = krawczyk(start, width, pass(start, width))) return *found;
    } catch (const Undecided&) {  // Newton's steps may lead to a smaller box
    }
  }
  const Vector zero = start.each([](const Ball&) { return Ball(0); });
  Vector width = zero;
  for (slong precision = bits; precision >= 64; precision /= 2) {  // each step doubles the digits
    const auto thin = pass(start, zero);
    const Vector step = thin.derivative.less_identity().middle().inverse().middle() * (thin.image - start).middle();
    if (!step.all(step, [](const Ball& x, const Ball&) { return x.is_finite(); })) throw Undecided("Newton's step");
    start = (start - step).middle();
    const double least = std::ldexp(1.0, -static_cast<int>(bits) + 12);
    width = step.each([](const Ball& by) { return Ball(std::abs(by.near()) / 512); }) +
            start.each([=](const Ball& at) { return Ball(least * (std::abs(at.near()) + 1e-3)); });
  }
  for (int attempt = 0; attempt < 5; ++attempt)
    if (const auto found = krawczyk(start, width, pass(start, width))) return *found;
  throw Undecided("whether there is a periodic motion: Krawczyk's operator doesn't contract");
}

}  // namespace verify
