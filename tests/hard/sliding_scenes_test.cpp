// Random scenes with dry friction: the program against the simulator of `slide.hpp`, event by event.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "hard/any_sliding_scene.hpp"
#include "hard/slide.hpp"
#include "hard/slide_match.hpp"
#include "point/exact_motion.hpp"
#include "point/point.hpp"

namespace clatter::hard::sliding_scenes_test {
namespace {

using Kind = SlideEvent::Kind;

/// The scene with each input moved by a few roundings. Signs are drawn, but friction rises against the force or falls.
Scene moved(const AnyScene& any, std::uint64_t way) {
  support::Random random(20471, 4 * any.index + way);
  const Scene& scene = any.scene;
  Scene other = scene;
  auto& [o, stops, start, shaking, friction, loose] = other;
  const auto by = [](double sign) { return 1 + sign * 2 * epsilon<double>(); };
  const auto nudge = [&](double value) { return value * by(random.sign()); };
  for (double* value : {&o.damping, &o.forcing, &o.frequency, &o.load, &o.stiffness, &start.velocity,
                        &stops.stiffness_lower, &stops.stiffness_upper, &stops.damping_lower, &stops.damping_upper})
    *value = nudge(*value);
  for (double* R : {&stops.restitution_lower, &stops.restitution_upper}) *R = std::min(1.0, nudge(*R));
  start.phase += random.sign() * 8 * epsilon<double>();
  const double rises = way % 2 == 0 ? 1 : -1;
  friction = {friction.kinetic * by(rises), friction.static_level * by(rises)};
  o.forcing = scene.oscillator.forcing * by(-rises);
  const auto is_on = [&](double stop) { return scene.start.displacement == stop; };
  const Stops before = stops;
  stops.lower = nudge(stops.lower), stops.upper = nudge(stops.upper);
  start.displacement = is_on(before.lower)   ? stops.lower
                       : is_on(before.upper) ? stops.upper
                                             : nudge(start.displacement);
  return other;
}

/// Results of a motion that are sums over it or its extremes, each over its scale.
using Results = std::array<double, 4>;

[[nodiscard]] double largest_difference(const Results& a, const Results& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) raise(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The simulator's motion of a scene, and how much roundings of the inputs are magnified in it.
class Reference {
 public:
  explicit Reference(const AnyScene& any)
      : run(slide(any.scene, any.duration, most_events)),
        scales(scales_of(any.scene, any.duration, run)),
        events(joined(run.events, any.duration)),
        is_unforced(any.scene.oscillator.forcing == 0),
        decided(events.size()),
        growth(events.size(), 0.0) {
    for (std::uint64_t way = 0; way < 4; ++way) compare(slide(moved(any, way), any.duration, most_events));
    compare(slide(any.scene, any.duration, most_events, epsilon<double>()));
    for (std::size_t i = 0; i < growth.size(); ++i)
      growth[i] = std::max({growth[i], of_stopping(events[i]), i == 0 ? 0 : growth[i - 1]});
    if (!growth.empty()) end_growth = std::max(end_growth, growth.back());
  }

  /// The most by which the program may be off in an event.
  [[nodiscard]] double allowed(std::size_t event) const {
    return std::max((16 + static_cast<double>(event)) * epsilon<double>(), 64 * growth[event]);
  }
  [[nodiscard]] double allowed_at_end() const {
    return std::max((16 + static_cast<double>(events.size())) * epsilon<double>(), 64 * end_growth);
  }
  [[nodiscard]] bool is_decided() const { return run.completed && decided == events.size() && ends_alike && !creeps(); }
  /// Whether heavy damping lets the mass come ever closer to its last place. Once nothing can tell it from there, it
  /// sticks in the program.
  [[nodiscard]] bool creeps() const { return is_unforced && run.v != 0 && std::abs(run.v) < 1e-12 * run.fastest; }
  [[nodiscard]] double end_deviation(double x, double v) const {
    return std::max(std::abs(x - static_cast<double>(run.x)) / scales.size,
                    std::abs(v - static_cast<double>(run.v)) / std::max(scales.fastest, 1e-300));
  }

  /// Least and greatest displacement, share of time in sticks, and the energy lost to friction.
  [[nodiscard]] Results scaled(double lowest, double highest, double stuck, double rubbed) const {
    const double energy = std::max(static_cast<double>(run.rubbed), scales.fastest * scales.fastest);
    return {lowest / scales.size, highest / scales.size, stuck, of_summed_chatter * rubbed / std::max(energy, 1e-300)};
  }
  /// The program tells all that is lost in the chatter that it sums, about 1e-11 of the energy, as lost in impacts.
  static constexpr double of_summed_chatter = 1e-3;
  [[nodiscard]] Results results_of(const SlideRun& one) const {
    return scaled(static_cast<double>(one.lowest), static_cast<double>(one.highest),
                  static_cast<double>(one.stuck) / scales.duration, static_cast<double>(one.rubbed));
  }

  static constexpr std::size_t most_events = 6000;
  SlideRun run;
  SlideScales scales;
  std::vector<SlideEvent> events;
  bool is_unforced;
  std::size_t decided;         ///< events before the first that roundings turn into another
  std::vector<double> growth;  ///< the effect of a few roundings, by event
  double end_growth = 0;
  bool ends_alike = true;

 private:
  /// That of a rounding of the velocity, a sixteenth of it, on the instant at which it falls to 0.
  [[nodiscard]] double of_stopping(const SlideEvent& event) const {
    if (event.before == 0) return 0;
    return epsilon<double>() / 16 * scales.fastest / std::abs(static_cast<double>(event.before)) / scales.duration;
  }
  void compare(const SlideRun& other) {
    const auto its = joined(other.events, scales.duration);
    const SlideMatch same = match(its, !other.completed, events, !run.completed, scales);
    for (const auto& [i, j] : same.pairs) growth[j] = std::max(growth[j], deviation_of(its[i], events[j], scales));
    decided = std::min(decided, same.first_difference);
    ends_alike = ends_alike && same.difference.empty();
    end_growth = std::max({end_growth, end_deviation(static_cast<double>(other.x), static_cast<double>(other.v)),
                           largest_difference(results_of(other), results_of(run))});
  }
};

/// The program's motion.
struct Told {
  explicit Told(const AnyScene& any) {
    const auto motion = point::ExactMotion::of(any.scene);
    point::MotionRecorder recorder(motion->stops());
    recorder.keep_events();
    end = motion->start();
    outcome = motion->run_for(end, any.duration / motion->period(), recorder);
    events = joined(as_slide_events(recorder.events), any.duration);
  }

  motion::State<double> end{};
  stepping::Outcome outcome{};
  std::vector<SlideEvent> events{};
};

/// The program's results, in the order of `Reference::scaled`.
[[nodiscard]] Results results_of(const AnyScene& any, const Reference& reference) {
  point::Problem problem = any.scene;
  auto& observe = problem.observe;
  observe.extrema = observe.impacts = observe.energy = observe.of_sticks = observe.of_friction = true;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  return reference.scaled(result.x_min, result.x_max, result.stick_fraction, result.loss_friction);
}

TEST(SlidingScenes, are_told_event_by_event_as_taylor_series_tell_them) {
  Tally same("the same events", sliding), off("times, speeds and places", sliding), ends("state at the end", sliding),
      results("extrema, time in sticks and work of friction", sliding);
  std::map<Kind, std::uint64_t> counts;
  std::uint64_t scenes = 0, decided = 0;
  in_every_scene(sliding, [&](const AnyScene& any) {
    const Reference reference(any);
    const Told told(any);
    const bool is_cut = told.outcome == stepping::Outcome::event_budget;
    const SlideMatch found = match(told.events, is_cut, reference.events, !reference.run.completed, reference.scales);
    const bool is_same =
        (told.outcome == stepping::Outcome::completed || is_cut) &&
        (found.difference.empty() || (found.first_difference >= reference.decided && !reference.is_decided()));
    same.take(any, is_same ? 0 : std::numeric_limits<double>::infinity());
    if (!is_same) std::cout << any.index << ": " << found.difference << "\n";
    double worst = 0;
    for (const auto& [i, j] : found.pairs) {
      if (j >= reference.decided) break;
      const double deviation = deviation_of(told.events[i], reference.events[j], reference.scales);
      raise(worst, deviation / reference.allowed(j)), ++counts[reference.events[j].kind];
    }
    off.take(any, worst);
    ++scenes;
    if (is_cut || !is_same || !(reference.is_decided() || reference.creeps())) return;
    ++decided;
    ends.take(any, reference.end_deviation(told.end.x, told.end.v) / reference.allowed_at_end());
    if (reference.creeps()) return;
    const double off_by = largest_difference(results_of(any, reference), reference.results_of(reference.run));
    results.take(any, off_by / reference.allowed_at_end());
  });
  same.conclude(1), off.conclude(1), ends.conclude(0.9), results.conclude(0.9);
  std::cout << decided << " of " << scenes << " decided;";
  for (const auto& [kind, count] : counts) std::cout << " " << static_cast<int>(kind) << ": " << count;
  std::cout << "\n";
}

}  // namespace
}  // namespace clatter::hard::sliding_scenes_test
