#pragma once

#include "linear.hpp"

namespace verify {

/// A small set of states in four coordinates and the derivative of the motion that brought it here, both in a frame
/// that turns with it, so that they widen with the motion and not with the number of steps (Lohner 1987).
class MovingSet {
 public:
  MovingSet() = default;
  /// A box about a centre.
  MovingSet(const Four& centre, const Four& half_widths);

  [[nodiscard]] const Four& centre() const { return centre_; }
  [[nodiscard]] Four hull() const { return centre_ + frame_ * box_; }
  /// The state that the centre of the first box has come to.
  [[nodiscard]] Four image_of_centre() const { return centre_ + frame_ * error_; }
  [[nodiscard]] bool is_a_point() const {
    return box_.all(box_, [](const Ball& width, const Ball&) { return width.is_zero(); });
  }
  [[nodiscard]] FourByFour derivative() const { return frame_ * derivative_; }

  /// The derivative of the state by a parameter that the motion depends on, for the same start.
  [[nodiscard]] Four by_parameter() const { return frame_ * by_parameter_; }

  /// Moves it by a map: the image of the centre, and the derivatives over all of the set (mean value theorem).
  void move(const Four& image_of_centre, const FourByFour& derivative, const Four& by_parameter = Four::zero());
  /// Puts a state in its place that all of its own motions reach, with the derivative of that by the parameter.
  void collapse(const Four& state, const Four& by_parameter);

 private:
  Four centre_ = Four::zero(), box_ = Four::zero();  ///< centre + frame box
  Four error_ = Four::zero();                        ///< of the centre, in the frame
  FourByFour frame_ = FourByFour::identity();
  FourByFour derivative_ = FourByFour::identity();  ///< by the start, in the frame
  Four by_parameter_ = Four::zero();                ///< likewise
};

}  // namespace verify
