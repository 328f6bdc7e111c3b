#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "hard/as_machine.hpp"
#include "hard/event_match.hpp"
#include "hard/machine.hpp"
#include "hard/machine_motion.hpp"
#include "hard/tally.hpp"
#include "motion/walls.hpp"
#include "point/exact_motion.hpp"
#include "point/point.hpp"

/// The program against the simulator of `machine.hpp`, event by event.
namespace clatter::hard::told_scenes {

using Real = ToldEvent::Real;

/// The z' of a rebound that nothing tells from rest.
[[nodiscard]] inline double faded_of(const AnyScene& any, const Scales& scales) {
  const double acceleration = scales.size + std::abs(any.scene.oscillator.load) + std::abs(any.scene.loose.load);
  return 64 * epsilon<double>() * (scales.fastest + acceleration * std::max(1.0, scales.duration));
}

/// Events without impacts just before the mass is carried that are too slow to be told from rest: how many of these a
/// chatter ends with is a matter of taste.
[[nodiscard]] inline std::vector<ToldEvent> without_faded(const std::vector<ToldEvent>& events, double faded) {
  std::vector<ToldEvent> kept;
  Side carried = Side::none;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (event->kind == ToldEvent::Kind::impact && event->side == carried && std::abs(event->velocity) <= faded)
      continue;
    carried = event->kind == ToldEvent::Kind::rest ? event->side : Side::none;
    kept.push_back(*event);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// Numbers of a motion, each over its scale.
using Numbers = std::vector<double>;
[[nodiscard]] inline double largest_difference(const Numbers& a, const Numbers& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) raise(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Extremes, time in sticks, and energies that the forces brought, and that were lost to the damper, in impacts and to
/// friction.
struct Results {
  Range x, y, z;
  Real stuck, work, damped, struck, rubbed;
};
[[nodiscard]] inline Results results_of(const MachineRun& run) {
  Real stuck = 0;
  for (const ToldEvent& event : told_events(run))
    if (event.kind == ToldEvent::Kind::stick) stuck += event.until - event.time;
  const Real work = run.stored + run.damped + run.struck + run.rubbed;
  return {run.of_x, run.of_y, run.of_z, stuck, work, run.damped, run.struck, run.rubbed};
}
/// Those of the program.
[[nodiscard]] inline Results results_of(const AnyScene& any) {
  point::Problem problem = any.scene;
  auto& observe = problem.observe;
  const bool has_loose = any.scene.loose.ratio > 0;
  observe.extrema = observe.impacts = observe.energy = true, observe.loose_extrema = has_loose;
  observe.of_sticks = observe.of_friction = !has_loose;
  point::ThreadScratch scratch;
  const point::PointResult r = run_point(problem, scratch);
  return {{r.x_min, r.x_max},
          {r.y_min, r.y_max},
          {r.z_min, r.z_max},
          r.stick_fraction * any.duration,
          r.work_in,
          r.loss_damping,
          r.loss_impact[0] + r.loss_impact[1],
          r.loss_friction};
}

/// The simulator's motion of a scene, and how much roundings of the inputs are magnified in it.
class Reference {
 public:
  explicit Reference(const AnyScene& given)
      : any(given),
        has_loose(any.scene.loose.ratio > 0),
        run(simulated(as_machine(any.scene), 0)),
        scales(scales_of(any.scene, any.duration, run)),
        faded(has_loose ? faded_of(any, scales) : 0),
        events(alike(told_events(run))),
        decided(events.size()),
        growth(events.size(), 0.0) {
    for (std::uint64_t way = 0; way < 4; ++way) compare(simulated(moved(any, way, 2, 8), 0), true);
    compare(simulated(as_machine(any.scene), 1), true);
    for (std::uint64_t way = 4; way < 6 && has_loose; ++way)
      compare(simulated(moved(any, way, 2 * margin, 8 * margin), 0), false);
    if (has_loose) compare(simulated(as_machine(any.scene), margin), false);
    for (std::size_t i = 0; i < growth.size(); ++i)
      growth[i] = std::max({growth[i], of_stopping(events[i]), i == 0 ? 0 : growth[i - 1]});
    if (!growth.empty()) end_growth = std::max(end_growth, growth.back());
    const auto chaos = std::find_if(growth.begin(), growth.end(), [](double of) { return of > lost; });
    decided = std::min(decided, static_cast<std::size_t>(chaos - growth.begin()));
    ends_alike = ends_alike && !(end_growth > lost);
  }

  [[nodiscard]] std::vector<ToldEvent> alike(const std::vector<ToldEvent>& told) const {
    return without_faded(joined(told, any.duration), faded);
  }
  /// The most by which the program may be off in an event.
  [[nodiscard]] double allowed(std::size_t event) const {
    return allowed(event, growth[event]) + of_fading(events[event]);
  }
  [[nodiscard]] double allowed_at_end() const { return allowed(events.size(), end_growth); }
  [[nodiscard]] bool is_decided() const { return run.finished && decided == events.size() && ends_alike && !creeps(); }
  /// Whether heavy damping lets the mass come ever closer to its last place. Once nothing can tell it from there, it
  /// sticks in the program.
  [[nodiscard]] bool creeps() const {
    return !has_loose && any.scene.oscillator.forcing == 0 && run.v != 0 && std::abs(run.v) < 1e-12 * run.fastest;
  }

  [[nodiscard]] Numbers end(Real x, Real v, Real z, Real w) const {
    return {static_cast<double>(x) / scales.size, static_cast<double>(v) / scales.fastest,
            static_cast<double>(z) / scales.size, static_cast<double>(w) / scales.fastest};
  }
  [[nodiscard]] Numbers end_of(const MachineRun& one) const { return end(one.x, one.v, one.z, one.w); }
  /// With friction, the program tells all that is lost in the chatter that it sums, about 1e-11 of the energy, as lost
  /// in impacts.
  [[nodiscard]] Numbers scaled(const Results& r) const {
    const Real fastest = scales.fastest, square = fastest * fastest, size = scales.size, of_summed_chatter = 1e-3L;
    const Real most = std::max(r.rubbed, square), energy = square + std::abs(r.work) + r.damped + r.struck;
    std::vector<Real> all{r.x.least / size, r.x.greatest / size};
    if (has_loose)
      for (const Real one : {r.y.least / size, r.y.greatest / size, r.z.least / size, r.z.greatest / size,
                             r.work / energy, r.damped / energy, r.struck / energy})
        all.push_back(one);
    else
      for (const Real one : {r.stuck / any.duration, of_summed_chatter * r.rubbed / most}) all.push_back(one);
    return {all.begin(), all.end()};
  }

  static constexpr double lost = 1e-4;  ///< a growth beyond which nothing is known of the motion
  static constexpr double margin = 16;  ///< the program may be off by as many times the effect of a few roundings
  const AnyScene any;
  bool has_loose;
  MachineRun run;
  Scales scales;
  double faded;  ///< z' that nothing tells from rest
  std::vector<ToldEvent> events;
  std::size_t decided;         ///< events before the first that roundings turn into another
  std::vector<double> growth;  ///< the effect of a few roundings, by event
  double end_growth = 0;
  bool ends_alike = true;

 private:
  [[nodiscard]] MachineRun simulated(MachineScene scene, double rounding) const {
    scene.still = 1e-16, scene.rounding = rounding * epsilon<double>();
    return run_machine(scene, any.duration, 3000);
  }
  [[nodiscard]] static double allowed(std::size_t events_before, double growth) {
    return std::max((16 + static_cast<double>(events_before)) * epsilon<double>(), margin * growth);
  }
  /// That of a rounding of the velocity, a quarter of it, on the instant at which it falls to 0.
  [[nodiscard]] double of_stopping(const ToldEvent& event) const {
    if (event.pull == 0 || has_loose) return 0;
    return epsilon<double>() / 4 * scales.fastest / std::abs(static_cast<double>(event.pull)) / any.duration;
  }
  /// That of the rest of a chatter, once it is below rounding, on the instant at which the mass is carried: a
  /// rebound w takes the time 2 w/z'', and all after it 1/(1 - R) of that.
  [[nodiscard]] double of_fading(const ToldEvent& event) const {
    if (event.kind != ToldEvent::Kind::rest) return 0;
    const double tail = of_tail(event);
    if (!(event.pull > 0) || !has_loose) return tail;
    const auto pull = static_cast<double>(event.pull);
    const double slowest = scales.fastest + scales.size + std::abs(any.scene.oscillator.load) + pull * any.duration,
                 faint = 2 * epsilon<double>() * slowest;
    double taken = 1;
    const MachineScene scene = as_machine(any.scene);
    for (const auto& law : {machine::Rebound{scene.wall_R_lower, scene.wall_law_lower},
                            machine::Rebound{scene.wall_R_upper, scene.wall_law_upper}})
      taken = std::min(taken, (1 - static_cast<double>(law.share(faint))) * (1 - law.law.exponent));
    return tail + faint / (pull * std::max(taken, 1e-3) * any.duration);
  }
  /// That of what follows the last impact of a chatter that the simulator takes, if its flights fall as the sum over n
  /// of n^(1/p): by the last flight and the next one.
  [[nodiscard]] double of_tail(const ToldEvent& rest) const {
    double p = 0;
    const MachineScene scene = as_machine(any.scene);
    for (const Law* law : {&scene.law_lower, &scene.law_upper, &scene.wall_law_lower, &scene.wall_law_upper})
      p = std::max(p, law->exponent);
    if (p == 0) return 0;
    const ToldEvent *last = nullptr, *before = nullptr;
    const auto told = told_events(run);
    for (const ToldEvent& event : told)
      if (event.kind == ToldEvent::Kind::impact && event.side == rest.side && event.time <= rest.time)
        before = std::exchange(last, &event);
    if (before == nullptr || !(std::abs(last->velocity) < std::abs(before->velocity))) return 0;
    const auto flight = static_cast<double>(last->time - before->time);
    const auto left = static_cast<double>(std::abs(last->velocity / before->velocity));
    return 2 * flight * left / ((1 - left) * (1 - p) * any.duration);
  }
  /// Finds from where on another run has other events, and by how much it is off until then.
  void compare(const MachineRun& other, bool grows) {
    const auto its = alike(told_events(other));
    const EventMatch same = match(its, !other.finished, events, !run.finished, scales);
    decided = std::min(decided, same.first_difference);
    ends_alike = ends_alike && same.difference.empty();
    if (!grows) return;
    for (const auto& [i, j] : same.pairs) growth[j] = std::max(growth[j], deviation_of(its[i], events[j], scales));
    raise(end_growth, largest_difference(end_of(other), end_of(run)));
    if (!has_loose) raise(end_growth, largest_difference(scaled(results_of(other)), scaled(results_of(run))));
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
    events = told_events(recorder.events);
    if (any.scene.loose.ratio == 0) return;
    const auto [place, velocity] = motion::place_in_housing(end, any.scene.loose);
    z = place, w = velocity;
  }

  motion::State<double> end{};
  double z = 0, w = 0;
  stepping::Outcome outcome{};
  std::vector<ToldEvent> events{};
};

/// `share_decided`: the share of scenes whose every event is to be known.
inline void compare(const Kind& kind, double share_decided = 0.9) {
  Tally same("the same events", kind), off("times, speeds and places", kind), ends("state at the end", kind),
      results("extremes, time in sticks and energies", kind);
  std::map<ToldEvent::Kind, std::uint64_t> counts;
  std::uint64_t scenes = 0, decided = 0, cut = 0;
  in_every_scene(kind, [&](const AnyScene& any) {
    const Reference reference(any);
    const Told told(any);
    const auto events = reference.alike(told.events);
    const bool is_cut = told.outcome == stepping::Outcome::event_budget;
    const EventMatch found = match(events, is_cut, reference.events, !reference.run.finished, reference.scales);
    const bool is_same =
        (told.outcome == stepping::Outcome::completed || is_cut) &&
        (found.difference.empty() || (found.first_difference >= reference.decided && !reference.is_decided()));
    if (!is_same) std::cout << any.index << ": " << found.difference << "\n";
    same.take(any, is_same ? 0 : std::numeric_limits<double>::infinity());
    double worst = 0;
    for (const auto& [i, j] : found.pairs) {
      if (j >= reference.decided) break;
      raise(worst, deviation_of(events[i], reference.events[j], reference.scales) / reference.allowed(j));
      ++counts[reference.events[j].kind];
    }
    off.take(any, worst);
    ++scenes, cut += is_cut;
    if (is_cut || !is_same || !(reference.is_decided() || reference.creeps())) return;
    ++decided;
    const Numbers end = reference.end(told.end.x, told.end.v, told.z, told.w);
    ends.take(any, largest_difference(end, reference.end_of(reference.run)) / reference.allowed_at_end());
    if (reference.creeps()) return;
    const Numbers simulated = reference.scaled(results_of(reference.run)), its = reference.scaled(results_of(any));
    results.take(any, largest_difference(its, simulated) / reference.allowed_at_end());
  });
  same.conclude(1), off.conclude(1), ends.conclude(share_decided), results.conclude(share_decided);
  EXPECT_GE(static_cast<double>(decided), share_decided * static_cast<double>(scenes));
  std::cout << decided << " of " << scenes << " decided, " << cut << " cut by the number of impacts;";
  for (const auto& [event, count] : counts) std::cout << " " << static_cast<int>(event) << ": " << count;
  std::cout << "\n";
}

}  // namespace clatter::hard::told_scenes
