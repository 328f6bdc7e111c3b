#include "branches/waiting.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "branches/equations/housing_flight.hpp"
#include "branches/start/start.hpp"
#include "branches/walk/graze.hpp"
#include "branches/walk/halves.hpp"
#include "branches/walk/violation.hpp"

namespace clatter::branches {

namespace {

/// The events of a motion in their order, whichever comes first: its word, or under dry friction a letter for each,
/// since many motions with the same impacts meet where their halts change.
std::string events_of(const Orbit& orbit) {
  if (!orbit.halts()) return orbit.word();
  std::string letters;
  for (const OrbitEvent& event : orbit.whole().events) {
    letters += {static_cast<char>('a' + static_cast<int>(event.kind)), event.side == Side::upper ? '+' : '-'};
  }
  std::string first = letters;
  for (std::size_t i = 0; i < letters.size(); i += 2) {
    std::rotate(letters.begin(), letters.begin() + 2, letters.end());
    first = std::min(first, letters);
  }
  return first;
}

/// The events of a branch that waits, beyond the special point.
std::string events_of(const Waiting& waiting) {
  constexpr double any = 1e-3;  // rad
  if (!waiting.opens || waiting.opens->kind == Opening::Kind::contact) return events_of(waiting.orbit);
  return events_of(with_opening(waiting.scene, waiting.orbit, *waiting.opens, any));
}

}  // namespace

bool Waiting::begins_across() const {
  if (opens) return opens->kind != Opening::Kind::contact;
  const auto turns = [](const OrbitEvent& event) { return presses(event.kind) && event.before == 0; };
  return direction || (special && std::ranges::any_of(orbit.events, turns));
}

void no_longer_waits(std::deque<Waiting>& waiting, std::size_t special, const Orbit& orbit) {
  const std::string events = events_of(orbit), image = events_of(orbit.mirror_image());
  std::erase_if(waiting, [&](const Waiting& one) {
    if (one.special != special) return false;
    const std::string other = events_of(one);
    return other == events || (other == image && is_symmetric(one.scene));
  });
}

Waiting with_contact(Waiting branch, std::size_t graze, int came) {
  branch.came = came;
  if (!is_impact(branch.orbit.events[graze].kind)) branch.opens = {Opening::Kind::contact, graze};
  return branch;
}

void wait_without(std::deque<Waiting>& waiting, Waiting without, bool symmetric_scene, int came) {
  const FollowedScene& scene = without.scene;
  const Orbit& orbit = without.orbit;
  if (is_anywhere(scene, orbit) || (has_loose_mass(scene.loose) && !orbit.meets_walls())) return;  // so may that
  if (orbit.size() == 0 && orbit.pressed == Side::none) {
    if (scene.oscillator.stiffness == 0) return;  // it has no place of its own
    without.orbit = Orbit{};
  }
  // without it the motion may repeat sooner, or be symmetric
  without.orbit = without.orbit.half_if_same(1e-6, symmetric_scene), without.came = came;
  waiting.push_back(std::move(without));
}

Waiting daughter_at(const BranchPoint& at, std::size_t special, std::int64_t generation) {
  const Orbit daughter = at.orbit.mirrored ? at.orbit.whole() : at.orbit.repeated(2);
  const Vector direction = direction_of_daughter(at.scene, at.orbit, daughter, speed_scale(at.scene, daughter));
  return {at.scene, daughter, direction, special, generation};
}

std::optional<Waiting> with_each(const BranchPoint& at, std::size_t graze, bool symmetric_scene, std::size_t special,
                                 std::int64_t generation) {
  if (!is_impact(at.orbit.events[graze].kind)) return std::nullopt;  // of a soft stop: they join
  const Orbit once = at.orbit.once_with_graze(graze, symmetric_scene);
  if (once.half_turns == at.orbit.half_turns) return std::nullopt;
  return Waiting{at.scene, once, {}, special, generation};
}

void wait_for_sooner(std::deque<Waiting>& waiting, const Record& record, const BranchPoint& at, std::size_t graze,
                     bool symmetric_scene, std::size_t special, std::int64_t generation) {
  if (!is_impact(at.orbit.events[graze].kind)) return;
  const auto add = [&](const std::optional<Waiting>& one) {
    if (!one || one->orbit.size() == 0 || one->orbit.half_turns == at.orbit.half_turns) return;
    const auto is_it = [&](const Waiting& other) {
      return other.special == special && other.orbit.half_turns == one->orbit.half_turns &&
             events_of(other) == events_of(*one);
    };
    if (!record.is_met_by(special, one->orbit) && std::ranges::none_of(waiting, is_it)) waiting.push_back(*one);
  };
  add(Waiting{at.scene, at.orbit.without(graze).half_if_same(1e-6, symmetric_scene), {}, special, generation});
  add(with_each(at, graze, symmetric_scene, special, generation));
}

namespace {

Vector along_parameter(const OrbitEquations& equations) {
  Vector axis(equations.unknowns(), 0.0);
  axis.back() = 1;
  return axis;
}

/// The point of a branch in the plane normal to `direction` through a guess, with its tangent in that direction.
std::optional<CurvePoint> point_beside(const OrbitEquations& equations, const Vector& guess, const Vector& direction,
                                       double tolerance) {
  const auto at = corrected(equations, guess, direction, tolerance);
  const auto along = at ? tangent(equations, *at, direction) : std::nullopt;
  return along ? std::optional(CurvePoint{*at, *along, 0.0}) : std::nullopt;
}

/// The point that is nearest to a guess, of a branch that runs across the parameter there.
std::optional<CurvePoint> nearest_point(const OrbitEquations& equations, const Vector& guess, double tolerance) {
  const auto across = tangent(equations, guess, along_parameter(equations));
  return across ? point_beside(equations, guess, *across, tolerance) : std::nullopt;
}

}  // namespace

std::optional<CurvePoint> point_near(const OrbitEquations& equations, const Vector& guess, double tolerance) {
  return point_beside(equations, guess, along_parameter(equations), tolerance);
}

CurvePoint start_near(const OrbitEquations& equations, const Vector& guess, double tolerance) {
  auto start = point_near(equations, guess, tolerance);
  if (!start) start = nearest_point(equations, guess, tolerance);
  if (!start)
    throw StartError(
        "Newton's method does not converge from the motion at the start; move it away from a special point");
  if (violation(equations, start->at))
    throw StartError(
        "Newton's method leads from the start to no motion between the stops; set x0 and v0 nearer to the motion "
        "that is meant");
  return *std::move(start);
}

bool leaves_range(const CurvePoint& start, const BranchSettings& settings) {
  const double width = settings.range[1] - settings.range[0], at = start.at.back() * width, rounding = 1e-14 * width;
  return (start.tangent.back() < 0 && at - settings.range[0] <= rounding) ||
         (start.tangent.back() > 0 && settings.range[1] - at <= rounding);
}

namespace {

/// The tangent of free motion that is its own mirror image, kept as a whole, by that of its half: each half alone may
/// come to where its halts change earlier or later by its own equations.
std::optional<Vector> tangent_of_both_halves(const OrbitEquations& equations, const Waiting& from, const Vector& axis) {
  const auto half = half_of_free_slips(from.scene, from.orbit);
  if (!half) return std::nullopt;
  const OrbitEquations of_half{from.scene, *half, equations.axes(), equations.speed_unit()};
  const auto first = static_cast<std::ptrdiff_t>(of_half.first_axis());
  Vector half_axis(axis.begin(), axis.begin() + first);
  half_axis.push_back(axis.back());
  const auto along = tangent(of_half, of_half.unknowns_of(from.scene, *half), half_axis);
  return along ? std::optional(along_both_halves(*along)) : std::nullopt;
}

}  // namespace

std::optional<Vector> first_step(const OrbitEquations& equations, const CurvePoint& start, const Waiting& from,
                                 double tolerance) {
  std::vector<Vector> tried;
  if (from.direction) {
    tried = {*from.direction};
  } else {
    Vector axis(equations.unknowns(), from.heading == 0 ? 1.0 : 0.0);
    if (from.heading != 0) axis.back() = from.heading;
    auto along = tangent_of_both_halves(equations, from, axis);
    if (!along) along = tangent(equations, start.at, axis);
    if (!along) return std::nullopt;
    tried = {*along};
    if (from.heading == 0) tried.push_back(sum(*along, -2.0, *along));
  }
  return direction_into_motion(equations, start.at, tried, tolerance);
}

}  // namespace clatter::branches
