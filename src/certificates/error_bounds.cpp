#include "certificates/error_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;
using motion::Jacobian;

/// The norm of (1 - M)^-1: how far the state that returns moves if the motion is off.
double norm_of_return(const Jacobian<double>& m) {
  const Jacobian<double> adjoint{1 - m[3], m[1], m[2], 1 - m[0]};
  const double determinant = (1 - m[0]) * (1 - m[3]) - m[1] * m[2];
  return std::max(1.0, Growth<2>::norm(adjoint) / std::abs(determinant));
}

}  // namespace

ErrorBounds::ErrorBounds(const point::Problem& problem, const RecordedMotion<2>& motion,
                         const point::PointResult& result, double time, bool periodic)
    : Bounds(problem, motion, time,
             std::max({std::abs(result.x_min), std::abs(result.x_max), result.x_max - result.x_min,
                       std::abs(result.v_min), std::abs(result.v_max)}),
             periodic ? norm_of_return(motion.derivative) : 0.0) {}

ErrorBounds::StateError ErrorBounds::error_after(const Map& derivative, const Sizes& rounding, double path) const {
  const double last = of_arithmetic * std::min(size_, path), before = of_arithmetic * size_;
  const auto of = [&](std::size_t i) {
    return of_start() * Growth<2>::row_norm(derivative, i) + last + before * rounding[i];
  };
  return {of(0), of(1)};
}

ClaimedEvent ErrorBounds::claimed(const RecordedEvent<2>& event, const ClaimedEvent* before) const {
  if (event.side == Side::none) {
    const StateError error = error_after(event.derivative, event.rounding, size_);
    return claimed_turn(event, error.x, error.v);
  }
  if (event.lasts()) return claimed_stay(event, before);
  const bool after_rest = before != nullptr && (before->kind == Kind::rest || before->kind == Kind::stick);
  const double since =
      before == nullptr ? event.time : begin_ + event.time - (after_rest ? before->then : before->time).value;
  const StateError error = error_after(event.derivative, event.rounding, size_ * since);
  return claimed_contact(event, error.x, error.v, acceleration_at(event.time, place_of(event), event.velocity()));
}

ClaimedEvent ErrorBounds::claimed_stay(const RecordedEvent<2>& event, const ClaimedEvent* before) const {
  const bool follows = before != nullptr && before->side == event.side;
  const bool after_chatter = follows && before->kind == Kind::chatter;
  const double late = after_chatter                             ? before->then.error
                      : follows && before->kind == Kind::impact ? before->time.error
                                                                : time_error(event.time);
  const double place = place_of(event);
  const double push = std::abs(acceleration_at(event.time, place, event.velocity()));
  const double end = event.kind == Kind::rest
                         ? release_error(event, place, 0.0)
                         : chatter_error(event, before, law_of(stops_, event.side), push, friction_.kinetic);
  return {event.kind, event.side, {begin_ + event.time, late}, {begin_ + event.end(), end}};
}

ClaimedEnd ErrorBounds::claimed_end(const RecordedMotion<2>& motion) const {
  const StateError error = error_after(motion.derivative, motion.rounding, size_);
  return {begin_ + motion.duration, {motion.end.x, error.x}, {motion.end.v, error.v}, {}, {}};
}

/// Two multipliers that are nearly equal move as the root of the change of their sum and product.
std::vector<ClaimedMultiplier> ErrorBounds::claimed(const std::array<std::complex<double>, 2>& multipliers) const {
  const double largest = std::max({1.0, std::abs(multipliers[0]), std::abs(multipliers[1])});
  const double off = of_multiplier * largest * of_start_ * stretching_;
  const double apart = std::abs(multipliers[0] - multipliers[1]);
  const double error = off + std::min(std::sqrt(off * largest), off * largest / apart);
  std::vector<ClaimedMultiplier> claims(2);
  for (std::size_t i = 0; i < 2; ++i) claims[i] = {multipliers[i].real(), multipliers[i].imag(), error};
  return claims;
}

}  // namespace clatter::certificates
