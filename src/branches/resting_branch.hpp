#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "branches/measures/moving.hpp"
#include "branches/waiting.hpp"
#include "branches/walk/touch.hpp"

namespace clatter::branches {

/// Follows motion that rests. It is a function of the parameter, the run from its release, and walked along that.
class RestingBranch {
 public:
  /// `symmetric`: all scenes along the parameter are.
  RestingBranch(const StartProblem& problem, const BranchSettings& settings, bool symmetric, double speed_unit,
                Record& record, std::deque<Waiting>& waiting);

  /// Both ways, or one if the branch has a heading; what begins at its ends waits.
  void follow(const Waiting& from);

  /// If a branch that was born at a graze not long ago ends in another one, they accumulate where a chatter ends in
  /// rest just at its release. Returns whether this is so; the motion that rests, not far beyond, waits then.
  bool waits_beyond(const BranchPoint& last, Side stop, std::int64_t generation);

  /// Without restitution, a flight that begins with a turn into its stop doesn't begin: the mass is pressed, and rests.
  /// Returns whether this is how a branch ends. The motion that rests waits then.
  bool ends_in_rest(const Equations& builder, const OrbitEquations& walked, const Touch& touch, double within,
                    std::int64_t generation);

  /// Where a branch ends because a chatter begins to complete, finds the motion that rests on that stop beyond, so far
  /// ahead or a little further, and lets it wait to be followed.
  void wait_beyond(const BranchPoint& last, Side stop, double ahead, std::size_t special, std::int64_t generation);

 private:
  /// The motion at a value of the parameter, and how it changes along it.
  struct Sample {
    double value;
    Orbit orbit;
    Moving moving;
  };
  /// A branch goes on to a value of the parameter; if it ends there, `beyond` is the next number.
  struct Stretch {
    double last;
    Orbit orbit;
    std::optional<double> beyond{};
  };

  [[nodiscard]] FollowedScene scene(double value) const { return changed(problem_, settings_.along, value); }
  [[nodiscard]] std::optional<Orbit> orbit(double value, Side stop, const Orbit& like) const;
  /// The motion with one rest more that begins at least so far ahead of a branch's end, and its parameter.
  [[nodiscard]] std::optional<std::pair<double, Orbit>> resting_ahead(const BranchPoint& last, Side stop,
                                                                      double ahead) const;
  [[nodiscard]] BranchPoint point(double value, const Orbit& orbit) const;
  [[nodiscard]] std::optional<Sample> sample(double value, const Orbit& like) const;
  [[nodiscard]] bool are_joined(const Sample& one, const Sample& other) const;
  [[nodiscard]] Stretch stretch(double here, const Orbit& from, double to) const;
  [[nodiscard]] bool has_rest_beside_limit(double value, const Orbit& orbit) const;
  [[nodiscard]] bool is_new_contact(const Orbit& one, const Orbit& other) const;
  void walk(Orbit orbit, int heading);
  void end(double last, const Orbit& good, double beyond, const std::optional<Orbit>& other, int heading);
  void wait_without_rest(std::size_t limit, double last, const Orbit& good, int heading);
  void go_on_beyond(std::size_t limit, double last, const Orbit& good, double beyond, const std::optional<Orbit>& other,
                    int heading);
  void join(std::size_t branch, const Waiting& cascade);
  void note_maxima(double here, double next, const Orbit& like);

  StartProblem problem_;
  BranchSettings settings_;
  bool symmetric_;
  double width_, speed_unit_;
  Record& record_;
  std::deque<Waiting>& waiting_;
  Side stop_ = Side::none;  ///< from which the motion is released, as long as a branch is followed
  double start_ = 0.0;
  int cascade_side_ = 0;
  std::int64_t generation_ = 0;
};

}  // namespace clatter::branches
