#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "hard/rescan.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::hard {

/// The same between stops of which some are soft: while one pushes, its force must not fall below 0, and beyond one
/// that doesn't, the force must not rise above it (eq. 50). Both come from Taylor steps; the force is over kappa, a
/// length.
class SoftRescan : public Rescan {
 public:
  explicit SoftRescan(const point::Problem& scene) : Rescan(scene) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    const auto& m = arc.start();
    if (flying_) go_on(m, arc.anchor());
    const Side pushing = arc.constants().stop.side;
    if (pushing != pushing_ && !(is_fresh_ || m.v == 0)) broken = infinity;  // reported by neither touch nor separation
    pushing_ = pushing, is_fresh_ = false;
    const Side around = pushing != Side::none ? pushing : around_of(arc.anchor(), m.offset);
    is_within_ = around != Side::none;
    if (!is_within_) return Rescan::arc(arc, begin, length);
    check_start(m, begin);
    stop_ = motion::soft_stop_at<double>(stops_, around), anchor_ = stop_.position;
    scan(arc, length);
    flying_ = true, rebound_ = 0, ++within;
  }
  void touch(const motion::Event& touch) {
    stop_ = motion::soft_stop_at<double>(stops_, touch.side), pushing_ = touch.side;
    if (touch.kind != motion::Event::Kind::touch) return check_change(touch.before);
    check_arrival(touch.place, touch.before);
    if (is_within_ || !(stop_.into(touch.before) > 0)) broken = infinity;
    x_ = touch.place, v_ = touch.before, flying_ = false;
  }
  void separate(const motion::Event& separation) {
    pushing_ = Side::none;
    check_change(separation.before);
  }
  void section(const motion::State<double>& state) {
    Rescan::section(state);
    is_fresh_ = true;
  }

  std::uint64_t within = 0;  ///< arcs beyond a soft stop's position
  double force = 0;          ///< of the stop: on the wrong side of 0, or not 0 where contact begins or ends

 private:
  static constexpr double most_radians = 40;  ///< of the fastest motion, in what is scanned at each end of an arc

  /// The soft stop beyond which a mass is, perhaps by less than an ulp of its displacement.
  [[nodiscard]] Side around_of(double anchor, double offset) const {
    for (const Side side : {Side::lower, Side::upper})
      if (is_soft(stops_, side) &&
          sign_of(side) * ((anchor - (side == Side::upper ? stops_.upper : stops_.lower)) + offset) > 0)
        return side;
    return Side::none;
  }

  /// Nothing is reported where a mass that has outrun a stop leaves it, or one without speed touches it; after a change
  /// of the force the displacement is new, the velocity has been reported.
  template <class M>
  void go_on(const M& m, double anchor) {
    const Real offset = m.offset + (static_cast<Real>(anchor) - anchor_);
    raise(position, ratio(std::abs(offset - flight_.end.offset), near_));
    raise(speed, ratio(std::abs(m.v - flight_.end.v), fast_ + speed_rounding(m.v)));
    if (changed_ && m.v != v_) broken = infinity;
    x_ = m.x, v_ = m.v, flying_ = changed_ = false;
  }

  /// Checks that the stop's force is 0 at the end of an arc.
  void check_change(double velocity) {
    raise(force, ratio(std::abs(flight_.end.offset + stop_.relaxation() * flight_.end.v), force_));
    raise(speed, ratio(std::abs(velocity - flight_.end.v), fast_ + speed_rounding(velocity)));
    v_ = velocity, changed_ = true;
  }

  template <class A>
  void scan(const A& arc, double length) {
    const TaylorScan taylor = pushing_ == Side::none
                                  ? TaylorScan(oscillator_, anchor_)
                                  : TaylorScan(oscillator_, anchor_, stop_.stiffness, kappa_damping());
    allow_within(arc.start(), length);
    const double part = std::min(length, most_radians / static_cast<double>(taylor.rate()));
    fly(taylor, arc.start(), part);
    if (part == length) return;
    const auto there = arc.at(part);
    raise(position, ratio(std::abs(there.offset - flight_.end.offset), near_));
    raise(speed, ratio(std::abs(there.v - flight_.end.v), fast_));
    fly(taylor, arc.at(length - part), part);
  }
  [[nodiscard]] double kappa_damping() const {
    return stop_.side == Side::upper ? stops_.damping_upper : stops_.damping_lower;
  }

  /// Flies a part of an arc and checks the signs of the stop's force and, without contact, of the depth.
  template <class M>
  void fly(const TaylorScan& taylor, const M& m, double length) {
    const TaylorScan::PhaseState start{m.offset, m.v, m.sine, m.cosine};
    flight_ = taylor.fly(start, length, stop_.relaxation());
    const Real least = stop_.side == Side::upper ? flight_.lowest : -flight_.highest,
               most = stop_.side == Side::upper ? flight_.highest : -flight_.lowest;
    raise(force, ratio(pushing_ != Side::none ? -least : most, force_));
    if (pushing_ != Side::none) return;
    const TaylorScan::Flight places = taylor.fly(start, length);
    raise(missed, ratio(stop_.side == Side::upper ? -places.lowest : places.highest, near_));
  }

  /// The allowed rounding beyond a stop's position, where displacements are offsets from it.
  template <class M>
  void allow_within(const M& m, double length) {
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const bool pushed = pushing_ != Side::none;
    const double stiffness = pushed ? k + stop_.stiffness : k, damping = pushed ? h + stop_.damping : h;
    const double natural = std::sqrt(std::abs(stiffness)), pull = std::abs(load) + std::abs(k * anchor_);
    const double part = std::min(length, 1 / std::max(natural, 1e-300));
    const double response = f == 0 ? 0
                                   : std::abs(f) * std::min(1 / std::hypot(stiffness - nu * nu, 2 * damping * nu),
                                                            (16 * part + length) * part);
    const double way = std::abs(m.offset) + std::abs(m.v) * part;
    // an ulp of the stiffness is one of the frequency, for as many radians as the motion lasts
    const double radians = std::min(natural * length, natural / damping);
    const double growth = stiffness < 0 ? std::exp(natural * length) : 1 + radians;
    const double unit = ulps * epsilon<double>() * growth;
    acceleration_ = pull + std::abs(stiffness) * way + std::abs(f) + 2 * damping * std::abs(m.v);
    near_ = unit * (way + (pull + std::abs(f)) * part * part + response);
    whole_ = near_ + unit * std::abs(anchor_);
    fast_ = unit * (std::abs(m.v) + std::abs(stiffness * m.offset) * part + (pull + std::abs(f)) * part +
                    response * std::max(natural, nu)) +
            std::numeric_limits<double>::min();
    force_ = near_ + stop_.relaxation() * fast_;
  }

  motion::SoftStop<double> stop_{};  ///< the one that the mass is beyond, or was last
  Side pushing_ = Side::none;        ///< the one that pushes
  bool is_within_ = false;           ///< the last arc was beyond a soft stop's position
  bool is_fresh_ = true;             ///< the next arc is the first of a run or a section
  bool changed_ = false;             ///< the force has passed 0 at the end of the last arc
  double force_ = 0;                 ///< allowed rounding of the force
};

}  // namespace clatter::hard
