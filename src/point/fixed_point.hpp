#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/state.hpp"
#include "point/problem.hpp"

namespace clatter::point {

/// A periodic motion in 50 digits.
struct FixedPoint {
  motion::State<FiftyDigits> start{};             ///< at a stroboscopic section
  std::vector<motion::State<double>> sections{};  ///< its states from the start on, at all but the last, rounded
};

/// The periodic motion of so many forcing periods near a state, by Newton's method in 50 digits; nothing if that
/// doesn't converge to 30 digits, or `stopped` ends it.
[[nodiscard]] std::optional<FixedPoint> fixed_point(const Problem& problem, const motion::State<double>& near,
                                                    std::int64_t periods, const std::function<bool()>& stopped = {});

/// The same with a loose mass.
[[nodiscard]] std::optional<FixedPoint> fixed_point_in_housing(const Problem& problem,
                                                               const motion::State<double>& near, std::int64_t periods,
                                                               const std::function<bool()>& stopped = {});

}  // namespace clatter::point
