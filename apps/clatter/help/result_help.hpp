#pragma once

#include <string>

#include "help/result_catalogue.hpp"

namespace clatter::app {

/// The help on a result: meaning, type, dimensions, unit, frame, when it is NaN, the key that asks for it.
[[nodiscard]] std::string result_reference(const CataloguedResult& result);

/// When a result is NaN and which key asks for it, as a clause each, for lists: "NaN if the point failed;
/// observe.extrema"; empty if there is nothing to say.
[[nodiscard]] std::string result_note(const CataloguedResult& result);

/// Every result with its meaning, by command.
[[nodiscard]] std::string list_of_results();

}  // namespace clatter::app
