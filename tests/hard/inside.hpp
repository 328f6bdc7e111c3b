#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"
#include "scene/response.hpp"

namespace clatter::hard {

/// The distance by which arcs go beyond the rigid stops, in ulps of the natural scale of a displacement: the sizes of
/// its terms (load, stop, forced response, free motion), and the way of response and mass in an ulp of the time. A
/// flight that a section cuts keeps the scale that it had before.
class BeyondStops : public Watcher {
 public:
  explicit BeyondStops(const point::Problem& scene) : oscillator_(scene.oscillator), stops_(rigid_ones(scene.stops)) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    for (int i = 1; i < looks; ++i) look(arc, length * i / looks);
    look(arc, length);
    flight_ = scale_;
  }
  void impact(const motion::Event&) { flight_ = 0; }
  void rest(const motion::Event&) { flight_ = 0; }

  [[nodiscard]] double ulps() const { return ulps_; }

 private:
  static constexpr int looks = 8;

  template <class A>
  void look(const A& arc, double s) {
    const auto m = arc.at(s);
    const auto& start = arc.start();
    const bool secular = forcing_of(oscillator_) == Forcing::secular;  // then it grows with the time
    const double amplitude = secular ? std::abs(oscillator_.forcing) * s : steady_response(oscillator_).amplitude;
    const double response = amplitude * (1 + oscillator_.frequency * s);
    scale_ = std::max(flight_, std::abs(pulled(s)) + std::abs(arc.anchor()) + response + std::abs(start.free_x) +
                                   std::abs(start.free_v) + std::abs(m.v) * s);
    const double beyond = std::max(stops_.lower - m.x, m.x - stops_.upper);
    if (beyond > 0) raise(ulps_, beyond / (epsilon<double>() * scale_));
  }

  /// The place to which the load pulls: the equilibrium, or where it has taken a mass without a spring.
  [[nodiscard]] double pulled(double s) const {
    return oscillator_.stiffness == 0 ? oscillator_.load * s * s / 2 : equilibrium_of(oscillator_);
  }

  Oscillator oscillator_;
  Stops stops_;
  double scale_ = 0, flight_ = 0, ulps_ = 0;
};

/// Whether every reported displacement of a motion is between the rigid stops, and every impact and rest on one.
class ToldPlaces : public Watcher {
 public:
  explicit ToldPlaces(const Stops& stops) : stops_(rigid_ones(stops)) {}

  void rest(const motion::Event& rest) {
    right_ = right_ && rest.place == (rest.side == Side::upper ? stops_.upper : stops_.lower);
  }
  void impact(const motion::Event& impact) {
    right_ = right_ && impact.place == (impact.side == Side::upper ? stops_.upper : stops_.lower);
  }
  void section(const motion::State<double>& state) { see(state.x); }
  void see(double x) { right_ = right_ && x >= stops_.lower && x <= stops_.upper; }

  [[nodiscard]] bool right() const { return right_; }

 private:
  Stops stops_;
  bool right_ = true;
};

}  // namespace clatter::hard
