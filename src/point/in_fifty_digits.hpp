#pragma once

#include "math/fifty_digits.hpp"
#include "point/problem.hpp"
#include "scene/parameter.hpp"

namespace clatter::point {

/// The scene of a problem in more digits, from the numbers that its user gave if they are known: the computed scene has
/// rounded them where its units or its frame are others, and a motion that stretches changes stretches that rounding,
/// too. Its start is that of the problem, whose sections begin there.
template <class Number>
[[nodiscard]] BasicScene<Number> in_digits(const Problem& problem) {
  if (!problem.given) return with_numbers<Number>(static_cast<const Scene&>(problem));
  BasicScene<Number> scene = in_shaken_frame(computed(with_numbers<Number>(*problem.given)).first);
  const auto& [displacement, velocity, phase] = problem.start;
  scene.start = {Number(displacement), Number(velocity), Number(phase)};
  return scene;
}
[[nodiscard]] inline BasicScene<FiftyDigits> in_fifty_digits(const Problem& problem) {
  return in_digits<FiftyDigits>(problem);
}

}  // namespace clatter::point
