#include "support/runs.hpp"

#include <type_traits>

#include "accuracy/reference_effects.hpp"
#include "math/fifty_digits.hpp"

namespace clatter::support {

namespace {

/// Runs for as many forcing periods as `turns_of` gives for one of them.
template <class Number, class TurnsOf>
Run<Number> run(const point::Problem& scene, const Number& x, const Number& v, TurnsOf&& turns_of) {
  const auto run_with = [&]<Effects effects>() {
    Run<Number> run;
    stepping::Exact<Number, effects> integrator(scene, limits_of(scene));
    run.end.x = x, run.end.v = v;
    run.outcome = run_for(integrator, run.end, turns_of(integrator.period()), run.record);
    run.evaluations = integrator.evaluations();
    return run;
  };
  if constexpr (std::is_same_v<Number, FiftyDigits>) return accuracy::with_every_effect(scene, run_with);
  return with_any_stops(scene, run_with);
}

}  // namespace

template <class Number>
Run<Number> run_scene(const point::Problem& scene, double duration) {
  return run<Number>(scene, Number(scene.start.displacement), Number(scene.start.velocity),
                     [&](const Number& period) { return Number(Number(duration) / period); });
}

template <class Number>
Run<Number> run_from(const point::Problem& scene, const Number& x, const Number& v, const Number& turns) {
  return run<Number>(scene, x, v, [&](const Number&) { return turns; });
}

template Run<double> run_scene(const point::Problem&, double);
template Run<FiftyDigits> run_scene(const point::Problem&, double);
template Run<double> run_from(const point::Problem&, const double&, const double&, const double&);
template Run<FiftyDigits> run_from(const point::Problem&, const FiftyDigits&, const FiftyDigits&, const FiftyDigits&);

Steady steady_of(const point::Problem& scene) {
  return with_any_stops(scene, [&]<Effects effects>() {
    stepping::Exact<double, effects> integrator(scene, limits_of(scene));
    motion::State<double> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    const steady::ObservedTime observed = find_steady(integrator, state, scene, scene.time, scene.integration);
    Steady steady{.status = observed.status,
                  .length = observed.turns * integrator.period(),
                  .turns = observed.turns,
                  .settled = observed.simulated,
                  .found_by = observed.found_by,
                  .from = observed.from};
    state = observed.from;
    if (!failed(observed.status) &&
        run_for(integrator, state, observed.turns, steady.record) != stepping::Outcome::completed)
      steady.status = steady::Status::unresolved;
    return steady;
  });
}

}  // namespace clatter::support
