#include "coordinates.hpp"

#include "format.hpp"

namespace clatter::app {

std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point) {
  std::string text;
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    (text += text.empty() ? "" : ", ") += key_of(axis.parameter);
    text += formatted(" = %.10g", value);
  });
  return text;
}

}  // namespace clatter::app
