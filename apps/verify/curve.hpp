#pragma once

#include <vector>

#include "course.hpp"
#include "motion.hpp"

namespace verify {

/// A state at the start and a parameter, less the claimed one; or a direction of them.
struct Place {
  Ball x, v, p;

  friend Place operator+(const Place& a, const Place& b) { return {a.x + b.x, a.v + b.v, a.p + b.p}; }
  friend Place operator*(const Ball& a, const Place& b) { return {a * b.x, a * b.v, a * b.p}; }
  [[nodiscard]] Place middle() const { return {x.middle(), v.middle(), p.middle()}; }
  [[nodiscard]] bool is_finite() const { return x.is_finite() && v.is_finite() && p.is_finite(); }
};
[[nodiscard]] Ball dot(const Place& a, const Place& b);
[[nodiscard]] Place cross(const Place& a, const Place& b);

/// The periodic motions of a special point's scenes near it: a curve of places, proved to exist and to be the only one.
/// A motion that is claimed to be its own mirror image half a period later is known by that half: it returns if the
/// mirror image of its end is its start. One that is released by a stop is known by the parameter alone.
class Curve {
 public:
  /// About the claimed place. Throws Refuted if no place within the claimed errors is one of a periodic motion, and
  /// Undecided.
  explicit Curve(const Certificate& certificate);

  /// A period, or a half, of all motions that start within a place.
  struct Passage {
    std::vector<Event> events;
    std::vector<Stretch> stretches;
    Ball x, v;                         ///< at the end, mirrored if half a period is kept, less those at the start
    Matrix derivative;                 ///< of the mapped state by the state
    Place row_x, row_v;                ///< derivatives of `x` and `v` by the place
    std::shared_ptr<const void> keep;  ///< what the stretches refer to
  };
  [[nodiscard]] Passage pass(const Place& at) const;

  /// The place of the curve at a distance along it, or all places of several.
  [[nodiscard]] Place at(const Ball& distance) const;
  /// All places within which the curve is proved.
  [[nodiscard]] Place everywhere() const;
  /// So far on each side of it the curve is proved; no claimed place is beyond.
  [[nodiscard]] const Ball& reach() const { return reach_; }
  /// The claimed errors of x, v and the parameter, about the claimed place.
  [[nodiscard]] bool may_be_claimed(const Place& place) const;
  [[nodiscard]] bool is_mirrored() const { return mirrored_; }  ///< half a period is followed
  [[nodiscard]] MovingScene scene(const Ball& offset) const { return certificate_.moving_scene(offset); }
  /// The direction of the curve, of any length, but nowhere 0.
  [[nodiscard]] Place direction(const Passage& passage) const;

 private:
  void find_centre();
  void prove();
  [[nodiscard]] std::array<Place, 3> rest_over(const Place& box) const;

  const Certificate& certificate_;
  Certificate kept_;
  bool mirrored_ = false;
  Place claimed_, errors_;
  Place centre_{}, along_{};  ///< distances along the curve are parts of the way from the centre in this direction
  Place residual_{};          ///< of the equations at the centre
  Ball reach_{0};
  Place box_{};                              ///< about the centre, in which the curve is the only one
  std::array<Place, 3> inverse_{}, rest_{};  ///< of Krawczyk's operator, by rows
};

}  // namespace verify
