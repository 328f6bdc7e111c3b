#pragma once

#include <functional>

namespace clatter::observables {

/// The end on the side of `high` of the smallest bracket of a root that doubles allow; the function has opposite signs
/// at low and high, `at_low` and `at_high` (Alefeld, Potra & Shi, ACM Trans. Math. Softw. 21, 327, 1995).
[[nodiscard]] double bracketed_root(const std::function<double(double)>& function, double low, double high,
                                    double at_low, double at_high);

}  // namespace clatter::observables
