#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/contact_force.hpp"
#include "motion/walls.hpp"
#include "scene/scene.hpp"

namespace clatter::steady {

/// Contacts so near a section, in forcing periods, that rounding may decide on which side of it they fall.
inline constexpr double same_instant = 1e-9;

/// Displacement and velocity at a section, and with a loose mass its place in the housing z and z'.
struct SectionNumbers {
  double x, v;
  double z = 0.0, w = 0.0;
};

/// Compares the states of a motion at its sections. If an impact falls on the section, rounding decides in each period
/// whether the state is the one before the impact or after it. To compare, a state just before one is taken beyond it:
/// the motion after the impact, extended back to the section. So both are the same but for rounding.
class BeyondContact {
 public:
  BeyondContact(const Scene& scene, double period)
      : stops_(rigid_ones(scene.stops)), loose_(scene.loose), within_(same_instant * period) {}

  [[nodiscard]] SectionNumbers operator()(SectionNumbers at) const {
    if (is_ahead(at.x, at.v, stops_.lower, stops_.upper)) [[unlikely]] {
      const auto stop = motion::stop_at<double>(stops_, at.v > 0 ? Side::upper : Side::lower);
      const double left = (stop.position - at.x) / at.v, after = stop.law.after(at.v);
      at.x += (at.v - after) * left, at.v = after;
    }
    if (is_ahead(at.z, at.w, loose_.lower, loose_.upper)) [[unlikely]] {
      const motion::WallRule<double> rule(loose_);
      const double left = ((at.w > 0 ? loose_.upper : loose_.lower) - at.z) / at.w;
      const double after = rule.law_for(at.w).after(at.w), v_after = rule.main_after(at.v, at.w);
      at.z += (at.w - after) * left, at.x += (at.v - v_after) * left;
      at.w = after, at.v = v_after;
    }
    return at;
  }
  /// Whether a state is that just before an impact on a stop, or just after one.
  [[nodiscard]] bool is_beside(double x, double v) const {
    return v != 0 && std::min(std::abs(x - stops_.lower), std::abs(x - stops_.upper)) <= within_ * std::abs(v);
  }

 private:
  [[nodiscard]] bool is_ahead(double x, double v, double lower, double upper) const {
    return v > 0 ? upper - x <= within_ * v : v < 0 && lower - x >= within_ * v;
  }

  Stops stops_;
  LooseMass loose_;
  double within_;  ///< tau
};

}  // namespace clatter::steady
