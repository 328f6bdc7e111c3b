#pragma once

#include "observables/sensitivity/course_extremes.hpp"
#include "observables/sensitivity/housing_course.hpp"

namespace clatter::observables {

/// The least and the greatest displacement of a main mass and of a loose one, both in the observed frame, and the
/// places of that in its housing.
struct HousingExtremes {
  Extremes x{}, y{}, z{};
};

[[nodiscard]] HousingExtremes extremes_of(const HousingCourse& course, const ObservedSpan& span);

}  // namespace clatter::observables
