#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motion/loose_tangent.hpp"
#include "motion/walls.hpp"
#include "point/exact_motion.hpp"
#include "point/fifty_digit_periods.hpp"
#include "point/fixed_point.hpp"
#include "point/reference_motion.hpp"

namespace clatter::point {
namespace {

/// The derivative of the map over so many periods, in double.
std::optional<motion::LooseJacobian> derivative_over(const Problem& problem, motion::State<double> state,
                                                     std::int64_t periods) {
  const auto motion = ExactMotion::of(problem);
  MotionRecorder recorder(motion->stops());
  recorder.loose.emplace(problem);
  for (std::int64_t section = 0; section < periods; ++section)
    if (motion->advance_to_section(state, 0, recorder) != stepping::Outcome::completed) return std::nullopt;
  return recorder.loose->map();
}

}  // namespace

/// The derivative in double serves all iterations: each leaves as small a share of the error as its rounding.
std::optional<FixedPoint> fixed_point_in_housing(const Problem& problem, const motion::State<double>& near,
                                                 std::int64_t periods, const std::function<bool()>& stopped) {
  constexpr int most_iterations = 12;
  const auto map = derivative_over(problem, near, periods);
  if (!map) return std::nullopt;
  FixedPoint found;
  found.start.x = near.x, found.start.v = near.v;
  found.start.loose = {near.loose.wall, near.loose.place, near.loose.speed, near.loose.pressed};
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto motion = ReferenceMotion::of(problem);
    ReferenceRecorder recorder;
    const auto state =
        run_periods(found, periods, stopped, [&](auto& at) { return motion->advance_to_section(at, recorder); });
    if (!state) return std::nullopt;
    const auto begin = motion::numbers_of(found.start, problem.loose), end = motion::numbers_of(*state, problem.loose);
    motion::Four<double> off;
    double change = 0.0, size = 0.0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      off[i] = static_cast<double>(end[i] - begin[i]);
      change += std::abs(off[i]), size += std::abs(static_cast<double>(end[i]));
    }
    if (change <= 1e-30 * size) return found;
    const motion::Four<double> by = motion::change_of_fixed_point(*map, off);
    if (!std::ranges::all_of(by, [](double number) { return std::isfinite(number); })) return std::nullopt;
    found.start = motion::moved(found.start, by);
  }
  return std::nullopt;
}

}  // namespace clatter::point
