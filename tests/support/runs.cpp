#include "support/runs.hpp"

#include <type_traits>

#include "accuracy/reference_effects.hpp"
#include "math/fifty_digits.hpp"

namespace clatter::support {

template <class Number>
Run<Number> run_scene(const point::Problem& scene, double duration) {
  const auto run_with = [&]<Effects effects>() {
    Run<Number> run;
    stepping::Exact<Number, effects> integrator(scene, limits_of(scene));
    run.end.x = scene.start.displacement, run.end.v = scene.start.velocity;
    run.outcome = run_for(integrator, run.end, Number(Number(duration) / integrator.period()), run.record);
    run.evaluations = integrator.evaluations();
    return run;
  };
  if constexpr (std::is_same_v<Number, FiftyDigits>) return accuracy::with_every_effect(scene, run_with);
  return with_any_stops(scene, run_with);
}

template Run<double> run_scene(const point::Problem&, double);
template Run<FiftyDigits> run_scene(const point::Problem&, double);

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
