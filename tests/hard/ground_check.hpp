#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hard/any_scene.hpp"
#include "hard/panels.hpp"
#include "hard/tally.hpp"
#include "hard/taylor_scan.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::hard {

/// Checks a motion, computed in the frame of shaken stops or of a shaken base, in the ground's frame, by the forces
/// that act there: eqs. 39 to 41 are not used. Every arc is computed again by Taylor steps, the work done in it is the
/// growth of x'^2/2, and a mass at rest on a moving stop is accelerated by what presses it on.
class GroundCheck : public Watcher {
 public:
  /// Of a problem as a user gives it, not yet in that frame.
  explicit GroundCheck(const point::Problem& scene)
      : oscillator_(scene.oscillator),
        b_(scene.shaking.stops + scene.shaking.base),
        on_base_(scene.shaking.base != 0),
        phase_(scene.start.phase) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    const auto stop = arc.constants().stop;
    if (!(length * arc.constants().rate < 300)) return;  // a stiff stop, pressed for long
    ++arcs;
    const auto last = arc.at(length);
    allow(arc.start(), last, stop, length);
    const Ground from = ground(arc.start(), begin), to = ground(last, begin + length);
    const TaylorScan::PhaseState there = again(from, stop, begin, length);
    raise(displacement, static_cast<double>(std::abs(there.offset - to.y)) / near_);
    raise(velocity, static_cast<double>(std::abs(there.v - to.w)) / fast_);
    double size = 0;
    const auto power = [&](const auto& m, double s) {
      return static_cast<double>(ground(m, begin + s).w) * force(m, stop, begin + s);
    };
    const double work = integral(arc, length, 2 * arc.constants().rate, power, size);
    const auto growth = static_cast<double>((to.w - from.w) * (to.w + from.w) / 2);
    const auto most = static_cast<double>(std::max(std::abs(to.w), std::abs(from.w)));
    raise(energy, std::abs(growth - work) / (1e-12 * (size + most * most) + 2 * fast_ * most));
  }
  void rest(const motion::Event& rest) {
    if (!rest.held) return;
    ++rests;
    constexpr int looks = 16;
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const double size =
        std::abs(f) + std::abs(load) + std::abs(k * rest.place) + std::abs(b_) * (std::abs(k) + 2 * h * nu + nu * nu);
    for (int i = 0; i <= looks; ++i) {
      const double time = rest.time + rest.length * i / looks;
      const motion::Motion<double> m{.offset = 0, .x = rest.place, .v = 0, .a = 0, .sine = 0, .cosine = 0};
      const double acceleration = -b_ * nu * nu * std::sin(angle(time));
      const double pressing = sign_of(rest.side) * (force(m, {}, time) - acceleration);
      raise(pressed, -pressing / (64 * epsilon<double>() * size));
    }
  }

  std::uint64_t arcs = 0, rests = 0;      ///< examined
  double displacement = 0, velocity = 0;  ///< at the end of an arc; deviations are in units of the allowed rounding
  double energy = 0, pressed = 0;

 private:
  using Real = TaylorScan::Real;
  /// Displacement and velocity in the ground's frame.
  struct Ground {
    Real y, w;
  };

  [[nodiscard]] double angle(double time) const { return phase_ + oscillator_.frequency * time; }
  template <class M>
  [[nodiscard]] Ground ground(const M& m, double time) const {
    const Real theta = angle(time), b = b_;
    return {m.x + b * std::sin(theta), m.v + b * oscillator_.frequency * std::cos(theta)};
  }

  /// All forces on the mass: spring and damper are fixed to the ground, or to the base.
  template <class M>
  [[nodiscard]] double force(const M& m, const motion::SoftStop<double>& stop, double time) const {
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const Ground g = ground(m, time);
    const auto stretch = on_base_ ? m.x : static_cast<double>(g.y), rate = on_base_ ? m.v : static_cast<double>(g.w);
    const double push = stop.side == Side::none ? 0.0 : stop.into(stop.force(stop.into(m.offset), stop.into(m.v)));
    return f * std::sin(angle(time)) + load - k * stretch - 2 * h * rate - push;
  }

  /// The end of an arc by Taylor steps. What moves pulls at springs and dampers by b sin(theta) and its rate.
  [[nodiscard]] TaylorScan::PhaseState again(const Ground& from, const motion::SoftStop<double>& stop, double begin,
                                             double length) const {
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const double kappa = stop.side == Side::none ? 0.0 : stop.stiffness,
                 damper = stop.side == Side::none ? 0.0 : stop.damping;
    const Real moved_k = kappa + (on_base_ ? k : 0.0), moved_h = damper + (on_base_ ? h : 0.0);
    const Real in_phase = f + moved_k * b_, quadrature = 2 * moved_h * nu * b_, F = std::hypot(in_phase, quadrature);
    const Real sine = std::sin(Real(angle(begin))), cosine = std::cos(Real(angle(begin)));
    const TaylorScan scan(h + Real(damper), F, nu, k + Real(kappa), load + Real(kappa) * stop.position);
    const Real size = F > 0 ? F : Real(1);
    return scan
        .fly({from.y, from.w, (in_phase * sine + quadrature * cosine) / size,
              (in_phase * cosine - quadrature * sine) / size},
             length)
        .end;
  }

  /// The allowed rounding in an arc: of its terms, as many ulps as it has radians more.
  template <class M>
  void allow(const M& first, const M& last, const motion::SoftStop<double>& stop, double length) {
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const double kappa = stop.side == Side::none ? 0.0 : stop.stiffness,
                 damper = stop.side == Side::none ? 0.0 : stop.damping;
    const double natural = std::sqrt(std::abs(k + kappa)), part = std::min(length, 1 / std::max(natural, 1e-300));
    const double forces = std::abs(f) + std::abs(load) + std::abs(b_) * (std::abs(k) + 2 * h * nu + nu * nu);
    const double speeds = std::abs(first.v) + std::abs(last.v);
    const double places = std::abs(first.x) + std::abs(last.x) + std::abs(b_) + forces * part * part;
    const double radians = std::min(natural * length, natural / (h + damper));
    const double unit = 64 * epsilon<double>() * (k + kappa < 0 ? std::exp(natural * length) : 1 + radians);
    near_ = unit * (places + speeds * part);
    fast_ = unit * (speeds + std::abs(b_) * nu + places * std::max(natural, nu) + forces * part);
  }

  Oscillator oscillator_;
  double b_;
  bool on_base_;
  double phase_;
  double near_ = 0, fast_ = 0;
};

}  // namespace clatter::hard
