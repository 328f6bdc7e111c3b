#pragma once

#include <optional>
#include <span>

#include "flow.hpp"

namespace verify {

/// A quantity that stays positive until an event: sign (x + q v - place), or sign v.
struct Margin {
  int sign;
  Ball place, q;
  int vanishing = 0;  ///< of it and its derivatives the first so many are exactly 0 at the start; the next is positive
  bool of_velocity = false;

  [[nodiscard]] Ball of(const Ball& x, const Ball& v) const {
    if (of_velocity) return Ball(sign) * v;
    return Ball(sign) * (q.is_zero() ? x - place : x + q * v - place);
  }
  /// A derivative of it, from those of the displacement of the same order and the next.
  [[nodiscard]] Ball derivative(const Ball& y, const Ball& next) const {
    if (of_velocity) return Ball(sign) * next;
    return Ball(sign) * (q.is_zero() ? y : y + q * next);
  }
};

/// A function of time with four derivatives between two instants, by Taylor's theorem about their middle: a flight, or
/// anything else that is given `at` an instant.
class Piece {
 public:
  template <class Flight>
  Piece(const Flight& flight, const Ball& from, const Ball& to)
      : middle_(flight.at(((from + to) / Ball(2)).middle())), all_(flight.at(Ball::hull(from, to))) {
    set_steps(from, to);
  }

  /// All values in the piece of a margin or of its derivative of some order, 0 ... 3.
  [[nodiscard]] Ball range(const Margin& margin, int order) const;

 private:
  void set_steps(const Ball& from, const Ball& to);

  Flow::Instant middle_, all_;
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
template <class Flight>
[[nodiscard]] std::optional<Crossing> first_crossing(double rate, const Flight& flight, std::span<const Margin> margins,
                                                     const Ball& horizon);

/// The instant between two others at which a margin turns round, whose second derivative has one sign there; nothing if
/// it doesn't turn.
[[nodiscard]] std::optional<Ball> turn_of(const Flow::Flight& flight, const Margin& margin, const Ball& between);

/// The instant of a crossing that lies between two instants, by Newton's method in balls.
template <class Flight>
[[nodiscard]] Ball instant_of(const Flight& flight, const Margin& margin, const Ball& between);

}  // namespace verify
