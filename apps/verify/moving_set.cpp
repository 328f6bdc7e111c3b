#include "moving_set.hpp"

namespace verify {

MovingSet::MovingSet(const Four& centre, const Four& half_widths) : centre_(centre.middle()), error_(centre - centre_) {
  box_ = half_widths.each([](const Ball& width) { return Ball::around_zero(width); }) + error_;
}

void MovingSet::move(const Four& image_of_centre, const FourByFour& derivative, const Four& by_parameter) {
  const FourByFour image = derivative * frame_;
  frame_ = frame_along(image, box_, derivative_);
  const FourByFour back = frame_.inverse(), step = back * image;
  centre_ = image_of_centre.middle();
  const Four new_error = back * (image_of_centre - centre_);
  box_ = step * box_ + new_error, error_ = step * error_ + new_error;
  derivative_ = step * derivative_;
  by_parameter_ = step * by_parameter_ + back * by_parameter;
}

void MovingSet::collapse(const Four& state, const Four& by_parameter) {
  *this = MovingSet(state, Four::zero());
  derivative_ = FourByFour::zero();
  by_parameter_ = by_parameter;
}

}  // namespace verify
