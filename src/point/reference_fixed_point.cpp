#include "point/motions_in_digits.hpp"
#include "stepping/exact.hpp"

namespace clatter::point {

// The reference that double is judged by finds its contacts without double.
std::optional<FixedPoint> fixed_point(const Problem& problem, const motion::State<double>& near, std::int64_t periods,
                                      const std::function<bool()>& stopped) {
  return with_every_effect(problem, [&]<Effects E>() {
    return find_fixed_point<stepping::Exact<FiftyDigits, E>>(problem, near, periods, stopped);
  });
}

}  // namespace clatter::point
