#include "coordinates.hpp"

#include "format.hpp"

namespace clatter::app {

void each_coordinate(const sweep::Sweep& sweep, std::size_t point,
                     const std::function<void(const sweep::Axis&, double)>& take) {
  std::size_t stride = size(sweep);
  for (const sweep::Dimension& dimension : sweep.dimensions) {
    stride /= length(dimension);
    const std::size_t index = point / stride % length(dimension);
    for (const sweep::Axis& axis : dimension) take(axis, axis.values[index]);
  }
}

std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point) {
  std::string text;
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    (text += text.empty() ? "" : ", ") += key_of(axis.parameter);
    text += formatted(" = %.10g", value);
  });
  return text;
}

}  // namespace clatter::app
