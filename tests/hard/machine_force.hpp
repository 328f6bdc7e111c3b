#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "hard/machine.hpp"
#include "hard/machine_series.hpp"

namespace clatter::hard::machine {

/// A piece of the shape s of a force, by the share t of the period since its beginning:
/// s = level + slope t + height sin(2 pi pace t).
struct ForcePiece {
  Quad from;  ///< its beginning, in periods; it lasts until the next one's, which may be at the same place
  Quad level, slope = 0;
  Quad height = 0, pace = 0;
};

/// The straight lines between rows.
[[nodiscard]] inline std::vector<ForcePiece> lines_of(const std::vector<ForceRow>& rows) {
  std::vector<ForcePiece> lines;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_last = i + 1 == rows.size();
    const Quad from = rows[i].share, until = is_last ? 1 + Quad(rows[0].share) : Quad(rows[i + 1].share),
               level = rows[i].after, end = is_last ? rows[0].before : rows[i + 1].before;
    lines.push_back({.from = from, .level = level, .slope = (end - level) / (until - from)});
  }
  return lines;
}

/// The pieces of a period, which may begin before angle 0.
[[nodiscard]] inline std::vector<ForcePiece> pieces_of(const MachineScene& scene) {
  const Quad duty = scene.duty, rise = scene.rise, quarter = 0.25;
  switch (scene.shape) {
    case ForceShape::sine:
      return {{.from = 0, .level = 0, .height = 1, .pace = 1}};
    case ForceShape::square:
      return {{.from = 0, .level = 1}, {.from = duty, .level = -1}};
    case ForceShape::pulse:
      return {{.from = 0, .level = 1}, {.from = duty, .level = 0}};
    case ForceShape::triangle:
      return {{.from = -quarter, .level = -1, .slope = 4}, {.from = quarter, .level = 1, .slope = -4}};
    case ForceShape::trapezoid:
      return {{.from = -rise / 2, .level = -1, .slope = 2 / rise},
              {.from = rise / 2, .level = 1},
              {.from = (1 - rise) / 2, .level = 1, .slope = -2 / rise},
              {.from = (1 + rise) / 2, .level = -1}};
    case ForceShape::sawtooth:
      return {{.from = 0, .level = -1, .slope = 2}};
    case ForceShape::half_sine:
      return {{.from = 0, .level = 0, .height = 1, .pace = 1 / (2 * duty)}, {.from = duty, .level = 0}};
    case ForceShape::table:
      return lines_of(scene.table);
    case ForceShape::orders:
      return {{.from = 0, .level = 0}};
  }
  return {};
}

/// The force f s(nu tau + phase) from an instant until the next at which it jumps or bends, a knot. At a knot it is
/// that of the piece from there on.
class PeriodicForce {
 public:
  explicit PeriodicForce(const MachineScene& scene)
      : size_(scene.forcing), frequency_(scene.frequency), phase_(scene.phase), pieces_(pieces_of(scene)) {
    if (scene.shape == ForceShape::orders) waves_ = scene.waves;
    if (scene.shape == ForceShape::sine || scene.shape == ForceShape::orders) return;
    periods_ = floorq(phase_ / turn_ - pieces_[0].from);
    while (end_of_piece() <= phase_) go_to_next();
    set_knot(), reached(0);
  }

  /// The next knot, tau; infinite: none.
  [[nodiscard]] Quad knot() const { return knot_; }
  /// Takes the force of an instant, and tells this: the next knot instead of one within rounding of it.
  Quad reached(Quad time) {
    for (; knot_ - time <= Quad(1e-30) * std::max(Quad(1), time); go_to_next(), set_knot())
      time = std::max(time, knot_);
    return time;
  }
  /// The fastest rate within the piece.
  [[nodiscard]] Quad rate() const {
    Quad pace = pieces_[piece_].pace;
    for (const ForceWave& wave : waves_) pace = std::max(pace, Quad(wave.order));
    return size_ != 0 ? frequency_ * pace : 0;
  }
  /// Its Taylor series over a step from an instant within the piece, by parts of the step.
  [[nodiscard]] Series series(Quad time, Quad step) const {
    const auto& [from, level, slope, height, pace] = pieces_[piece_];
    const Quad since = frequency_ * time + phase_ - turn_ * (periods_ + from);
    const Quad sine = height != 0 ? sinq(pace * since) : 0, cosine = height != 0 ? cosq(pace * since) : 0;
    const std::array<Quad, 4> derivatives{sine, cosine, -sine, -cosine};
    Series force{};
    Quad factor = size_ * height;  // times (pace nu step)^n / n!
    for (std::size_t n = 0; n < terms && factor != 0; ++n) {
      force[n] = factor * derivatives[n % 4];
      factor *= pace * frequency_ * step / number(n + 1);
    }
    force[0] += size_ * (level + slope * since / turn_);
    force[1] += size_ * slope * frequency_ * step / turn_;
    for (const auto& [order, of_sine, of_cosine] : waves_) {
      const Quad angle = order * (frequency_ * time + phase_), s = sinq(angle), c = cosq(angle);
      const std::array<Quad, 2> even{of_sine * s + of_cosine * c, of_sine * c - of_cosine * s};
      Quad power = size_;
      for (std::size_t n = 0; n < terms; ++n) {
        force[n] += (n % 4 < 2 ? 1 : -1) * power * even[n % 2];
        power *= order * frequency_ * step / number(n + 1);
      }
    }
    return force;
  }
  [[nodiscard]] Quad at(Quad time) const { return series(time, 0)[0]; }

 private:
  /// The angle at which the piece ends.
  [[nodiscard]] Quad end_of_piece() const {
    const bool is_last = piece_ + 1 == pieces_.size();
    return turn_ * (periods_ + (is_last ? 1 + pieces_[0].from : pieces_[piece_ + 1].from));
  }
  void go_to_next() {
    if (++piece_ == pieces_.size()) piece_ = 0, periods_ += 1;
  }
  void set_knot() {
    if (size_ != 0 && frequency_ != 0) knot_ = (end_of_piece() - phase_) / frequency_;
  }

  Quad turn_ = 2 * acosq(-1);
  Quad size_, frequency_, phase_;
  std::vector<ForcePiece> pieces_;
  std::vector<ForceWave> waves_{};
  std::size_t piece_ = 0;  ///< the one that holds
  Quad periods_ = 0;       ///< the period that it is of
  Quad knot_ = std::numeric_limits<double>::infinity();
};

}  // namespace clatter::hard::machine
