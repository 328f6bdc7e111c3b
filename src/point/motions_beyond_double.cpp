#include <cmath>
#include <utility>

#include "motion/contact_force.hpp"
#include "point/in_digits.hpp"

namespace clatter::point {
namespace {

/// Whether a mass may come to rest on a stop.
bool can_hold(const Problem& problem, Side side) {
  const auto stop = motion::stop_at<double>(problem.stops, side);
  return std::isfinite(stop.position) && !is_soft(problem.stops, side) &&
         (stop.law.loses() || has_friction(problem.friction));
}

}  // namespace

std::vector<motion::State<double>> periodic_sections(const Problem& problem, const motion::State<double>& near,
                                                     std::int64_t periods) {
  if (auto found = InDigits<DoubleDouble>::fixed_point(problem, near, periods)) return std::move(found->sections);
  if (auto found = InDigits<WideFloat>::fixed_point(problem, near, periods)) return std::move(found->sections);
  return {};
}

std::optional<ReleasedMotion> released_motion(const Problem& problem, Side side, std::int64_t periods) {
  if (!can_hold(problem, side)) return std::nullopt;
  if (auto motion = InDigits<DoubleDouble>::released_motion(problem, side, periods)) return motion;
  return InDigits<WideFloat>::released_motion(problem, side, periods);
}

RestingMotion resting_motion(const Problem& problem, Side side) {
  if (!can_hold(problem, side)) return {};
  const RestingMotion motion = InDigits<DoubleDouble>::resting_motion(problem, side);
  return motion.kind != RestingMotion::Kind::undecided ? motion : resting_motion_in_fifty_digits(problem, side);
}

RestingMotion resting_motion_in_fifty_digits(const Problem& problem, Side side) {
  return InDigits<WideFloat>::resting_motion(problem, side);
}

}  // namespace clatter::point
