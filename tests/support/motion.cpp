#include "support/motion.hpp"

#include <cmath>
#include <type_traits>

#include "math/fifty_digits.hpp"
#include "motion/arc.hpp"

namespace clatter::support {
namespace {

template <class Number, Effects E>
motion::Motion<Number> first_motion(const motion::ArcConstants<Number, E>& constants, const ArcStart& start) {
  const SineCosine<Number> phase = constants.phase_at(Number(start.turns));
  const Number x(start.x), v(start.v);
  return {Number(0), x, v, constants.acceleration(x - constants.equilibrium, v, phase), phase.sine, phase.cosine};
}

/// Calls `function.operator()<set>()` for an oscillator: in 50 digits one of two sets, which serve all.
template <class Number, class Function>
decltype(auto) with_set(const Oscillator& oscillator, Function&& function) {
  if constexpr (std::is_same_v<Number, double>)
    return with_any_stops(oscillator, function);
  else if (rotates(oscillator))
    return function.template operator()<effect_sets::of_any_stiffness(Damping::light, Forcing::secular)>();
  else
    return function.template operator()<effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular)>();
}

}  // namespace

template <class Number>
motion::Motion<Number> motion_after(const Oscillator& oscillator, const ArcStart& start, double s) {
  return with_set<Number>(oscillator, [&]<Effects effects>() {
    const motion::ArcConstants<Number, effects.arc()> constants(oscillator);
    return motion::Arc<Number, effects.arc()>(constants, first_motion(constants, start)).at(Number(s));
  });
}

template <class Number>
motion::Motion<Number> motion_by_taylor(const Oscillator& o, const ArcStart& start, double s) {
  return with_set<Number>(o, [&]<Effects effects>() {
    const motion::ArcConstants<Number, effects.arc()> constants(o);
    const motion::Arc<Number, effects.arc()> arc(constants, first_motion(constants, start));
    const auto steps = static_cast<int>(std::ceil(s * static_cast<double>(constants.rate) * 5));
    motion::Motion<Number> m = arc.start();
    for (int i = 0; i < steps; ++i) m = arc.near(m, Number(s) / steps);
    return m;
  });
}

template motion::Motion<double> motion_after(const Oscillator&, const ArcStart&, double);
template motion::Motion<FiftyDigits> motion_after(const Oscillator&, const ArcStart&, double);
template motion::Motion<FiftyDigits> motion_by_taylor(const Oscillator&, const ArcStart&, double);

}  // namespace clatter::support
