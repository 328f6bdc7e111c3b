#include "moving_set.hpp"

namespace verify {

template <class Vector, class Matrix>
BasicMovingSet<Vector, Matrix>::BasicMovingSet(const Vector& centre, const Vector& half_widths)
    : centre_(centre.middle()), error_(centre - centre_) {
  box_ = half_widths.each([](const Ball& width) { return Ball::around_zero(width); }) + error_;
}

template <class Vector, class Matrix>
void BasicMovingSet<Vector, Matrix>::move(const Vector& image_of_centre, const Matrix& derivative,
                                          const Vector& by_parameter) {
  const Matrix image = derivative * frame_;
  frame_ = frame_along(image, box_, derivative_);
  const Matrix back = frame_.inverse(), step = back * image;
  centre_ = image_of_centre.middle();
  const Vector new_error = back * (image_of_centre - centre_);
  box_ = step * box_ + new_error, error_ = step * error_ + new_error;
  derivative_ = step * derivative_;
  by_parameter_ = step * by_parameter_ + back * by_parameter;
}

template <class Vector, class Matrix>
void BasicMovingSet<Vector, Matrix>::collapse(const Vector& state, const Vector& by_parameter) {
  *this = BasicMovingSet(state, zero());
  derivative_ = Matrix::zero();
  by_parameter_ = by_parameter;
}

template class BasicMovingSet<Vector, Matrix>;
template class BasicMovingSet<Four, FourByFour>;

}  // namespace verify
