#include "extrema.hpp"

#include <optional>
#include <queue>

#include "deadline.hpp"
#include "first_crossing.hpp"

namespace verify {
namespace {

/// The largest of some numbers, of which those below the largest lower bound don't count.
class Largest {
 public:
  void add(const Ball& y) {
    require_known(y);
    if (!best_ || y.lower() > lower_) lower_ = y.lower();
    best_ = !best_ || y.upper() > best_->upper() ? y : *best_;
  }
  /// Adds a number that may not be one of them: none is larger for it.
  void add_bound(const Ball& y) {
    require_known(y);
    if (best_ && y.upper() > best_->upper()) best_ = y;
  }
  [[nodiscard]] bool exceeds(const Ball& y) const { return best_ && y.upper() <= lower_; }
  [[nodiscard]] bool has_any() const { return best_.has_value(); }
  [[nodiscard]] Ball value() const { return Ball::hull(lower_, best_->upper()); }

 private:
  /// What isn't a number is neither above nor below another one, so that the comparisons would pass it over.
  static void require_known(const Ball& y) {
    if (!y.is_finite()) throw Undecided("where the mass is");
  }

  std::optional<Ball> best_;  ///< the one with the largest upper bound
  Ball lower_;                ///< the largest lower bound
};

/// Looks into the parts of a stretch, that with the largest upper bound first.
void search(const Stretch& stretch, const Margin& x, Largest& largest) {
  struct Part {
    Ball from, to, range;
    int depth;
    bool operator<(const Part& other) const { return range.upper() < other.range.upper(); }
  };
  std::priority_queue<Part> parts;
  slong parts_left = 256 + 16 * bits;  // of a wide set of states no part, however short, tells where it turns
  const auto add = [&](const Ball& from, const Ball& to, int depth) {
    const Ball range = Piece(stretch.flight, from, to).range(x, 0);
    if (!largest.exceeds(range)) parts.push({from, to, range, depth});
  };
  // the end of the stretch is only known as a ball, and what lies beyond it bounds the values before it at most
  const Ball& length = stretch.length;
  const auto value_at = [&](const Ball& time) {
    return x.of(stretch.flight.at(time < length ? time : length).x, Ball(0));
  };
  const auto add_range = [&](const Ball& range, const Ball& to) {
    if (to < length)
      largest.add(range);
    else
      largest.add_bound(range);
  };
  add(Ball(0), length.upper(), 0);
  while (!parts.empty()) {
    require_time();
    const Part part = parts.top();
    parts.pop();
    if (largest.exceeds(part.range)) return;
    if (--parts_left < 0) return add_range(part.range, part.to);
    const Piece piece(stretch.flight, part.from, part.to);
    const Ball rate = piece.range(x, 1);
    if (rate.is_positive() || rate.is_negative()) {
      largest.add(value_at(rate.is_positive() ? part.to : part.from));
    } else if (piece.range(x, 2).is_negative()) {  // it is largest where it turns round, or at one of the ends
      const auto turn = turn_of(stretch.flight, x, Ball::hull(part.from, part.to));
      if (turn) add_range(Piece(stretch.flight, turn->lower(), turn->upper()).range(x, 0), turn->upper());
      largest.add(value_at(part.from)), largest.add(value_at(part.to));
    } else if (part.depth > bits) {
      add_range(part.range, part.to);
    } else {
      const Ball middle = ((part.from + part.to) / Ball(2)).middle();
      add(part.from, middle, part.depth + 1), add(middle, part.to, part.depth + 1);
    }
  }
}

}  // namespace

Ball extremum(std::span<const Stretch> stretches, std::span<const Ball> places, int sign) {
  const Margin x{sign, Ball(0), Ball(0), 0};
  Largest largest;
  for (const Ball& place : places) largest.add(x.of(place, Ball(0)));
  for (const Stretch& stretch : stretches)
    for (const Ball& end : {Ball(0), stretch.length}) largest.add(x.of(stretch.flight.at(end).x, Ball(0)));
  for (const Stretch& stretch : stretches) search(stretch, x, largest);
  if (!largest.has_any()) throw Undecided("where the mass is");
  return Ball(sign) * largest.value();
}

}  // namespace verify
