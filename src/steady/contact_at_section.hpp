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
      : stops_(rigid_ones(scene.stops), scene.oscillator.frequency, scene.start.phase),
        loose_(scene.loose),
        within_(same_instant * period) {}

  [[nodiscard]] SectionNumbers operator()(SectionNumbers at) const {
    const double to_lower = at.v - stops_.velocity_lower, to_upper = at.v - stops_.velocity_upper;
    const bool meets_upper = to_upper > 0 && stops_.upper - at.x <= within_ * to_upper,
               meets_lower = to_lower < 0 && stops_.lower - at.x >= within_ * to_lower;
    if (meets_upper || meets_lower) [[unlikely]] {
      const auto stop = motion::stop_at<double>(stops_, meets_upper ? Side::upper : Side::lower);
      const double w = meets_upper ? to_upper : to_lower, after = stop.law.after(w);
      at.x += (w - after) * ((stop.position - at.x) / w), at.v += after - w;
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
    const auto is_near = [&](double stop, double w) { return w != 0 && std::abs(x - stop) <= within_ * std::abs(w); };
    return is_near(stops_.lower, v - stops_.velocity_lower) || is_near(stops_.upper, v - stops_.velocity_upper);
  }

 private:
  [[nodiscard]] bool is_ahead(double x, double v, double lower, double upper) const {
    return v > 0 ? upper - x <= within_ * v : v < 0 && lower - x >= within_ * v;
  }

  StopsNow stops_;
  LooseMass loose_;
  double within_;  ///< tau
};

}  // namespace clatter::steady
