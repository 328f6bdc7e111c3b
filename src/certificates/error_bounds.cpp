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
  if (event.side == Side::none) return claimed_turn(event);
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
  const double end =
      event.kind == Kind::rest ? release_error(event, place_of(event), 0.0) : chatter_error(event, before);
  return {event.kind, event.side, {begin_ + event.time, late}, {begin_ + event.end(), end}};
}

/// The velocity falls to 0 the later the slower it does: a mass that turns back is pushed that way, one that sticks may
/// be pushed on by less than the friction.
ClaimedEvent ErrorBounds::claimed_turn(const RecordedEvent<2>& event) const {
  const StateError error = error_after(event.derivative, event.rounding, size_);
  const double push = std::abs(push_at(event.time, event.place)), mu = friction_.kinetic;
  const bool turns = event.kind == Kind::reversal || push >= mu;
  const double late = error.v / (turns ? push + mu : mu - push) + time_error(event.time);
  ClaimedEvent claim{event.kind, Side::none, {begin_ + event.time, late}, {}, {event.place, error.x}};
  if (event.kind == Kind::stick) claim.then = {begin_ + event.end(), release_error(event, event.place, error.x)};
  return claim;
}

/// The flights of a chatter last S v together, 2 v/(a (1 - R)) without friction (eqs. 24 and 63): its end is off by the
/// error of its first impact and by that of its speed.
double ErrorBounds::chatter_error(const RecordedEvent<2>& event, const ClaimedEvent* before) const {
  const double R = restitution_at<double>(stops_, event.side).share_at_rest();
  double error = of_chatter * event.length + time_error(event.end());
  if (before == nullptr) return error;
  const double push = std::abs(acceleration_at(event.time, place_of(event), event.velocity())),
               up = push + friction_.kinetic, down = push - friction_.kinetic;
  const double flights = (1 / up + 1 / std::sqrt(up * down)) / (1 - R * std::sqrt(down / up));
  return error + before->time.error + R * flights * before->then.error;
}

/// The force that holds the mass falls to 0 the later the slower it changes, and of a stick the further the spring has
/// to be overcome (eq. 65); where nothing releases the mass, the end is that of the motion.
double ErrorBounds::release_error(const RecordedEvent<2>& event, double x, double x_error) const {
  const double force = std::abs(push_at(event.end(), x)) - friction_.static_level;
  const double largest = std::abs(oscillator_.forcing) + std::abs(oscillator_.load) +
                         std::abs(oscillator_.stiffness * x) + friction_.static_level;
  const double rate =
      std::abs(oscillator_.forcing * oscillator_.frequency * std::cos(oscillator_.frequency * event.end() + phase_));
  if (!(std::abs(force) <= of_chatter * largest)) return time_error(event.end());
  return time_error(event.end()) + (of_state * largest + stiffness_at(x) * x_error) / rate;
}
/// The force on a mass at x' = 0, and the stiffness that acts on it, those of a soft stop included.
double ErrorBounds::push_at(double time, double x) const {
  double push = oscillator_.forcing * std::sin(oscillator_.frequency * time + phase_) + constant_force(oscillator_, x);
  if (const Side within = soft_stop_beyond(stops_, x); within != Side::none) {
    const auto stop = motion::soft_stop_at<double>(stops_, within);
    push -= stop.stiffness * (x - stop.position);
  }
  return push;
}
double ErrorBounds::stiffness_at(double x) const {
  const Side within = soft_stop_beyond(stops_, x);
  const double k = std::abs(oscillator_.stiffness);
  return within == Side::none ? k : k + motion::soft_stop_at<double>(stops_, within).stiffness;
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
