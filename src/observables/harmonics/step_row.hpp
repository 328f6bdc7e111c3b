#pragma once

#include <array>
#include <cstddef>

#include "motion/arc.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

/// The steps of an oscillator over 1, 2, ... 16 spacings, coefficient by coefficient, so that vectors take several of
/// them at once.
///
/// The change of displacement in a step (eq. 10) and the velocity after it are linear in the sine and cosine of the
/// forcing phase and in the free motion, with coefficients that are the same for all motions of the oscillator.
class StepRow {
 public:
  static constexpr std::size_t size = 16;

  /// Makes the first `count` steps, unless they are there.
  template <Effects E>
  void make(const motion::ArcConstants<double, E>& constants, std::size_t count, double spacing) {
    for (; made_ < count; ++made_) put(made_, constants, constants.step(static_cast<double>(made_ + 1) * spacing));
  }
  void clear() { made_ = 0; }

  /// Displacements between the stops, and velocities, shape [size], after all steps from an instant of an arc whose
  /// offsets count from `anchor`; those after steps that haven't been made have no meaning.
  void take(const motion::Motion<double>& from, double anchor, const Stops& stops, double* x, double* v) const;

 private:
  /// Coefficients of the sine, the cosine and the free motion, and a constant term.
  struct Terms {
    std::array<double, size> sine, cosine, free_x, free_v, constant;
  };

  template <Effects E>
  void put(std::size_t i, const motion::ArcConstants<double, E>& constants, const motion::Step<double>& step) {
    const auto of_sine = constants.change(step.turn, {1.0, 0.0}), of_cosine = constants.change(step.turn, {0.0, 1.0});
    x_.sine[i] = constants.response_displacement(of_sine.sine, of_sine.cosine);
    x_.cosine[i] = constants.response_displacement(of_cosine.sine, of_cosine.cosine);
    v_.sine[i] = constants.response_velocity(1 + of_sine.sine, of_sine.cosine);
    v_.cosine[i] = constants.response_velocity(of_cosine.sine, 1 + of_cosine.cosine);
    if (constants.forms_together()) {
      x_.sine[i] = constants.f * step.displacement.sine, x_.cosine[i] = constants.f * step.displacement.cosine;
      v_.sine[i] = constants.f * step.velocity.sine, v_.cosine[i] = constants.f * step.velocity.cosine;
    }
    x_.free_x[i] = step.free.a_minus_one, x_.free_v[i] = step.free.b;
    v_.free_x[i] = -constants.spring(step.free.b), v_.free_v[i] = step.free.c;
    if constexpr (E.stiffness)
      x_.constant[i] = constants.unbalanced * step.pulled, v_.constant[i] = constants.unbalanced * step.free.b;
  }

  void take_here(const motion::Motion<double>& from, double anchor, const Stops& stops, double* x, double* v) const;
  void take_by_avx2(const motion::Motion<double>& from, double anchor, const Stops& stops, double* x, double* v) const;

  Terms x_{}, v_{};
  std::size_t made_ = 0;
};

}  // namespace clatter::observables
