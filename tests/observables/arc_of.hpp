#pragma once

#include "motion/arc.hpp"

namespace clatter::observables {

/// An arc of an oscillator from (x, v) at the phase (0.6, 0.8).
template <class Number, Effects E>
motion::Arc<Number, E> arc_of(const motion::ArcConstants<Number, E>& constants, double x, double v) {
  motion::Motion<Number> m{Number(0), Number(x), Number(v), Number(0), Number(6) / 10, Number(8) / 10};
  m.a = constants.acceleration(m.x - constants.equilibrium, m.v, {m.sine, m.cosine});
  return {constants, m};
}

}  // namespace clatter::observables
