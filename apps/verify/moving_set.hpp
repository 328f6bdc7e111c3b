#pragma once

#include "flow.hpp"

namespace verify {

/// A small set of states in two coordinates and the derivative of the motion that brought it here, both in a frame that
/// turns with it, so that they widen with the motion and not with the number of steps (Lohner 1987).
class MovingSet {
 public:
  MovingSet() = default;
  /// A box about a centre.
  MovingSet(const Vector& centre, const Vector& half_widths);

  [[nodiscard]] const Vector& centre() const { return centre_; }
  [[nodiscard]] Vector hull() const { return centre_ + frame_ * box_; }
  /// The state that the centre of the first box has come to.
  [[nodiscard]] Vector image_of_centre() const { return centre_ + frame_ * error_; }
  [[nodiscard]] bool is_a_point() const { return box_.x.is_zero() && box_.y.is_zero(); }
  [[nodiscard]] Matrix derivative() const { return frame_ * derivative_; }

  /// The derivative of the state by a parameter that the motion depends on, for the same start.
  [[nodiscard]] Vector by_parameter() const { return frame_ * by_parameter_; }

  /// Moves it by a map: the image of the centre, and the derivatives over all of the set (mean value theorem).
  void move(const Vector& image_of_centre, const Matrix& derivative, const Vector& by_parameter);
  /// Puts a state in its place that all of its own motions reach, with the derivative of that by the parameter.
  void collapse(const Vector& state, const Vector& by_parameter);

 private:
  Vector centre_{Ball(0), Ball(0)}, box_{Ball(0), Ball(0)};  ///< centre + frame box
  Vector error_{Ball(0), Ball(0)};                           ///< of the centre, in the frame
  Matrix frame_{Ball(1), Ball(0), Ball(0), Ball(1)};
  Matrix derivative_{Ball(1), Ball(0), Ball(0), Ball(1)};  ///< by the start, in the frame
  Vector by_parameter_{Ball(0), Ball(0)};                  ///< likewise
};

}  // namespace verify
