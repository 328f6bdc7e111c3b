#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "point/fixed_point.hpp"
#include "point/rounded.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// Runs so many forcing periods from the start of a fixed point, each by `advance_to_section(state)`, and keeps the
/// sections on the way; the state at the end, or nothing if the run doesn't complete, or `stopped` ends it.
template <class Number, class Advance>
[[nodiscard]] std::optional<motion::State<Number>> run_periods(BasicFixedPoint<Number>& found, std::int64_t periods,
                                                               const std::function<bool()>& stopped,
                                                               Advance&& advance_to_section) {
  motion::State<Number> state = found.start;
  found.sections.clear();
  for (std::int64_t section = 0; section < periods; ++section) {
    if (stopped && stopped()) return std::nullopt;
    found.sections.push_back(rounded(state));
    if (advance_to_section(state) != stepping::Outcome::completed) return std::nullopt;
  }
  return state;
}

}  // namespace clatter::point
