#include "moving_set.hpp"

#include <cmath>
#include <utility>

namespace verify {

MovingSet::MovingSet(const Vector& centre, const Vector& half_widths)
    : centre_(centre.middle()),
      box_{Ball::around_zero(half_widths.x) + (centre.x - centre_.x),
           Ball::around_zero(half_widths.y) + (centre.y - centre_.y)},
      error_{centre.x - centre_.x, centre.y - centre_.y} {}

void MovingSet::move(const Vector& image_of_centre, const Matrix& derivative, const Vector& by_parameter) {
  const Matrix image = derivative * frame_;
  // the longer side of the image of the box is the first axis of the new frame; any choice is right, a good one narrow
  double x = image.a.near(), y = image.c.near();
  const double u = image.b.near(), w = image.d.near();
  const double first = box_.x.radius() + derivative_.a.radius(), second = box_.y.radius() + derivative_.c.radius();
  if (std::hypot(u, w) * second > std::hypot(x, y) * first) x = u, y = w;
  const double length = std::hypot(x, y);
  if (length > 1e-300 && length < 1e300)
    frame_ = {Ball(x / length), Ball(-y / length), Ball(y / length), Ball(x / length)};
  else
    frame_ = {Ball(1), Ball(0), Ball(0), Ball(1)};
  const Matrix back = frame_.inverse(), step = back * image;
  centre_ = image_of_centre.middle();
  const Vector new_error = back * (image_of_centre - centre_);
  box_ = step * box_ + new_error, error_ = step * error_ + new_error;
  derivative_ = step * derivative_;
  by_parameter_ = step * by_parameter_ + back * by_parameter;
}

void MovingSet::collapse(const Vector& state, const Vector& by_parameter) {
  *this = MovingSet(state, {Ball(0), Ball(0)});
  derivative_ = {Ball(0), Ball(0), Ball(0), Ball(0)};
  by_parameter_ = by_parameter;
}

}  // namespace verify
