#include "coordinates.hpp"

#include "format.hpp"

namespace clatter::app {

std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point) {
  std::string text;
  if (sweep.direction == sweep::Direction::both)
    text = point < size_one_way(sweep) ? "direction = 1" : "direction = -1";
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    (text += text.empty() ? "" : ", ") += axis.parameter.key();
    text += formatted(" = %.10g", value);
  });
  return text;
}

}  // namespace clatter::app
