#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/panels.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

/// Keeps the books of the energy E = x'^2/2 + x^2/2 - load x: what the force puts in, less what friction and impacts
/// take out, is what E has grown by.
class EnergyBooks : public Watcher {
 public:
  explicit EnergyBooks(const point::Problem& scene)
      : EnergyBooks(scene, scene.start.displacement, scene.start.velocity) {}

  /// Of a motion that is at displacement x and velocity v when it is first seen.
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
  void rest(const motion::Rest&) {  // a chatter takes what its last rebound left; before other rests that is nothing
    const double left = rebound_ * rebound_ / 2;
    gain(-left, left);
    rebound_ = 0;
  }
  void section(const motion::State<double>& state) {
    meet(state.x, state.v);
    const double now = energy(state.x, state.v);
    all_gained_ += gained_, all_moved_ += moved_;
    raise(of_period_, std::abs(now - before_ - gained_) / (highest_ + moved_));
    of_run_ = std::abs(now - begin_ - all_gained_) / (all_highest_ + all_moved_);
    before_ = now, gained_ = 0, moved_ = 0, highest_ = 0;
    meet(state.x, state.v);
  }

  /// What was missing in the period where most was, and in the whole run, over the largest energy plus all that was put
  /// in and taken out.
  [[nodiscard]] double of_period() const { return of_period_; }
  [[nodiscard]] double of_run() const { return of_run_; }
  /// Work that impacts and friction did not take up, over the same: 0 where a motion repeats.
  [[nodiscard]] double left_over() const { return std::abs(all_gained_) / (all_highest_ + all_moved_); }

 private:
  [[nodiscard]] double energy(double x, double v) const { return v * v / 2 + x * x / 2 - oscillator_.load * x; }
  void meet(double x, double v) {
    highest_ = std::max(highest_, v * v / 2 + x * x / 2 + std::abs(oscillator_.load * x));
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
