#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/panels.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

/// Checks the balance of the energy E = x'^2/2 + k x^2/2 - load x (eq. 34): the work of the force, less the losses by
/// damping and impacts, is the growth of E.
class EnergyBooks : public Watcher {
 public:
  explicit EnergyBooks(const point::Problem& scene)
      : EnergyBooks(scene, scene.start.displacement, scene.start.velocity) {}

  /// For a motion that is first observed at displacement x and velocity v.
  EnergyBooks(const point::Problem& scene, double x, double v)
      : oscillator_(scene.oscillator), begin_(energy(x, v)), before_(begin_) {
    meet(x, v);
  }

  template <class A>
  void arc(const A& arc, double, double length) {
    const double f = oscillator_.forcing, h = oscillator_.damping;
    double size = 0;
    const auto power = [&](const auto& m, double) {
      meet(m.x, m.v);
      return f * m.v * m.sine - 2 * h * m.v * m.v;
    };
    gain(integral(arc, length, 2 * arc.constants().rate, power, size), size);
  }
  void impact(const motion::Impact& impact) {
    meet(impact.position, impact.before);
    const double loss = (impact.before - impact.after) * (impact.before + impact.after) / 2;
    gain(-loss, loss);
    rebound_ = impact.after;
  }
  void rest(
      const motion::Rest&) {  // a completed chatter takes the energy of its last rebound, which is 0 before other rests
    const double left = rebound_ * rebound_ / 2;
    gain(-left, left);
    rebound_ = 0;
  }
  void section(const motion::State<double>& state) {
    meet(state.x, state.v);
    const double now = energy(state.x, state.v);
    all_gained_ += gained_, all_moved_ += moved_;
    raise(of_period_, relative(now - before_ - gained_, highest_ + moved_));
    of_run_ = relative(now - begin_ - all_gained_, all_highest_ + all_moved_);
    before_ = now, gained_ = 0, moved_ = 0, highest_ = 0;
    meet(state.x, state.v);
  }

  /// The largest error of the balance over a period, and that over the whole run, relative to the largest energy plus
  /// all work and losses.
  [[nodiscard]] double of_period() const { return of_period_; }
  [[nodiscard]] double of_run() const { return of_run_; }
  /// Work less losses, relative to the same: 0 if the motion repeats.
  [[nodiscard]] double left_over() const { return std::abs(all_gained_) / (all_highest_ + all_moved_); }

 private:
  /// Without a spring a mass at rest has no energy at all.
  [[nodiscard]] static double relative(double error, double size) { return error == 0 ? 0.0 : std::abs(error) / size; }
  [[nodiscard]] double energy(double x, double v) const {
    return v * v / 2 + oscillator_.stiffness * x * x / 2 - oscillator_.load * x;
  }
  void meet(double x, double v) {
    highest_ =
        std::max(highest_, v * v / 2 + std::abs(oscillator_.stiffness) * x * x / 2 + std::abs(oscillator_.load * x));
    all_highest_ = std::max(all_highest_, highest_);
  }
  void gain(double energy, double size) { gained_ += energy, moved_ += size; }

  Oscillator oscillator_;
  double begin_, before_;  ///< energy at the start and at the last section
  double rebound_ = 0;
  double highest_ = 0, all_highest_ = 0, gained_ = 0, all_gained_ = 0, moved_ = 0, all_moved_ = 0;
  double of_period_ = 0, of_run_ = 0;
};

}  // namespace clatter::hard
