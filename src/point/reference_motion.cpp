#include "point/reference_motion.hpp"

#include <cstdint>

#include "motion/walls.hpp"
#include "point/every_effect.hpp"
#include "point/in_fifty_digits.hpp"
#include "point/rounded.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::point {
namespace {

/// Passes a run with a set of effects to a recorder.
template <Effects E>
class Recording {
 public:
  Recording(const InDouble<E>& in_double, ReferenceRecorder& recorder) : in_double_(in_double), recorder_(recorder) {}

  template <Effects Of>
  void arc(const motion::Arc<FiftyDigits, Of>& arc, double begin, double length) {
    if constexpr (!E.loose)
      if (recorder_.tangent) recorder_.tangent->arc(arc, begin, length);
    if (recorder_.harmonics) in_double_.show(arc, [&](const auto& rounded) { observe(rounded, begin, length); });
  }
  /// While a soft wall couples both masses.
  void arc(const motion::CoupledArc<FiftyDigits>& arc, double begin, double length) {
    if (recorder_.harmonics) observe(in_double(arc), begin, length);
  }
  void event(const motion::Event& event) {
    if (event.kind != motion::Event::Kind::press) recorder_.events.push_back(event.in_housing());
    if constexpr (!E.loose)
      if (recorder_.tangent) recorder_.tangent->event(event);
    if (!recorder_.harmonics || (event.kind == motion::Event::Kind::strike && !(event.time > 0))) return;
    recorder_.extrema.event(event), recorder_.harmonics->event(event);
  }

 private:
  template <class A>
  void observe(const A& arc, double begin, double length) {
    recorder_.extrema.arc(arc, begin, length), recorder_.harmonics->arc(arc, begin, length);
  }

  const InDouble<E>& in_double_;
  ReferenceRecorder& recorder_;
};

template <Effects E>
class WithEffects : public ReferenceMotion {
 public:
  explicit WithEffects(const Problem& problem)
      : scene_(problem), integrator_(in_digits<FiftyDigits>(problem), limits_of(problem)), in_double_(problem) {}

  [[nodiscard]] State start() const override {
    State state;
    state.x = scene_.start.displacement, state.v = scene_.start.velocity;
    if constexpr (E.loose) state.loose = motion::loose_start<FiftyDigits>(scene_);
    return state;
  }
  [[nodiscard]] FiftyDigits period() const override { return integrator_.period(); }
  [[nodiscard]] double impacts() const override { return integrator_.impacts(); }
  [[nodiscard]] double evaluations() const override { return integrator_.evaluations(); }
  [[nodiscard]] stepping::Outcome advance(State& state, const FiftyDigits& end, ReferenceRecorder& recorder) override {
    Recording<E> recording(in_double_, recorder);
    return integrator_.advance(state, end, 0, recording);
  }
  [[nodiscard]] stepping::Outcome advance_to_section(State& state, ReferenceRecorder& recorder) override {
    Recording<E> recording(in_double_, recorder);
    return stepping::advance_to_section(integrator_, state, 0, recording);
  }

 private:
  Scene scene_;
  stepping::Exact<FiftyDigits, E> integrator_;
  InDouble<E> in_double_;
};

}  // namespace

std::unique_ptr<ReferenceMotion> ReferenceMotion::of(const Problem& problem) {
  return with_every_effect_but_own_motion(problem, [&]<Effects E>() -> std::unique_ptr<ReferenceMotion> {
    return std::make_unique<WithEffects<E>>(problem);
  });
}

stepping::Outcome ReferenceMotion::run_for(State& state, const FiftyDigits& turns, ReferenceRecorder& recorder,
                                           const std::function<bool()>& stopped) {
  const auto sections = static_cast<std::int64_t>(turns);
  for (std::int64_t section = 0; section < sections; ++section) {
    if (stopped && stopped()) return stepping::Outcome::unresolved;
    if (const auto outcome = advance_to_section(state, recorder); outcome != stepping::Outcome::completed)
      return outcome;
  }
  return advance(state, FiftyDigits(turns - FiftyDigits(sections)), recorder);
}

}  // namespace clatter::point
