#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "stepping/theta_steps.hpp"

namespace clatter::stepping {

/// The velocity of a main mass at the end of a step of Moreau's method, from the impulses of forces, dry friction and
/// rigid stops over it.
template <Effects E>
class StepVelocities : public ThetaSteps<E> {
 protected:
  using Base = ThetaSteps<E>;
  using Base::Base;
  using State = motion::State<double>;
  using Kind = motion::Event::Kind;
  using Walls = motion::Walls<double>;

  /// A step of the main mass, alone or with the loose one.
  struct Step {
    double length, sine;     ///< in tau; sine of the forcing phase at its end
    double free, v;          ///< velocities at its end, without the impulse of a stop and with it
    Side stop = Side::none;  ///< a rigid one, which the mass meets, or presses
    bool stands = false;     ///< friction holds the mass

    /// Whether a mass with this velocity before the step stays where it is.
    [[nodiscard]] bool holds(double before) const { return stands || (stop != Side::none && before == 0); }
    /// Whether it has an impact.
    [[nodiscard]] bool hits(double before) const { return stop != Side::none && before != 0; }
  };

  /// The step of a mass to a phase, with an impulse over it beside those of the forces.
  template <class Mass>
  [[nodiscard]] Step step_of(const Mass& mass, const State& state, double turns, double impulse = 0.0) {
    return with_oscillator(mass, state, [&](const auto& constants) {
      const auto end = this->step_end(constants, state, turns);
      const double v = rubbed(mass, end.momentum + impulse, state.v, end.length) / end.mass;
      Step step{end.length, end.sine, v, v};
      step.stands = mass.is_rough() && state.v == 0 && v == 0;
      const Side side = step.stands ? Side::none : active(state, end.length);
      const auto stop = motion::stop_at<double>(this->stops(), side);
      if (side == Side::none || !(stop.into(v) > stop.into(stop.law.after(state.v)))) return step;
      step.stop = side, step.v = state.v == 0 ? 0.0 : rebound(mass.constants(), stop, state.v, step);
      return step;
    });
  }

  /// The velocity with which a mass meets a stop: one that leaves too slowly is pushed back by the force.
  [[nodiscard]] static double arriving(const motion::Stop<double>& stop, double v, const Step& step) {
    return stop.into(v) > 0 ? v : step.free;
  }
  /// The part of a step before its impulse, with which an impact must not coincide at its beginning.
  [[nodiscard]] double until_impulse(const Step& step) const {
    constexpr double least = 1e-6;
    return std::max(1 - this->theta_, least) * step.length;
  }

  /// Calls `function(constants)` with those of a mass, with the soft stop that pushes it.
  template <class Mass, class Function>
  static decltype(auto) with_oscillator(const Mass& mass, const State& state, Function&& function) {
    if constexpr (E.soft)
      if (state.pressed) return mass.in_contact(state.within, std::forward<Function>(function));
    return function(mass.constants());
  }

  /// The rigid stop that the mass is beyond in the middle of the step, at its present velocity; none while a soft one
  /// pushes it.
  [[nodiscard]] Side active(const State& state, double length) const {
    if (E.soft && state.pressed) return Side::none;
    const double x = state.x + length / 2 * state.v;
    if (x <= this->stops().lower && !(E.soft && is_soft(this->stops(), Side::lower))) return Side::lower;
    return x >= this->stops().upper && !(E.soft && is_soft(this->stops(), Side::upper)) ? Side::upper : Side::none;
  }

  /// The soft stop beyond whose position the mass is, and whether it pushes, a time later at its present velocity.
  void look_beyond(State& state, double later) const {
    const auto around = motion::soft_stop_around(this->stops(), state.x + later * state.v, state.v);
    state.within = around.side, state.pressed = around.pressed;
  }
  /// Finds whether a soft stop acts in the next step, and reports a contact that begins or ends; false if it is one too
  /// many.
  template <class Stage>
  [[nodiscard]] bool meet(Stage& stage, double length) {
    State& state = stage.state;
    const Side was_within = state.within;
    const bool was_pressed = state.pressed;
    look_beyond(state, length / 2);
    const bool goes_on = was_pressed && state.pressed && was_within == state.within;
    if (was_pressed && !goes_on) stage.show_contact(Kind::separation, was_within);
    if (!state.pressed || goes_on) return true;
    stage.show_contact(was_within != state.within ? Kind::touch : Kind::renewal, state.within);
    return this->count_impact();
  }

  /// Reports that the mass has turned back since its last slip, in this step or at the end of the one before.
  template <class Mass, class Stage>
  void turn(const Mass& mass, Stage& stage, const Step& step) {
    if constexpr (E.friction) {
      const State& state = stage.state;
      const double way = step.free != 0 ? step.free : state.v;
      if (!mass.is_rough() || way == 0) return;
      this->with_oscillator(mass, state, [&](const auto& constants) {
        const double push = this->force(constants, state.x, 0.0, this->sine_),
                     rubs = std::copysign(mass.slips().kinetic, way);
        const bool turns_back = std::exchange(slid_, way) * way < 0 && (push - rubs) * (push + rubs) > 0;
        if (turns_back && state.v * way <= 0) stage.show_reversal(push + rubs, push - rubs);
      });
    }
  }

  /// Moves a loose mass; one that has met no wall counts by y.
  static void move_loose(State& state, double offset, double w) {
    motion::LooseState<double>& loose = state.loose;
    const bool is_of_wall = loose.wall != Side::none;
    loose.place = is_of_wall ? offset : state.x + offset, loose.speed = is_of_wall ? w : state.v + w;
  }
  /// The wall that the loose mass is beyond in the middle of a step, at its present z'.
  [[nodiscard]] static Side active_wall(const Walls& walls, const motion::RelativeStart<double>& loose, double length) {
    const double z = loose.origin + (loose.offset + length / 2 * loose.w);
    return z <= walls.places.lower ? Side::lower : z >= walls.places.upper ? Side::upper : Side::none;
  }

  /// What a step would do to a loose mass that ends it with the velocity of the main one.
  struct Hold {
    double needed;  ///< the impulse over the loose mass that takes
    bool holds;     ///< the wall and friction give it
    [[nodiscard]] Side leaves_to() const { return needed < 0 ? Side::upper : Side::lower; }
  };
  /// `w`: z' at the beginning of the step, `level` of the friction, as an acceleration.
  [[nodiscard]] static Hold hold_in(const Walls& walls, const State& state, const Step& both, double w, double level) {
    const double needed = (both.v - state.v - w) - walls.load * both.length, most = level * both.length;
    const bool on_wall = state.loose.place == 0 && state.loose.wall != Side::none && w == 0;
    const double away = on_wall ? sign_of(state.loose.wall) * needed : std::abs(needed);
    return {needed, away < most || (away == most && walls.is_rough())};
  }

  double slid_ = 0.0;  ///< velocity of the last slip of the main mass; 0 if it has stood since

 private:
  /// The velocity after an impact; 0 if the force would end the rebound within the step.
  template <class Constants>
  [[nodiscard]] double rebound(const Constants& constants, const motion::Stop<double>& stop, double v,
                               const Step& step) const {
    const double after = stop.law.after(arriving(stop, v, step)),
                 pressed = stop.into(this->force(constants, stop.position, 0.0, step.sine));
    return 2 * -stop.into(after) > pressed * step.length && stop.into(v) > 0 ? after + 0.0 : 0.0;  // no negative zero
  }

  /// Of the momentum at the end of a step what friction leaves.
  template <class Mass>
  [[nodiscard]] static double rubbed(const Mass& mass, double momentum, double v, double length) {
    if constexpr (E.friction) {
      if (!mass.is_rough()) return momentum;
      const double most = mass.slips().kinetic * length, hold = mass.slips().static_level * length;
      const bool turns = momentum * v <= 0;  // or stands
      if (std::abs(momentum) <= most || (turns && std::abs(momentum - v) <= hold)) return 0.0;
      return momentum - std::copysign(most, momentum);
    }
    return momentum;
  }
};

}  // namespace clatter::stepping
