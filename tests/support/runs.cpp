#include "support/runs.hpp"

#include "numbers/fifty_digits.hpp"

namespace clatter {

template <class Number>
Run<Number> run_scene(const Scene& scene, double duration) {
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    Run<Number> run;
    Exact<Number, effects> integrator(scene);
    run.end.x = scene.start.displacement, run.end.v = scene.start.velocity;
    run.outcome = run_for(integrator, run.end, Number(Number(duration) / integrator.period()), run.record);
    run.evaluations = integrator.evaluations();
    return run;
  });
}

template Run<double> run_scene(const Scene&, double);
template Run<FiftyDigits> run_scene(const Scene&, double);

Steady steady_of(const Scene& scene) {
  return with_any_stops(scene.oscillator, [&]<Effects effects>() {
    Exact<double, effects> integrator(scene);
    State<double> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    const Observed observed = settle(integrator, state, scene);
    Steady steady{.status = observed.status,
                  .length = observed.turns * integrator.period(),
                  .turns = observed.turns,
                  .settled = observed.settled,
                  .found_by = observed.found_by,
                  .from = observed.from};
    state = observed.from;
    if (!failed(observed.status) && run_for(integrator, state, observed.turns, steady.record) != Outcome::completed)
      steady.status = Status::unresolved;
    return steady;
  });
}

}  // namespace clatter
