#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "accuracy/accuracy_dataset.hpp"
#include "support/runs.hpp"

namespace clatter::accuracy {

inline constexpr double no_setting = std::numeric_limits<double>::quiet_NaN();

/// Fig. 18, from rest: smooth motion with one impact on each stop in a period.
inline point::Problem smooth_scene() {
  point::Problem scene = support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7);
  scene.time.window = 6;
  return scene;
}

/// From rest to a chatter that ends in a rest, then impacts without rest, asymmetrically.
inline point::Problem chattering_scene() {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);
  scene.time.window = 4;
  return scene;
}

/// Past grazing, one of the paper's scenes that never repeat: a digit is lost in some ten forcing periods.
inline point::Problem chaotic_scene() {
  point::Problem scene = support::scene_of({0.1, -1.0, 0.95, 0.0}, -3.0, 3.0, 0.7);
  scene.time.window = 200, scene.time.max_periods = 500;
  return scene;
}

/// Trials of one kind, at 10^-first ... 10^-last.
inline std::vector<Trial> decades(TestedMethod method, int first, int last) {
  std::vector<Trial> trials;
  for (int digits = first; digits <= last; ++digits) trials.push_back({method, std::pow(10.0, -digits)});
  return trials;
}

/// One trial of each kind.
inline std::vector<Trial> one_of_each() {
  return {
      {TestedMethod::exact, no_setting},           {TestedMethod::dopri5, 1e-6},        {TestedMethod::moreau, 1e-2},
      {TestedMethod::harmonics_exact, no_setting}, {TestedMethod::harmonics_fft, 1024}, {TestedMethod::steady, 1e-10},
      {TestedMethod::steady_repetition, 1e-10}};
}

inline const WorkPrecision& row_of(const PointAccuracy& of_point, TestedMethod method) {
  return *std::ranges::find_if(of_point.rows, [&](const WorkPrecision& row) { return row.trial.method == method; });
}

/// Slope of the straight line through the logarithms of the settings of rows and of their errors.
inline double order_of(const PointAccuracy& of_point, double WorkPrecision::*error) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const WorkPrecision& row : of_point.rows) {
    const double u = std::log(row.trial.setting), v = std::log(row.*error);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// The measured errors of a row, all NaN if there is nothing to compare with.
inline std::vector<double> errors_of(const WorkPrecision& row) {
  return {row.contact_time, row.contact_speed, row.rest,  row.extrema,     row.harmonics,
          row.v_harmonics,  row.missed,        row.extra, row.rests_missed};
}
inline bool has_errors(const WorkPrecision& row) {
  return std::ranges::any_of(errors_of(row), [](double error) { return !std::isnan(error); });
}
inline double sum_of_faults(const WorkPrecision& row) { return row.missed + row.extra + row.rests_missed; }

}  // namespace clatter::accuracy
