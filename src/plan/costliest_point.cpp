#include "plan/costliest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "plan/sample.hpp"
#include "plan/survey.hpp"
#include "point/point.hpp"
#include "scene/required_effects.hpp"
#include "scene/response.hpp"

namespace clatter::plan {
namespace {

constexpr double long_time = 10.0;  ///< seconds that a point may take without a warning

/// The time in tau that a point may run for.
double longest_time(const point::Problem& scene) {
  const steady::TimeSettings& time = scene.time;
  if (time.mode == steady::Mode::transient) return time.duration;
  return static_cast<double>(time.max_periods + time.window) * period_of(scene.oscillator);
}

/// About the distance that motion between two stops travels: at its initial speed, until damping or friction has taken
/// that, plus at the speed of the response to the force.
double way_of(const point::Problem& scene) {
  const Oscillator& o = scene.oscillator;
  const double time = longest_time(scene);
  const double begun = norm(scene.start.displacement - equilibrium_of(o), scene.start.velocity);
  const double response = (1 + o.frequency) * steady_response(o).amplitude;
  const double forced = std::min(response, std::abs(o.forcing) * time);  // at resonance it grows
  return begun * std::min({time, 1 / o.damping, begun / (2 * scene.friction.kinetic)}) + forced * time;
}

/// Impacts in a time under an acceleration `pull`, between which v passes in 2v/pull, while v falls as e^(-fading t).
double bounces_in(double time, double pull, double speed, double fading) {
  const double stretched = fading > 0 ? std::expm1(fading * time) / fading : time;
  return pull * stretched / (2 * speed);
}

/// Impacts on a stop that an acceleration `pull` presses the mass onto: it returns after 2v/pull, and damping
/// takes 2h v^2/3 of its energy in a unit of time, so that v falls as e^(-2ht/3). Friction takes mu/pull of the
/// speed in each flight, mu/2 in a unit of time, and all of its digits in some 36 pull/mu flights.
double bounces_on(const point::Problem& scene, double position, double pull) {
  if (!(pull >= 0)) return 0;
  const double time = longest_time(scene), fading = 2 * scene.oscillator.damping / 3;
  const double height = std::abs(scene.start.displacement - position);
  const double speed = std::hypot(scene.start.velocity, std::sqrt(2 * pull * height));
  const double friction = scene.friction.kinetic, spent = friction * time / (2 * speed);  // share of the speed
  const double impacts =
      bounces_in(time, pull, speed, fading) * (spent > 0 ? -std::log1p(-std::min(spent, 1.0)) / spent : 1);
  if (friction > 0) return std::min(36 * pull / friction, impacts);  // also if its start isn't known
  return std::isnan(impacts) ? scene.time.max_impacts : impacts;     // its start isn't known, or it stays on the stop
}

/// Impacts on a wall that the load of a loose mass presses it onto for good, since the main mass with it never
/// accelerates as much. In flights without its weight the main mass accelerates eps times as much the other way. It has
/// eps/(1 + eps) of the relative velocity w, of which damping takes its share: w falls as e^(-2ht/3 eps/(1 + eps)).
double bounces_in_housing(const point::Problem& scene) {
  const LooseMass& loose = scene.loose;
  if (has_loose_friction(loose)) return 0;
  const double both = 1 + loose.ratio, wall = loose.load < 0 ? loose.lower : loose.upper;
  const Side side = loose.load < 0 ? Side::lower : Side::upper;
  if (takes_energy(walls_of(loose), side) || is_soft(loose, side) || loose.load == 0 || std::isinf(wall)) return 0;
  Oscillator o = scene.oscillator;
  o.damping /= both, o.forcing /= both, o.stiffness /= both;
  const double shaken = o.forcing == 0 ? 0.0 : o.frequency * o.frequency * steady_response(o).amplitude;
  if (!(shaken < std::abs(loose.load))) return 0;
  const double pull = both * std::abs(loose.load), height = std::abs(loose.place - wall);
  const double speed = std::hypot(loose.velocity, std::sqrt(2 * pull * height));
  return bounces_in(longest_time(scene), pull, speed, 2 * scene.oscillator.damping / 3 * loose.ratio / both);
}

/// One digit of a number above 1: 30, 2000, 1e+08.
std::string number_text(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", std::round(value / unit) * unit);
  return text.data();
}

/// Steps of a transient that meets a stop, each an evaluation of an arc.
double steps_of_transient(const point::Problem& scene) {
  if (scene.time.mode != steady::Mode::transient) return 0;
  return scene.time.duration / period_of(scene.oscillator) * work_of_period(scene, effects_of(scene));
}

/// The point that takes most of something.
struct Costliest {
  double most = 0;
  std::size_t point = 0;

  void see(double of_point, std::size_t number) {
    if (of_point > most) most = of_point, point = number;
  }
  /// "point 2 alone may take 1e+08 impacts, some 30 s", if that is long.
  [[nodiscard]] std::optional<std::string> told(const sweep::Sweep& sweep, double evaluations, const char* unit) const {
    if (!(most > 1e5)) return std::nullopt;
    const double each = point::seconds_per_evaluation(effects_of(problem_at(sweep, point)));
    const double seconds = most * evaluations * each;
    if (!(seconds > long_time)) return std::nullopt;
    const std::string which = size(sweep) > 1 ? "point " + std::to_string(point) + " alone" : "the point";
    return which + " may take " + number_text(most) + ' ' + unit + ", some " + number_text(seconds) + " s";
  }
};

}  // namespace

double impacts_without_loss(const point::Problem& scene) {
  if (has_loose_mass(scene.loose)) return std::min(scene.time.max_impacts, bounces_in_housing(scene));
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const auto keeps = [&](Side side) { return !is_soft(stops, side) && !takes_energy(stops, side); };
  if (!keeps(Side::lower) && !keeps(Side::upper)) return 0;
  if (scene.time.mode == steady::Mode::steady && !is_driven(o))
    return 0;  // its period is known in closed form, or it comes to a standstill
  const Requirements needs = requirements_of(scene, duration_of(scene.time));
  const bool lower = needs.effects.lower && keeps(Side::lower), upper = needs.effects.upper && keeps(Side::upper);
  const double push = std::abs(o.forcing);
  double impacts = 0;
  const auto bounces = [&](double position, double pressing) {
    const bool at_times = pressing <= 0 && pressing + push >= 0;
    return bounces_on(scene, position, at_times ? (pressing + push) / 2 : pressing);
  };
  if (lower) impacts = bounces(stops.lower, -constant_force(o, stops.lower));
  if (upper) impacts = std::max(impacts, bounces(stops.upper, constant_force(o, stops.upper)));
  if (lower && upper && !std::isnan(scene.start.displacement))
    impacts = std::max(impacts, way_of(scene) / (stops.upper - stops.lower));
  return std::min(scene.time.max_impacts, impacts);
}

std::optional<std::string> warning_of_costliest_point(const sweep::Sweep& sweep,
                                                      const std::optional<results::Shard>& shard) {
  const sweep::Share share(sweep, shard);
  const Sample sample(share.points(), 10000);
  Costliest bounces, periods;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const std::size_t number = sample[i].number;
    const std::size_t point = share.point(number / share.length(), number % share.length());
    const point::Problem scene = problem_at(sweep, point);
    bounces.see(impacts_without_loss(scene), point), periods.see(steps_of_transient(scene), point);
  }
  constexpr double evaluations = 2;  // an impact
  if (const auto told = bounces.told(sweep, evaluations, "impacts")) {
    const std::string R = has_loose_mass(problem_at(sweep, bounces.point).loose) ? "loose_R" : "R";
    return *told + ": with " + R + " = 1 nothing ends its bouncing; lower time.max_impacts, or take " + R + " below 1";
  }
  if (const auto told = periods.told(sweep, 1, "steps"))
    return *told + ", since its time is long beside its periods; lower time.duration, or look for a slip in " +
           (sweep.problem.is_si ? "mass, stiffness or frequency" : "nu or stiffness");
  return std::nullopt;
}

}  // namespace clatter::plan
