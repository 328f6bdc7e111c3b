#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "branches/branch.hpp"
#include "branches/walk/walk.hpp"

namespace clatter::branches {

/// Points, special points and ends of branches, or of curves, as they are found.
class Record {
 public:
  /// Of branches along one axis, or of curves in the plane of two.
  Record(std::vector<OrbitEquations::Axis> axes, std::int64_t max_points)
      : axes_(std::move(axes)), max_points_(static_cast<std::size_t>(max_points)) {}

  /// Begins the next branch. Against this speed states of special points are compared.
  void begin(double speed_unit);
  [[nodiscard]] std::size_t branch() const { return branch_; }

  /// A point of the present branch, with multipliers.
  [[nodiscard]] BranchPoint point(const OrbitEquations& equations, const CurvePoint& at) const;
  void add(const BranchPoint& point) { found_.points.push_back(point); }
  [[nodiscard]] bool is_full() const { return found_.points.size() + kept_for_start_ >= max_points_; }

  /// The special point of that kind near another, known already or new; the present branch belongs to it.
  struct Noted {
    std::size_t number;
    bool is_new;
  };
  Noted note(SpecialKind kind, BranchPoint at, const Condition& condition = {});
  [[nodiscard]] bool knows(SpecialKind kind, const BranchPoint& at) const { return number_of(kind, at) < specials(); }
  /// Whether a special point can't be told from a graze of its branch: near a rigid stop a multiplier may be -1 within
  /// rounding of it.
  [[nodiscard]] bool grazes_at(std::size_t special) const;
  /// Whether a branch of motion like this, or its mirror image, belongs to a special point.
  [[nodiscard]] bool is_met_by(std::size_t special, const Orbit& orbit) const;
  /// A birth at a special point isn't followed from there.
  void leave_out(std::size_t special) { found_.special[special].left_out = true; }
  /// A branch belongs to a special point, too.
  void meet(std::size_t special, std::size_t branch);

  void end(const BranchPoint& last, std::string reason) { end(last, std::move(reason), false); }
  void fail(const BranchPoint& last, std::string_view reason) { end(last, std::string(reason), true); }

  /// How far, in the first parameter, the present branch has come from its first point to a point.
  [[nodiscard]] double way_to(const BranchPoint& last) const;
  /// Whether the present branch ends as one of ever more grazes, in ever shorter steps, near a chatter limit: it is
  /// shorter than a part of the range.
  [[nodiscard]] bool is_of_cascade(const BranchPoint& last, double within = 1e-5) const;

  /// The branch that has motion of these letters at a value of the first parameter, between two of its points.
  [[nodiscard]] std::optional<std::size_t> branch_of(const std::string& word, double value) const;

  /// The present branch is walked backwards first, from a start that is added only after turn_round().
  void walk_back() { kept_for_start_ = 1; }
  /// All of the present branch so far was walked backwards: brings it into the order of the whole branch.
  void turn_round();

  [[nodiscard]] const Branches& found() const { return found_; }
  /// All that is found. What was left out at a special point, but met it on a way of its own, isn't.
  [[nodiscard]] Branches take();

 private:
  void end(const BranchPoint& last, std::string reason, bool failed);
  [[nodiscard]] std::size_t specials() const { return found_.special.size(); }
  [[nodiscard]] std::size_t number_of(SpecialKind kind, const BranchPoint& at) const;

  std::vector<OrbitEquations::Axis> axes_;
  std::size_t max_points_, branch_ = 0, first_point_ = 0, first_special_ = 0, kept_for_start_ = 0;
  double speed_unit_ = 1.0;
  Branches found_;
};

}  // namespace clatter::branches
