#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "point/fixed_point.hpp"
#include "point/in_fifty_digits.hpp"
#include "point/rounded.hpp"
#include "stepping/run.hpp"

namespace clatter::point {

/// Runs so many forcing periods from the start of a fixed point, by an integrator of its numbers, and keeps the
/// sections on the way; the state at the end, or nothing if the run doesn't complete, or `stopped` ends it.
template <class Integrator, class Number, class Observer>
[[nodiscard]] std::optional<motion::State<Number>> run_periods(const Problem& problem, BasicFixedPoint<Number>& found,
                                                               std::int64_t periods,
                                                               const std::function<bool()>& stopped,
                                                               Observer& observer) {
  Integrator integrator(in_digits<Number>(problem), limits_of(problem));
  motion::State<Number> state = found.start;
  found.sections.clear();
  for (std::int64_t section = 0; section < periods; ++section) {
    if (stopped && stopped()) return std::nullopt;
    found.sections.push_back(rounded(state));
    if (advance_to_section(integrator, state, 0, observer) != stepping::Outcome::completed) return std::nullopt;
  }
  return state;
}

}  // namespace clatter::point
