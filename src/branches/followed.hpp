#pragma once

#include <string>
#include <string_view>

#include "point/problem.hpp"
#include "sweep/parameter.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches {

/// A parameter along which motion is followed: the number of the computed scene, and the key that its user gives.
/// Without [machine] both are the same.
struct Followed {
  sweep::Parameter parameter;          ///< of the computed scene; of mass its inverse, over that at the start
  sweep::Parameter given;              ///< a key of the section
  std::string_view section = "scene";  ///< that describes the scene: "scene", or "machine"
  double factor = 1.0;                 ///< from the computed number, or its inverse, to the user's
  bool is_inverse = false;             ///< of the user's number: the computed one grows as that falls

  Followed(sweep::Parameter key) : parameter(key), given(key) {}

  [[nodiscard]] double to_user(double computed) const { return is_inverse ? factor / computed : factor * computed; }
  [[nodiscard]] double to_computed(double users) const { return is_inverse ? factor / users : users / factor; }
  [[nodiscard]] std::string_view name() const { return sweep::key_of(given); }
  /// "scene.nu", "machine.frequency"
  [[nodiscard]] std::string key() const { return std::string(section) + '.' + std::string(name()); }
};

/// The problem of the scene, or of the machine in the units that it is computed in, with the start that was given;
/// shaking stays as it was given.
[[nodiscard]] point::Problem start_problem(const sweep::Sweep& sweep);

/// How a key of [scene] or [machine] is followed from that problem on. The units stay those of the start, so each
/// number of the computed scene is linear in what is followed.
[[nodiscard]] Followed followed(sweep::Parameter key, const point::Problem& start);

}  // namespace clatter::branches
