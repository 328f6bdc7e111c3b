#pragma once

#include "branches/branch.hpp"
#include "results/dataset.hpp"

namespace clatter::branches {

/// The dataset of branches: their points over `point`, branch after branch, special points over `special`, in the order
/// of the branches. Numbers are in the user's units, of which `units` are those that the branches were computed in.
[[nodiscard]] results::Dataset branch_dataset(const Branches& branches, const BranchSettings& settings,
                                              const Units& units = {});

}  // namespace clatter::branches
