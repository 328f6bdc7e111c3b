#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "math/number.hpp"

namespace clatter {
inline namespace scene {

/// Restitution as it was measured at some speeds: straight lines between them, constant beyond.
struct SpeedTable {
  struct Knot {
    double speed;  ///< >= 0, rising
    double R;      ///< 0 ... 1
    friend bool operator==(const Knot&, const Knot&) = default;
  };
  std::vector<Knot> knots;  ///< at least one

  friend bool operator==(const SpeedTable&, const SpeedTable&) = default;
};

/// A table that lasts as long as the program, the same one for equal tables: scenes are copied often, and by all
/// threads.
[[nodiscard]] const SpeedTable* kept(const SpeedTable& table);

/// Newton's law of restitution (eq. 4) with a share of the speed that is left, for every number type; SIMD lanes take
/// it from here.
template <class Number>
struct ConstantRestitution {
  Number R;  ///< 0 ... 1

  /// Velocity after an impact: 0 - R v rather than -R v, so that R = 0 leaves no negative zero.
  [[nodiscard]] Number after(const Number& before) const { return Number(0) - R * before; }
  /// Change of the velocity by an impact.
  [[nodiscard]] Number jump(const Number& before) const { return -(Number(1) + R) * before; }
  /// Energy that an impact takes, per unit mass.
  [[nodiscard]] Number lost(const Number& before) const { return (1 - R) * (1 + R) * before * before / 2; }
};

/// The law of restitution of a stop: the loop and its derivative, the general methods and all bounds take it from here.
/// R is a number, or depends on the speed v of the impact: by a table, or as that of viscoelastic bodies
/// 1 - (1 - R) (v/V)^p (eq. 86), and below a speed nothing rebounds.
template <class Number>
struct Restitution {
  Number R{1.0};                     ///< 0 ... 1; at the speed V
  Number exponent{0.0};              ///< p, 0 ... 1; 0: R is the same at each speed
  Number reference{1.0};             ///< V > 0
  Number below{0.0};                 ///< the speed below which nothing rebounds, >= 0
  const SpeedTable* table{nullptr};  ///< in place of R, one that is `kept`; its speeds are in
  Number unit{1.0};                  ///< this unit

  Restitution() = default;
  /// The same R at each speed.
  Restitution(const Number& constant) : R(constant) {}
  template <class Other>
  explicit Restitution(const Restitution<Other>& other)
      : R(other.R),
        exponent(other.exponent),
        reference(other.reference),
        below(other.below),
        table(other.table),
        unit(other.unit) {}

  /// Whether R is the same at each speed.
  [[nodiscard]] bool is_constant() const {
    return table == nullptr && is_always_zero(exponent) && is_always_zero(below);
  }
  /// The share of the speed that an impact leaves.
  [[nodiscard]] Number share(const Number& before) const {
    using std::abs;
    return is_constant() ? R : piece_at(Number(abs(before))).share;
  }
  /// That of the slowest impacts, to which the flights of a chatter tend.
  [[nodiscard]] Number share_at_rest() const {
    if (is_constant()) return R;
    if (below > 0) return Number(0);
    if (table != nullptr) return Number(table->knots.front().R);
    return R < 1 ? Number(1) : R;
  }
  /// Whether the slowest impacts take speed, so that flights on a stop that presses the mass become ever shorter.
  [[nodiscard]] bool loses() const { return share_at_rest() < 1 || is_power(); }
  /// Whether impacts of some speed take energy.
  [[nodiscard]] bool takes_energy() const {
    if (!(share_at_rest() >= 1) || is_power()) return true;
    if (table != nullptr)
      for (const SpeedTable::Knot& knot : table->knots)
        if (knot.R < 1) return true;
    return false;
  }
  /// Whether R tends to 1 with the speed, so that the speeds of a chatter fall more slowly than those of a series.
  [[nodiscard]] bool is_power() const { return table == nullptr && !(below > 0) && exponent > 0 && R < 1; }

  [[nodiscard]] Number after(const Number& before) const {
    return ConstantRestitution<Number>{share(before)}.after(before);
  }
  [[nodiscard]] Number jump(const Number& before) const {
    return ConstantRestitution<Number>{share(before)}.jump(before);
  }
  [[nodiscard]] Number lost(const Number& before) const {
    return ConstantRestitution<Number>{share(before)}.lost(before);
  }
  /// Derivative of the velocity after by the velocity before; on a corner of the law that of faster impacts.
  [[nodiscard]] Number derivative(const Number& before) const {
    using std::abs;
    return is_constant() ? Number(-R) : Number(-piece_at(Number(abs(before))).slope);
  }

  /// A bound of the second derivative of the speed after by speeds between two, both > 0; nothing if the law has a
  /// corner or a jump there.
  [[nodiscard]] std::optional<Number> bend(const Number& slowest, const Number& fastest) const {
    using std::abs;
    if (is_constant()) return Number(0);
    if (!(slowest > 0) || (slowest < below && below <= fastest)) return std::nullopt;
    const Piece piece = piece_at(slowest);
    if (fastest >= piece.end) return std::nullopt;
    return abs(piece.bend);
  }

  /// How R depends on the lowest speeds: share_at_rest() + slope v below `end`; by a power law for none.
  struct AtRest {
    Number slope, end;
  };
  [[nodiscard]] AtRest at_rest() const {
    const Number everywhere(std::numeric_limits<double>::infinity());
    if (below > 0) return {Number(0), below};
    if (table == nullptr) return {Number(0), everywhere};
    const Piece piece = piece_at(Number(0));
    return {piece.bend / 2, piece.end};
  }

  /// Counts speeds in another unit, in which each is so many times its number.
  template <class Factor>
  void scale_speeds(const Factor& factor) {
    for (Number* const speed : {&below, &reference, &unit}) *speed = *speed * factor;
  }

  friend bool operator==(const Restitution&, const Restitution&) = default;

 private:
  /// The law near a speed.
  struct Piece {
    Number share;                                         ///< R
    Number slope;                                         ///< of the speed after, R + v dR/dv
    Number bend{0.0};                                     ///< its second derivative: largest where it begins
    Number end{std::numeric_limits<double>::infinity()};  ///< a corner or a jump: the next faster one
  };

  [[nodiscard]] Piece piece_at(const Number& speed) const {
    if (speed < below) return {Number(0), Number(0), Number(0), below};
    if (table != nullptr) return piece_of_table(speed);
    if (is_always_zero(exponent)) return {R, R};
    return piece_of_power(speed);
  }
  [[nodiscard]] Piece piece_of_table(const Number& speed) const {
    const auto& knots = table->knots;
    const Number v = speed / unit;
    std::size_t next = 0;
    while (next < knots.size() && Number(knots[next].speed) <= v) ++next;
    const Number R_next(next < knots.size() ? knots[next].R : knots.back().R);
    const Number end = next < knots.size() ? Number(Number(knots[next].speed) * unit)
                                           : Number(std::numeric_limits<double>::infinity());
    if (next == 0 || next == knots.size()) return {R_next, R_next, Number(0), end};
    const Number from(knots[next - 1].speed), R_from(knots[next - 1].R);
    const Number rise = (R_next - R_from) / (Number(knots[next].speed) - from), share = R_from + rise * (v - from);
    return {share, share + rise * v, 2 * rise / unit, end};
  }
  /// 1 - (1 - R) (v/V)^p down to p/(1 + p), at which the speed after would begin to fall with that before.
  [[nodiscard]] Piece piece_of_power(const Number& speed) const {
    using std::exp, std::log;
    const Number &p = exponent, most = 1 / (1 + p);
    if (speed == 0) return {exponent > 0 && R < 1 ? Number(1) : R, Number(1)};
    const Number taken = (1 - R) * exp(p * log(Number(speed / reference)));
    if (!(taken < most)) return {1 - most, 1 - most};
    const Number end = R < 1 ? Number(reference * exp(log(Number(most / (1 - R))) / p))
                             : Number(std::numeric_limits<double>::infinity());
    return {1 - taken, 1 - (1 + p) * taken, p * (1 + p) * taken / speed, end};
  }
};

}  // namespace scene
}  // namespace clatter
