#pragma once

#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"

namespace clatter::observables {

/// A course without friction, its stretches divided where the velocity passes 0, as the least friction divides them: of
/// the main mass, or of a loose one that doesn't rub, in its housing.
[[nodiscard]] Course divided_into_slips(const Course& course, const ObservedSpan& span, bool of_loose = false);

}  // namespace clatter::observables
