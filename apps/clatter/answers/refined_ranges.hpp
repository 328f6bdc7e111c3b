#pragma once

#include <string>
#include <vector>

#include "answers/ranges.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {

/// Moves the ends of ranges to where the word changes between two points, to 1e-9 of the axis: runs the scene between
/// them, halving the distance. Throws ChoiceError if a point of the file doesn't run alone: of branches, along
/// `follow`, or numbers of motions.
void refine(std::vector<RangeLine>& lines, const Ranges& ranges, const results::FileSummary& summary,
            const std::string& path);

}  // namespace clatter::app
