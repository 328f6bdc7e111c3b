// Properties of every scene, between rigid stops and soft ones: 10^4 random ones of each kind, or those that
// CLATTER_SCENES names as FROM:TO.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "hard/any_soft_scene.hpp"
#include "hard/energy.hpp"
#include "hard/inside.hpp"
#include "hard/soft_rescan.hpp"
#include "hard/tally.hpp"
#include "motion/tangent_map.hpp"
#include "observables/extremes/extrema_observer.hpp"
#include "observables/samples/samples.hpp"

namespace clatter::hard::properties_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class MotionProperties : public testing::TestWithParam<Kind> {
 protected:
  [[nodiscard]] static bool is_soft() { return GetParam().draw == any_soft_scene; }
};

INSTANTIATE_TEST_SUITE_P(, MotionProperties, testing::Values(between_rigid_stops, between_soft_stops),
                         [](const auto& kind) { return kind.param.name; });

/// Counts all that happens in a motion.
struct Contents : Watcher {
  std::uint64_t impacts = 0, rests = 0, chatters = 0, touches = 0, renewed = 0, separations = 0;

  void rest(const motion::Event& rest) { ++(rest.held ? rests : chatters); }
  void impact(const motion::Event&) { ++impacts; }
  void touch(const motion::Event& touch) { ++(touch.kind == motion::Event::Kind::touch ? touches : renewed); }
  void separate(const motion::Event&) { ++separations; }
};

TEST_P(MotionProperties, scenes_are_completed_and_hold_all_that_motion_is_made_of) {
  Tally resolved("outcome is completed or event_budget", GetParam());
  Contents all;
  std::uint64_t scenes = 0, unfinished = 0, hit = 0;
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    Contents contents;
    const stepping::Outcome outcome = watch(any, contents);
    resolved.take(any,
                  outcome == stepping::Outcome::completed || outcome == stepping::Outcome::event_budget ? 0 : infinity);
    ++scenes, hit += contents.impacts + contents.touches > 0, unfinished += outcome == stepping::Outcome::event_budget;
    all.impacts += contents.impacts, all.rests += contents.rests, all.chatters += contents.chatters;
    all.touches += contents.touches, all.renewed += contents.renewed, all.separations += contents.separations;
  });
  resolved.conclude(1);
  std::cout << hit << " scenes with impacts, " << unfinished << " over budget; " << all.impacts << " impacts, "
            << all.rests << " rests, " << all.chatters << " chatters, " << all.touches << " touches, " << all.renewed
            << " renewed, " << all.separations << " separations\n";
  if (scenes < Tally::enough) return;
  EXPECT_LT(unfinished, scenes / 25);  // pressed without loss, or nearly so
  EXPECT_GT(hit, scenes * 4 / 5);
  if (!is_soft()) {
    EXPECT_GT(all.impacts, 50 * scenes);
    EXPECT_GT(all.rests, scenes);
    EXPECT_GT(all.chatters, scenes);
  } else {
    EXPECT_GT(all.touches, 5 * scenes);
    EXPECT_GT(all.separations, 5 * scenes);
    EXPECT_GT(all.renewed, scenes / 50);
    EXPECT_GT(all.impacts, scenes);
  }
}

TEST_P(MotionProperties, arcs_stay_between_the_stops_to_two_ulps) {
  Tally tally("arcs between the stops", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    BeyondStops beyond(any.scene);
    (void)watch(any, beyond);
    tally.take(any, beyond.ulps() / 2);  // every term is known to an ulp or so; they seldom err the same way
  });
  tally.conclude(1);
}

/// Reports a motion to the observers of samples and extrema.
struct Told : ToldPlaces {
  Told(const AnyScene& any)
      : ToldPlaces(any.scene.stops), samples(100, any.duration / 99, observables::AtImpact::after, any.scene.stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    extrema.arc(arc, begin, length), samples.arc(arc, begin, length);
  }
  void rest(const motion::Event& rest) { extrema.event(rest), samples.event(rest), ToldPlaces::rest(rest); }
  void impact(const motion::Event& impact) { extrema.event(impact), samples.event(impact), ToldPlaces::impact(impact); }

  observables::Extrema::Observer extrema;
  observables::Samples samples;
};

TEST_P(MotionProperties, no_place_outside_the_stops_is_told) {
  Tally tally("reported displacements between the stops", GetParam()),
      bounds("samples between the extrema", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    Told told(any);
    with_any_stops(any.scene, [&]<Effects effects>() {
      stepping::Exact<double, effects> integrator(any.scene, limits_of(any.scene));
      motion::State<double> state = start_of(any.scene);
      support::Told shown(told);
      if (run_for(integrator, state, any.duration / integrator.period(), shown) == stepping::Outcome::completed)
        told.section(state);
    });
    const auto range = told.extrema.displacement(rigid_ones(any.scene.stops));
    told.see(range.low), told.see(range.high);
    double beyond = 0, largest = std::max(std::abs(range.low), std::abs(range.high));
    for (const double x : told.samples.displacement()) {
      told.see(x);
      beyond = std::max({beyond, range.low - x, x - range.high});
    }
    tally.take(any, told.right() ? 0 : infinity);
    bounds.take(any, beyond > 0 ? beyond / (8 * epsilon<double>() * largest) : 0);  // extrema are cut at the stops
  });
  tally.conclude(1);
  bounds.conclude(1);
}

/// Whether events come in the order of time, and soft stops begin and end to push in turn. Contact with a stiff one may
/// be shorter than an ulp of the time.
struct Order : Watcher {
  enum class Change : std::uint8_t { none, touch, separation };

  template <class A>
  void arc(const A&, double begin, double) {
    right = right && begin >= last_impact;
  }
  void rest(const motion::Event& rest) { right = right && rest.time >= last_impact && rest.length >= 0; }
  void impact(const motion::Event& impact) {
    right = right && impact.time > last_impact;
    last_impact = impact.time;
    ++impacts;
  }
  void touch(const motion::Event& touch) { change(touch.time, Change::touch); }
  void separate(const motion::Event& separation) { change(separation.time, Change::separation); }
  void change(double time, Change kind) {
    right = right && time >= last_impact && !(kind == Change::touch && last_change == kind);
    last_impact = time, last_change = kind;
    ++impacts;
  }
  void section(const motion::State<double>&) { last_impact = -infinity; }  // times count from the next one

  double last_impact = -infinity;  ///< or touch, or separation
  Change last_change = Change::none;
  std::uint64_t impacts = 0;
  bool right = true;
};

TEST_P(MotionProperties, impacts_come_strictly_one_after_the_other) {
  Tally tally("impacts in the order of time", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    Order order;
    (void)watch(any, order);
    if (order.impacts > 1) tally.take(any, order.right ? 0 : infinity);
  });
  tally.conclude(is_soft() ? 0.75 : 0.8);
}

TEST_P(MotionProperties, energy_balances_over_every_period) {
  Tally periods("energy over a period", GetParam()), runs("energy over the run", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    EnergyBooks books(any.scene);
    (void)watch(any, books);
    if (!books.in_reach()) return;
    periods.take(any, books.of_period() / 1e-11);  // a rounding an impact and panel, thousands of them
    runs.take(any, books.of_run() / 1e-11);
  });
  const double share = is_soft() ? 0.75 : 1;
  periods.conclude(share);
  runs.conclude(share);
}

TEST_P(MotionProperties, no_impact_is_missed) {
  Tally missed("no impact of Taylor steps is missed", GetParam()),
      position("displacements of Taylor steps", GetParam()), speed("velocities of Taylor steps", GetParam()),
      pressed("mass at rest is pressed", GetParam()),
      broken("motion continues from its last state and time", GetParam()),
      force("force of a soft stop by Taylor steps", GetParam());
  std::uint64_t within = 0;
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    SoftRescan rescan(any.scene);
    (void)watch(any, rescan);
    missed.take(any, rescan.missed), position.take(any, rescan.position), speed.take(any, rescan.speed);
    pressed.take(any, rescan.pressed), broken.take(any, rescan.broken), force.take(any, rescan.force);
    within += rescan.within;
  });
  for (const Tally* tally : {&missed, &position, &speed, &pressed, &broken, &force}) tally->conclude(1);
  std::cout << within << " arcs beyond a soft stop's position\n";
  EXPECT_EQ(within > 0, is_soft());
}

/// The tangent map of a motion, and its determinant by eq. 28; in contact with soft stops their dampers are added.
struct Area : Watcher {
  explicit Area(const point::Problem& scene) : damping(scene.oscillator.damping), tangent(scene.stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    tangent.arc(arc, begin, length);
    // an arc's determinant e^{-2hs} is a difference of products that are larger than it under heavy damping
    const auto p = arc.constants().propagator(length);
    const double decayed = 2 * arc.constants().h * length;
    in_stops += 2 * (arc.constants().h - damping) * length;
    rounding += (1 + decayed) * (1 + (std::abs(p.a * p.c) + p.b * p.b) * std::exp(decayed));
  }
  void rest(const motion::Event&) { smooth = false; }
  void touch(const motion::Event& touch) {
    tangent.event(touch);
    ++touches, rounding += 1;
  }
  void impact(const motion::Event& impact) {
    tangent.event(impact);
    smooth = smooth && impact.before * sign_of(impact.side) > 0 && impact.after != 0;
    ++(impact.side == Side::upper ? on_upper : on_lower);
    rounding += 1;
  }
  /// The logarithm of e^{-2hT} times R^2 for each impact (eq. 28).
  [[nodiscard]] double expected(const AnyScene& any) const {
    const Stops& stops = any.scene.stops;
    double sum = -2 * damping * any.duration - in_stops;
    if (on_lower > 0) sum += 2 * on_lower * std::log(stops.restitution_lower.R);
    if (on_upper > 0) sum += 2 * on_upper * std::log(stops.restitution_upper.R);
    return sum;
  }

  double damping;
  motion::TangentMap<double> tangent;
  double on_lower = 0, on_upper = 0, touches = 0, rounding = 0;
  double in_stops = 0;  ///< decay by their dampers
  bool smooth = true;   ///< no rest, no impact without a rebound
};

TEST_P(MotionProperties, areas_shrink_by_damping_and_restitution_alone) {
  Tally tally("determinant of the tangent map", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    Area area(any.scene);
    support::Told told(area);
    const auto outcome = with_any_stops(any.scene, [&]<Effects effects>() {
      stepping::Exact<double, effects> integrator(any.scene, limits_of(any.scene));
      motion::State<double> state = start_of(any.scene);
      return run_for(integrator, state, any.duration / integrator.period(), told);
    });
    if (outcome != stepping::Outcome::completed || !area.smooth || area.on_lower + area.on_upper + area.touches == 0)
      return;
    const double expected = area.expected(any), allowed = 4 * epsilon<double>() * (area.rounding + std::abs(expected));
    if (allowed > 1e-6 || expected < -600) return;  // nothing left of it in doubles
    tally.take(any, std::abs(std::log(area.tangent.determinant()) - expected) / allowed);
  });
  tally.conclude(0.1);
}

/// All reports of a motion as numbers, those with a sign times `sign`, those with the unit of length times `scale`.
struct Trace : Watcher {
  Trace(int sign_, double scale_) : sign(sign_), scale(sign_ * scale_) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    add({begin, length, scale * arc.start().x, scale * arc.start().v, 0});
  }
  void rest(const motion::Event& rest) {
    add({rest.time, rest.length, double(sign * sign_of(rest.side)), scale * rest.place, double(rest.held)});
  }
  void impact(const motion::Event& impact) {
    add({impact.time, double(sign * sign_of(impact.side)), scale * impact.before, scale * impact.after,
         scale * impact.place});
  }
  void touch(const motion::Event& touch) {
    add({touch.time, double(sign * sign_of(touch.side)), scale * touch.before,
         double(touch.kind == motion::Event::Kind::touch), 1});
  }
  void separate(const motion::Event& separation) {
    add({separation.time, double(sign * sign_of(separation.side)), scale * separation.before, 0, 2});
  }
  void section(const motion::State<double>& state) { add({scale * state.x, scale * state.v, state.phase_turns, 0, 0}); }
  /// A velocity that an overdamped stop takes keeps no digits below the normal numbers.
  void add(std::array<double, 5> row) {
    for (double& y : row)
      if (std::abs(y) < 1e-290) y = 0;
    rows.push_back(row);
  }

  int sign;
  double scale;
  std::vector<std::array<double, 5>> rows{};
};

AnyScene mirrored(AnyScene any) {
  Scene& scene = any.scene;
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  oscillator.forcing *= -1, oscillator.load *= -1;
  stops = {-stops.upper,          -stops.lower,          stops.restitution_upper, stops.restitution_lower,
           stops.stiffness_upper, stops.stiffness_lower, stops.damping_upper,     stops.damping_lower};
  start.displacement *= -1, start.velocity *= -1;
  return any;
}

AnyScene scaled(AnyScene any, double by) {
  Scene& scene = any.scene;
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  for (double* length :
       {&oscillator.forcing, &oscillator.load, &stops.lower, &stops.upper, &start.displacement, &start.velocity})
    *length *= by;
  return any;
}

/// The trace of a run that starts after a number of periods.
Trace traced(const AnyScene& any, int sign, double scale, std::int64_t sections = 0) {
  Trace trace(sign, scale);
  (void)watch(any, trace, sections);
  return trace;
}

TEST_P(MotionProperties, symmetries_hold_bit_for_bit) {
  Tally mirror("mirrored", GetParam()), scale("scaled by a power of two", GetParam()),
      shift("started whole periods later", GetParam());
  in_every_scene(GetParam(), [&](const AnyScene& any) {
    const auto rows = traced(any, 1, 1).rows;
    const double by = std::ldexp(1.0, static_cast<int>(any.index % 41) - 20);
    mirror.take(any, traced(mirrored(any), -1, 1).rows == rows ? 0 : infinity);
    scale.take(any, traced(scaled(any, by), 1, 1 / by).rows == rows ? 0 : infinity);
    shift.take(any, traced(any, 1, 1, std::int64_t(1) << 40).rows == rows ? 0 : infinity);
  });
  for (const Tally* tally : {&mirror, &scale, &shift}) tally->conclude(1);
}

}  // namespace
}  // namespace clatter::hard::properties_test
