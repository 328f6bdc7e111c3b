#pragma once

#include <cstdint>
#include <optional>

#include "point/problem.hpp"
#include "steady/passage_observer.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::motion {

inline State<double> at(double x, double v) {
  State<double> state;
  state.x = x, state.v = v;
  return state;
}

/// A motion over some forcing periods: its contacts in order, its end and its derivative.
struct Run {
  std::uint64_t itinerary;
  State<double> end;
  Jacobian<double> derivative;
};

template <Effects effects>
std::optional<Run> run(const point::Problem& scene, State<double> state, double turns) {
  stepping::Exact<double, effects> integrator(scene);
  steady::PassageObserver watch(scene.stops);
  watch.differentiate();
  if (run_for(integrator, state, turns, watch) != stepping::Outcome::completed) return std::nullopt;
  return Run{watch.passage().itinerary, state, watch.derivative()};
}

}  // namespace clatter::motion
