#pragma once

#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"

namespace clatter::observables {

/// A course without friction, its stretches divided where the velocity passes 0, as the least friction divides them.
[[nodiscard]] Course divided_into_slips(const Course& course, const ObservedSpan& span);

}  // namespace clatter::observables
