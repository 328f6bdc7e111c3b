#pragma once

#include <algorithm>
#include <cmath>

#include "motion/arc.hpp"
#include "motion/first_crossing.hpp"

namespace clatter::branches {

using Margin = motion::Margin<double>;

/// The instant from `s` on at which a margin that has fallen below zero is least.
template <class A>
double turning_time(const A& arc, const Margin& margin, double s) {
  for (int iteration = 0; iteration < 60; ++iteration) {
    const motion::Motion<double> m = arc.at(s);
    // on as long as it falls; a step no longer than a small part of a cycle
    const double most = 0.1 / arc.constants().rate, falls = -margin.slope(m);
    double curvature = -margin.place * m.a;
    if (margin.speed != 0) curvature -= margin.speed * arc.constants().jerk(m);
    const double step = curvature < 0 ? std::clamp(-falls / curvature, -most, most) : falls > 0 ? most : -most;
    s += step;
    if (std::abs(step) <= 1e-13 * (1 + s)) break;
  }
  return s;
}

/// A soft contact is found as early as its displacement's rounding over its speed.
inline bool is_at_end(double elapsed, double length, double x, double speed, double nu) {
  const double late = (1e-11 + 1e-12 * (1 + std::abs(x)) / std::max(std::abs(speed), 1e-12)) / nu;
  return length - elapsed <= late + 1e-9 * length;
}

}  // namespace clatter::branches
