#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "point/exact_motion.hpp"
#include "scene/scene.hpp"

namespace clatter::certificates {

/// A claimed number: the true one differs from `value` by at most `error`.
struct Claimed {
  double value = 0.0, error = 0.0;
};

/// A claimed event; times are counted as the start's.
struct ClaimedEvent {
  motion::Event::Kind kind;
  Side side;
  Claimed time;
  Claimed then;          ///< of a rest, a stick or a chatter the time of its end, else the velocity before the event
  Claimed place{};       ///< of a stick or a reversal the displacement, of those of a loose mass z
  bool grazes = false;   ///< it has no speed, and changes nothing
  bool of_wall = false;  ///< of a loose mass: the velocity is z', a rest is a press
};

/// A claimed multiplier.
struct ClaimedMultiplier {
  double re = 0.0, im = 0.0, error = 0.0;
};

/// The claimed state at the end of a transient.
struct ClaimedEnd {
  double time = 0.0;  ///< tau, exact
  Claimed x, v;
  Claimed z, w;  ///< of a loose mass
};

/// The claims that only periodic motion has.
struct ClaimedPeriod {
  std::size_t periods = 1;                                      ///< forcing periods, > 0
  std::optional<std::vector<ClaimedMultiplier>> multipliers{};  ///< two, with a loose mass four; nothing: not claimed
  std::optional<std::string> word{};                            ///< nothing: too long to be told
  std::optional<bool> symmetric{};                              ///< nothing: the scene isn't
};

/// The derivatives of a scene's numbers by a parameter.
struct SceneSlopes {
  double h, k, f, nu, load, phase;
  struct Stop {
    double position, R, stiffness, damping;
  } lower, upper;
  std::array<ForceOrder<double>, ForceOrders<double>::most> orders{};  ///< of a force of several, with f the first sine
};

/// The claims of a special point of a branch.
struct ClaimedSpecial {
  std::string kind;
  Claimed parameter;  ///< of the computed scene
  SceneSlopes slopes;
};

/// A motion and all that is claimed of it, in computed units and in the frame of what is shaken. Time 0 is where the
/// phase of the force is that of `scene.start`.
struct Certificate {
  Scene scene;                          ///< `start` and the loose mass's place and velocity are those at `time`
  double time = 0.0;                    ///< of the start, tau
  double x_error = 0.0, v_error = 0.0;  ///< of the state at the start, of periodic motion; with a loose mass all four
  Side pressed = Side::none;            ///< the wall that presses a loose mass at the start
  Side released = Side::none;           ///< the stop that releases the mass at the start; none: the start is a state
  std::vector<ClaimedEvent> events{};
  Claimed x_min{}, x_max{};
  std::optional<ClaimedPeriod> period{};    ///< of a periodic motion,
  std::optional<ClaimedSpecial> special{};  ///< and of one at a special point of a branch
  std::optional<ClaimedEnd> end{};          ///< of a transient
};

}  // namespace clatter::certificates
