#include "motion/known_soft_stops.hpp"

namespace clatter::motion {

SoftStop<double> known_soft_stop(const Stops& stops, Side side) { return soft_stop_at<double>(stops, side); }

Within<double> known_soft_stop_around(const Stops& stops, double x, double v) {
  return soft_stop_around<double>(stops, x, v);
}

}  // namespace clatter::motion
