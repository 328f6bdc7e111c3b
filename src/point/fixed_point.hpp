#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/state.hpp"
#include "point/problem.hpp"

namespace clatter::point {

/// A periodic motion in more digits than double has.
template <class Number>
struct BasicFixedPoint {
  motion::State<Number> start{};                  ///< at a stroboscopic section
  std::vector<motion::State<double>> sections{};  ///< its states from the start on, at all but the last, rounded
};
using FixedPoint = BasicFixedPoint<FiftyDigits>;

/// The sections of the periodic motion of so many forcing periods near a state, by Newton's method in as many digits as
/// it needs, 31 or 50; empty if it doesn't converge.
[[nodiscard]] std::vector<motion::State<double>> periodic_sections(const Problem& problem,
                                                                   const motion::State<double>& near,
                                                                   std::int64_t periods);

/// The periodic motion of so many forcing periods near a state, by Newton's method in 50 digits; nothing if that
/// doesn't converge to 30 digits, or `stopped` ends it.
[[nodiscard]] std::optional<FixedPoint> fixed_point(const Problem& problem, const motion::State<double>& near,
                                                    std::int64_t periods, const std::function<bool()>& stopped = {});

/// The same with a loose mass.
[[nodiscard]] std::optional<FixedPoint> fixed_point_in_housing(const Problem& problem,
                                                               const motion::State<double>& near, std::int64_t periods,
                                                               const std::function<bool()>& stopped = {});

}  // namespace clatter::point
