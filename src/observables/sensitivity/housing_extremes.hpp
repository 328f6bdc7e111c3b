#pragma once

#include "observables/sensitivity/course.hpp"
#include "observables/sensitivity/course_extremes.hpp"

namespace clatter::observables {

/// The least and the greatest displacement of a main mass and of a loose one, both in the observed frame, and the
/// places of that in its housing.
struct HousingExtremes {
  Extremes x{}, y{}, z{};
};

[[nodiscard]] HousingExtremes extremes_in_housing(const Course& course, const ObservedSpan& span);

}  // namespace clatter::observables
