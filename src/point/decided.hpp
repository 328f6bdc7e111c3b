#pragma once

#include <array>
#include <list>
#include <optional>
#include <vector>

#include "point/resting_motion.hpp"
#include "scene/given_scene.hpp"
#include "steady/observed_time.hpp"

namespace clatter::point {

/// Decides doubtful motions beyond rounding, and keeps what was found for the last scenes: all starts of a scene end in
/// the same few motions.
class Decisions {
 public:
  Decisions();
  ~Decisions();
  Decisions(const Decisions&) = delete;
  Decisions& operator=(const Decisions&) = delete;

  /// A found motion, decided if it is doubtful: if it stretches changes so much that rounding, stretched with them, may
  /// reach 1e-11 of its size, its sections are computed in 50 digits. Motion that rests is made of at most two
  /// stretches, each from a stop's release to the next one, which tell its period; other motion is found anew by
  /// Newton's method. The status becomes `undecided` if 50 digits don't tell either.
  [[nodiscard]] steady::ObservedTime decided(const Problem& problem, steady::ObservedTime found);

 private:
  static constexpr std::size_t most_scenes = 256;

  using Sections = std::vector<motion::State<double>>;  ///< of one period of a motion
  struct OfScene {
    Oscillator oscillator;
    Stops stops;
    Friction friction;
    double phase, most_impacts;
    std::optional<GivenScene> given;
    std::array<std::optional<RestingMotion>, 2> resting{};  ///< [stop]
    std::vector<Sections> orbits{};                         ///< without a rest
  };

  OfScene& of(const Problem& problem);
  const RestingMotion& resting(const Problem& problem, Side side);
  /// The motion from a release with its sections, if it departs.
  const RestingMotion& departing(const Problem& problem, Side side);
  [[nodiscard]] steady::ObservedTime decided_by_release(const Problem& problem, steady::ObservedTime found, Side side);
  [[nodiscard]] steady::ObservedTime decided_by_fixed_point(const Problem& problem, steady::ObservedTime found);

  std::list<OfScene> scenes_;  ///< the latest first
};

}  // namespace clatter::point
