#include "certificates/housing_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "branches/equations/linear_system.hpp"
#include "motion/linear_maps.hpp"

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;
using Map = Growth<4>::Map;
using Sizes = Growth<4>::Sizes;

/// (1 - M)^-1 b; nothing if there is no inverse.
std::optional<branches::Vector> returned(const Map& map, const branches::Vector& b) {
  branches::Matrix left(4, 4);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) left(i, j) = (i == j ? 1.0 : 0.0) - map[4 * i + j];
  return branches::solve(left, b);
}

/// The norm of (1 - M)^-1: how far the state that returns moves if the motion is off.
double norm_of_return(const Map& map) {
  Sizes rows{};
  for (std::size_t j = 0; j < 4; ++j) {
    branches::Vector unit(4, 0.0);
    unit[j] = 1.0;
    const auto column = returned(map, unit);
    if (!column) return std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) rows[i] += std::abs((*column)[i]);
  }
  return std::max(1.0, *std::ranges::max_element(rows));
}

/// The most that the walls and the way of the main mass let a loose mass move, and what is seen of its speed.
double size_of(const point::PointResult& result, const LooseMass& loose, const RecordedMotion<4>& motion) {
  double size =
      std::max({std::abs(result.x_min), std::abs(result.x_max), result.x_max - result.x_min, std::abs(result.v_min),
                std::abs(result.v_max), result.z_max - result.z_min, std::abs(motion.end.w), std::abs(loose.velocity)});
  for (const RecordedEvent<4>& event : motion.events) size = std::max(size, event.speed());
  return size;
}

}  // namespace

HousingBounds::HousingBounds(const point::Problem& problem, const RecordedMotion<4>& motion,
                             const point::PointResult& result, double time, bool periodic)
    : Bounds(problem, motion, time, size_of(result, problem.loose, motion),
             periodic ? norm_of_return(motion.derivative) : 0.0),
      loose_(problem.loose),
      duration_(motion.duration) {}

Sizes HousingBounds::error_after(const Map& derivative, const Sizes& rounding) const {
  Sizes error{};
  for (std::size_t i = 0; i < 4; ++i)
    error[i] = of_start() * Growth<4>::row_norm(derivative, i) + of_arithmetic * size_ * (1 + rounding[i]);
  return error;
}

motion::Event::Main HousingBounds::main_at(const RecordedEvent<4>& event) {
  return event.of_wall ? event.main : motion::Event::Main{event.place, event.before, event.after};
}

double HousingBounds::acceleration(const RecordedEvent<4>& event, double time, bool pressed) const {
  const auto [x, v, after] = main_at(event);
  double a = acceleration_at(time, x, v);
  if (const auto within = motion::known_soft_stop_around(stops_, x, v); within.pressed) {
    const auto stop = motion::known_soft_stop(stops_, within.side);
    a -= stop.stiffness * within.offset + 2 * stop.damping * v;
  }
  return pressed ? (a + loose_.ratio * loose_.load) / (1 + loose_.ratio) : a;
}

ClaimedEvent HousingBounds::claimed_by_load(const RecordedEvent<4>& event, const ClaimedEvent* before) const {
  const Sizes error = error_after(event.derivative, event.rounding);
  if (event.is_of_loose_friction()) return claimed_in_housing(event, before);
  if (event.side == Side::none) return claimed_turn(event, error[0], error[1]);
  if (event.lasts()) return claimed_stay(event, before);
  if (event.of_wall) {  // the instant at which z reaches a wall
    const double force = std::abs(loose_.load - acceleration(event));
    return claimed_contact(event, error[2], event.velocity(), error[3], force);
  }
  const ClaimedEvent alone = claimed_contact(event, error[0], error[1], acceleration(event));
  if (before == nullptr || !is_cut(*before, alone)) return alone;
  return claimed_contact(event, error[0], error[1], acceleration(event, true));
}

/// z' falls to 0 the later the slower it does; a hold that an event of the main mass begins has its time.
ClaimedEvent HousingBounds::claimed_in_housing(const RecordedEvent<4>& event, const ClaimedEvent* before) const {
  const bool turns = event.kind == Kind::reversal;
  const Sizes error =
      turns ? error_after(event.derivative, event.rounding) : error_after(event.stop, event.rounding_at_stop);
  ClaimedEvent claim{
      event.kind, Side::none, {begin_ + event.time, time_error(event.time)}, {}, {event.place, error[2]}};
  claim.of_wall = true;
  if (event.a_before != 0)
    claim.time.error += error[3] / std::abs(event.a_before);
  else if (before != nullptr)
    claim.time.error = before->time.error, claim.place.error = error_after(event.derivative, event.rounding)[2];
  if (!turns) claim.then = {begin_ + event.end(), release_error(event)};
  return claim;
}

ClaimedEvent HousingBounds::claimed_stay(const RecordedEvent<4>& event, const ClaimedEvent* before) const {
  ClaimedEvent claim{event.kind, event.side, {begin_ + event.time, time_error(event.time)}, {begin_ + event.end(), 0}};
  claim.of_wall = event.of_wall;
  if (before != nullptr) claim.time.error = before->kind == Kind::chatter ? before->then.error : before->time.error;
  if (event.kind == Kind::rest) {
    claim.then.error = event.of_wall ? release_error(event) : Bounds::release_error(event, place_of(event), 0.0);
    return claim;
  }
  const auto law = event.of_wall ? motion::WallRule<double>(loose_).law(event.side) : law_of(stops_, event.side);
  const double push =
      event.of_wall ? std::abs(loose_.load - acceleration(event)) : std::abs(push_at(event.time, place_of(event)));
  claim.then.error = chatter_error(event, before, law, push, event.of_wall ? 0.0 : friction_.kinetic);
  return claim;
}

/// x'' of both masses as one reaches the acceleration at which the loose one is let go the later, the slower it changes
/// (eqs. 72 and 81); a press, or a hold, may go on to the end of the motion.
double HousingBounds::release_error(const RecordedEvent<4>& event) const {
  constexpr double same = 1e-12;
  if (event.end() >= duration_ * (1 - same)) return time_error(event.end());
  const Sizes error = error_after(event.derivative, event.rounding);
  const auto& [place, v, after] = event.main;
  double h = oscillator_.damping, k = oscillator_.stiffness, forces = std::abs(oscillator_.load);
  if (const auto within = motion::known_soft_stop_around(stops_, place, v); within.pressed) {
    const auto stop = motion::known_soft_stop(stops_, within.side);
    h += stop.damping, k += stop.stiffness, forces += std::abs(stop.stiffness * stop.position);
  }
  const double nu = oscillator_.frequency, both = 1 + loose_.ratio;
  const double a = acceleration(event, event.end(), true);
  const double jerk = std::abs(nu * force_at(event.end()).slope - 2 * h * a - k * v) / both;
  forces += std::abs(oscillator_.forcing) + 2 * h * std::abs(v) + std::abs(k * place) + loose_.friction_static;
  const double of_force =
      2 * h * error[1] + std::abs(k) * error[0] + of_arithmetic * (forces / both + std::abs(loose_.load));
  return time_error(event.end()) + of_force / jerk;
}

ClaimedEnd HousingBounds::claimed_end(const RecordedMotion<4>& motion) const {
  const Sizes error = error_after(motion.derivative, motion.rounding);
  const MachineState& end = motion.end;
  const bool pressed = end.pressed_by != Side::none;
  return {begin_ + motion.duration,
          {end.x, error[0]},
          {end.v, error[1]},
          {end.z, pressed ? 0 : error[2]},
          {end.w, pressed ? 0 : error[3]}};
}

std::vector<ClaimedMultiplier> HousingBounds::claimed_multipliers(const RecordedMotion<4>& motion,
                                                                  const point::PointResult& result) const {
  constexpr int changes = 8;
  const double off = of_multiplier * of_start_ * stretching_;
  const std::size_t rows = motion.end.pressed_by == Side::none ? 4 : 2;  // of a press the others are 0
  std::vector<ClaimedMultiplier> claims(4);
  for (std::size_t i = 0; i < 4; ++i)
    claims[i] = {result.multiplier_re[i], result.multiplier_im[i], i < rows ? off : 0};
  for (int change = 0; change < changes; ++change) {
    motion::LooseJacobian map{};
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < rows; ++j) {
        const bool up = (static_cast<unsigned>(change) * 0x9e3779b9u >> (4 * i + j)) % 2 == 0;
        map[i][j] = motion.derivative[4 * i + j] + (up ? off : -off);
      }
    const auto others = motion::multipliers_of(map);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::complex<double> own(claims[i].re, claims[i].im);
      const auto distance = [&](const std::complex<double>& other) { return std::abs(other - own); };
      claims[i].error = std::max(claims[i].error, 4 * distance(*std::ranges::min_element(others, {}, distance)));
    }
  }
  return claims;
}

std::optional<MachineState> step_to_return(const MachineState& start, const RecordedMotion<4>& motion) {
  const bool pressed = start.pressed_by != Side::none;
  branches::Vector off{motion.end.x - start.x, motion.end.v - start.v, motion.end.z - start.z, motion.end.w - start.w};
  if (pressed) off[2] = off[3] = 0.0;
  const auto by = returned(motion.derivative, off);
  if (!by) return std::nullopt;
  MachineState there = start;
  there.x += (*by)[0], there.v += (*by)[1];
  if (!pressed) there.z += (*by)[2], there.w += (*by)[3];
  return there;
}

}  // namespace clatter::certificates
