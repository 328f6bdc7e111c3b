#include "point/motions_in_digits.hpp"
#include "point/reference_motion.hpp"

namespace clatter::point {

std::optional<FixedPoint> fixed_point(const Problem& problem, const motion::State<double>& near, std::int64_t periods,
                                      const std::function<bool()>& stopped) {
  return find_fixed_point<FiftyDigits>(near, [&](FixedPoint& found) -> std::optional<Round<FiftyDigits>> {
    const auto motion = ReferenceMotion::of(problem);
    ReferenceRecorder recorder;
    recorder.tangent.emplace(problem.stops);
    const auto end =
        run_periods(found, periods, stopped, [&](auto& state) { return motion->advance_to_section(state, recorder); });
    if (!end) return std::nullopt;
    return Round<FiftyDigits>{*end, recorder.tangent->map()};
  });
}

}  // namespace clatter::point
