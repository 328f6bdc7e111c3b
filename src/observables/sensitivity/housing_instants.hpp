#pragma once

#include <cstddef>
#include <optional>

#include "motion/soft_stop.hpp"
#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"
#include "observables/sensitivity/dual_motion.hpp"
#include "observables/sensitivity/main_oscillators.hpp"

namespace clatter::observables {

/// Where the stretches of a course with a loose mass end, on numbers that carry derivatives.
template <class Along, Effects E>
class HousingInstants {
  using Motion = motion::Motion<Along>;
  using Kind = motion::Event::Kind;

 public:
  /// Of a force that leads by `lead`, or one in pieces.
  HousingInstants(const Course& course, const ObservedSpan& span, const BasicScene<Along>& scene,
                  const MainOscillators<Along, E>& oscillators, const DualForce<Along>& pieces, const Along& lead)
      : course_(course),
        scene_(scene),
        oscillators_(oscillators),
        pieces_(pieces),
        lead_(lead),
        rubs_(has_loose_friction(span.scene.loose)) {}

  /// Both masses at the end of a stretch, the loose one in its housing.
  struct End {
    const Motion &main, &loose;
    double jerk;  ///< of the main mass
  };
  /// By how much the end of a stretch comes later, with the main mass at x and a phase of the force: the surface of its
  /// event over its rate of change. Its value is 0.
  [[nodiscard]] Along lateness(std::size_t i, const End& end, const Along& x, const Along& phase) const {
    const Stretch& stretch = course_[i];
    if (stretch.ends.empty() || stretch.ends.front().kind == Kind::press) {
      // a press alone comes where the force of the wall only touches zero, and changes nothing
      const Stretch* const next = i + 1 < course_.size() ? &course_[i + 1] : nullptr;
      if (next != nullptr && pieces_.is_in_pieces() && pieces_.begins_by_jump(*next))
        return with_slope_of(0, (pieces_.knot(*next) - phase) / scene_.oscillator.frequency.value);
      if (const auto late = next != nullptr ? lateness_of_hold(stretch, *next, end) : std::nullopt) return *late;
      const bool lets_go = stretch.is_held && next != nullptr && !next->is_held;
      Along then = lets_go ? phase_of_release(stretch, *next, x) : lead_;
      if (pieces_.is_in_pieces() && !lets_go) then += pieces_.knot(next != nullptr ? *next : course_.front());
      return with_slope_of(0, (then - phase) / scene_.oscillator.frequency.value);
    }
    const motion::Event& event = stretch.ends.front();
    if (event.kind != Kind::strike) return lateness_of(event, end.main, stretch.anchor, scene_.stops);
    const Along& wall = event.side == Side::upper ? scene_.loose.upper : scene_.loose.lower;
    return with_slope_of(0, -(end.loose.x - wall) / end.loose.v.value);
  }

 private:
  /// The same where friction in the housing stops the loose mass, or turns it (z' = 0), or lets it go (eq. 81).
  [[nodiscard]] std::optional<Along> lateness_of_hold(const Stretch& stretch, const Stretch& next,
                                                      const End& end) const {
    if (!rubs_) return std::nullopt;
    if (!stretch.carries && (next.carries || next.slides_to != stretch.slides_to))
      return with_slope_of(0, -end.loose.v / end.loose.a.value);
    if (!stretch.carries || next.carries || stretch.is_held) return std::nullopt;
    const Along level = scene_.loose.load - sign_of(next.slides_to) * scene_.loose.friction_static / scene_.loose.ratio;
    return with_slope_of(0, (level - end.main.a) / end.jerk);
  }
  /// The phase of the force at which a main mass held at x is let go, where the pull on it passes the level of
  /// friction, on a stop without friction 0 (eqs. 26 and 66).
  [[nodiscard]] Along phase_of_release(const Stretch& held, const Stretch& next, const Along& x) const {
    Along phase;
    oscillators_.with_slips(held, [&](const auto& still, const auto& slips) {
      Along needed = still.spring(x) - still.load + sign_of(next.ahead) * slips.static_level;
      if (next.pressed != Side::none) {
        const auto soft = motion::soft_stop_at<Along>(scene_.stops, next.pressed);
        const Along share = held.carries ? 1 / (1 + scene_.loose.ratio) : Along(1);
        needed += share * soft.stiffness * (x - soft.position);
      }
      const Along sine = needed / still.f;
      if (!pieces_.is_in_pieces()) {
        const auto [at, slope] = still.drive(SineCosine<Along>{next.start.sine, next.start.cosine});
        phase = with_slope_of(0, (sine - at) / slope.value);
      } else {
        phase = next.start.cosine == 0 ? pieces_.knot(next)
                                       : with_slope_of(0, (sine - pieces_.at(next, Along(0)).sine) / next.start.cosine);
      }
    });
    return phase;
  }

  const Course& course_;
  const BasicScene<Along>& scene_;
  const MainOscillators<Along, E>& oscillators_;
  const DualForce<Along>& pieces_;
  Along lead_;
  bool rubs_;
};

}  // namespace clatter::observables
