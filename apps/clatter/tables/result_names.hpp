#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "results/dataset_file.hpp"

namespace clatter::app {

// Files name a result by what has it: the word of a motion is `impact_word` in a sweep, `word` on a branch,
// `special_word` at a special point, and `motion_word` of a motion that starts end in. Users type one name, `word`; the
// name in the file is understood, too.

/// The name of a result in files of `clatter run`, and the one that users type.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 1> names_of_sweeps{
    {{"impact_word", "word"}}};

/// The name in a file for one that a user typed, a component staying with it: that which begins with `prefix`, of
/// special points, impacts or motions, if the file has it; the typed one if it has neither.
[[nodiscard]] std::string name_in_file(const results::FileSummary& summary, const std::string& typed,
                                       std::string_view prefix = {});

/// The name that users type for a variable over dimensions in words: "word" for "special_word".
[[nodiscard]] std::string typed_name(std::string_view variable, std::string_view over);

}  // namespace clatter::app
