#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>
#include <utility>

#include "hard/any_scene.hpp"
#include "support/deviation.hpp"
#include "support/scene_range.hpp"

namespace clatter::hard {

/// Random scenes of one kind, and how many of them a test draws, unless CLATTER_SCENES names some.
struct Kind {
  const char* name;
  AnyScene (*draw)(std::uint64_t index);
  std::uint64_t scenes;
};
inline constexpr Kind between_rigid_stops{"rigid", any_scene, 10000};

inline void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }  // for GoogleTest

[[nodiscard]] inline support::SceneRange tested_scenes(const Kind& kind = between_rigid_stops) {
  return support::scene_range(kind.scenes);
}

template <class Check>
void in_every_scene(const Kind& kind, Check&& check) {
  const auto [from, to] = tested_scenes(kind);
  for (std::uint64_t index = from; index < to; ++index) check(kind.draw(index));
}
template <class Check>
void in_every_scene(Check&& check) {
  in_every_scene(between_rigid_stops, std::forward<Check>(check));
}

/// The tally of one property: the number of scenes that broke it, and the scene with the largest deviation.
class Tally {
 public:
  explicit Tally(std::string property, const Kind& kind = between_rigid_stops)
      : property_(std::move(property)), scenes_(tested_scenes(kind)) {}

  /// Takes the deviation of a scene, in units of the allowed one: beyond 1 the scene has failed.
  void take(const AnyScene& any, double deviation) {
    ++checked_;
    if (!(deviation <= worst_)) worst_ = deviation, worst_index_ = any.index;
    if (deviation <= 1 || ++failed_ > shown) return;
    ADD_FAILURE() << property_ << ": " << deviation << " of the allowed deviation, in scene " << any.index << "\n"
                  << support::configuration_of(any.scene, any.duration);
  }

  /// Fails if scenes have failed, or if fewer than this share of them had anything to check.
  void conclude(double share) const {
    const auto [from, to] = scenes_;
    EXPECT_EQ(failed_, 0u) << property_;
    if (to - from >= enough) {
      EXPECT_GE(static_cast<double>(checked_), share * static_cast<double>(to - from)) << property_;
    }
    std::cout << property_ << ": " << checked_ << " scenes, " << failed_ << " failed; at most " << worst_
              << " of the allowed deviation (scene " << worst_index_ << ")\n";
  }

  static constexpr std::uint64_t enough = 1000;  ///< number of scenes from which on shares of them are checked

 private:
  static constexpr std::uint64_t shown = 3;

  std::string property_;
  support::SceneRange scenes_;
  std::uint64_t checked_ = 0, failed_ = 0, worst_index_ = 0;
  double worst_ = 0.0;
};

/// Keeps the larger, or a NaN.
inline void raise(double& worst, double deviation) {
  if (!(deviation <= worst)) worst = deviation;
}

}  // namespace clatter::hard
