#include "law.hpp"

namespace verify {
namespace {

Rebound with_share(const Ball& R) { return {Dual(-R)}; }

/// The straight line from one knot to the next.
Rebound on_line(const Law::Knot& from, const Law::Knot& to) {
  const Ball rise = (to.R - from.R) / (to.speed - from.speed);
  return {Dual(rise * from.speed - from.R), -rise};
}

Ball share_on_line(const Law::Knot& from, const Law::Knot& to, const Ball& speed) {
  return from.R + (to.R - from.R) / (to.speed - from.speed) * (speed - from.speed);
}

bool is_same(const Ball& a, const Ball& b) { return (a - b).is_zero(); }

}  // namespace

Rebound Law::at(const Ball& v) const {
  const Ball speed = abs(v);
  if (!below.is_zero()) {
    if (speed < below) return with_share(Ball(0));
    if (!(speed > below)) throw Undecided("whether an impact is fast enough to rebound");
  }
  if (!knots.empty()) return on_knots(speed);
  return is_power() ? by_power(speed) : with_share(R);
}

Rebound Law::on_knots(const Ball& speed) const {
  if (speed < knots.front().speed) return with_share(knots.front().R);
  if (speed > knots.back().speed) return with_share(knots.back().R);
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (speed > knots[i - 1].speed && speed < knots[i].speed) return on_line(knots[i - 1], knots[i]);
  throw Undecided("on which side of a knot of the restitution the speed of an impact is");
}

Ball Law::taken_at(const Ball& speed) const {
  if (!speed.is_positive()) throw Undecided("how much speed a slow impact takes");
  return (Ball(1) - R) * exp(*exponent * log(speed / reference));
}

Rebound Law::by_power(const Ball& speed) const {
  const Ball taken = taken_at(speed), most = Ball(1) / (Ball(1) + *exponent);
  if (taken > most) return with_share(*exponent * most);
  if (!(taken < most)) throw Undecided("whether the restitution has fallen to its least");
  return {Dual(-1), Ball(0), Ball(1) - R, *exponent, reference};
}

bool Law::stops_the_slowest() const {
  if (!below.is_zero()) return true;
  if (knots.empty()) return R.is_zero() && !is_power();
  if (!knots.front().R.is_zero()) return false;
  return !knots.front().speed.is_zero() || knots.size() == 1 || knots[1].R.is_zero();
}

Ball Law::shares_up_to(const Ball& speed) const {
  if (stops_the_slowest()) throw Undecided("a chatter on a stop from which slow impacts don't rebound");
  if (is_power()) {
    const Ball least = *exponent / (Ball(1) + *exponent), there = Ball(1) - taken_at(speed);
    return Ball::hull(there > least ? there : least, Ball(1));
  }
  if (knots.empty()) return R;
  Ball all = knots.front().R;
  for (std::size_t i = 1; i < knots.size() && !(knots[i - 1].speed > speed); ++i) {
    const bool ends_before = knots[i].speed > speed;
    all = Ball::hull(all, ends_before ? share_on_line(knots[i - 1], knots[i], speed) : knots[i].R);
  }
  return all;
}

std::optional<Ball> Law::only_share_up_to(const Ball& speed) const {
  if (stops_the_slowest() || is_power()) return std::nullopt;
  if (knots.empty()) return R;
  return speed < knots.front().speed ? std::optional(knots.front().R) : std::nullopt;
}

/// With x = C w^p a rebound at u <= w is followed by one at u (1 - c u^p), with c w^p within x -+ change w, since the
/// speed after an impact grows with that before. Let F(u) = u^(1-p)/(1 - p): then F(u) - F(u - d) is the integral of
/// u^-p, which is convex, so with d = c u^(1+p) it is above c u + p c d/2 (tangent at u), and below the mean of both
/// ends times d. The sums over all rebounds telescope, F to F(w), d to w.
Ball Law::sum_of_rebounds(const Ball& w, const Ball& change) const {
  const Ball &p = *exponent, one(1), x = taken_at(w), off = change * w;
  const Ball least = x - off, most = x + off;
  if (!(taken_at(w + w * off) < one / (one + p)) || !least.is_positive() || !(most < one))
    throw Undecided("whether a chatter ends");
  const Ball rest = exp(-(p + Ball(2)) * log(one - most)) * p * (p + one) / Ball(4);
  const Ball largest = w / (least * (one - p)) - p * w / Ball(2);
  const Ball smallest = w / (most * (one - p)) - (p / Ball(2) + rest * most) * w;
  return Ball::hull(smallest, largest);
}

bool Law::is_like(const Law& other) const {
  if (exponent.has_value() != other.exponent.has_value() || knots.size() != other.knots.size()) return false;
  if (exponent && !(is_same(*exponent, *other.exponent) && is_same(reference, other.reference))) return false;
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (!is_same(knots[i].speed, other.knots[i].speed) || !is_same(knots[i].R, other.knots[i].R)) return false;
  return is_same(below, other.below) && (!knots.empty() || is_same(R, other.R));
}

}  // namespace verify
