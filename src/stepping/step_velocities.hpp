#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/coupled_arc.hpp"
#include "motion/housed_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "stepping/laws.hpp"
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
    double length, drive;    ///< in tau; s of the force at its end
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
      Step step{end.length, end.drive, v, v};
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
        const double push = this->force(constants, state.x, 0.0, this->drive_),
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
    const Side side = z <= walls.places.lower ? Side::lower : z >= walls.places.upper ? Side::upper : Side::none;
    return walls.is_soft(side) ? Side::none : side;
  }
  /// Finds whether a soft wall acts in the next step, and reports a contact that begins or ends; false if it is one too
  /// many.
  template <class Loop, class Stage>
  [[nodiscard]] bool meet_soft_wall(const Loop& loop, Stage& stage, const motion::RelativeStart<double>& from,
                                    double length) {
    State& state = stage.state;
    motion::LooseState<double>& loose = state.loose;
    const Walls& walls = loop.walls();
    const bool was_within = loose.within, was_pushed = loose.pushed;
    const Side was_at = loose.wall;
    Side within = Side::none;
    for (const Side side : {Side::lower, Side::upper})
      if (walls.is_soft(side) &&
          sign_of(side) * (from.origin + from.offset + length / 2 * from.w - walls.place(side)) > 0)
        within = side;
    loose.within = loose.pushed = within != Side::none;
    if (within != Side::none) {
      loose = {.wall = within,
               .place = from.origin - walls.place(within) + from.offset,
               .speed = from.w,
               .within = true,
               .pushed = true};
      const auto& wall = walls.soft[index_of(within)];
      loose.pushed = wall.force(wall.into(loose.place + length / 2 * loose.speed), wall.into(loose.speed)) > 0;
    }
    const bool goes_on = was_pushed && loose.pushed && was_at == loose.wall;
    if (was_pushed && !goes_on) laws::tell_of_soft_wall(loop, stage, Kind::wall_separation);
    if (!loose.pushed || goes_on) return true;
    laws::tell_of_soft_wall(loop, stage, was_within && was_at == loose.wall ? Kind::wall_renewal : Kind::wall_touch);
    return this->count_impact();
  }
  /// Shows a part of a step in which a soft wall pushes.
  template <class Loop, class Stage, Effects Of>
  static void show_at_wall(const Loop& loop, const Stage& stage, const motion::PolynomialInHousing<Of>& beside,
                           double length) {
    const auto& main = beside.main();
    const auto course = [](const auto& arc) {
      motion::Course<double> of;
      const auto way = to_powers(arc.offset()), velocity = to_powers(arc.velocity());
      for (std::size_t k = 0; k < way.size(); ++k) of.way[k] = k == 0 ? 0.0 : way[k], of.velocity[k] = velocity[k];
      return of;
    };
    const motion::Coupling<double> coupling{loop.walls().soft[index_of(stage.state.loose.wall)],
                                            loop.walls().rule.ratio, true};
    const motion::CoupledArc<double> coupled(motion::as_any(main.constants()), main.start(), main.anchor(),
                                             main.length(), course(main));
    const motion::RelativeStart<double> from = modes::loose_start_of(loop, stage.state);
    const motion::CoupledInHousing<double> in_wall(coupled, coupling, from, beside.load(), course(beside));
    stage.show(motion::HousedArc{coupled, in_wall}, length);
  }
  /// The impulse of the soft wall that pushes over a step, along x: its force at the end is implicit, as is that of the
  /// spring. A main mass that is held doesn't give way.
  template <class Mass>
  [[nodiscard]] double impulse_of_wall(const Mass& mass, const State& state, double turns, const Walls& walls,
                                       double load, bool is_held) {
    const motion::LooseState<double>& loose = state.loose;
    if (!loose.pushed) return 0.0;
    return with_oscillator(mass, state, [&](const auto& constants) {
      const auto end = this->step_end(constants, state, turns);
      const auto& wall = walls.soft[index_of(loose.wall)];
      const double part = this->theta_ * end.length, before = end.length - part, damper = 2 * wall.damping;
      const double moved = is_held ? 0.0 : end.momentum / end.mass - state.v, gives = is_held ? 0.0 : 1 / end.mass;
      const double w = loose.speed + (load * end.length - moved), place = loose.place + before * loose.speed;
      const double free = before * walls.push(loose) + part * (wall.stiffness * (place + part * w) + damper * w);
      return free / (1 + part * (wall.stiffness * part + damper) * (1 / walls.rule.ratio + gives));
    });
  }

  /// What a step would do to a loose mass that ends it with the velocity of the main one.
  struct Hold {
    double needed;  ///< the impulse over the loose mass that takes
    bool holds;     ///< the wall and friction give it
    [[nodiscard]] Side leaves_to() const { return needed < 0 ? Side::upper : Side::lower; }
  };
  /// `w`: z' at the beginning of the step, `level` of the friction, as an acceleration.
  [[nodiscard]] static Hold hold_in(const Walls& walls, const State& state, const Step& both, double w, double level) {
    const double load = walls.load - walls.push(state.loose) / walls.rule.ratio;
    const double needed = (both.v - state.v - w) - load * both.length, most = level * both.length;
    const bool on_wall = walls.lies_on_wall(state.loose) && w == 0;
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
                 pressed = stop.into(this->force(constants, stop.position, 0.0, step.drive));
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
