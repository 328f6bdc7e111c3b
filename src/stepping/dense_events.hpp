#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "motion/first_crossing.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "stepping/carrying.hpp"

/// Events on the dense output of a step, for certain: the Bernstein form shows two crossings within a step, too.
namespace clatter::stepping {

/// Distance from the anchor to a stop, or a wall, positive inside.
[[nodiscard]] inline double gap_to(const Stops& stops, double anchor, Side side) {
  return side == Side::upper ? stops.upper - anchor : anchor - stops.lower;
}

/// Whether a place is that of a stop, or a wall.
[[nodiscard]] inline bool lies_on(const Stops& stops, double place, Side side) {
  return place == (side == Side::upper ? stops.upper : stops.lower);
}

/// The stop that the mass is on and moves into; none if there isn't one.
[[nodiscard]] inline Side entered(const Stops& stops, double anchor, double offset, double v) {
  for (const Side side : {Side::lower, Side::upper})
    if (gap_to(stops, anchor, side) - sign_of(side) * offset <= 0 && sign_of(side) * v > 0) return side;
  return Side::none;
}

/// The first crossing of a stop by the polynomial; else its end, or the horizon.
template <class A>
[[nodiscard]] motion::Crossing<double> first_contact(const A& arc, const Stops& stops, double horizon) {
  motion::Crossing<double> first{0, Side::none, std::min(arc.length(), horizon), {}};
  for (const Side side : {Side::lower, Side::upper}) {
    const double away = gap_to(stops, arc.anchor(), side);
    if (std::isinf(away)) continue;
    Bernstein<double> c = arc.offset();
    for (double& y : c) y = away - sign_of(side) * y;
    c[0] = std::max(c[0], 0.0);
    if (c[0] == 0 && arc.velocity()[0] == 0)  // released: the force leads away, but the polynomial's error may not
      c[1] = 0, c[2] = std::max(c[2], 0.0);
    const auto root = FirstRoot<double>::of(c);
    if (root && *root * arc.length() <= first.elapsed) first.side = side, first.elapsed = *root * arc.length();
  }
  first.motion = arc.at(first.elapsed);
  if (first.side == Side::none) return first;
  first.motion.x = motion::stop_at<double>(stops, first.side).position;
  if (sign_of(first.side) * first.motion.v <= 0) first.motion.v = 0;  // the two polynomials differ by their errors
  return first;
}

/// The first of some margins that the polynomial carries below 0; else its end, or the horizon.
template <Effects Of, std::size_t count>
[[nodiscard]] motion::Crossing<double> first_crossing(const motion::PolynomialArc<Of>& arc,
                                                      const std::array<motion::Margin<double>, count>& margins,
                                                      double horizon) {
  motion::Crossing<double> first{count, Side::none, std::min(arc.length(), horizon), {}};
  for (std::size_t i = 0; i < count; ++i) {
    Bernstein<double> c;
    for (std::size_t j = 0; j < c.size(); ++j)
      c[j] = margins[i].constant + margins[i].place * arc.offset()[j] + margins[i].speed * arc.velocity()[j];
    c[0] = std::max(c[0], 0.0);
    const auto root = FirstRoot<double>::of(c);
    if (root && *root * arc.length() <= first.elapsed) first.margin = i, first.elapsed = *root * arc.length();
  }
  first.motion = arc.at(first.elapsed);
  return first;
}

/// The first instant at which the polynomial of z' of a loose mass that slides to a side falls to 0; else the end of
/// the step, or the horizon.
template <Effects Of>
[[nodiscard]] motion::Crossing<double> end_of_slide(const motion::PolynomialInHousing<Of>& beside, Side towards,
                                                    double horizon) {
  motion::Crossing<double> end{1, Side::none, std::min(beside.length(), horizon), {}};
  Bernstein<double> c = beside.velocity();
  for (double& w : c) w *= sign_of(towards);
  c[0] = std::max(c[0], 0.0);
  if (c[0] == 0) c[1] = std::max(c[1], 0.0);  // let go: friction leads on, but the polynomial's error may not
  const auto root = FirstRoot<double>::of(c);
  if (root && *root * beside.length() <= end.elapsed) end.margin = 0, end.elapsed = *root * beside.length();
  end.motion = beside.at(end.elapsed);
  return end;
}

/// The end of a time in which a wall presses: where the polynomial through x'' and its rate leaves the load; else the
/// end of the step, or the horizon.
template <Effects Of>
[[nodiscard]] motion::Crossing<double> end_of_press(const motion::PolynomialArc<Of>& arc,
                                                    const Pressing<double>& pressing, double horizon) {
  const double length = arc.length();
  motion::Crossing<double> end{1, Side::none, std::min(length, horizon), {}};
  const motion::Motion<double> first = arc.at(0.0), last = arc.at(length);
  Bernstein<double> c = quintic(length, {first.a, arc.constants().jerk(first)}, {last.a, arc.constants().jerk(last)},
                                {arc.at(length / 3).a, arc.at(2 * length / 3).a});
  for (double& a : c) a = sign_of(pressing.wall) * (pressing.load - a);
  c[0] = std::max(c[0], 0.0);
  const auto root = pressing.wall == Side::none ? std::nullopt : FirstRoot<double>::of(c);
  if (root && *root * length <= end.elapsed) end.margin = 0, end.elapsed = *root * length;
  end.motion = arc.at(end.elapsed);
  return end;
}

}  // namespace clatter::stepping
