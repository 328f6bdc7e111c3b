#pragma once

#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "tables/condition.hpp"

namespace clatter::app {

[[nodiscard]] bool is_text(const results::Variable& variable);

/// The word for each value: the text itself, or the meaning of a flag.
[[nodiscard]] std::vector<std::string> words_of(const results::Variable& variable);

/// Throws ChoiceError unless a condition names one of the words that a variable may have, where they are known: of a
/// flag, and of kinds of special points.
void require_known_word(const Condition& condition, const results::Variable& variable);

/// " is one of LU, LLUU": some words, the most frequent first, without empty ones, and the one that is nearly meant.
[[nodiscard]] std::string words_there(const std::string& meant, const std::vector<std::string>& words);

}  // namespace clatter::app
