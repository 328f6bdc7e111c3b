#pragma once

#include <cstddef>
#include <limits>

#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"

namespace clatter::observables {

/// An instant of a course at which the displacement is extreme.
struct Place {
  double x;
  std::size_t stretch = 0;
  double s = 0.0;    ///< tau since the stretch began
  int quarter = -1;  ///< at rest on what is shaken, which turns back there: the quarter turn of its phase

  [[nodiscard]] bool is_in(std::size_t i) const { return stretch == i; }
};

/// The least and the greatest displacement of a course in the observed frame.
struct Extremes {
  Place least{std::numeric_limits<double>::infinity()}, greatest{-std::numeric_limits<double>::infinity()};

  /// Takes a place that goes beyond those before it by more than a margin.
  void see(const Place& place, double margin = 0.0) {
    if (place.x < least.x - margin) least = place;
    if (place.x > greatest.x + margin) greatest = place;
  }
};

[[nodiscard]] Extremes extremes_of(const Course& course, const ObservedSpan& span);

}  // namespace clatter::observables
