#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "math/dual.hpp"
#include "motion/soft_stop.hpp"
#include "scene/parameter.hpp"
#include "scene/phased_force.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches {

/// A scene on a branch: the numbers that its user gives, of which one or two are followed, and those that are computed
/// from them, in the units of the start. Phases are nu tau + phase, as the user gave it: those of the force that was
/// given, not of the one in the moving frame.
struct FollowedScene : Scene {
  GivenScene given{};
  Units units{};

  FollowedScene() = default;
  /// In units of its own.
  FollowedScene(const Scene& scene) : Scene(scene), given(scene) {}
  FollowedScene(const GivenScene& numbers, const Units& of_start)
      : Scene(computed(numbers, of_start)), given(numbers), units(of_start) {}
};

/// The problem that a branch begins with; shaking stays as it was given. A machine is computed in its natural units, a
/// scene in its own.
struct StartProblem : FollowedScene, point::RunSettings {
  StartProblem(const point::Problem& problem) : FollowedScene(problem), RunSettings(problem) {}
  StartProblem(const sweep::GivenProblem& problem)
      : FollowedScene(problem, problem.is_si ? natural_units(problem) : Units{}), RunSettings(problem) {}
};

/// A problem whose damping, or that of its soft stops, is given by a parameter, if that is a way to give it.
[[nodiscard]] StartProblem damped_by(const StartProblem& start, Parameter parameter);

/// A scene with one of its parameters changed.
[[nodiscard]] FollowedScene changed(const FollowedScene& scene, Parameter parameter, double value);
[[nodiscard]] inline double value_of(const FollowedScene& scene, Parameter parameter) {
  return value_of(scene.given, parameter);
}

/// The numbers of a computed scene, of a type that may carry derivatives.
/// They have each impact rebound: one that is too slow for that ends a branch.
template <class Number>
struct SceneNumbers : BasicScene<Number> {
  Number mass{1.0};  ///< over that of the units

  SceneNumbers() = default;
  SceneNumbers(const BasicScene<Number>& scene, const Number& over_unit = Number(1))
      : BasicScene<Number>(scene), mass(over_unit) {
    for (Restitution<Number>* const law : laws_of<Number>(*this)) law->below = Number(0);
    if (!this->oscillator.shape.has_orders()) return;
    const bool is_on_ground = this->loose.ratio != 0;
    this->oscillator = (is_on_ground ? with_force_on_ground(this->oscillator, this->shaking)
                                     : with_force_in_frame(this->oscillator, this->shaking))
                           .oscillator;
  }

  [[nodiscard]] const Number& position(Side stop) const {
    return stop == Side::upper ? this->stops.upper : this->stops.lower;
  }
  [[nodiscard]] Restitution<Number> law(Side stop) const { return restitution_at<Number>(this->stops, stop); }
  [[nodiscard]] motion::SoftStop<Number> soft_stop(Side stop) const {
    return motion::soft_stop_at<Number>(this->stops, stop);
  }
  /// The constant force on a mass that stands still at x, beyond the position of a soft stop or of none.
  [[nodiscard]] Number standing_force(const Number& x, Side held_by) const {
    const Number force = this->oscillator.load - this->oscillator.stiffness * x;
    return held_by == Side::none ? force : Number(force - soft_stop(held_by).stiffness * (x - position(held_by)));
  }
  /// The only place that motion may be symmetric about; without a spring it has to lie between the stops.
  [[nodiscard]] Number middle() const {
    const auto& [lower, upper] = std::pair(this->stops.lower, this->stops.upper);
    if (this->oscillator.stiffness != 0) return this->oscillator.load / this->oscillator.stiffness;
    return is_finite(lower) && is_finite(upper) ? Number((lower + upper) / 2) : Number(0);
  }
  /// The middle of the walls of a loose mass; of one wall 0.
  [[nodiscard]] Number middle_of_walls() const {
    const auto& [lower, upper] = std::pair(this->loose.lower, this->loose.upper);
    return is_finite(lower) && is_finite(upper) ? Number((lower + upper) / 2) : Number(0);
  }
  /// In the frame of what is shaken, with a loose mass in that of the ground; several orders are in it already.
  [[nodiscard]] LeadingForce<Number> force() const {
    if (this->oscillator.shape.has_orders()) return {this->oscillator.forcing, Number(0)};
    if (this->loose.ratio != 0) return force_on_ground(this->oscillator, this->shaking);
    return force_in_frame(this->oscillator, this->shaking);
  }
  /// That force at a phase, rad, and its derivative by the phase.
  [[nodiscard]] PhasedForce<Number> force_at(const Number& phase) const {
    const auto [f, lead] = force();
    return clatter::force_at(f, this->oscillator.shape, Number(phase + lead));
  }
};

/// The numbers of a scene; `vary(given)` sets those of its parameters that vary, with their derivatives.
template <class Number, class Vary>
[[nodiscard]] SceneNumbers<Number> numbers_of(const FollowedScene& scene, const Vary& vary) {
  BasicGivenScene<Number> given = with_numbers<Number>(scene.given);
  vary(given);
  return {computed(given, scene.units), given.mass / scene.units.mass};
}

/// The numbers of a scene in which nothing varies.
template <class Number>
[[nodiscard]] SceneNumbers<Number> numbers_of(const FollowedScene& scene) {
  if constexpr (std::is_same_v<Number, double>) return {scene, scene.given.mass / scene.units.mass};
  return numbers_of<Number>(scene, [](auto&) {});
}

/// A scene's numbers with their derivatives by one parameter.
using Along = Dual<double, 1>;
[[nodiscard]] SceneNumbers<Along> numbers_along(const FollowedScene& scene, Parameter parameter);

/// Whether a symmetric scene stays so if a parameter changes: stops hold the mirror in their middle, and without any
/// it goes along with the equilibrium.
[[nodiscard]] bool keeps_symmetry(const FollowedScene& scene, Parameter parameter);

/// Whether walls of a loose mass have letters of their own in words, beside those of stops.
[[nodiscard]] inline bool tells_walls(const Scene& scene) {
  return !has_loose_mass(scene.loose) || has_events_of_its_own(scene);
}

/// Whether the stiffness of the spring, per unit mass, changes with a parameter.
[[nodiscard]] bool varies_stiffness(const FollowedScene& scene, Parameter parameter);

/// Its oscillator in the frame of what is shaken, with the force there (eqs. 39 and 40), or on the ground (eq. 69).
[[nodiscard]] Oscillator oscillator_in_frame(const Scene& scene);

/// Relative motion less that in which a scene is computed: of a loose mass on a shaken base, which is computed on the
/// ground; nothing if the frames don't differ.
[[nodiscard]] std::optional<FrameMotion> frame_of_results(const Scene& scene);

/// The problem that a branch begins with, or another scene on it, as it is computed.
[[nodiscard]] point::Problem with_scene(const StartProblem& start, const FollowedScene& scene);

/// "scene.nu", "machine.frequency"
[[nodiscard]] std::string key_in_section(const FollowedScene& scene, Parameter parameter);

}  // namespace clatter::branches
