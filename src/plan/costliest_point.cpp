#include "plan/costliest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "model/required_effects.hpp"
#include "model/response.hpp"
#include "plan/sample.hpp"
#include "point/point.hpp"

namespace clatter::plan {
namespace {

constexpr double long_time = 10.0;  ///< seconds that a point may take without a warning

/// The time in tau that a point may run for.
double longest_time(const point::Problem& scene) {
  const steady::TimeSettings& time = scene.time;
  if (time.mode == steady::Mode::transient) return time.duration;
  return static_cast<double>(time.max_periods + time.window) * period_of(scene.oscillator);
}

/// About the distance that motion between two stops travels: at its initial speed, until damping has taken that, plus
/// at the speed of the response to the force.
double way_of(const point::Problem& scene) {
  const Oscillator& o = scene.oscillator;
  const double time = longest_time(scene);
  const double begun = norm(scene.start.displacement - equilibrium_of(o), scene.start.velocity);
  const double response = (1 + o.frequency) * steady_response(o).amplitude;
  const double forced = std::min(response, std::abs(o.forcing) * time);  // at resonance it grows
  return begun * std::min(time, 1 / o.damping) + forced * time;
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1g", value);
  return text.data();
}

}  // namespace

double impacts_without_loss(const point::Problem& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  if (!(stops.restitution_lower >= 1 || stops.restitution_upper >= 1)) return 0;
  if (scene.time.mode == steady::Mode::steady && o.forcing == 0)
    return 0;  // its period is known in closed form, or it comes to a standstill
  const Requirements needs = requirements_of(scene, duration_of(scene.time));
  const bool lower = needs.effects.lower && !is_soft(stops, Side::lower) && stops.restitution_lower >= 1,
             upper = needs.effects.upper && !is_soft(stops, Side::upper) && stops.restitution_upper >= 1;
  const double push = std::abs(o.forcing);
  if ((lower && !(push < constant_force(o, stops.lower))) || (upper && !(push < -constant_force(o, stops.upper))))
    return scene.time.max_impacts;
  if (!(lower && upper) || std::isnan(scene.start.displacement)) return 0;
  return std::min(scene.time.max_impacts, way_of(scene) / (stops.upper - stops.lower));
}

std::optional<std::string> warning_of_costliest_point(const sweep::Sweep& sweep,
                                                      const std::optional<sweep::Shard>& shard) {
  const sweep::Share share(sweep, shard);
  const Sample sample(share.points(), 10000);
  double impacts = 0;
  std::size_t costliest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const std::size_t number = sample[i].number;
    const std::size_t point = share.point(number / share.length(), number % share.length());
    if (const double of_point = impacts_without_loss(problem_at(sweep, point)); of_point > impacts)
      impacts = of_point, costliest = point;
  }
  if (!(impacts > 1e5)) return std::nullopt;
  constexpr double evaluations = 2;  // an impact
  const double seconds =
      impacts * evaluations * point::seconds_per_evaluation(effects_of(problem_at(sweep, costliest)));
  if (!(seconds > long_time)) return std::nullopt;
  const std::string which = size(sweep) > 1 ? "point " + std::to_string(costliest) + " alone" : "the point";
  return which + " may take " + number_text(impacts) + " impacts, some " + number_text(seconds) +
         " s: with R = 1 nothing ends its bouncing; lower time.max_impacts, or take R below 1";
}

}  // namespace clatter::plan
