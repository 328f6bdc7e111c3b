#include "branches/walk/walk.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "branches/walk/corner.hpp"
#include "branches/walk/resonance.hpp"

namespace clatter::branches {

std::optional<CurvePoint> Walk::after(double s) const {
  if (s == 0) return here_;
  const Vector predicted = sum(here_.at, s, here_.tangent);
  const auto at = corrected(equations_, predicted, here_.tangent, limits_.tolerance);
  // where another branch crosses this one at a right angle, all its points solve the equations of a step
  if (!at || !(largest(sum(*at, -1.0, predicted)) <= s / 2 + 1e-9)) return std::nullopt;
  const auto along = tangent(equations_, *at, here_.tangent);
  if (!along) return std::nullopt;
  return CurvePoint{*at, *along, here_.arclength + s};
}

std::optional<CurvePoint> Walk::next() {
  constexpr double least_cosine = 0.98, shortest = 1e-9;
  for (; step_ > shortest * limits_.largest_step; step_ /= 2) {
    const std::optional<CurvePoint> point = after(step_);
    const double cosine = point ? product(point->tangent, here_.tangent) : 0.0;
    if (!(cosine > least_cosine)) {
      if (const auto beyond = past_corner(step_)) return beyond;
      continue;
    }
    if (may_resonate_between(equations_, here_.at, point->at)) continue;
    if (cosine > 0.998) step_ = std::min(1.6 * step_, limits_.largest_step);
    return point;
  }
  return std::nullopt;
}

/// The point just beyond a corner that the next step comes to, if it does.
std::optional<CurvePoint> Walk::past_corner(double step) const {
  const Vector predicted = sum(here_.at, step, here_.tangent);
  const auto corner = corner_between(equations_, here_.at, predicted);
  return corner ? beyond_corner(equations_, here_, predicted, *corner, limits_.tolerance) : std::nullopt;
}

bool Walk::passes(const CurvePoint& other, const CurvePoint& next) const {
  const double step = next.arclength - here_.arclength;
  const Vector way = sum(other.at, -1.0, here_.at);
  const double ahead = product(way, here_.tangent);
  if (!(ahead > 0 && ahead <= step) || !(product(other.tangent, here_.tangent) > 0.9)) return false;
  const Vector aside = sum(way, -ahead, here_.tangent);
  return product(aside, aside) <= 0.04 * ahead * ahead + 1e-16;
}

std::optional<CurvePoint> Walk::zero(const TestFunction& test, double to, double from) const {
  std::optional<CurvePoint> best;
  bool followed = true;
  const auto value = [&](double part) {
    const auto point = after(part);
    if (!point) return followed = false, 0.0;
    best = point;
    return test(*point);
  };
  const double low = value(from), high = value(to);
  if (!followed || !((low < 0) != (high < 0))) return std::nullopt;
  std::uintmax_t most = 60;
  const auto [a, b] = boost::math::tools::toms748_solve(
      value, from, to, low, high, [to](double x, double y) { return std::abs(x - y) <= 4e-16 * to; }, most);
  static_cast<void>(value(a + (b - a) / 2));
  return followed ? best : zero_between_reached(test, to, from);
}

/// Bisects towards the change of sign, as long as one of three instants between the ends can be reached.
std::optional<CurvePoint> Walk::zero_between_reached(const TestFunction& test, double to, double from) const {
  std::optional<CurvePoint> low = after(from), high = after(to);
  double at_low = test(*low), at_high = test(*high);
  for (bool narrower = true; narrower;) {
    narrower = false;
    const double width = to - from;
    for (const double part : {0.5, 0.25, 0.75}) {
      const double middle = from + part * width;
      const auto point = width > 1e-12 * to ? after(middle) : std::nullopt;
      if (!point) continue;
      const double there = test(*point);
      if ((there < 0) == (at_low < 0))
        low = point, at_low = there, from = middle;
      else
        high = point, at_high = there, to = middle;
      narrower = true;
      break;
    }
  }
  const double share = at_low / (at_low - at_high);
  CurvePoint zero = *low;
  zero.at = sum(low->at, share, sum(high->at, -1.0, low->at));
  zero.arclength += share * (high->arclength - low->arclength);
  return zero;
}

}  // namespace clatter::branches
