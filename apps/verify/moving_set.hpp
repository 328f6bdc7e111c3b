#pragma once

#include "linear.hpp"

namespace verify {

/// A small set of states in two coordinates, or in four, and the derivative of the motion that brought it here, both in
/// a frame that turns with it, so that they widen with the motion and not with the number of steps (Lohner 1987).
template <class Vector, class Matrix>
class BasicMovingSet {
 public:
  BasicMovingSet() = default;
  /// A box about a centre.
  BasicMovingSet(const Vector& centre, const Vector& half_widths);

  [[nodiscard]] const Vector& centre() const { return centre_; }
  [[nodiscard]] Vector hull() const { return centre_ + frame_ * box_; }
  /// The state that the centre of the first box has come to.
  [[nodiscard]] Vector image_of_centre() const { return centre_ + frame_ * error_; }
  [[nodiscard]] bool is_a_point() const {
    return box_.all(box_, [](const Ball& width, const Ball&) { return width.is_zero(); });
  }
  [[nodiscard]] Matrix derivative() const { return frame_ * derivative_; }

  /// The derivative of the state by a parameter that the motion depends on, for the same start.
  [[nodiscard]] Vector by_parameter() const { return frame_ * by_parameter_; }

  /// Moves it by a map: the image of the centre, and the derivatives over all of the set (mean value theorem).
  void move(const Vector& image_of_centre, const Matrix& derivative, const Vector& by_parameter = zero());
  /// Puts a state in its place that all of its own motions reach, with the derivative of that by the parameter.
  void collapse(const Vector& state, const Vector& by_parameter);

 private:
  [[nodiscard]] static Vector zero() {
    return Vector{}.each([](const Ball&) { return Ball(0); });
  }

  Vector centre_ = zero(), box_ = zero();  ///< centre + frame box
  Vector error_ = zero();                  ///< of the centre, in the frame
  Matrix frame_ = Matrix::identity();
  Matrix derivative_ = Matrix::identity();  ///< by the start, in the frame
  Vector by_parameter_ = zero();            ///< likewise
};

extern template class BasicMovingSet<Vector, Matrix>;
extern template class BasicMovingSet<Four, FourByFour>;

using MovingSet = BasicMovingSet<Vector, Matrix>;
using FourSet = BasicMovingSet<Four, FourByFour>;

}  // namespace verify
