#pragma once

#include <algorithm>
#include <vector>

#include "scene/force_table.hpp"
#include "support/random.hpp"

namespace clatter::support {

/// A random table of 1 ... 9 knots, some of them jumps, some at the same value as the one before, the values in any
/// unit.
[[nodiscard]] inline const ForceTable* any_force_table(Random& random) {
  const int count = 1 + static_cast<int>(random.uniform(0, 9));
  const double unit = random.logarithmic(0.1, 10);
  std::vector<double> turns{0};
  while (static_cast<int>(turns.size()) < count) turns.push_back(random.uniform(0.01, 0.99));
  std::ranges::sort(turns);
  std::vector<ForceTable::Knot> knots;
  double value = unit;
  for (const double there : turns) {
    if (!knots.empty() && there - knots.back().turns < 1e-3) continue;
    if (!random.happens(0.2)) value = unit * random.uniform(-1, 1);
    knots.push_back({there, value, random.happens(0.3) ? unit * random.uniform(-1, 1) : value});
    value = knots.back().after;
  }
  return kept(ForceTable(knots));
}

}  // namespace clatter::support
