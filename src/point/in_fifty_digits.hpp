#pragma once

#include "math/fifty_digits.hpp"
#include "point/problem.hpp"
#include "scene/parameter.hpp"

namespace clatter::point {

/// The scene of a problem in 50 digits, from the numbers that its user gave if they are known: the computed scene has
/// rounded them where its units or its frame are others, and a motion that stretches changes stretches that rounding,
/// too. Its start is that of the problem, whose sections begin there.
[[nodiscard]] inline BasicScene<FiftyDigits> in_fifty_digits(const Problem& problem) {
  if (!problem.given) return with_numbers<FiftyDigits>(static_cast<const Scene&>(problem));
  BasicScene<FiftyDigits> scene = in_shaken_frame(computed(with_numbers<FiftyDigits>(*problem.given)).first);
  const auto& [displacement, velocity, phase] = problem.start;
  scene.start = {FiftyDigits(displacement), FiftyDigits(velocity), FiftyDigits(phase)};
  return scene;
}

}  // namespace clatter::point
