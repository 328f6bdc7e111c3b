#include "branches/equations/followed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::branches {
namespace {

/// The numbers that give the damping of one stop, in each of its ways.
struct StopDamping {
  double &ratio, &damper, &restitution;

  [[nodiscard]] bool is_given_by(const double& own) const {
    return (&own == &ratio || ratio == 0) && (&own == &damper || damper == 0) &&
           (&own == &restitution || restitution == 1);
  }
};

StopDamping damping_of(GivenScene& given, Side side) {
  auto& s = given.stops;
  if (side == Side::lower) return {s.damping_lower, given.stop_damper_lower, given.stop_restitution_lower};
  return {s.damping_upper, given.stop_damper_upper, given.stop_restitution_upper};
}

/// Gives the damping of a soft stop by a parameter of it, which may be another way than that of the user.
void give_damping_by(Parameter parameter, Side side, const FollowedScene& start, GivenScene& given) {
  const auto& row = parameter.row();
  double& own = (side == Side::upper && parameter.is_of_both() ? row.place_of_upper : row.place)(given);
  const StopDamping ways = damping_of(given, side);
  if (!is_soft(start.stops, side) || ways.is_given_by(own)) return;
  const double zeta = side == Side::lower ? start.stops.damping_lower : start.stops.damping_upper,
               kappa = side == Side::lower ? start.stops.stiffness_lower : start.stops.stiffness_upper;
  ways.ratio = ways.damper = 0, ways.restitution = 1;
  own = &own == &ways.restitution ? restitution_of(zeta)
        : &own == &ways.damper    ? 2 * zeta * std::sqrt(kappa) * given.mass / start.units.time
                                  : zeta;
}

}  // namespace

StartProblem damped_by(const StartProblem& start, Parameter parameter) {
  if (parameter.role() == Role::stop_damping) {
    StartProblem same = start;
    for (const Side side : {Side::lower, Side::upper})
      if (parameter.is_of_both() || parameter.side() == side) give_damping_by(parameter, side, start, same.given);
    return same;
  }
  const double h = start.oscillator.damping, natural = std::sqrt(std::abs(start.oscillator.stiffness));
  const double own = value_of(start, parameter);
  const bool is_own = own != 0 && std::isfinite(own);
  if (parameter.role() != Role::damping || !start.given.is_si || h == 0 || is_own) return start;
  StartProblem same = start;
  GivenScene& given = same.given;
  given.damper = given.damping_ratio = 0, given.quality = std::numeric_limits<double>::infinity();
  const bool is_ratio = parameter == "damping_ratio";
  set(given, parameter,
      is_ratio                 ? h / natural
      : parameter == "quality" ? natural / (2 * h)
                               : 2 * h * given.mass / start.units.time);
  return same;
}

FollowedScene changed(const FollowedScene& scene, Parameter parameter, double value) {
  GivenScene given = scene.given;
  set(given, parameter, value);
  return {given, scene.units};
}

SceneNumbers<Along> numbers_along(const FollowedScene& scene, Parameter parameter) {
  return numbers_of<Along>(scene, [&](auto& given) { set(given, parameter, Along(value_of(scene, parameter), 0)); });
}

bool keeps_symmetry(const FollowedScene& scene, Parameter parameter) {
  if (parameter.is_loose() && parameter.role() == Role::position) return true;  // any two walls have a middle
  if (parameter.role() != Role::load && !parameter.keeps_symmetry()) return false;
  const SceneNumbers<Along> p = numbers_along(scene, parameter);
  const Along &k = p.oscillator.stiffness, &load = p.oscillator.load;
  const bool is_held = std::isfinite(scene.stops.lower) && std::isfinite(scene.stops.upper);
  if (!is_held) return k.value != 0 || load.slope[0] == 0;  // the mirror goes along with the equilibrium
  // stops hold it in their middle, where spring and load have to stay in balance: both change alike with a mass, to
  // rounding
  const Along out_of_balance = k * (p.stops.lower + p.stops.upper) / 2 - load;
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double farther = std::max(std::abs(scene.stops.lower), std::abs(scene.stops.upper));
  return std::abs(out_of_balance.slope[0]) <= rounding * std::abs(k.slope[0]) * farther;
}

bool varies_stiffness(const FollowedScene& scene, Parameter parameter) {
  return !numbers_along(scene, parameter).oscillator.stiffness.is_constant();
}

Oscillator oscillator_in_frame(const Scene& scene) {
  if (has_loose_mass(scene.loose)) return with_force_on_ground(scene.oscillator, scene.shaking).oscillator;
  return with_force_in_frame(scene.oscillator, scene.shaking).oscillator;
}

std::optional<FrameMotion> frame_of_results(const Scene& scene) {
  if (!has_loose_mass(scene.loose) || !is_shaken(scene.shaking)) return std::nullopt;
  Shaking shaking = scene.shaking;
  shaking.lead = with_force_on_ground(scene.oscillator, shaking).lead;
  return FrameMotion(shaking, oscillator_in_frame(scene), 0.0).reversed();
}

point::Problem with_scene(const StartProblem& start, const FollowedScene& scene) { return {scene, start, scene.units}; }

std::string key_in_section(const FollowedScene& scene, Parameter parameter) {
  return (scene.given.is_si ? "machine." : "scene.") + std::string(parameter.key());
}

}  // namespace clatter::branches
