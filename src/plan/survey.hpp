#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "plan/bounds.hpp"
#include "scene/required_effects.hpp"
#include "sweep/run.hpp"

namespace clatter::plan {

/// Points that a survey examines at most; of more it takes a sample of this size.
inline constexpr std::size_t most_examined = 1'000'000;

/// The point that comes closest to a stop, the first of equal ones.
struct Closest {
  double ratio = -1;
  std::size_t point = 0;

  void add(const Closest& other) {
    if (other.ratio > ratio || (other.ratio == ratio && other.point < point)) *this = other;
  }
};

/// A stop, over all points.
struct StopSeen {
  bool met = false;  ///< by any point
  Closest closest;   ///< among those that don't meet it

  void add(const StopSeen& other) { met = met || other.met, closest.add(other.closest); }
};

/// A group while it is collected.
struct Collected {
  Effects effects;
  std::size_t points = 0;
  Closest example;
  Bounds periods;
  Bounds work, lane_work;  ///< of points in the scalar loop, and in lanes (`work_of_period`)

  void add(const Collected& other) {
    points += other.points;
    periods += other.periods, work += other.work, lane_work += other.lane_work;
    example.add(other.example);
  }
};

/// The work of points, whatever their order and division. Each point of a sample counts for those that it stands for.
struct Survey {
  std::size_t examined = 0;  ///< points that were examined
  std::vector<Collected> groups;
  StopSeen lower, upper;
  bool lasting = false;  ///< a transient never fades

  void add(const Collected& part) {
    const auto same = std::ranges::find(groups, part.effects, &Collected::effects);
    if (same == groups.end()) {
      groups.push_back(part);
    } else {
      same->add(part);
    }
  }
  void add(const Survey& other) {
    for (const Collected& group : other.groups) add(group);
    lower.add(other.lower), upper.add(other.upper), lasting = lasting || other.lasting;
  }
};

/// A point as the plan examines it; along a followed chain its start isn't known yet, and NaN.
[[nodiscard]] point::Problem planned_problem(const sweep::Sweep& sweep, std::size_t point);

/// Evaluations of arcs in a forcing period, from the length of the steps that are proved free of contact; two impacts a
/// period, each worth two. The work of general methods counts in forcing periods.
[[nodiscard]] double work_of_period(const point::Problem& scene, const Effects& effects);

/// Examines the points of a run, or a sample of them; the same survey for every number of threads.
[[nodiscard]] Survey survey_of(const sweep::Sweep& sweep, const sweep::Share& share, const sweep::RunOptions& options);

}  // namespace clatter::plan
