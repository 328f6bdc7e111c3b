#include "linear.hpp"

#include <algorithm>
#include <cmath>

namespace verify {

FourByFour FourByFour::inverse() const {
  FourByFour left = *this, right = identity();
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < 4; ++row)
      if (std::abs(left[row][column].near()) > std::abs(left[pivot][column].near())) pivot = row;
    std::swap(left[column], left[pivot]), std::swap(right[column], right[pivot]);
    const auto divided = [by = left[column][column]](const Ball& x) { return x / by; };
    left[column] = left[column].each(divided), right[column] = right[column].each(divided);
    for (std::size_t row = 0; row < 4; ++row) {
      if (row == column || left[row][column].is_zero()) continue;
      const auto times = [by = left[row][column]](const Ball& x) { return by * x; };
      left[row] = left[row] - left[column].each(times), right[row] = right[row] - right[column].each(times);
    }
  }
  return right;
}

namespace {

using Doubles = std::array<double, 4>;

double dot(const Doubles& p, const Doubles& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]; }

/// What axes leave of a side, of length 1; nothing but rounding: 0.
Doubles beside(const std::array<Doubles, 4>& axes, std::size_t count, Doubles side) {
  const double whole = std::sqrt(dot(side, side));
  for (int twice = 0; twice < 2; ++twice)
    for (std::size_t i = 0; i < count; ++i) {
      const double along = dot(axes[i], side);
      for (std::size_t k = 0; k < 4; ++k) side[k] -= along * axes[i][k];
    }
  const double length = std::sqrt(dot(side, side));
  if (!(length > 1e-8 * whole && length > 1e-150 && length < 1e150)) return {};
  for (double& number : side) number /= length;
  return side;
}

}  // namespace

FourByFour frame_along(const FourByFour& image, const Four& box, const FourByFour& uncertain) {
  std::array<std::pair<double, Doubles>, 8> sides{};  // those of the image, the longest first, and then the axes
  for (std::size_t j = 0; j < 4; ++j) {
    auto& [length, side] = sides[j];
    for (std::size_t i = 0; i < 4; ++i) side[i] = image[i][j].near();
    length = std::sqrt(dot(side, side)) * (box[j].radius() + uncertain[j][0].radius());
    sides[4 + j].first = -1, sides[4 + j].second[3 - j] = 1;
  }
  std::stable_sort(sides.begin(), sides.begin() + 4, [](const auto& p, const auto& q) { return p.first > q.first; });
  std::array<Doubles, 4> axes{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < sides.size() && count < 4; ++k) {
    const Doubles axis = beside(axes, count, sides[k].second);
    if (dot(axis, axis) > 0.5) axes[count++] = axis;
  }
  FourByFour frame = FourByFour::zero();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) frame[i][j] = Ball(axes[j][i]);
  return frame;
}

}  // namespace verify
