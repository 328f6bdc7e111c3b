#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/panels.hpp"
#include "hard/tally.hpp"

namespace clatter::hard {

/// Checks the balance of the energy E = x'^2/2 + k x^2/2 - load x (eq. 34) and of the springs of soft stops: the work
/// of the force, less the losses by damping, by impacts and in soft stops (eq. 54), is the growth of E.
class EnergyBooks : public Watcher {
 public:
  explicit EnergyBooks(const point::Problem& scene)
      : EnergyBooks(scene, scene.start.displacement, scene.start.velocity) {}

  /// For a motion that is first observed at displacement x and velocity v.
  EnergyBooks(const point::Problem& scene, double x, double v)
      : oscillator_(scene.oscillator), stops_(scene.stops), begin_(energy(x, v)), before_(begin_) {
    meet(x, v);
    doubt_ = doubt(x);
  }

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto& stop = arc.constants().stop;
    const double f = oscillator_.forcing, h = oscillator_.damping + (stop.side == Side::none ? 0.0 : stop.damping);
    if (stop.side == Side::none) relax(arc.start().x, arc.at(length).x);
    if (stop.side != Side::none) longest_ = std::max(longest_, length * arc.constants().rate);
    if (!in_reach()) return;
    double size = 0;
    const auto power = [&](const auto& m, double) {
      meet(m.x, m.v);
      return f * m.v * m.sine - 2 * h * m.v * m.v;
    };
    gain(integral(arc, length, 2 * arc.constants().rate, power, size), size);
  }
  void impact(const motion::Event& impact) {
    meet(impact.place, impact.before);
    const double loss = (impact.before - impact.after) * (impact.before + impact.after) / 2;
    gain(-loss, loss);
    rebound_ = impact.after;
  }
  /// A completed chatter takes the energy of its last rebound, which is 0 before other rests.
  void rest(const motion::Event&) {
    const double left = rebound_ * rebound_ / 2;
    gain(-left, left);
    rebound_ = 0;
  }
  void section(const motion::State<double>& state) {
    meet(state.x, state.v);
    const double now = energy(state.x, state.v);
    all_gained_ += gained_, all_moved_ += moved_, doubt_ += doubt(state.x), all_doubt_ += doubt_;
    raise(of_period_, relative(beyond(now - before_ - gained_, doubt_), highest_ + moved_));
    of_run_ = relative(beyond(now - begin_ - all_gained_, all_doubt_), all_highest_ + all_moved_);
    before_ = now, gained_ = 0, moved_ = 0, highest_ = 0, doubt_ = doubt(state.x);
    meet(state.x, state.v);
  }

  /// Whether all contacts are short enough to be integrated: a stiff stop that is pressed for long moves too often.
  [[nodiscard]] bool in_reach() const { return longest_ < 2e3; }
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
    return v * v / 2 + oscillator_.stiffness * x * x / 2 - oscillator_.load * x + stored(x);
  }
  /// The energy in the springs of soft stops.
  [[nodiscard]] double stored(double x) const {
    double sum = 0;
    for (const Side side : {Side::lower, Side::upper}) {
      if (!is_soft(stops_, side)) continue;
      const auto stop = motion::soft_stop_at<double>(stops_, side);
      const double depth = std::max(0.0, stop.into(x - stop.position));
      sum += stop.stiffness * depth * depth / 2;
    }
    return sum;
  }
  /// What an ulp or two of a displacement is of the energy in the springs: a small depth has few digits of it.
  [[nodiscard]] double doubt(double x) const {
    double sum = 0;
    for (const Side side : {Side::lower, Side::upper}) {
      if (!is_soft(stops_, side)) continue;
      const auto stop = motion::soft_stop_at<double>(stops_, side);
      const double depth = std::max(0.0, stop.into(x - stop.position)), ulps = 2 * epsilon<double>() * std::abs(x);
      sum += stop.stiffness * (depth + ulps) * ulps;
    }
    return sum;
  }
  [[nodiscard]] static double beyond(double error, double doubt) {
    return std::isnan(error) ? error : std::max(0.0, std::abs(error) - doubt);
  }
  /// Where the mass outruns a soft stop, that loses the energy of its spring (the second part of eq. 54).
  void relax(double from, double to) {
    const double loss = stored(from) - stored(to);
    gain(-loss, std::abs(loss));
    doubt_ += doubt(from) + doubt(to);
  }
  void meet(double x, double v) {
    highest_ = std::max(
        highest_, v * v / 2 + std::abs(oscillator_.stiffness) * x * x / 2 + std::abs(oscillator_.load * x) + stored(x));
    all_highest_ = std::max(all_highest_, highest_);
  }
  void gain(double energy, double size) { gained_ += energy, moved_ += size; }

  Oscillator oscillator_;
  Stops stops_;
  double longest_ = 0;     ///< contact with a soft stop, in radians of its fastest motion
  double begin_, before_;  ///< energy at the start and at the last section
  double rebound_ = 0;
  double doubt_ = 0, all_doubt_ = 0;  ///< rounding of the energy in soft stops
  double highest_ = 0, all_highest_ = 0, gained_ = 0, all_gained_ = 0, moved_ = 0, all_moved_ = 0;
  double of_period_ = 0, of_run_ = 0;
};

}  // namespace clatter::hard
