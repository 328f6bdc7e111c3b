#pragma once

#include <algorithm>
#include <limits>

namespace clatter::observables {

/// The least and the greatest value of a quantity so far.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double y) { low = std::min(low, y), high = std::max(high, y); }
};

}  // namespace clatter::observables
