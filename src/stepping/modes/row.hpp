#pragma once

#include <string_view>

namespace clatter::stepping {

/// How the first of a mode's guards that falls to 0 is found: gaps to rigid stops and walls keep their relative
/// accuracy by a rule of their own (`motion::GapRule`), as does the pull of a wall (`PullRule`); beside a soft wall
/// the series of a step is one polynomial, whose first root is found; all else goes by `MarginRule`, or is known in
/// closed form.
enum class Search { gaps, margins, pull, series, closed_form };

/// A mode in words: a row of the guide's table.
struct Row {
  std::string_view mode, oscillator, guards;
  Search search;
  std::string_view laws;
};

}  // namespace clatter::stepping
