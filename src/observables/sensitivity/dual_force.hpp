#pragma once

#include <cmath>
#include <cstddef>

#include "motion/state.hpp"
#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"
#include "scene/force_shape.hpp"

namespace clatter::observables {

/// A force in pieces along a course, on numbers that carry derivatives: its knots move with the shares of its parts.
template <class Along>
class DualForce {
 public:
  DualForce(const ObservedSpan& span, const BasicScene<Along>& scene)
      : pieces_(scene.oscillator.shape),
        is_half_sine_(scene.oscillator.shape.waveform == Waveform::half_sine),
        of_run_(span.scene.oscillator.shape),
        begin_(span.theta / (2 * pi<double>())),
        frequency_(span.scene.oscillator.frequency / (2 * pi<double>())) {}

  [[nodiscard]] bool is_in_pieces() const { return pieces_.size() > 0; }

  /// s and ds/dtheta at the start of a stretch, at a phase of which only the derivatives count.
  [[nodiscard]] SineCosine<Along> at(const Stretch& stretch, const Along& phase) const {
    using std::cos, std::sin;
    const auto [i, since] = place_of(stretch);
    const ForcePiece<Along> piece = pieces_[i];
    const Along angle = piece.slope * (Along(2 * pi<double>() * since) + phase - moved(i));
    if (is_half_sine_ && piece.slope.value != 0) return {sin(angle), piece.slope * cos(angle)};
    return {piece.value + angle, piece.slope};
  }
  /// The phase, of which only the derivatives count, of the knot at which a stretch begins; 0 if it begins elsewhere.
  [[nodiscard]] Along knot(const Stretch& stretch) const {
    const auto [i, since] = place_of(stretch);
    return since == 0 ? moved(i) : Along(0);
  }
  /// Whether a stretch begins where the force jumps.
  [[nodiscard]] bool begins_by_jump(const Stretch& stretch) const {
    const auto [i, since] = place_of(stretch);
    if (since != 0 || is_half_sine_) return false;
    const ForcePieces<double> pieces(of_run_);
    const std::size_t last = i > 0 ? i - 1 : pieces.size() - 1;
    const ForcePiece<double> before = pieces[last];
    const double end = before.value + before.slope * 2 * pi<double>() * (pieces.end_of(last) - before.begin);
    return std::abs(end - pieces[i].value) > 1e-12;
  }

 private:
  [[nodiscard]] double turns_of(const Stretch& stretch) const { return begin_ + frequency_ * stretch.begin; }
  [[nodiscard]] Along moved(std::size_t i) const {
    Along knot = 2 * pi<double>() * pieces_[i].begin;
    knot.value = 0;
    return knot;
  }
  /// The piece in which a stretch begins; a knot just ahead, from which the force goes on as it does there, is that of
  /// the stretch, to rounding.
  [[nodiscard]] typename ForcePieces<double>::Place place_of(const Stretch& stretch) const {
    const ForcePieces<double> pieces(of_run_);
    constexpr double near = 1e-9;
    const double turns = turns_of(stretch);
    const auto ahead = pieces.at(part_of_turn(turns + near));
    const auto [begin, value, slope] = pieces[ahead.piece];
    const motion::Motion<double>& m = stretch.start;
    const double rounding = 1e-6 * (1 + std::abs(slope));
    if (ahead.since <= 2 * near && std::abs(value - m.sine) <= rounding && std::abs(slope - m.cosine) <= rounding)
      return {ahead.piece, 0.0};
    return pieces.at(part_of_turn(turns));
  }

  ForcePieces<Along> pieces_;
  bool is_half_sine_;
  ForceShape of_run_;
  double begin_, frequency_;  ///< the phase at the beginning, in turns, and turns by tau
};

}  // namespace clatter::observables
