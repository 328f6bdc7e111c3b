#pragma once

#include <array>
#include <optional>

#include "force.hpp"
#include "law.hpp"

namespace verify {

enum class Side { lower, upper };

[[nodiscard]] inline std::size_t index_of(Side side) { return side == Side::upper ? 1 : 0; }
/// The direction from between the stops into one of them.
[[nodiscard]] inline int sign_of(Side side) { return side == Side::upper ? 1 : -1; }
[[nodiscard]] inline Side opposite(Side side) { return side == Side::upper ? Side::lower : Side::upper; }
[[nodiscard]] inline const char* name_of(Side side) { return side == Side::upper ? "upper" : "lower"; }

/// A stop: rigid (eq. 4), or a spring and a damper without mass (eq. 50).
template <class Number>
struct BasicStop {
  Number position;
  bool soft = false;
  Number R;                  ///< restitution of a rigid stop
  Number kappa;              ///< stiffness of a soft stop
  Number zeta;               ///< its damping ratio
  Number h_s;                ///< its damping, zeta kappa^(1/2)
  std::optional<Law> law{};  ///< in place of R, if it depends on the speed

  /// What an impact with a velocity, or with all of a ball's, does to it.
  [[nodiscard]] Rebound rebound(const Ball& v) const { return law ? law->at(v) : Rebound{Dual(-R)}; }

  /// Its force falls to 0 if x + q v is the position.
  [[nodiscard]] Number q() const { return soft ? Number(2) * h_s / kappa : Number(0); }
};

/// A loose mass in a housing that the main mass carries: y'' = load between impacts on its walls, at z = y - x.
template <class Number>
struct BasicLooseMass {
  Number mass;                                 ///< over the main mass
  std::array<Number, 2> R;                     ///< restitution [wall]
  Number load;                                 ///< acceleration in flight
  std::array<std::optional<Number>, 2> walls;  ///< z [side]
  Number friction{0}, friction_static{0};      ///< on the housing, over the main mass: in a slide, the most at z' = 0
  bool is_let_go_gently = true;                ///< both are the same, exactly
  std::array<std::optional<Law>, 2> laws{};    ///< [wall] in place of R, if it depends on the speed

  [[nodiscard]] const Number& wall(Side side) const { return *walls[index_of(side)]; }
  [[nodiscard]] const Number& restitution(Side side) const { return R[index_of(side)]; }
  [[nodiscard]] const std::optional<Law>& law(Side side) const { return laws[index_of(side)]; }
  /// What an impact on a wall does to z'.
  [[nodiscard]] Rebound rebound(Side side, const Ball& w) const {
    return law(side) ? law(side)->at(w) : Rebound{Dual(-restitution(side))};
  }
  [[nodiscard]] bool is_rough() const { return !friction_static.is_zero(); }
  /// The share of both masses that it is: of a jump of z' the main mass takes so much.
  [[nodiscard]] Number share() const { return mass / (Number(1) + mass); }
};

/// x'' + 2h x' + k x + friction sgn x' = force(nu tau + phase) + load between two stops.
template <class Number>
struct BasicScene {
  Number h, k;
  BasicForce<Number> force;
  Number nu, load, phase;
  std::array<std::optional<BasicStop<Number>>, 2> stops;  ///< [side]
  Number friction{0}, friction_static{0};                 ///< of a mass that moves, and the most that holds a still one
  bool is_let_go_gently = true;                           ///< both are the same, exactly: so x'' grows from 0
  std::optional<BasicLooseMass<Number>> loose{};

  [[nodiscard]] const BasicStop<Number>& stop(Side side) const { return *stops[index_of(side)]; }
  [[nodiscard]] bool is_rough() const { return !friction_static.is_zero(); }
  /// Whether the walls of a loose mass are told from stops.
  [[nodiscard]] bool tells_walls() const { return loose && (stops[0] || stops[1] || is_rough()); }
  [[nodiscard]] Number period() const { return Number(2) * Number(Ball::pi()) / nu; }
  [[nodiscard]] Number force_at(const Number& time) const { return force.at(nu * time + phase).first; }
  /// The force that presses a mass at rest into a stop (eq. 22); friction apart.
  [[nodiscard]] Number pressing(Side side, const Number& time) const {
    return Number(sign_of(side)) * (force_at(time) + load - k * stop(side).position);
  }
};

/// The centre about which a scene is its own mirror image, exactly, and stays so if it changes: a linear function of
/// the parameter, too.
template <class Number>
[[nodiscard]] std::optional<Number> mirror_centre(const BasicScene<Number>& scene) {
  const auto& [lower, upper] = scene.stops;
  if (!scene.force.is_odd()) return std::nullopt;
  if (const auto& loose = scene.loose)  // its housing has the mirror image that it is about its own middle
    if (!loose->load.is_zero() || !loose->walls[0] || !loose->walls[1] || !(loose->R[0] - loose->R[1]).is_zero() ||
        !are_alike(loose->laws[0], loose->laws[1]))
      return std::nullopt;
  if (lower.has_value() != upper.has_value()) return std::nullopt;
  if ((scene.k.is_zero() || !scene.k.is_constant()) && !scene.load.is_zero()) return std::nullopt;
  if (!lower) return scene.k.is_zero() ? Number(0) : scene.load / scene.k;
  const bool alike = lower->soft == upper->soft && (lower->R - upper->R).is_zero() &&
                     are_alike(lower->law, upper->law) && (lower->kappa - upper->kappa).is_zero() &&
                     (lower->zeta - upper->zeta).is_zero();
  const Number middle = (lower->position + upper->position) / Number(2);
  const bool centred = scene.k.is_zero() || (middle.is_zero() && scene.load.is_zero()) ||
                       (scene.k.is_constant() && (scene.k * middle - scene.load).is_zero());
  return alike && centred ? std::optional(middle) : std::nullopt;
}

using Stop = BasicStop<Ball>;
using LooseMass = BasicLooseMass<Ball>;
using Scene = BasicScene<Ball>;
/// A scene that changes with a parameter: its numbers, and their derivatives.
using MovingScene = BasicScene<Dual>;

}  // namespace verify
