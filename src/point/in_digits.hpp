#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "math/double_double.hpp"
#include "math/wide_float.hpp"
#include "point/fixed_point.hpp"
#include "point/resting_motion.hpp"

namespace clatter::point {

/// What the functions of these names in `resting_motion.hpp` and `fixed_point.hpp` do, in numbers of one type: of 31
/// digits, or of 50. Each type is compiled in a file of its own.
template <class Number>
struct InDigits {
  static RestingMotion resting_motion(const Problem& problem, Side side);
  static std::optional<ReleasedMotion> released_motion(const Problem& problem, Side side, std::int64_t periods);
  static std::optional<BasicFixedPoint<Number>> fixed_point(const Problem& problem, const motion::State<double>& near,
                                                            std::int64_t periods,
                                                            const std::function<bool()>& stopped = {});
};

extern template struct InDigits<DoubleDouble>;
extern template struct InDigits<WideFloat>;

}  // namespace clatter::point
