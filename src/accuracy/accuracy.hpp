#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "accuracy/tested_method.hpp"
#include "point/point.hpp"

namespace clatter::accuracy {

/// A row of an accuracy run: the errors and costs of a method at one setting. NaN: does not apply, or there is nothing
/// to compare; all values if lanes leave the scene to the scalar loop. In lanes impacts are only counted, without their
/// times.
struct WorkPrecision {
  Trial trial;
  steady::Status status = steady::Status::unresolved;
  double contact_time = point::no_value;   ///< largest error of an impact's time, in forcing periods
  double contact_speed = point::no_value;  ///< largest error of an impact's speed, over the largest speed
  double rest = point::no_value;           ///< largest error of a rest's beginning or end, in forcing periods
  double extrema = point::no_value;        ///< error of the least and greatest x and x', over the largest |x| and |x'|
  double harmonics = point::no_value;      ///< of x: error of the complex amplitudes 1 ... 3, over the largest of them
  double v_harmonics = point::no_value;    ///< the same of x'
  double missed = point::no_value, extra = point::no_value;  ///< impacts; in lanes by the number on each stop
  double rests_missed = point::no_value;
  double impacts = point::no_value;            ///< number simulated
  double simulated_periods = point::no_value;  ///< forcing periods, settling included
  double observed_periods = point::no_value;   ///< forcing periods observed: for periodic motion its period
  double evaluations = point::no_value;        ///< of arcs in the scalar loop; of eq. 3 by general methods
  double ns_per_period = point::no_value;  ///< median wall time of a forcing period on one thread, in ns; in lanes of a
                                           ///< full block that runs the same point, over the number of lanes
  double ns_spread = point::no_value;      ///< interquartile range of ns_per_period; NaN if it was measured once
};

/// The cost of accuracy at one point of a sweep. Periods are forcing periods, without forcing those of the spring, 2 pi
/// at k = 1. No value has a unit but ns_per_period, so all are the same in any units of the scene.
struct PointAccuracy {
  double asked = 0.0;                       ///< periods to compare: the duration of a transient, else the window
  double horizon = 0.0;                     ///< periods compared: as long as double and 50 digits agree
  double impacts = 0.0;                     ///< number in the reference within the horizon
  double rests = 0.0;                       ///< number in the reference within the horizon, sticks included
  double steady_periods = point::no_value;  ///< period of the steady motion that repeats are compared with; NaN: none
  std::vector<WorkPrecision> rows;
};

struct AccuracyOptions {
  int rounds = 9;  ///< the most measurements of time a row
  /// Called after every trial and every round, with the seconds that the rest takes, once they can be estimated.
  std::function<void(std::optional<double> seconds_left)> progress{};
  std::function<bool()> stopped{};  ///< asked before every run; once true, nothing more is run
};

/// Number of calls of `progress` at a point of so many rows.
[[nodiscard]] std::size_t steps_of(std::size_t rows, const AccuracyOptions& options);

/// Measures every trial of a scene: its error against 50 digits, and its time, in turn with all others. Rows are
/// incomplete if the run was stopped.
[[nodiscard]] PointAccuracy measure_accuracy(const point::Problem& scene, const std::vector<Trial>& trials,
                                             const AccuracyOptions& options);

}  // namespace clatter::accuracy
