#include "attractors/tracked_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/number.hpp"
#include "scene/creep.hpp"

namespace clatter::attractors {
namespace {

/// A problem whose parameters lie between those of two others, at a share 0 ... 1 of the way.
point::Problem between(const point::Problem& from, const point::Problem& to, double share) {
  point::Problem problem = to;
  const auto mix = [share](double a, double b) { return a == b ? b : a + share * (b - a); };
  const auto mix_laws = [&](const Restitution<double>& a, const Restitution<double>& b) {
    Restitution<double> law = b;
    law.R = mix(a.R, b.R), law.exponent = mix(a.exponent, b.exponent), law.reference = mix(a.reference, b.reference);
    law.below = mix(a.below, b.below), law.unit = mix(a.unit, b.unit);
    return law;
  };
  const auto mix_motions = [&](const StopMotion& a, const StopMotion& b) -> StopMotion {
    return {mix(a.amplitude, b.amplitude), mix(a.phase, b.phase)};
  };
  const Oscillator &a = from.oscillator, &b = to.oscillator;
  Oscillator& o = problem.oscillator;
  o.damping = mix(a.damping, b.damping), o.forcing = mix(a.forcing, b.forcing);
  o.frequency = mix(a.frequency, b.frequency), o.load = mix(a.load, b.load);
  o.stiffness = mix(a.stiffness, b.stiffness);
  o.shape = {b.shape.waveform, mix(a.shape.duty, b.shape.duty), mix(a.shape.rise, b.shape.rise), b.shape.table};
  for (std::size_t i = 0; i < o.shape.orders.of.size(); ++i) {
    const auto &one = a.shape.orders.of[i], &other = b.shape.orders.of[i];
    o.shape.orders.of[i] = {mix(one.in_phase, other.in_phase), mix(one.quadrature, other.quadrature)};
  }
  problem.friction = {mix(from.friction.kinetic, to.friction.kinetic),
                      mix(from.friction.static_level, to.friction.static_level)};
  problem.stops = {mix(from.stops.lower, to.stops.lower),
                   mix(from.stops.upper, to.stops.upper),
                   mix_laws(from.stops.restitution_lower, to.stops.restitution_lower),
                   mix_laws(from.stops.restitution_upper, to.stops.restitution_upper),
                   mix(from.stops.stiffness_lower, to.stops.stiffness_lower),
                   mix(from.stops.stiffness_upper, to.stops.stiffness_upper),
                   mix(from.stops.damping_lower, to.stops.damping_lower),
                   mix(from.stops.damping_upper, to.stops.damping_upper),
                   mix_motions(from.stops.motion_lower, to.stops.motion_lower),
                   mix_motions(from.stops.motion_upper, to.stops.motion_upper)};
  o.paces_stops = move_by_themselves(problem.stops);
  const LooseMass &one = from.loose, &other = to.loose;
  problem.loose = {.ratio = mix(one.ratio, other.ratio),
                   .lower = mix(one.lower, other.lower),
                   .upper = mix(one.upper, other.upper),
                   .restitution_lower = mix_laws(one.restitution_lower, other.restitution_lower),
                   .restitution_upper = mix_laws(one.restitution_upper, other.restitution_upper),
                   .load = mix(one.load, other.load),
                   .friction = mix(one.friction, other.friction),
                   .friction_static = mix(one.friction_static, other.friction_static)};
  return problem;
}

/// Where a mass that stands still does so at other parameters: on its stop, or in equilibrium; a loose one on its wall.
SectionState place_of_rest(const point::Problem& from, const point::Problem& to, SectionState state) {
  Oscillator both = to.oscillator;
  both.load += to.loose.ratio * to.loose.load;
  state.x = state.x == from.stops.lower   ? to.stops.lower
            : state.x == from.stops.upper ? to.stops.upper
                                          : equilibrium_of(both);
  if (state.z == from.loose.lower) state.z = to.loose.lower;
  if (state.z == from.loose.upper) state.z = to.loose.upper;
  return state;
}

}  // namespace

TrackedMotion::TrackedMotion(const point::Problem& problem, const Motion& motion)
    : at_(problem), state_(motion.state), periods_(motion.periods()), symmetric_(motion.symmetric) {
  sticks_ = motion.sticks, creeps_to_ = motion.creeps_to;
  floats_ = motion.floats || (motion.periodic && motion.periodic->floats);
  if (floats_) at_ = floating(problem);
  if (!motion.periodic) return;
  const PeriodicMotion& periodic = *motion.periodic;
  word_ = periodic.word, size_ = periodic.size;
  state_ = periodic.cycle[static_cast<std::size_t>(periodic.middle_of_flight)];
  phase_turns_ = periodic.middle_of_flight - std::floor(periodic.middle_of_flight);
  if (!has_loose_mass(at_.loose)) state_.z = state_.w = 0;
  if (sticks_ || !is_driven(problem.oscillator) || phase_turns_ == 0) return;
  const auto there = state_after(started(at_, state_, 0.0), phase_turns_);
  lost_ = !there;
  if (there) state_ = *there;
}

bool TrackedMotion::follow(const point::Problem& next) {
  if (lost_) return false;
  const point::Problem to = floats_ ? floating(next) : next;
  bool followed = true;
  if (sticks_) {  // perhaps elsewhere in its band
    if (!stands_for_good(to, state_)) state_.x = equilibrium_of(to.oscillator);
    followed = stands_for_good(to, state_);
  } else if (creeps_to_ != Side::none) {
    state_.x = edge_of_band(to, creeps_to_, state_.x).value_or(state_.x);
    followed = band_edge_at(to, state_.x) == creeps_to_;
  } else if (floats_ && !may_float(next)) {
    followed = false;
  } else if (!is_driven(to.oscillator) || !is_driven(at_.oscillator)) {
    followed = is_driven(to.oscillator) == is_driven(at_.oscillator);
    state_ = place_of_rest(at_, to, state_);
  } else if (is_periodic()) {
    followed = follow_periodic(to);
  } else {
    auto sections =
        run_sections(started(to, moved_inside(started(to, state_, 0.0), state_), 0.0), VisitedCells::long_look);
    followed = sections && sections->repeats_after == 0;
    if (followed) {
      state_ = sections->states.back();
      states_ = sections->states;
      if (floats_) forget_places(states_);
    }
  }
  at_ = to;
  return followed;
}

bool TrackedMotion::follow_periodic(const point::Problem& to) {
  constexpr double shortest = 1.0 / 64;
  const point::Problem from = at_;
  double done = 0.0;
  for (double step = 1.0; done < 1.0;) {
    const double next = std::min(1.0, done + step);
    const TrackedMotion before = *this;
    if (correct(next == 1.0 ? to : between(from, to, next))) {
      done = next, step *= 2;
      continue;
    }
    *this = before, step /= 2;
    if (step < shortest) return false;
  }
  return true;
}

/// Newton's method from the present state, at other parameters. Its first step is the prediction by the derivative of
/// the stroboscopic map; each further one must be much shorter.
bool TrackedMotion::correct(const point::Problem& problem) {
  constexpr int most_iterations = 8;
  const double phase = 2 * pi<double>() * phase_turns_, enough = 1e-11 * size_;
  double before = std::numeric_limits<double>::infinity();
  const point::Problem at_phase = started(problem, state_, phase);
  state_ = moved_inside(at_phase, state_);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto round = run_round(started(problem, state_, phase), periods_);
    if (!round || (floats_ && round->meets_walls)) return false;
    const SectionState step = newton_step(*round);
    const double length = size_of(step);
    if (length <= enough)
      return word_of(problem, *round) == word_ && spectral_radius(*round) < 1 && move_section(problem, *round);
    if (!(length <= before / 4)) return false;
    before = length;
    state_ = moved_inside(at_phase, {state_.x + step.x, state_.v + step.v, state_.z + step.z, state_.w + step.w});
  }
  return false;
}

/// Moves the section into the middle of the longest flight.
bool TrackedMotion::move_section(const point::Problem& problem, const Round& round) {
  const double turns = round.middle_of_flight;
  size_ = round.fastest;
  for (std::size_t i = 0; i < periods_; ++i) size_ = std::max(size_, size_of(round.states[i]));
  const auto there = state_after(started(problem, state_, 2 * pi<double>() * phase_turns_), turns);
  if (!there) return false;
  state_ = *there, phase_turns_ += turns, phase_turns_ -= std::floor(phase_turns_);
  return true;
}

std::optional<std::size_t> TrackedMotion::among(const EnsembleMotions& motions) const {
  if (sticks_) return motions.band();
  if (!is_periodic()) {
    const auto met = motions.visiting(states_, floats_);
    return met && motions.motions()[*met].symmetric == symmetric_ ? met : std::nullopt;
  }
  if (!is_driven(at_.oscillator) || creeps_to_ != Side::none) return motions.passing(state_);
  const auto there = state_after(started(at_, state_, 2 * pi<double>() * phase_turns_), 1 - phase_turns_);
  return there ? motions.passing(after_impact(at_, *there, size_)) : std::nullopt;
}

}  // namespace clatter::attractors
