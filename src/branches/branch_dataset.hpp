#pragma once

#include "branches/branch.hpp"
#include "sweep/dataset.hpp"

namespace clatter::branches {

/// The dataset of branches: their points over `point`, branch after branch, special points over `special`, in the order
/// of the branches. Numbers are in the user's units, of which `units` are those that the branches were computed in.
[[nodiscard]] sweep::Dataset branch_dataset(const Branches& branches, const BranchSettings& settings,
                                            const Units& units = {});

/// The names of its variables that hold texts.
[[nodiscard]] std::vector<std::string> names_of_texts();

}  // namespace clatter::branches
