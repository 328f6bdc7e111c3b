#include "branches/event_run.hpp"

#include "model/required_effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::branches {
namespace {

/// Keeps the events of a run.
class EventObserver {
 public:
  EventObserver(Orbit& orbit, double nu) : orbit_(orbit), nu_(nu) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) { add(rest.side, rest.time, 0.0, Event::impact, rest.length); }
  void impact(const motion::Impact& impact) { add(impact.side, impact.time, impact.before, Event::impact); }
  void touch(const motion::Touch& touch) {
    add(touch.side, touch.time, touch.velocity, touch.from_outside ? Event::touch : Event::renewal);
  }
  void separate(const motion::Separation& separation) {
    add(separation.side, separation.time, separation.velocity, Event::separation);
  }

 private:
  void add(Side side, double time, double before, Event event, double rest = 0.0) {
    orbit_.impacts.push_back({side, nu_ * time, before, nu_ * rest, event});
  }

  Orbit& orbit_;
  double nu_;
};

}  // namespace

std::optional<Orbit> event_run(const point::Problem& problem, std::size_t periods) {
  const Effects effects = required_effects(problem);
  Orbit orbit{{}, 2 * static_cast<int>(periods), false};
  const bool completed = with_effects(effects, [&]<Effects E>() {
    stepping::Exact<double, E> integrator(problem, stops_in_reach(problem.stops, effects), limits_of(problem));
    motion::State<double> state;
    state.x = problem.start.displacement, state.v = problem.start.velocity;
    EventObserver observer(orbit, problem.oscillator.frequency);
    return run_for(integrator, state, static_cast<double>(periods), observer) == stepping::Outcome::completed;
  });
  if (!completed) return std::nullopt;
  if (orbit.size() == 0)
    for (const Side side : {Side::lower, Side::upper}) {
      const double position = side == Side::upper ? problem.stops.upper : problem.stops.lower;
      if (is_soft(problem.stops, side) && sign_of(side) * (problem.start.displacement - position) > 0)
        orbit.pressed = side;
    }
  return orbit;
}

}  // namespace clatter::branches
