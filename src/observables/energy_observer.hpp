#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "observables/energy.hpp"
#include "observables/loose_energy.hpp"
#include "observables/quadrature.hpp"

namespace clatter::observables {

class Energy::Observer {
 public:
  Observer(const Settings&, const ObservedSpan& span)
      : oscillator_(span.scene.oscillator), stops_(span.scene.stops), phase_(span.scene.start.phase) {
    if (has_loose_mass(span.scene.loose)) loose_.emplace(span);
  }

  template <class A>
  void arc(const A& arc, double begins, double length) {
    if (loose_) return loose_->arc(arc, begins, length);
    if (!(length > 0)) return;
    const motion::Motion<double>& first = arc.start();
    begin(first.x, first.v);
    integrate(arc, length);
  }
  void rest(const motion::Rest& rest) {
    begin(rest.position, rest.v_begin);
    if (rest.is_stick()) return press(rest);
    const std::size_t stop = index_of(rest.side);
    // a chatter takes the energy of its rebounds, and gives their momentum back to the mass
    impulse_[stop] += pressing(rest) - sign_of(rest.side) * (rest.v_end - rest.v_begin);
    loss_impact_[stop] += (rest.v_begin - rest.v_end) * (rest.v_begin + rest.v_end) / 2;
  }
  void impact(const motion::Impact& impact) {
    begin(impact.position, impact.before);
    const std::size_t stop = index_of(impact.side);
    loss_impact_[stop] += (impact.before - impact.after) * (impact.before + impact.after) / 2;
    impulse_[stop] += std::abs(impact.after - impact.before);
  }

  template <class A>
  void in_housing(const A& arc, double begins, double length) {
    loose_->in_housing(arc, begins, length);
  }
  template <class A>
  void hold(const A& arc, const motion::Rest& hold) {
    loose_->hold(arc, hold);
  }
  void strike(const motion::Strike& strike) { loose_->strike(strike); }
  void press(const motion::Press& press) { loose_->press(press); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    if (loose_) return with_loose_mass(span, x, v);
    begin(x, v);
    const double load_work = oscillator_.load * (x - x_begin_);  // of a period only that of rounding
    Values values{.work_in = force_work_ + (span.periodic ? 0.0 : load_work),
                  .loss_damping = loss_damping_,
                  .loss_friction = loss_friction_};
    values.loss_impact = loss_impact_, values.impulse = impulse_;
    const double lost = loss_impact_[0] + loss_impact_[1];
    const double k = oscillator_.stiffness, stored = stored_at(x) - stored_at(x_begin_),
                 growth = ((v - v_begin_) * (v + v_begin_) + k * (x - x_begin_) * (x + x_begin_)) / 2 + stored;
    values.energy_residual = force_work_ + load_work - loss_damping_ - loss_friction_ - lost - growth;
    values.impact_power = lost / span.total;
    return values;
  }
  [[nodiscard]] double evaluations() const {  ///< of arcs
    return loose_ ? loose_->evaluations() : evaluations_;
  }

 private:
  [[nodiscard]] Values with_loose_mass(const ObservedSpan& span, double x, double v) {
    const LooseEnergy::Ledger ledger = loose_->finish(x, v);
    Values values{.work_in = ledger.work, .loss_damping = ledger.damped, .loss_friction = 0.0};
    values.loss_impact = ledger.lost, values.impulse = ledger.impulse;
    values.energy_residual = ledger.residual();
    values.impact_power = (ledger.lost[0] + ledger.lost[1]) / span.total;
    return values;
  }
  /// The state in which the observed time begins: the first that is seen.
  void begin(double x, double v) {
    if (!has_begun_) x_begin_ = x, v_begin_ = v, has_begun_ = true;
  }

  /// Over an arc, by panels in which neither v^2 nor v sin(theta) turns by more than a few radians.
  template <class A>
  void integrate(const A& arc, double length) {
    const auto& constants = arc.constants();
    if (stands_still(arc, length)) return press(arc, length);
    const auto panels = static_cast<std::size_t>(std::ceil(length * constants.rate / 2));
    double work = 0, squares = 0, impulse = 0;
    const auto* stop = soft_stop_of(arc);
    over_panels<20>(length, panels, [&](double s, double weight) {
      const motion::Motion<double> m = arc.at(s);
      work += weight * m.v * m.sine, squares += weight * m.v * m.v;
      if (stop != nullptr) impulse += weight * stop->force(stop->into(m.offset), stop->into(m.v));
    });
    force_work_ += constants.f * work;
    if (constants.friction != 0) loss_friction_ -= constants.friction * (arc.at(length).offset - arc.start().offset);
    if (stop != nullptr) {
      loss_damping_ += 2 * oscillator_.damping * squares;
      loss_impact_[index_of(stop->side)] += 2 * stop->damping * squares;
      impulse_[index_of(stop->side)] += impulse;
    } else {
      loss_damping_ += 2 * constants.h * squares;
      if (is_soft_) lose_stored(arc.start().x, arc.at(length).x);
    }
    evaluations_ += 20 * static_cast<double>(panels);
  }

  /// Whether a mass at its equilibrium stays there. An arc of it may last for a period of a very weak spring, of which
  /// that of the stop that it leans on is a tiny part.
  template <class A>
  [[nodiscard]] static bool stands_still(const A& arc, double length) {
    if (arc.constants().f != 0 || arc.start().v != 0) return false;
    const motion::Motion<double> middle = arc.at(length / 2), last = arc.at(length);
    return middle.v == 0 && last.v == 0 && middle.x == arc.start().x && last.x == arc.start().x;
  }
  template <class A>
  void press(const A& arc, double length) {
    const motion::Motion<double>& m = arc.start();
    if (const auto* const stop = soft_stop_of(arc); stop != nullptr)
      impulse_[index_of(stop->side)] += length * stop->force(stop->into(m.offset), stop->into(m.v));
  }
  /// The force of a soft stop, with which friction holds the mass.
  void press(const motion::Rest& stick) {
    const Side side = soft_stop_beyond(stops_, stick.position);
    if (side == Side::none) return;
    const auto stop = motion::soft_stop_at<double>(stops_, side);
    impulse_[index_of(side)] += stick.length * stop.force(stop.into(stick.position - stop.position), 0.0);
  }
  /// The soft stop that an arc is in contact with, or nullptr.
  template <class A>
  [[nodiscard]] static const motion::SoftStop<double>* soft_stop_of(const A& arc) {
    if constexpr (A::effects.stiffness)
      if (arc.constants().stop.side != Side::none) return &arc.constants().stop;
    return nullptr;
  }
  /// Energy of the spring of a soft stop at a displacement beyond it.
  [[nodiscard]] double stored_at(double x, Side side) const {
    if (!is_soft(stops_, side)) return 0.0;
    const auto stop = motion::soft_stop_at<double>(stops_, side);
    const double depth = std::max(0.0, stop.into(x - stop.position));
    return stop.stiffness * depth * depth / 2;
  }
  [[nodiscard]] double stored_at(double x) const { return stored_at(x, Side::lower) + stored_at(x, Side::upper); }
  /// A stop that the mass outruns loses the energy of its spring as it relaxes.
  void lose_stored(double from, double to) {
    for (const Side side : {Side::lower, Side::upper})
      loss_impact_[index_of(side)] += stored_at(from, side) - stored_at(to, side);
  }

  /// Integral of the force that presses the mass into a stop, eq. 22, over a rest.
  [[nodiscard]] double pressing(const motion::Rest& rest) const {
    const Oscillator& o = oscillator_;
    double sum = constant_force(o, rest.position) * rest.length;
    if (o.forcing != 0) {
      const double half = o.frequency * rest.length / 2;
      sum += 2 * o.forcing / o.frequency * std::sin(phase_ + o.frequency * rest.time + half) * std::sin(half);
    }
    return sign_of(rest.side) * sum;
  }

  Oscillator oscillator_;
  Stops stops_;
  bool is_soft_ = has_soft_stop(stops_);
  double phase_;  ///< of the force at the beginning, a section
  bool has_begun_ = false;
  double x_begin_ = 0, v_begin_ = 0;
  double force_work_ = 0, loss_damping_ = 0, loss_friction_ = 0;
  std::array<double, 2> loss_impact_{}, impulse_{};  ///< [stop]
  double evaluations_ = 0;
  std::optional<LooseEnergy> loose_{};  ///< with a loose mass, in place of all others
};

}  // namespace clatter::observables
