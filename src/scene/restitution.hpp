#pragma once

namespace clatter {
inline namespace scene {

/// Newton's law of restitution on a stop (eq. 4), for every number type: the exact loop and its derivative, the general
/// methods and the lanes take it from here.
template <class Number>
struct Restitution {
  Number R;  ///< 0 ... 1

  /// Velocity after an impact: 0 - R v rather than -R v, so that R = 0 leaves no negative zero.
  [[nodiscard]] Number after(const Number& before) const { return Number(0) - R * before; }
  /// Change of the velocity by an impact.
  [[nodiscard]] Number jump(const Number& before) const { return -(Number(1) + R) * before; }
  /// Derivative of the velocity after by the velocity before.
  [[nodiscard]] Number derivative() const { return -R; }
};

}  // namespace scene
}  // namespace clatter
