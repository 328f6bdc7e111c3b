#pragma once

#include <optional>
#include <span>

#include "machine_flight.hpp"

namespace verify {

/// A quantity that stays positive until an event: sign (x + q v - place), or sign v; of a loose mass sign (z - place),
/// or the force of a wall.
struct Margin {
  int sign;
  Ball place, q;
  int vanishing = 0;  ///< of it and its derivatives the first so many are exactly 0 at the start; the next is positive
  bool of_velocity = false;
  Of which = Of::main;

  [[nodiscard]] Ball of(const Ball& x, const Ball& v) const {
    if (of_velocity) return Ball(sign) * v;
    return Ball(sign) * (q.is_zero() ? x - place : x + q * v - place);
  }
  [[nodiscard]] Ball at(const Moment& moment) const { return of(moment.of(which).x, moment.of(which).v); }
  /// Its rate, or the next derivatives.
  [[nodiscard]] Ball rate(const Moment& moment) const { return derivative(moment.of(which).v, moment.of(which).a); }
  [[nodiscard]] Ball bend(const Moment& moment) const { return derivative(moment.of(which).a, moment.of(which).j); }
  /// A derivative of it, from those of the displacement of the same order and the next.
  [[nodiscard]] Ball derivative(const Ball& y, const Ball& next) const {
    if (of_velocity) return Ball(sign) * next;
    return Ball(sign) * (q.is_zero() ? y : y + q * next);
  }
};

/// A flight between two instants, by Taylor's theorem about their middle.
class Piece {
 public:
  Piece(const MachineFlight& flight, const Ball& from, const Ball& to);

  /// All values in the piece of a margin or of its derivative of some order, 0 ... 3.
  [[nodiscard]] Ball range(const Margin& margin, int order) const;

 private:
  Moment middle_, all_;
  Ball step_, half_square_, sixth_cube_;  ///< the powers of the time from the middle
};

/// The crossing of one margin, which every motion makes exactly once between two instants.
struct Crossing {
  std::size_t margin;
  Ball from, to;
};

/// The first margin to fall to 0 within a time, with proof that none does so before, for all motions of the flight's
/// balls; nothing if none falls to 0 in that time. `rate` is the greatest at which motion changes, for the choice of a
/// step. Throws Undecided if two come too near to each other, or one to 0.
[[nodiscard]] std::optional<Crossing> first_crossing(double rate, const MachineFlight& flight,
                                                     std::span<const Margin> margins, const Ball& horizon);

/// The instant between two others at which a margin turns round, whose second derivative has one sign there; nothing if
/// it doesn't turn.
[[nodiscard]] std::optional<Ball> turn_of(const MachineFlight& flight, const Margin& margin, const Ball& between);

/// The instant of a crossing that lies between two instants, by Newton's method in balls.
[[nodiscard]] Ball instant_of(const MachineFlight& flight, const Margin& margin, const Ball& between);

}  // namespace verify
