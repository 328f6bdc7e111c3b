#include "attractors/ensemble_motions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/number.hpp"
#include "scene/creep.hpp"

namespace clatter::attractors {
namespace {

/// The phase of the start: of the force, or of the shaking.
double start_phase(const point::Problem& problem) { return problem.start.phase - problem.shaking.lead; }

/// From a phase to phase 0, in forcing periods, 0 ... 1.
double turns_to_phase_zero(double phase) {
  const double turns = phase / (2 * pi<double>());
  return std::ceil(turns) - turns;
}

/// Whether a point can have ended so: what was read from a file may be anything.
bool is_possible(const point::Problem& problem, const Ending& ending) {
  return ending.periods >= 0 && ending.periods <= static_cast<double>(steady::RepeatFinder::longest) &&
         ending.periods == std::floor(ending.periods) && std::isfinite(ending.phase.value_or(0.0)) &&
         is_inside(started(problem, ending.state, ending.phase.value_or(start_phase(problem))), ending.state);
}

/// A mass that friction holds for good, or that creeps to the edge of the band in which it does.
Motion stuck(const point::Problem& problem, const SectionState& state, Side creeps_to = Side::none) {
  Motion motion{.periodic = standstill(problem, state), .state = state};
  motion.sticks = creeps_to == Side::none, motion.creeps_to = creeps_to;
  motion.periodic->word = observables::ImpactWord::stuck;
  if (is_driven(problem.oscillator)) motion.periodic->regime = "0/1";
  return motion;
}

/// The edge of the band at which a mass stands: it has crept there, or started there.
Side edge_under(const Scene& scene, const SectionState& state) {
  const bool may_creep = has_friction(scene.friction) && !has_loose_mass(scene.loose) && state.v == 0;
  return may_creep ? band_edge_at(scene, state.x) : Side::none;
}

/// Whether no wall meets a loose mass for as long as a motion is looked at: what then moves is the main mass alone,
/// unless that rubs.
bool floats_for_long(const point::Problem& problem, const SectionState& state) {
  if (!has_loose_mass(problem.loose)) return false;
  for (const std::size_t look : {VisitedCells::short_look, VisitedCells::at_once}) {
    const auto sections = run_sections(started(problem, state, 0.0), look);
    if (!sections || sections->meets_walls) return false;
  }
  return true;
}

}  // namespace

std::optional<std::size_t> EnsembleMotions::motion_of(const point::Problem& problem, const Ending& ending) {
  if (!is_possible(problem, ending)) return std::nullopt;
  SectionState state = ending.state;
  if (const Side edge = edge_under(problem, state); edge != Side::none) {
    const auto known = passing(state);
    return known ? known : add(stuck(problem, state, edge));
  }
  if (stands_for_good(problem, state)) return band_ ? band_ : add(stuck(problem, state));
  if (!is_driven(problem.oscillator)) {
    if (const auto known = passing(state)) return known;
    return add({.periodic = standstill(problem, state), .state = state});
  }
  const double phase = ending.phase.value_or(start_phase(problem));
  if (const double turns = turns_to_phase_zero(phase); turns > 0) {
    const auto later = state_after(started(problem, state, phase), turns);
    if (!later) return std::nullopt;
    state = *later;
  }
  return ending.periods > 0 ? periodic_of(problem, state, static_cast<std::size_t>(ending.periods))
                            : aperiodic_of(problem, state);
}

void EnsembleMotions::restore(const point::Problem& problem, const Ending& ending) {
  Motion motion{.state = ending.state};
  if (const Side edge = edge_under(problem, ending.state); edge != Side::none) {
    motion = stuck(problem, ending.state, edge);
  } else if (stands_for_good(problem, ending.state)) {
    motion = stuck(problem, ending.state);
  } else if (!is_driven(problem.oscillator)) {
    motion.periodic = standstill(problem, ending.state);
  } else if (ending.periods > 0) {
    motion.periodic = periodic_motion(problem, ending.state, static_cast<std::size_t>(ending.periods));
  } else {
    motion.floats = floats_for_long(problem, ending.state);
    const point::Problem its = motion.floats ? floating(problem) : problem;
    if (!has_loose_mass(its.loose)) motion.state = {ending.state.x, ending.state.v};
    if (auto sections = run_sections(started(its, motion.state, 0.0), VisitedCells::long_look)) {
      if (motion.floats) forget_places(sections->states);
      motion.cells = VisitedCells(sections->states);
      motion.symmetric = is_symmetric(its) && visits_mirror(its, motion);
    }
  }
  add(std::move(motion));
}

std::optional<std::size_t> EnsembleMotions::passing(const SectionState& state) const {
  const double reach = same_motion * largest_;
  for (auto near = by_x_.lower_bound(state.x - reach); near != by_x_.end() && near->first <= state.x + reach; ++near)
    if (motions_[near->second].periodic->passes(state)) return near->second;
  return std::nullopt;
}

std::optional<std::size_t> EnsembleMotions::periodic_of(const point::Problem& problem, const SectionState& state,
                                                        std::size_t periods) {
  if (const auto known = passing(after_impact(problem, state, largest_))) return known;
  std::optional<PeriodicMotion> motion = periodic_motion(problem, state, periods);
  if (!motion || !motion->contracts) return std::nullopt;
  const SectionState first = motion->cycle.front();
  if (const auto known = passing(first)) return known;
  return add({.periodic = std::move(motion), .state = first});
}

std::optional<std::size_t> EnsembleMotions::visiting(std::span<const SectionState> states, bool floats) const {
  for (std::size_t i = 0; i < motions_.size(); ++i)
    if (!motions_[i].periodic && motions_[i].floats == floats && motions_[i].cells.are_visited_by(states)) return i;
  return std::nullopt;
}

std::optional<std::size_t> EnsembleMotions::aperiodic_of(const point::Problem& problem, const SectionState& state) {
  if (!floats_for_long(problem, state)) return aperiodic_of(problem, state, false);
  const point::Problem its = floating(problem);
  return aperiodic_of(its, has_loose_mass(its.loose) ? state : SectionState{state.x, state.v}, true);
}

/// A short look tells most motions from those that are known, a long one those that stay in a part of the cells for
/// long.
std::optional<std::size_t> EnsembleMotions::aperiodic_of(const point::Problem& problem, const SectionState& state,
                                                         bool floats) {
  const bool has_known = std::ranges::any_of(motions_, [](const Motion& motion) { return !motion.periodic; });
  if (has_known) {
    auto sections = run_sections(started(problem, state, 0.0), VisitedCells::short_look);
    if (!sections) return std::nullopt;
    if (floats) forget_places(sections->states);
    if (const auto known = visiting(sections->states, floats)) return known;
  }
  std::vector<SectionState> states;
  double log_area = 0.0;
  SectionState last = state;
  bool may_repeat = true;
  while (states.size() < (has_known ? longest_look_ : VisitedCells::long_look)) {
    auto sections = run_sections(started(problem, last, 0.0), VisitedCells::at_once);
    if (!sections) return std::nullopt;
    last = sections->states.back(), log_area += sections->log_area;
    if (may_repeat && sections->repeats_after > 0) {
      if (const auto periodic = periodic_of(problem, last, sections->repeats_after)) {
        if (floats) motions_[*periodic].periodic->floats = true;  // else it may have come to float meanwhile
        return periodic;
      }
      may_repeat = false;  // by rounding alone, and so it would again
    }
    if (floats) forget_places(sections->states);
    if (const auto known = visiting(sections->states, floats)) return known;
    states.insert(states.end(), sections->states.begin(), sections->states.end());
  }
  if (!(log_area < -1e-12)) return std::nullopt;  // nothing attracts it
  Motion motion{.state = state, .cells = VisitedCells(states), .floats = floats};
  motion.symmetric = is_symmetric(problem) && visits_mirror(problem, motion);
  return add(std::move(motion));
}

/// Whether a motion without a period visits the cells of its mirror image.
bool EnsembleMotions::visits_mirror(const point::Problem& problem, const Motion& motion) const {
  std::optional<SectionState> last = mirrored(problem, motion.state);
  for (std::size_t look = 0; last && look < longest_look_; look += VisitedCells::at_once) {
    auto sections = run_sections(started(problem, *last, 0.0), VisitedCells::at_once);
    if (!sections || sections->repeats_after > 0) return false;
    last = sections->states.back();
    if (motion.floats) forget_places(sections->states);
    if (motion.cells.are_visited_by(sections->states)) return true;
  }
  return false;
}

std::size_t EnsembleMotions::add(Motion motion) {
  const std::size_t index = motions_.size();
  if (motion.sticks) {
    band_ = index;
  } else if (motion.periodic) {
    largest_ = std::max(largest_, motion.periodic->size);
    for (const SectionState& state : motion.periodic->cycle) by_x_.emplace(state.x, index);
  }
  motions_.push_back(std::move(motion));
  return index;
}

}  // namespace clatter::attractors
