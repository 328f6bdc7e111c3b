#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "branches/equations/equations.hpp"
#include "branches/settings.hpp"
#include "branches/start/start.hpp"
#include "branches/walk/special_kind.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// What may be born at a special point, if anything.
[[nodiscard]] std::optional<Birth> birth_at(SpecialKind kind);

/// A periodic motion on a branch, with its multipliers.
struct BranchPoint {
  std::size_t branch = 0;
  double arclength = 0.0;  ///< from the branch's first point, in the units of the equations; backwards negative
  FollowedScene scene;
  Orbit orbit;
  bool stable = false;
  /// Of the whole period, `multipliers_in` its scene, the one of larger modulus first: real and imaginary parts.
  std::array<double, 4> multiplier_re{}, multiplier_im{};
};

struct SpecialPoint {
  SpecialKind kind = SpecialKind::fold;
  BranchPoint at;
  std::vector<std::size_t> branches;  ///< that meet there
  Condition condition{};              ///< of a graze
  bool left_out = false;              ///< a birth there isn't followed
};

/// How the end of a branch, or of a curve, came about.
struct BranchEnd {
  std::size_t branch = 0;
  FollowedScene scene;  ///< of the last good point
  std::string reason;   ///< "range", "graze", ..., or the words of a failure
  bool failed = false;
  bool of_curve = false;
};

constexpr std::string_view max_points_spent = "branch.max_points is spent; raise it";
constexpr std::string_view no_step = "no step leads on; try a smaller branch.largest_step, or begin beyond";
constexpr std::string_view no_graze =
    "a contact that no graze explains; try a smaller branch.largest_step, or begin beyond";

constexpr std::string_view no_halt_change =
    "a halt that friction doesn't explain; try a smaller branch.largest_step, or begin beyond";

struct Branches {
  std::vector<BranchPoint> points;  ///< branch after branch, each in the order of its arclength
  std::vector<SpecialPoint> special;
  std::vector<BranchEnd> ends;
  OfBirths<std::size_t> left_out{};  ///< special points with a birth that isn't followed
  WordLetters letters{};             ///< of the words of the motions
};

/// Follows the branch of a problem both ways from its start, and what it leads to. Throws StartError if the scene
/// settles on nothing that can be followed.
[[nodiscard]] Branches follow_branches(const StartProblem& problem, const BranchSettings& settings);

}  // namespace clatter::branches
