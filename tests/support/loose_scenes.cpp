#include "support/loose_scenes.hpp"

#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/methods.hpp"

namespace clatter::support {

LooseRun run_loose(const point::Problem& scene, double duration) {
  const auto by = [&]<Effects E>() {
    stepping::Exact<double, E> exact(scene, stepping::Limits{.impacts = 1e9});
    LooseRun run{.end = start_of(scene)};
    run.outcome = run_for(exact, run.end, duration / exact.period(), run.record);
    const auto [z, w] = motion::place_in_housing(run.end, scene.loose);
    run.z = z, run.w = w;
    return run;
  };
  if (rotates(scene.oscillator))
    return by.template operator()<effect_sets::with_loose_mass(Damping::light, Forcing::secular)>();
  return by.template operator()<effect_sets::with_loose_mass(Damping::heavy, Forcing::regular)>();
}

}  // namespace clatter::support
