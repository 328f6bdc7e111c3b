#include "first_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "deadline.hpp"

namespace verify {

Piece::Piece(const MachineFlight& flight, const Ball& from, const Ball& to)
    : middle_(flight.at(((from + to) / Ball(2)).middle())), all_(flight.at(Ball::hull(from, to))) {
  step_ = Ball::hull(from, to) - ((from + to) / Ball(2)).middle();
  const Ball half = abs(step_).upper(), half_of_square = half * half / Ball(2);
  half_square_ = Ball::hull(Ball(0), half_of_square);
  sixth_cube_ = Ball::around_zero(half_of_square * half / Ball(3));
}

Ball Piece::range(const Margin& margin, int order) const {
  const Flow::Instant &m = middle_.of(margin.which), &all = all_.of(margin.which);
  const Ball third = margin.derivative(all.j, all.d4);
  switch (order) {
    case 0:
      return margin.of(m.x, m.v) + step_ * margin.derivative(m.v, m.a) + half_square_ * margin.derivative(m.a, m.j) +
             sixth_cube_ * third;
    case 1:
      return margin.derivative(m.v, m.a) + step_ * margin.derivative(m.a, m.j) + half_square_ * third;
    case 2:
      return margin.derivative(m.a, m.j) + step_ * third;
    default:
      return third;
  }
}

namespace {

/// What a piece of a flight does to a margin that is positive where it begins, or vanishes there.
enum class Clearance { clear, crosses, unknown };

Clearance clearance_of(const Piece& piece, const MachineFlight& flight, const Margin& margin, bool begins,
                       const Ball& to) {
  if (begins && margin.vanishing > 0)
    return piece.range(margin, margin.vanishing).is_positive() ? Clearance::clear : Clearance::unknown;
  if (piece.range(margin, 0).is_positive()) return Clearance::clear;
  const Ball rate = piece.range(margin, 1);
  if (rate.is_positive()) return Clearance::clear;
  if (!rate.is_negative()) return Clearance::unknown;
  const Ball value = margin.at(flight.at(to));
  return value.is_positive() ? Clearance::clear : value.is_negative() ? Clearance::crosses : Clearance::unknown;
}

/// A step for the first piece: half of a short flight, if the first derivatives tell of one.
Ball first_step(double fastest, const MachineFlight& flight, std::span<const Margin> margins) {
  double step = 0.5 / fastest;
  const Moment start = flight.at(Ball(0));
  for (const Margin& margin : margins) {
    if (margin.vanishing != 1) continue;
    const double rate = margin.rate(start).near(), bend = margin.bend(start).near();
    if (bend < 0 && rate > 0) step = std::min(step, -0.8 * rate / bend);
  }
  return Ball(step);
}

}  // namespace

std::optional<Crossing> first_crossing(double fastest, const MachineFlight& flight, std::span<const Margin> margins,
                                       const Ball& horizon) {
  if (!horizon.is_finite()) throw Undecided("how long a flight lasts");
  const Ball end = horizon.upper(), longest(2 / fastest);
  Ball from(0), step = first_step(fastest, flight, margins);
  const double most_pieces = std::min(8.0 * static_cast<double>(bits) + 16 * fastest * end.near(), 1e6);
  int halvings = 0;
  for (double pieces = 0; from < end; ++pieces) {
    require_time();
    if (!(pieces < most_pieces)) throw Undecided("which event comes first, in balls as wide as these");
    Ball to = (from + step).middle();
    if (!(to < end)) to = end;
    const Piece piece(flight, from, to);
    std::optional<std::size_t> crosses;
    bool known = true;
    for (std::size_t i = 0; i < margins.size() && known; ++i) {
      const Clearance clearance = clearance_of(piece, flight, margins[i], from.is_zero(), to);
      known = clearance == Clearance::clear || (clearance == Clearance::crosses && !crosses);
      if (clearance == Clearance::crosses) crosses = i;
    }
    if (known && crosses) return Crossing{*crosses, from, to};
    if (known) {
      from = to, halvings = 0;
      step = smaller(step + step, longest);
      continue;
    }
    if (++halvings > bits) throw Undecided("which event comes first, or whether a stop is met at all");
    step = ((to - from) / Ball(2)).middle();
  }
  return std::nullopt;
}

std::optional<Ball> turn_of(const MachineFlight& flight, const Margin& margin, const Ball& between) {
  Ball now = between;
  for (int iteration = 0; iteration < 64; ++iteration) {
    const Ball bend = Piece(flight, now.lower(), now.upper()).range(margin, 2), middle = now.middle();
    if (!bend.is_negative() && !bend.is_positive()) break;
    const Ball newton = middle - margin.rate(flight.at(middle)) / bend;
    if (!newton.overlaps(now)) return std::nullopt;
    const Ball next = now.within(newton);
    const bool done = next.radius() > 0.5 * now.radius();
    now = next;
    if (done) break;
  }
  return now;
}

Ball instant_of(const MachineFlight& flight, const Margin& margin, const Ball& between) {
  Ball now = between, guess = between.middle();
  Moment there = flight.at(guess);
  for (int iteration = 0; iteration < 8 && now.radius() > 1e-6; ++iteration) {  // no proof depends on where this leads
    const Ball step = margin.at(there) / margin.rate(there), next = (guess - step).middle();
    if (!next.is_finite() || !next.overlaps(now)) break;
    guess = next, there = flight.at(guess);
    if (std::abs(step.near()) < 1e-9) break;
  }
  for (int iteration = 0; iteration < 64; ++iteration) {
    const Ball rate = Piece(flight, now.lower(), now.upper()).range(margin, 1);
    if (!rate.is_negative() && !rate.is_positive()) throw Undecided("the time of an event that is nearly a graze");
    const Ball next = now.within(guess - margin.at(there) / rate);
    const double rounding = std::ldexp(std::abs(next.near()), 4 - static_cast<int>(bits));
    const bool done = next.radius() > 0.5 * now.radius() || next.radius() <= rounding;
    now = next;
    if (done) break;
    guess = now.middle(), there = flight.at(guess);
  }
  return now;
}

}  // namespace verify
