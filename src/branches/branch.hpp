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
#include "branches/start.hpp"
#include "branches/walk/violation.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// Special points of branches and of curves in two parameters.
enum class SpecialKind : std::uint8_t {
  fold,
  flip,
  symmetry_breaking,
  graze,
  chatter_limit,      ///< a chatter ends in rest just at the release: beyond it the mass doesn't rest
  release_tangency,   ///< beyond it the mass is never released, or earlier
  impact_speed,       ///< largest along the branch
  impact_power,       ///< likewise
  harmonic,           ///< likewise
  resonant_graze,     ///< of a curve: an impact that vanishes on curves of multipliers +1 and -1
  cusp,               ///< of a curve: two special points meet and vanish
  crossing_sliding,   ///< under dry friction: a reversal of a slip becomes a stick, or the other way round
  grazing_sliding,    ///< likewise: a slip whose velocity just comes to 0 gains a stick, or the other way round
  switching_sliding,  ///< likewise: a reversal and the slip to a stick vanish, or appear before it
  neimark_sacker,     ///< of a loose mass: a pair of multipliers leaves the unit circle
  motion_ceases       ///< under dry friction: it comes up to the force, and beyond holds the mass for good
};
[[nodiscard]] std::string_view name_of(SpecialKind kind);
/// What may be born there, if anything.
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
  bool word_sticks = false;          ///< words of the motions have a letter for each stick
};

/// Follows the branch of a problem both ways from its start, and what it leads to. Throws StartError if the scene
/// settles on nothing that can be followed.
[[nodiscard]] Branches follow_branches(const StartProblem& problem, const BranchSettings& settings);

}  // namespace clatter::branches
