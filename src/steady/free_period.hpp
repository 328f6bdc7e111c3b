#pragma once

#include <cmath>

#include "math/number.hpp"
#include "scene/stops.hpp"

namespace clatter::steady {

/// Period of conservative motion (h = f = 0, R = 1) from its start (x, v), in tau: 2 pi without contact, else twice the
/// angle that the free rotation around the load turns by from stop to stop (eq. 35 for symmetric stops). If a stop
/// isn't reached, the turning point before it takes its place.
template <class Number>
[[nodiscard]] Number free_period(const Number& load, const Stops& stops, const Number& x, const Number& v) {
  using std::atan2, std::isfinite, std::sqrt;
  const Number amplitude = norm(Number(x - load), v);
  struct End {
    Number distance, speed;  ///< from the load's equilibrium, and there; over the amplitude
  };
  const auto end = [&](double position, Side side) -> End {
    if (!isfinite(position)) return {Number(1), Number(0)};
    const Number fall = (x - position) / amplitude, middle = (x + position - 2 * load) / amplitude;
    const Number square = (v / amplitude) * (v / amplitude) + fall * middle;  // no difference of squares
    const Number distance = sign_of(side) * (position - load) / amplitude;
    return square > 0 ? End{distance, sqrt(square)} : End{Number(1), Number(0)};
  };
  const End upper = end(stops.upper, Side::upper), lower = end(stops.lower, Side::lower);
  Number sine = upper.distance * lower.speed + lower.distance * upper.speed;
  const bool both = upper.speed > 0 && lower.speed > 0;
  if (both && (upper.distance < 0 || lower.distance < 0)) {  // on one side: no difference of large numbers
    const Number width = (Number(stops.upper) - stops.lower) / amplitude;
    const Number sum = upper.distance < 0 ? Number(lower.distance * upper.speed - upper.distance * lower.speed)
                                          : Number(upper.distance * lower.speed - lower.distance * upper.speed);
    const Number difference =
        upper.distance < 0 ? Number(lower.distance - upper.distance) : Number(upper.distance - lower.distance);
    sine = width * difference / sum;
  }
  return 2 * atan2(sine, Number(upper.speed * lower.speed - upper.distance * lower.distance));
}

}  // namespace clatter::steady
