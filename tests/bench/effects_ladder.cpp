// The cost of each effect. Every rung is a scene without one effect, timed with the compiled set of its own effects,
// with one that also has that effect, and with one that has them all: the same motion by different compiled sets.
// scripts/effects_ladder.py makes the table in src/scene/README.md.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "point/problem.hpp"
#include "scene/required_effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::bench {
namespace {

/// A scene, and the effects with which it is timed in comparison.
struct Rung {
  std::string left_out;  ///< the effect that the scene lacks and the rung above has
  point::Problem scene;  ///< run from its start
  Effects kept_in;       ///< the scene's own effects and the one that it lacks
  double periods;        ///< of one run, in forcing periods, without forcing of 2 pi
};

/// Adds the effect that is left out.
using PutBack = void (*)(Effects&);
void same(Effects&) {}  // no compiled set differs
void resonance(Effects& effects) { effects.forcing = Forcing::secular; }
void forcing(Effects& effects) { effects.forcing = Forcing::regular; }
void damping(Effects& effects) { effects.damping = Damping::light; }
void rest(Effects& effects) { effects.rest = true; }
void upper(Effects& effects) { effects.upper = true; }
void stops(Effects& effects) { effects.lower = effects.upper = effects.dissipation = true; }
void friction(Effects& effects) { effects.friction = true; }
void stops_and_rest(Effects& effects) { stops(effects), rest(effects); }

constexpr double long_run = 200;
constexpr double until_rest = 5;  // pressed without forcing: then at rest for good, and nothing is left to time

Rung rung(std::string left_out, PutBack put_back, const Oscillator& oscillator, const Stops& between,
          const Start& start = {}, double periods = long_run) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.stops = between, scene.start = start;
  Effects kept_in = required_effects(scene);
  put_back(kept_in);
  return {std::move(left_out), scene, kept_in, periods};
}

/// A scene with friction, that lacks nothing.
Rung rough(const Oscillator& oscillator, const Stops& between, double kinetic) {
  Rung with_friction = rung("", same, oscillator, between);
  with_friction.scene.friction = {kinetic, kinetic};
  with_friction.kept_in = required_effects(with_friction.scene);
  return with_friction;
}

/// A scene with a loose mass, that lacks nothing.
Rung carrying(const Oscillator& oscillator, const LooseMass& loose) {
  Rung with_loose_mass = rung("", same, oscillator, {});
  with_loose_mass.scene.loose = loose;
  with_loose_mass.kept_in = required_effects(with_loose_mass.scene);
  return with_loose_mass;
}

constexpr Oscillator near_resonance(double h) { return {.damping = h, .forcing = 1, .frequency = 1.03, .load = 0.02}; }
constexpr Oscillator driven(double h) { return {.damping = h, .forcing = 1, .frequency = 0.7, .load = 0.02}; }
constexpr Oscillator driven_without_load(double h) { return {.damping = h, .forcing = 1, .frequency = 0.7}; }
constexpr Oscillator free_motion(double h, double load = 0) { return {.damping = h, .load = load}; }

/// From the scene with all effects down to free motion; then the sets of effects that this path doesn't have.
std::vector<Rung> rungs() {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Stops close{-0.1, 0.12, 0.5, 0.5};  // nearer than the force is strong: chatter, rest, release
  const Stops wide{-1.2, 1.3, 0.7, 0.6};    // no force can hold the mass on them
  const Stops elastic{-1.2, 1.3, 1, 1}, single{-1.2, none, 1, 1};
  const Stops far{-30, 30, 0.7, 0.6};  // out of reach
  const Stops pressed{-0.5, 0.5, 0.7, 0.7}, narrow{-0.5, 0.6, 1, 1}, lopsided{-0.5, 2, 1, 1};
  constexpr double push = 0.8, light = 0.1, heavy = 2, creeping = 1e-4;  // the last fades little in a run
  constexpr Start moving{.displacement = 0, .velocity = 1};
  return {
      rung("", same, near_resonance(0.04), close),
      rung("resonance", resonance, driven(light), close),
      rung("chatter and rest", rest, driven(light), wide),
      rung("dissipation", same, driven(light), elastic),
      rung("load", same, driven_without_load(light), elastic),
      rung("upper stop", same, driven_without_load(light), single),
      rung("both stops", stops, driven_without_load(light), far),
      rung("damping", same, driven_without_load(0), far),
      rung("forcing", forcing, free_motion(0), far, moving),
      rung("chatter and rest", rest, near_resonance(0.04), wide),
      rung("both stops", stops, near_resonance(0.04), far),
      rung("damping", damping, near_resonance(0), close),
      rung("damping", damping, driven(0), close),
      rung("forcing", forcing, free_motion(light, push), pressed, {}, until_rest),
      rung("damping", damping, free_motion(0, push), pressed, {}, until_rest),
      rung("chatter and rest", rest, free_motion(creeping), narrow, moving),
      rung("damping", damping, free_motion(0), narrow, moving),
      rung("upper stop", upper, free_motion(0), lopsided, moving),
      rung("", same, driven(heavy), close),
      rung("heavy damping", same, driven(1), close),
      rung("forcing", forcing, free_motion(heavy, push), pressed, {}, until_rest),
      rung("both stops", stops_and_rest, driven(heavy), far),
      rough(driven(light), wide, 0.1),
      rung("friction", friction, driven(light), wide),
      carrying(driven(light),
               {.ratio = 0.05, .lower = -0.5, .upper = 0.5, .restitution_lower = 0.7, .restitution_upper = 0.7}),
      carrying(
          driven(light),
          {.ratio = 0.5, .lower = -0.1, .upper = 1, .restitution_lower = 0.3, .restitution_upper = 0.3, .load = -0.3})};
}

/// A scene's effects in words, separated by commas.
std::string words(const Effects& effects) {
  constexpr const char* of_damping[] = {"", ", light damping", ", critical damping", ", heavy damping"};
  constexpr const char* of_forcing[] = {"", ", forcing", ", resonance"};
  std::string text = of_damping[static_cast<int>(effects.damping)];
  text += of_forcing[static_cast<int>(effects.forcing)];
  if (effects.load) text += ", load";
  if (effects.stops()) text += effects.lower && effects.upper ? ", two stops" : ", one stop";
  if (effects.dissipation) text += ", R < 1";
  if (effects.rest) text += ", rest";
  if (effects.friction) text += ", friction";
  if (effects.loose) text += ", loose mass";
  return text.empty() ? "none" : text.substr(2);
}

struct CountRests : stepping::NoObserver {
  void event(const motion::Event& event) {
    const bool is_hold = event.kind == motion::Event::Kind::hold;
    rests += (event.lasts() && event.held && !is_hold) || event.kind == motion::Event::Kind::press ? 1 : 0;
  }
  double rests = 0;
};

/// Runs a rung's scene from its start; returns the integrator with its counts.
template <Effects set, class Observer>
stepping::Exact<double, set> run_once(const Rung& rung, const Stops& in_reach, Observer& observer,
                                      benchmark::State& state) {
  stepping::Exact<double, set> integrator(rung.scene, in_reach);
  motion::State<double> now;
  now.x = rung.scene.start.displacement, now.v = rung.scene.start.velocity;
  if constexpr (set.loose) now.loose = motion::loose_start<double>(rung.scene);
  if (run_for(integrator, now, rung.periods, observer) != stepping::Outcome::completed)
    state.SkipWithError("the run did not complete");
  benchmark::DoNotOptimize(now);
  return integrator;
}

/// Times a rung's scene as a scene of these effects. Counters are per period, in seconds and numbers.
void time_as(benchmark::State& state, const Rung& rung, const Effects& effects) {
  using benchmark::Counter;
  const Stops in_reach = stops_in_reach(rung.scene.stops, effects);
  with_effects(effects, [&]<Effects set>() {
    stepping::NoObserver none;
    for ([[maybe_unused]] auto _ : state) (void)run_once<set>(rung, in_reach, none, state);
    CountRests counted;
    const stepping::Exact<double, set> integrator = run_once<set>(rung, in_reach, counted, state);
    state.counters["impacts"] = integrator.impacts() / rung.periods;
    state.counters["evaluations"] = integrator.evaluations() / rung.periods;
    state.counters["rests"] = counted.rests / rung.periods;
  });
  state.counters["time"] = Counter(rung.periods, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["set"] = static_cast<double>(effect_set_of(effects));
  state.SetLabel(words(required_effects(rung.scene)));
}

/// Whether a rung's scene runs through the same code on the same stops.
bool same_run(const Rung& rung, const Effects& a, const Effects& b) {
  const Stops with_a = stops_in_reach(rung.scene.stops, a), with_b = stops_in_reach(rung.scene.stops, b);
  return effect_set_of(a) == effect_set_of(b) && with_a.lower == with_b.lower && with_a.upper == with_b.upper;
}

/// Benchmarks called e.g. "1/resonance/own" and "1/resonance/kept in, all".
void add(std::size_t number, const Rung& rung) {
  const Effects own = required_effects(rung.scene), all = all_effects(rung.scene);
  std::vector<std::pair<std::string, Effects>> runs{{"own", own}};
  const auto compare_with = [&](const std::string& what, const Effects& effects) {
    for (auto& [names, known] : runs)
      if (same_run(rung, known, effects)) return void(names += ", " + what);
    runs.emplace_back(what, effects);
  };
  compare_with("kept in", rung.kept_in);
  compare_with("all", all);
  for (const auto& [names, effects] : runs) {
    const std::string name = std::to_string(number) + '/' + rung.left_out + '/' + names;
    benchmark::RegisterBenchmark(name.c_str(),
                                 [rung, as = effects](benchmark::State& state) { time_as(state, rung, as); });
  }
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  std::size_t number = 0;
  for (const clatter::bench::Rung& rung : clatter::bench::rungs()) clatter::bench::add(number++, rung);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
