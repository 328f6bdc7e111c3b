#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "branches/record.hpp"
#include "branches/walk/opening.hpp"

namespace clatter::branches {

/// A branch that waits to be followed.
struct Waiting {
  FollowedScene scene;
  Orbit orbit;
  std::optional<Vector> direction{};     ///< along which it begins; nothing: the way on which it is motion
  std::optional<std::size_t> special{};  ///< that it comes from
  std::int64_t generation = 0;
  int heading = 0;                       ///< up or down the parameter; 0: both ways
  std::optional<std::size_t> cascade{};  ///< the branch that came near it through ever more grazes
  int cascade_side = 0;                  ///< on which that lies: up or down the parameter
  std::optional<Opening> opens{};        ///< in the orbit, which is that of the special point
  /// The heading, up or down the parameter, of the branch that came to the graze it begins at: if it turns back there,
  /// it is born. 0: it goes on whatever its heading is.
  int came = 0;
  bool passes = false;  ///< its special point lies within it: it is followed both ways

  /// Whether it begins across the parameter, which by rounding may turn there: as what is born on another branch, a
  /// slip that begins, or a touch that a renewal has turned into. A contact that begins is followed from where it
  /// lasts.
  [[nodiscard]] bool begins_across() const;
};

/// A branch that came to its end in a special point needn't begin there any more, nor does its mirror image.
void no_longer_waits(std::deque<Waiting>& waiting, std::size_t special, const Orbit& orbit);

/// A branch that begins with the impact that grazes, or with a contact with a soft stop there.
[[nodiscard]] Waiting with_contact(Waiting branch, std::size_t graze, int came = 0);

/// Motion without the impact that grazes, or the contact, waits to be followed from there, unless that has no place.
/// `came`: as of Waiting.
void wait_without(std::deque<Waiting>& waiting, Waiting without, bool symmetric_scene, int came = 0);

/// A branch that is born at a flip or a loss of symmetry begins along the eigenvector of multiplier -1.
[[nodiscard]] Waiting daughter_at(const BranchPoint& at, std::size_t special, std::int64_t generation);

/// Motion that repeats sooner without the impact that grazes, or is symmetric, may gain such an impact in each of its
/// repetitions, too: this motion. Nothing if it doesn't.
[[nodiscard]] std::optional<Waiting> with_each(const BranchPoint& at, std::size_t graze, bool symmetric_scene,
                                               std::size_t special, std::int64_t generation);

/// Motion over several periods that comes to a graze which is known already may do so with several impacts at once:
/// then motion that repeats sooner, without them or with all of them, begins there, too, unless it is known.
void wait_for_sooner(std::deque<Waiting>& waiting, const Record& record, const BranchPoint& at, std::size_t graze,
                     bool symmetric_scene, std::size_t special, std::int64_t generation);

/// The point of a branch at the parameter of a guess, with its tangent towards larger values of that.
[[nodiscard]] std::optional<CurvePoint> point_near(const OrbitEquations& equations, const Vector& guess,
                                                   double tolerance);

/// The point at the parameter of a guess where a branch begins that doesn't begin at another one. Throws StartError if
/// there is none that is motion between the stops.
[[nodiscard]] CurvePoint start_near(const OrbitEquations& equations, const Vector& guess, double tolerance);

/// Whether a walk begins on a bound of the range, outwards.
[[nodiscard]] bool leaves_range(const CurvePoint& start, const BranchSettings& settings);

/// The direction from a special point into a branch that begins there, in which it is motion between the stops.
[[nodiscard]] std::optional<Vector> first_step(const OrbitEquations& equations, const CurvePoint& start,
                                               const Waiting& from, double tolerance);

}  // namespace clatter::branches
