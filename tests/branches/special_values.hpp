#pragma once

#include <algorithm>
#include <vector>

#include "branches/branch.hpp"

namespace clatter::branches {

/// Special points of one kind, by their parameter, in order.
inline std::vector<double> special_values(const Branches& found, SpecialKind kind, Parameter along) {
  std::vector<double> all;
  for (const SpecialPoint& special : found.special)
    if (special.kind == kind) all.push_back(value_of(special.at.scene, along));
  std::ranges::sort(all);
  return all;
}

}  // namespace clatter::branches
