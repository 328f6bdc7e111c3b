#pragma once

#include <string>

#include "branches/branch.hpp"
#include "results/dataset.hpp"

namespace clatter::branches {

/// "0 symmetry, 2 flip, 1 graze"
[[nodiscard]] std::string births_text(const OfBirths<std::size_t>& births);

/// The dataset of branches: their points over `point`, branch after branch, special points over `special`, in the order
/// of the branches. If births were chosen, the attribute `births_left_out` and `special_left_out` tell the others.
/// Numbers are in the user's units, of which `units` are those that the branches were computed in. `in_housing`: they
/// are those of a loose mass.
[[nodiscard]] results::Dataset branch_dataset(const Branches& branches, const BranchSettings& settings,
                                              const Units& units = {}, bool in_housing = false);

}  // namespace clatter::branches
