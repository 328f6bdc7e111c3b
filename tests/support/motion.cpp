#include "support/motion.hpp"

#include <cmath>

#include "dynamics/arc.hpp"
#include "numbers/fifty_digits.hpp"

namespace clatter {
namespace {

template <class Number, Effects E>
Motion<Number> first_motion(const Flow<Number, E>& flow, const ArcStart& start) {
  const auto [sine, cosine] = sine_cosine_of_turns(Number(start.turns));
  const Number x(start.x), v(start.v);
  return {Number(0), x, v, flow.acceleration(x - flow.load, v, sine), sine, cosine};
}

}  // namespace

template <class Number>
Motion<Number> motion_after(const Oscillator& oscillator, const ArcStart& start, double s) {
  return with_any_stops(oscillator, [&]<Effects effects>() {
    const Flow<Number, effects.arc()> flow(oscillator);
    return Arc<Number, effects.arc()>(flow, first_motion(flow, start)).at(Number(s));
  });
}

template <class Number>
Motion<Number> motion_by_taylor(const Oscillator& o, const ArcStart& start, double s) {
  const Oscillator away{o.damping, 1.0, 10.0, 0.0};  // from resonance: response and transient apart
  return with_any_stops(away, [&]<Effects effects>() {
    const Flow<Number, effects.arc()> flow(o);
    const Arc<Number, effects.arc()> arc(flow, first_motion(flow, start));
    const auto steps = static_cast<int>(std::ceil(s * static_cast<double>(flow.rate) * 5));
    Motion<Number> m = arc.start();
    for (int i = 0; i < steps; ++i) m = arc.near(m, Number(s) / steps);
    return m;
  });
}

template Motion<double> motion_after(const Oscillator&, const ArcStart&, double);
template Motion<FiftyDigits> motion_after(const Oscillator&, const ArcStart&, double);
template Motion<FiftyDigits> motion_by_taylor(const Oscillator&, const ArcStart&, double);

}  // namespace clatter
