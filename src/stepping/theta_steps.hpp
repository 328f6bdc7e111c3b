#pragma once

#include <cmath>

#include "motion/polynomial_arc.hpp"
#include "stepping/integration.hpp"
#include "stepping/integrator.hpp"
#include "stepping/stage.hpp"

namespace clatter::stepping {

/// The steps of the theta method (Jean 1999; Acary & Brogliato 2008, ch. 10), without regard to impacts. They count
/// from the stroboscopic section, and the last one before the next section is cut there.
template <Effects E>
class ThetaSteps : public IntegratorBase<double, E> {
  using Base = IntegratorBase<double, E>;

 protected:
  ThetaSteps(const Scene& scene, const Integration& integration, const Limits& limits)
      : Base(scene, scene.stops, limits), step_(integration.step), theta_(integration.theta) {}

  /// The end of the step that begins at a phase, in turns; `end` is that of the run.
  [[nodiscard]] double next_turns(double turns, double end) const {
    constexpr double least = 1e-6;  // of a step: rounding must not leave a stub
    const double next = (std::floor(turns / step_ + least) + 1) * step_;
    return next < end - least * step_ ? next : end;
  }

  template <class Constants>
  [[nodiscard]] static double force(const Constants& constants, double x, double v, double drive) {
    return constants.equation().acceleration(x - constants.equilibrium, v, drive);
  }

  /// The end of a step: the velocity is the momentum over the mass, which has the implicit parts of the forces.
  struct StepEnd {
    double length, drive;   ///< in tau; s of the force
    double momentum, mass;  ///< over the mass that moves
  };
  template <class Constants>
  [[nodiscard]] StepEnd step_end(const Constants& constants, const motion::State<double>& state, double turns) {
    const double length = (turns - state.phase_turns) * this->period(), part = theta_ * length;
    const double end = this->start_turns() + turns;
    const double drive = constants.f == 0            ? 0.0
                         : constants.shape.is_sine() ? std::sin(2 * pi<double>() * end)
                                                     : constants.drive(constants.phase_at(end)).sine;
    const double at_begin = force(constants, state.x, state.v, drive_);
    const double at_end = force(constants, state.x + (length - part) * state.v, 0.0,
                                drive);  // without the term in v there, which is implicit
    this->count_evaluations(1);
    return {length, drive, state.v + (length - part) * at_begin + part * at_end,
            1 + part * (2 * constants.h + constants.spring(part))};
  }
  /// The change of a place in a time, with the velocities at its ends.
  [[nodiscard]] double way(double length, double v, double v_end) const {
    return length * (theta_ * v_end + (1 - theta_) * v);
  }

  template <Effects Of>
  [[nodiscard]] motion::PolynomialArc<Of> arc(const motion::ArcConstants<double, Of>& constants, double anchor,
                                              double turns, double length, const Bernstein<double>& offset,
                                              const Bernstein<double>& v) const {
    return {constants, anchor, this->start_turns() + turns, length, offset, v};
  }
  /// A velocity that changes evenly.
  [[nodiscard]] static Bernstein<double> ramp(double length, double v, double v_end) {
    const double a = (v_end - v) / length;
    return cubic(length, {v, a}, {v_end, a});
  }

  double step_, theta_;
  double drive_ = 0.0;  ///< s of the force, at the state
};

}  // namespace clatter::stepping
