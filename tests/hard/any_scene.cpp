#include "hard/any_scene.hpp"

#include <algorithm>

#include "stepping/exact.hpp"

namespace clatter::hard {

stepping::Outcome watched(const AnyScene& any, AnyWatcher& watcher, std::int64_t sections) {
  return with_any_stops(any.scene, [&]<Effects effects>() {
    stepping::Exact<double, effects> integrator(any.scene, limits_of(any.scene));
    motion::State<double> state = start_of(any.scene);
    state.periods = sections;
    support::Showing showing{&watcher};
    for (double turns = any.duration / integrator.period(); turns > 0; turns -= 1) {
      const stepping::Outcome outcome = integrator.advance(state, std::min(turns, 1.0), state.periods, showing);
      if (outcome != stepping::Outcome::completed) return outcome;
      watcher.section(state);
      if (turns >= 1) state.phase_turns = 0, ++state.periods;
    }
    return stepping::Outcome::completed;
  });
}

}  // namespace clatter::hard
