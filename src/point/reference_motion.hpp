#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/event.hpp"
#include "motion/state.hpp"
#include "motion/tangent_map.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "point/problem.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// Keeps the events of a run in 50 digits, and, if they are asked for, its derivative, its extrema and its harmonics.
/// The last two are taken from its arcs, each rounded to double at its start: an error of a few roundings, which
/// doesn't grow.
struct ReferenceRecorder {
  std::vector<motion::Event> events{};                       ///< as `MotionRecorder` keeps them
  std::optional<motion::TangentMap<FiftyDigits>> tangent{};  ///< without a loose mass
  std::optional<observables::ExactHarmonics> harmonics{};    ///< asks for extrema, too
  observables::Extrema::Observer extrema{};
};

/// The motion of a problem in 50 digits by the exact method with every effect, between stops that don't move by
/// themselves: the reference that double is judged by, which finds its contacts without double. It completes a chatter
/// only long after a double would have done so. It is compiled once, whoever asks.
class ReferenceMotion {
 public:
  using State = motion::State<FiftyDigits>;

  [[nodiscard]] static std::unique_ptr<ReferenceMotion> of(const Problem& problem);
  virtual ~ReferenceMotion() = default;

  [[nodiscard]] virtual State start() const = 0;
  [[nodiscard]] virtual FiftyDigits period() const = 0;  ///< as that of `ExactMotion`
  [[nodiscard]] virtual double impacts() const = 0;      ///< simulated so far
  [[nodiscard]] virtual double evaluations() const = 0;  ///< of arcs, so far

  /// Up to a phase in turns since the section; as the function of this name of the integrator.
  [[nodiscard]] virtual stepping::Outcome advance(State& state, const FiftyDigits& end,
                                                  ReferenceRecorder& recorder) = 0;
  /// To the next section.
  [[nodiscard]] virtual stepping::Outcome advance_to_section(State& state, ReferenceRecorder& recorder) = 0;
  /// For a time in forcing periods from a section on; `unresolved` if `stopped`, which is called at each, ends it.
  [[nodiscard]] stepping::Outcome run_for(State& state, const FiftyDigits& turns, ReferenceRecorder& recorder,
                                          const std::function<bool()>& stopped = {});
};

}  // namespace clatter::point
