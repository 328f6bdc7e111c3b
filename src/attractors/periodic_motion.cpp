#include "attractors/periodic_motion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "math/number.hpp"
#include "motion/contact_force.hpp"
#include "motion/walls.hpp"
#include "point/decided.hpp"
#include "steady/contraction.hpp"
#include "steady/doubt.hpp"
#include "steady/repeat.hpp"

namespace clatter::attractors {
namespace {

using observables::ImpactWord;

double larger_of(double x, double v) { return std::max(std::abs(x), std::abs(v)); }

double size_of(const Round& round) {
  double size = round.fastest;
  for (const SectionState& state : std::span(round.states).first(round.orbit.periods))
    size = std::max(size, size_of(state));
  return size;
}

/// The exact round near another one, as far as Newton's method, which must meet the same stops in the same order, gets
/// there.
Round polished(const point::Problem& problem, Round round, double phase) {
  constexpr int most_iterations = 6;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double gap = size_of(round.gap());
    if (!(gap > 0)) break;
    const SectionState step = newton_step(round), &from = round.states.front();
    const SectionState next{from.x + step.x, from.v + step.v, from.z + step.z, from.w + step.w};
    const point::Problem from_there = started(problem, next, phase);
    if (!is_inside(from_there, next)) break;
    const std::optional<Round> closer = run_round(from_there, round.orbit.periods);
    if (!closer || closer->orbit.passages != round.orbit.passages || !(size_of(closer->gap()) < gap)) break;
    round = *closer;
  }
  return round;
}

/// The facts that one round of a motion tells.
PeriodicMotion described(const point::Problem& problem, const Round& round) {
  PeriodicMotion motion{.size = size_of(round)};
  const std::size_t periods = round.orbit.periods;
  double log_area = -2 * problem.oscillator.damping * period_of(problem.oscillator) * static_cast<double>(periods);
  for (std::size_t i = 0; i < periods; ++i) {
    motion.cycle.push_back(after_impact(problem, round.states[i], motion.size));
    log_area += round.orbit.passages[i].log_area;
  }
  motion.contracts = log_area < -1e-12;
  motion.word = word_of(problem, round);
  motion.regime = ImpactWord::regime_of(round.contacts, static_cast<double>(periods));
  motion.middle_of_flight = round.middle_of_flight;
  return motion;
}

/// A motion that is near a round, decided beyond rounding.
steady::ObservedTime decided(const point::Problem& problem, const steady::MapOrbit& orbit, double phase) {
  steady::Rests rests;
  for (std::size_t i = 0; i < orbit.periods; ++i) rests.pass(orbit.passages[i], static_cast<std::int64_t>(i));
  const auto section = static_cast<std::int64_t>(orbit.periods);
  const point::Problem from_here = started(problem, {orbit.states[0].x, orbit.states[0].v}, phase);
  return point::Decisions{}.decided(from_here, steady::repeated(orbit.states[0], orbit.periods, 0.0, section, rests));
}

}  // namespace

bool PeriodicMotion::passes(const SectionState& state) const {
  return std::ranges::any_of(cycle, [&](const SectionState& own) {
    SectionState apart = difference(own, state);
    if (floats) apart.z = 0, apart.w = rubs ? apart.w : 0;
    return size_of(apart) <= same_motion * size;
  });
}

SectionState after_impact(const Scene& scene, SectionState state, double size) {
  const StopsNow stops(rigid_ones(scene.stops), scene.oscillator.frequency, scene.shaking.lead);
  const auto meet = [&](Side side, double carried) {
    const auto stop = motion::stop_at<double>(stops, side);
    const double into = state.v - carried;
    if (stop.into(into) > 0 && std::abs(state.x - stop.position) <= same_motion * size)
      state.v = stop.law.after(into) + carried;
  };
  meet(Side::lower, stops.velocity_lower), meet(Side::upper, stops.velocity_upper);
  const LooseMass& loose = scene.loose;
  const double wall = state.w < 0 ? loose.lower : loose.upper;
  if (state.w != 0 && std::abs(state.z - wall) <= same_motion * size) {
    const motion::WallRule<double> rule(loose);
    state.v = rule.main_after(state.v, state.w), state.w = rule.law_for(state.w).after(state.w);
  }
  return state;
}

std::optional<PeriodicMotion> periodic_motion(const point::Problem& problem, SectionState state, std::size_t periods,
                                              double phase) {
  const std::optional<Round> first = run_round(started(problem, state, phase), periods);
  if (!first) return std::nullopt;
  const bool rubs = has_loose_friction(problem.loose);
  if (!has_loose_mass(problem.loose)) {
    const steady::ObservedTime exact = decided(problem, first->orbit, phase);
    if (exact.status != steady::Status::periodic) return std::nullopt;
    if (!exact.sections.empty()) {
      const auto round =
          run_round(started(problem, {exact.from.x, exact.from.v}, phase), exact.sections.size(), exact.sections);
      return round ? std::optional(described(problem, *round)) : std::nullopt;
    }
  } else if (!first->meets_walls && !rubs) {  // neutral, so that Newton's method has no way to go
    auto motion = periodic_motion(floating(problem), {state.x, state.v}, periods, phase);
    if (!motion) return std::nullopt;
    motion->floats = true;
    for (std::size_t i = 0; i < motion->cycle.size(); ++i)
      motion->cycle[i].z = first->states[i].z, motion->cycle[i].w = first->states[i].w;
    return motion;
  }
  Round round = polished(problem, *first, phase);
  const std::vector<SectionState>& states = round.states;
  const double same = same_motion * size_of(round);
  const std::size_t shortest =
      steady::least_divisor(periods, [&](std::size_t m) { return size_of(difference(states[0], states[m])) <= same; });
  if (shortest < periods) {  // contacts, word and flight of the shorter period
    const auto again = run_round(started(problem, states[0], phase), shortest);
    if (!again) return std::nullopt;
    round = *again;
  }
  PeriodicMotion motion = described(problem, round);
  motion.rubs = rubs, motion.floats = rubs && !round.meets_walls;
  return motion;
}

PeriodicMotion standstill(const point::Problem& problem, const SectionState& state) {
  const double x = state.x;
  double size = larger_of(x, equilibrium_of(problem.oscillator));
  for (const double stop : {problem.stops.lower, problem.stops.upper})
    if (std::isfinite(stop)) size = std::max(size, std::abs(stop));
  const Stops& stops = problem.stops;
  const LooseMass& loose = problem.loose;
  const bool rubs = has_loose_friction(loose) && state.z != loose.lower && state.z != loose.upper;
  const Side on = x == stops.lower ? Side::lower : x == stops.upper ? Side::upper : soft_stop_beyond(stops, x);
  return {.cycle = {{x, 0.0, state.z}},
          .word = ImpactWord::word_of({}, on),
          .regime = {},
          .size = std::max(size, 1.0),
          .contracts = true,
          .floats = rubs,
          .rubs = rubs};
}

std::optional<SectionState> mirrored(const point::Problem& problem, const SectionState& state) {
  const std::optional<double> centre = mirror_centre(problem);
  if (!centre) return std::nullopt;
  const double walls = has_loose_mass(problem.loose) ? problem.loose.lower + problem.loose.upper : 0.0;
  const auto image = [&](const SectionState& of) {
    return SectionState{2 * *centre - of.x, -of.v, walls - of.z, -of.w};
  };
  if (!is_driven(problem.oscillator)) return image(state);
  const std::optional<SectionState> later = state_after(started(problem, state, 0.0), 0.5);
  return later ? std::optional(image(*later)) : std::nullopt;
}

}  // namespace clatter::attractors
