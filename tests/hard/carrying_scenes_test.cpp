// Random scenes with a loose mass: the program against the simulator of `carry.hpp`, event by event.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "hard/any_carrying_scene.hpp"
#include "hard/carry.hpp"
#include "hard/slide_match.hpp"
#include "point/point_run.hpp"

namespace clatter::hard::carrying_scenes_test {
namespace {

using Kind = SlideEvent::Kind;
using Real = CarryEvent::Real;

/// The simulator's events as those of a mass between stops. The place and the velocities before and after an impact
/// are those of the main mass; `before` a carried time is the acceleration with which the mass is pressed.
[[nodiscard]] std::vector<SlideEvent> as_slide_events(const std::vector<CarryEvent>& events) {
  std::vector<SlideEvent> all;
  for (const CarryEvent& e : events) {
    const Side side = e.side > 0 ? Side::upper : Side::lower;
    if (e.kind == CarryEvent::Kind::impact)
      all.push_back({Kind::impact, side, e.time, e.w, e.time, e.x, e.before, e.after});
    else
      all.push_back({Kind::rest, side, e.time, 0, e.until, e.x, e.pressing});
  }
  return all;
}

/// The scene with each input moved by some roundings, z by those of y, and the loose mass with its wall if it starts
/// there.
[[nodiscard]] CarryScene moved(const AnyScene& any, std::uint64_t way, double roundings) {
  support::Random random(20611, 8 * any.index + way);
  const CarryScene scene = as_carry_scene(any.scene);
  CarryScene other = scene;
  const auto nudge = [&](double value) { return value * (1 + random.sign() * roundings * epsilon<double>()); };
  for (double* value :
       {&other.damping, &other.stiffness, &other.forcing, &other.frequency, &other.load, &other.loose_mass,
        &other.lower, &other.upper, &other.loose_load, &other.x, &other.v, &other.z, &other.w})
    *value = nudge(*value);
  other.restitution = std::min(1.0, nudge(scene.restitution));
  other.phase += random.sign() * 4 * roundings * epsilon<double>();
  other.z = std::clamp(other.z + random.sign() * roundings / 2 * epsilon<double>() * scene.x, other.lower, other.upper);
  if (scene.z == scene.lower) other.z = other.lower;
  if (scene.z == scene.upper) other.z = other.upper;
  return other;
}

/// The size of the motion and of the response to the force, whose differences make a flight.
[[nodiscard]] SlideScales scales_of(const AnyScene& any, const CarryRun& run) {
  const Oscillator& o = any.scene.oscillator;
  const double nu = o.frequency, h = o.damping, k = o.stiffness;
  const double response = std::abs(o.forcing) / std::max({std::abs(k - nu * nu), 2 * h * nu, nu / any.duration});
  const Real farthest = std::max({-run.of_x.least, run.of_x.greatest, -run.of_z.least, run.of_z.greatest});
  const double size = std::max(response, static_cast<double>(farthest));
  const auto fastest = static_cast<double>(std::max(run.fastest, run.fastest_main));
  return {any.duration, size, std::max({response * nu, size * std::sqrt(std::abs(k)), fastest})};
}

/// The state at the end, x, x', z and z', each over its scale.
using State = std::array<double, 4>;
[[nodiscard]] State scaled(Real x, Real v, Real z, Real w, const SlideScales& scales) {
  return {static_cast<double>(x) / scales.size, static_cast<double>(v) / scales.fastest,
          static_cast<double>(z) / scales.size, static_cast<double>(w) / scales.fastest};
}
[[nodiscard]] State end_of(const CarryRun& run, const SlideScales& scales) {
  return scaled(run.x, run.v, run.z, run.w, scales);
}
template <std::size_t n>
[[nodiscard]] double largest_difference(const std::array<double, n>& a, const std::array<double, n>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (a[i] != b[i]) raise(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The z' of a rebound that nothing tells from rest.
[[nodiscard]] double faded_of(const AnyScene& any, const SlideScales& scales) {
  const double acceleration = scales.size + std::abs(any.scene.oscillator.load) + std::abs(any.scene.loose.load);
  return 64 * epsilon<double>() * (scales.fastest + acceleration * std::max(1.0, scales.duration));
}

/// Events without impacts just before the mass is carried that are too slow to be told from rest: how many of these a
/// chatter ends with is a matter of taste.
[[nodiscard]] std::vector<SlideEvent> without_faded(const std::vector<SlideEvent>& events, double faded) {
  std::vector<SlideEvent> kept;
  Side carried = Side::none;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (event->kind == Kind::impact && event->side == carried && std::abs(event->velocity) <= faded) continue;
    carried = event->kind == Kind::rest ? event->side : Side::none;
    kept.push_back(*event);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// The largest relative difference of two events: of time and z', and at an impact of the motion of the main mass.
[[nodiscard]] double whole_deviation(const SlideEvent& event, const SlideEvent& reference, const SlideScales& scales) {
  double off = deviation_of(event, reference, scales);
  if (reference.kind != Kind::impact) return off;
  raise(off, static_cast<double>(std::abs(event.place - reference.place)) / scales.size);
  raise(off, static_cast<double>(std::abs(event.before - reference.before)) / scales.fastest);
  raise(off, static_cast<double>(std::abs(event.after - reference.after)) / scales.fastest);
  return off;
}

/// The simulator's motion of a scene, and how much roundings of the inputs are magnified in it.
class Reference {
 public:
  explicit Reference(const AnyScene& any)
      : run(carry(as_carry_scene(any.scene), any.duration, most_events)),
        scales(scales_of(any, run)),
        faded(faded_of(any, scales)),
        events(told_alike(run)),
        decided(events.size()),
        growth(events.size(), 0.0),
        load(any.scene.oscillator.load),
        restitution(any.scene.loose.restitution_lower) {
    const CarryScene scene = as_carry_scene(any.scene);
    const auto simulated = [&](const CarryScene& one, double rounding) {
      return carry_events(one, any.duration, most_events, rounding * epsilon<double>());
    };
    for (std::uint64_t way = 0; way < 4; ++way) compare(simulated(moved(any, way, 2), 0), true);
    compare(simulated(scene, 1), true);
    for (std::uint64_t way = 4; way < 6; ++way) compare(simulated(moved(any, way, 2 * margin), 0), false);
    compare(simulated(scene, margin), false);
    for (std::size_t i = 1; i < growth.size(); ++i) growth[i] = std::max(growth[i], growth[i - 1]);
    if (!growth.empty()) end_growth = std::max(end_growth, growth.back());
  }

  /// The most by which the program may be off in an event.
  [[nodiscard]] double allowed(std::size_t event) const {
    return allowed(event, growth[event]) + of_fading(events[event]);
  }
  [[nodiscard]] double allowed_at_end() const { return allowed(events.size(), end_growth); }
  [[nodiscard]] bool is_decided() const { return run.completed && decided == events.size() && ends_alike; }

  static constexpr std::size_t most_events = 3000;
  static constexpr double margin = 16;  ///< the program may be off by as many times the effect of a few roundings
  CarryRun run;
  SlideScales scales;
  double faded;  ///< z' that nothing tells from rest
  std::vector<SlideEvent> events;
  std::size_t decided;         ///< events before the first that roundings turn into another
  std::vector<double> growth;  ///< the effect of a few roundings, by event
  double end_growth = 0;
  bool ends_alike = true;

 private:
  [[nodiscard]] std::vector<SlideEvent> told_alike(const CarryRun& one) const {
    return without_faded(joined(as_slide_events(one.events), scales.duration), faded);
  }
  [[nodiscard]] static double allowed(std::size_t events_before, double growth) {
    return std::max((16 + static_cast<double>(events_before)) * epsilon<double>(), margin * growth);
  }
  /// That of the rest of a chatter, once it is below rounding, on the instant at which the mass is carried: a
  /// rebound w takes the time 2 w/z'', and all after it 1/(1 - R) of that.
  [[nodiscard]] double of_fading(const SlideEvent& event) const {
    if (event.kind != Kind::rest || !(event.before > 0)) return 0;
    const auto pressing = static_cast<double>(event.before);
    const double slowest = scales.fastest + scales.size + std::abs(load) + pressing * scales.duration;
    return 2 * epsilon<double>() * slowest / (pressing * std::max(1 - restitution, 1e-3) * scales.duration);
  }
  /// Finds from where on another run has other events, and by how much it is off until then.
  void compare(const CarryRun& other, bool grows) {
    const auto its = told_alike(other);
    const SlideMatch same = match(its, !other.completed, events, !run.completed, scales);
    decided = std::min(decided, same.first_difference);
    ends_alike = ends_alike && same.difference.empty();
    if (!grows) return;
    for (const auto& [i, j] : same.pairs) growth[j] = std::max(growth[j], whole_deviation(its[i], events[j], scales));
    raise(end_growth, largest_difference(end_of(other, scales), end_of(run, scales)));
  }

  double load, restitution;
};

/// Hears of the program's motion what the simulator tells of its own. Times count from the last section.
struct Listener : Watcher {
  std::vector<SlideEvent> events{};
  double passed = 0;  ///< time of the last section

  void strike(const motion::Event& s) {
    const Real time = Real(passed) + s.time;
    events.push_back({Kind::impact, s.side, time, s.before, time, s.main.place, s.main.before, s.main.after});
  }
  void hold(const motion::Event& rest) {
    const Real time = Real(passed) + rest.time;
    events.push_back({Kind::rest, rest.side, time, 0, time + rest.length});
  }
};

/// The program's motion.
struct Told {
  explicit Told(const AnyScene& any) {
    with_effects(required_effects(any.scene), [&]<Effects effects>() {
      if constexpr (effects.loose) run<effects>(any);
    });
  }
  template <Effects effects>
  void run(const AnyScene& any) {
    stepping::Exact<double, effects> integrator(any.scene, limits_of(any.scene));
    motion::State<double> state = point::start_of(any.scene);
    Listener listener;
    support::Told told(listener);
    for (double turns = any.duration / integrator.period(); turns > 0; turns -= 1) {
      outcome = integrator.advance(state, std::min(turns, 1.0), state.periods, told);
      if (outcome != stepping::Outcome::completed) break;
      if (turns >= 1) state.phase_turns = 0, ++state.periods, listener.passed += integrator.period();
    }
    events = joined(listener.events, any.duration);
    end = state;
  }
  [[nodiscard]] State at_end(const Scene& scene, const SlideScales& scales) const {
    const auto [z, w] = motion::place_in_housing(end, scene.loose);
    return scaled(end.x, end.v, z, w, scales);
  }

  motion::State<double> end{};
  stepping::Outcome outcome = stepping::Outcome::unresolved;
  std::vector<SlideEvent> events{};
};

/// Extremes of x, y and z, and energies, each over its scale.
using Results = std::array<double, 9>;
[[nodiscard]] Results results_of(const CarryRun& run, const SlideScales& scales) {
  Results all{};
  std::size_t n = 0;
  for (const Range& range : {run.of_x, run.of_y, run.of_z})
    for (const Real extreme : {range.least, range.greatest}) all[n++] = static_cast<double>(extreme) / scales.size;
  const Real energy = scales.fastest * scales.fastest + std::abs(run.work) + run.damped + run.struck;
  for (const Real part : {run.work, run.damped, run.struck}) all[n++] = static_cast<double>(part / energy);
  return all;
}
/// Those of the program.
[[nodiscard]] Results results_of(const AnyScene& any, const SlideScales& scales) {
  point::Problem problem = any.scene;
  problem.observe.extrema = problem.observe.loose_extrema = problem.observe.energy = true;
  point::ThreadScratch scratch;
  const point::PointResult r = run_point(problem, scratch);
  CarryRun run;
  run.of_x = {r.x_min, r.x_max}, run.of_y = {r.y_min, r.y_max}, run.of_z = {r.z_min, r.z_max};
  run.work = r.work_in, run.damped = r.loss_damping, run.struck = r.loss_impact[0] + r.loss_impact[1];
  return results_of(run, scales);
}

/// The scene as a configuration's text.
[[nodiscard]] std::string text_of(const AnyScene& any) {
  const CarryScene s = as_carry_scene(any.scene);
  std::ostringstream out;
  out << std::setprecision(17) << "[scene]\nh = " << s.damping << "\nstiffness = " << s.stiffness
      << "\nf = " << s.forcing << "\nnu = " << s.frequency << "\nphase = " << s.phase << "\nload = " << s.load
      << "\nx0 = " << s.x << "\nv0 = " << s.v << "\nloose_mass = " << s.loose_mass << "\nloose_lower = " << s.lower
      << "\nloose_upper = " << s.upper << "\nloose_R = " << s.restitution << "\nloose_load = " << s.loose_load
      << "\nloose_x0 = " << s.z << "\nloose_v0 = " << s.w
      << "\n[time]\nmode = \"transient\"\nduration = " << any.duration << "\n";
  return out.str();
}

TEST(CarryingScenes, are_told_event_by_event_as_taylor_series_tell_them) {
  Tally same("the same events", carrying), off("times, relative speeds, main mass at impacts", carrying),
      ends("state at the end", carrying), results("extremes and energies", carrying);
  std::map<Kind, std::uint64_t> counts;
  std::uint64_t scenes = 0, decided = 0, cut = 0, differing = 0;
  in_every_scene(carrying, [&](const AnyScene& any) {
    const Reference reference(any);
    const Told told(any);
    const auto events = without_faded(told.events, reference.faded);
    const bool is_cut = told.outcome == stepping::Outcome::event_budget;
    const SlideMatch found = match(events, is_cut, reference.events, !reference.run.completed, reference.scales);
    const bool agrees = found.difference.empty();
    const bool is_same = (told.outcome == stepping::Outcome::completed || is_cut) &&
                         (agrees || (found.first_difference >= reference.decided && !reference.is_decided()));
    double worst = 0, end = 0, result = 0;
    for (const auto& [i, j] : found.pairs) {
      if (j >= reference.decided) break;
      raise(worst, whole_deviation(events[i], reference.events[j], reference.scales) / reference.allowed(j));
      ++counts[reference.events[j].kind];
    }
    ++scenes, cut += is_cut, differing += is_same && !agrees;
    const bool is_ended = !is_cut && is_same && reference.is_decided();
    if (is_ended) {
      const auto& [run, scales] = std::tie(reference.run, reference.scales);
      const double allowed = reference.allowed_at_end();
      end = largest_difference(told.at_end(any.scene, scales), end_of(run, scales)) / allowed;
      result = largest_difference(results_of(any, scales), results_of(run, scales)) / allowed;
      ends.take(any, end), results.take(any, result), ++decided;
    }
    if (!is_same || !(std::max({worst, end, result}) <= 1))
      std::cout << "scene " << any.index << ": " << found.difference << "\n" << text_of(any);
    same.take(any, is_same ? 0 : std::numeric_limits<double>::infinity()), off.take(any, worst);
  });
  same.conclude(1), off.conclude(1), ends.conclude(0.9), results.conclude(0.9);
  std::cout << decided << " of " << scenes << " decided, " << cut << " cut by the number of impacts, " << differing
            << " differ from where roundings decide; impacts: " << counts[Kind::impact]
            << ", times carried: " << counts[Kind::rest] << "\n";
}

}  // namespace
}  // namespace clatter::hard::carrying_scenes_test
