#include "motion/soft_neighbourhood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/watched_run.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"
#include "support/scene_range.hpp"

namespace clatter::motion::soft_neighbourhood_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon(), none = std::numeric_limits<double>::infinity();

template <class Function>
auto with_effects_of(const point::Problem& scene, Function&& function) {
  return rotates(scene.oscillator)
             ? function.template operator()<effect_sets::with_soft_stops(Damping::light, Forcing::secular)>()
             : function.template operator()<effect_sets::with_soft_stops(Damping::heavy, Forcing::regular)>();
}

std::optional<Run> run(const point::Problem& scene, State<double> state, double turns) {
  return with_effects_of(scene, [&]<Effects effects>() { return run<effects>(scene, state, turns); });
}

SoftNeighbourhood neighbourhood_of(const point::Problem& scene, State<double> state, double turns,
                                   const Ellipse& start) {
  return with_effects_of(scene, [&]<Effects effects>() {
    stepping::Exact<double, effects> integrator(scene);
    SoftNeighbourhood neighbourhood(scene.stops, start, 64 * ulp * (std::abs(state.x) + std::abs(state.v)));
    EXPECT_EQ(run_for(integrator, state, turns, neighbourhood), stepping::Outcome::completed);
    return neighbourhood;
  });
}

/// Number of proofs that were found, and the tightness of their enclosures.
struct Tally {
  int proved = 0, refused = 0, touched = 0, renewed = 0, impacts = 0, from_within = 0;
  double tightest = 0;  ///< the largest remainder beyond the derivative, over its enclosure
  double large = 0;     ///< the widest neighbourhood proved with contacts
};

/// A random scene with a soft stop or two, its start and the size of the neighbourhood.
struct Case {
  point::Problem scene;
  State<double> from;
  double turns, size, skew, wide;
};

Case any_case(std::uint64_t seed, std::uint64_t i) {
  support::Random random(seed, i);
  const double g = random.logarithmic(0.1, 2), nu = random.logarithmic(0.3, 3);
  const double h = random.happens(0.3) ? 0 : random.happens(0.8) ? random.logarithmic(1e-4, 0.8) : random.uniform(1, 3);
  Case any;
  any.scene = support::scene_of({h, 1.0, nu, random.uniform(-0.3, 0.3)}, -g, g * random.uniform(0.5, 2), 0);
  if (random.happens(0.4)) any.scene.oscillator.stiffness = random.happens(0.5) ? 0 : -random.uniform(0.1, 1);
  Stops& stops = any.scene.stops;
  const auto any_stiffness = [&] { return random.happens(0.3) ? random.uniform(1.1, 3) : random.logarithmic(3, 1e5); };
  const auto any_damping = [&] {
    return random.happens(0.3) ? 0 : random.happens(0.7) ? random.logarithmic(1e-3, 1) : random.uniform(1, 4);
  };
  stops.stiffness_lower = any_stiffness(), stops.damping_lower = any_damping();
  stops.stiffness_upper = any_stiffness(), stops.damping_upper = any_damping();
  if (random.happens(0.2)) stops.stiffness_upper = none, stops.restitution_upper = random.uniform(0.2, 1);
  if (random.happens(0.1) && any.scene.oscillator.stiffness == 1) stops.upper = none;
  any.from = at(random.uniform(-1.0 * g, 0.4 * g), random.uniform(-2, 2));
  if (random.happens(0.3)) any.from.x = stops.lower - random.uniform(0, 2 / std::sqrt(stops.stiffness_lower));
  any.turns = random.uniform(0.3, 3), any.size = random.logarithmic(1e-9, 1e-1);
  any.skew = random.uniform(-0.9, 0.9), any.wide = random.logarithmic(0.01, 3);
  return any;
}

/// A stop that the steady motion of amplitude A of the oscillator alone nearly or just reaches.
Case grazing_case(std::uint64_t seed, std::uint64_t i) {
  Case any = any_case(seed, i);
  support::Random random(seed + 1, i);
  any.scene.oscillator.damping = random.uniform(0, 0.5), any.scene.oscillator.stiffness = 1;
  const PhasePoint start = response_at(any.scene.oscillator, 0.0, 1.0);
  any.from = at(equilibrium_of(any.scene.oscillator) + start.x, start.v);
  const double amplitude = steady_response(any.scene.oscillator.damping, 1.0, any.scene.oscillator.frequency).amplitude;
  any.scene.stops.lower =
      equilibrium_of(any.scene.oscillator) - amplitude * (1 + random.sign() * random.logarithmic(1e-9, 1e-1));
  any.scene.stops.upper = equilibrium_of(any.scene.oscillator) + amplitude * random.uniform(1.1, 2);
  return any;
}

/// Stops of strong dampers, which a force shakes off and presses again.
Case shaken_case(std::uint64_t seed, std::uint64_t i) {
  Case any = any_case(seed, i);
  support::Random random(seed + 1, i);
  Stops& stops = any.scene.stops;
  stops.stiffness_lower = random.logarithmic(1.2, 100), stops.stiffness_upper = random.logarithmic(1.2, 100);
  stops.damping_lower = random.uniform(0.5, 5), stops.damping_upper = random.uniform(0.5, 5);
  any.scene.oscillator.frequency = random.uniform(1, 8), any.scene.oscillator.forcing = random.uniform(1, 8);
  any.scene.oscillator.load = -random.uniform(0, 1) * (1 - stops.lower);
  any.size = random.logarithmic(1e-7, 1e-1);
  return any;
}

/// Begins or ends near an event.
Case close_case(std::uint64_t seed, std::uint64_t i) {
  Case any = i % 3 == 0 ? shaken_case(seed, i) : any_case(seed, i);
  support::Random random(seed + 2, i);
  if (random.happens(0.3)) any.from.x = any.scene.stops.lower + random.sign() * random.logarithmic(1e-9, 1e-1);
  point::Problem scene = any.scene;
  scene.start = {any.from.x, any.from.v, 0};
  const double period = period_of(scene.oscillator);
  const auto record = support::run_scene(scene, any.turns * period).record;
  std::vector<double> times;
  for (const Event& touch : record.touches) times.push_back(touch.time);
  for (const Event& separation : record.separations) times.push_back(separation.time);
  if (times.empty()) return any;
  const double time = times[static_cast<std::size_t>(random.uniform(0, static_cast<double>(times.size())))];
  any.turns = std::max(0.01, (time + random.sign() * random.logarithmic(1e-9, 1e-1)) / period);
  return any;
}

/// The largest frequency of motion in contact: an ulp of the clock is so many of the velocity, by the acceleration
/// there.
double stiffest(const Stops& stops) {
  double most = 1;
  for (const double kappa : {stops.stiffness_lower, stops.stiffness_upper})
    if (std::isfinite(kappa)) most = std::max(most, std::sqrt(1 + kappa));
  return most;
}

/// A change in a direction, a part of the way to the edge of the ellipse: by its Cholesky factor.
Perturbation change_of(const Case& any, double angle, double part) {
  const double along = part * std::cos(angle), across = part * std::sin(angle), root = std::sqrt(any.wide);
  return {root * any.size * along,
          any.size * (any.skew / root * along + std::sqrt((1 - any.skew * any.skew) / any.wide) * across)};
}

void check(const Case& any, std::uint64_t i, Tally& tally) {
  const double size = any.size, skew = any.skew, wide = any.wide;
  const Ellipse start(size * size * wide, size * size * skew, size * size / wide);
  const std::optional<Run> seen = run(any.scene, any.from, any.turns);
  const SoftNeighbourhood proof = neighbourhood_of(any.scene, any.from, any.turns, start);
  if (!seen || !proof.holds()) {
    ++tally.refused;
    return;
  }
  ++tally.proved;
  point::Problem scene = any.scene;
  scene.start = {any.from.x, any.from.v, 0};
  if (seen->itinerary != 0) {
    const auto record = support::run_scene(scene, any.turns * period_of(scene.oscillator)).record;
    for (const Event& touch : record.touches)
      ++(touch.kind == motion::Event::Kind::touch ? tally.touched : tally.renewed);
    tally.impacts += static_cast<int>(record.impacts.size());
    tally.from_within += record.separations.size() > record.touches.size();
    tally.large = std::max(tally.large, size);
  }
  for (int k = 0; k < 24; ++k) {
    const Perturbation change = change_of(any, 2 * pi<double>() * k / 24, k % 3 == 0 ? 0.5 : 1.0);
    const std::optional<Run> other = run(any.scene, at(any.from.x + change.x, any.from.v + change.v), any.turns);
    EXPECT_TRUE(other) << i;
    if (!other) continue;
    EXPECT_EQ(other->itinerary, seen->itinerary) << i << " change " << size;
    const Perturbation linear = seen->derivative * change, real = between(seen->end, other->end);
    double rounding = 256 * ulp * (1 + std::abs(any.from.v)) * stiffest(any.scene.stops), entries = 2;
    for (const double entry : seen->derivative) entries += std::abs(entry);
    rounding *= entries;
    EXPECT_LE(std::abs(real.x - linear.x), proof.remainder().x() + rounding) << i << " change " << size;
    EXPECT_LE(std::abs(real.v - linear.v), proof.remainder().v() + rounding) << i << " change " << size;
    if (!(proof.first_order().size() > 1e-150)) continue;  // its square underflows
    EXPECT_LE(std::abs(linear.x), proof.first_order().x() * (1 + 1e-9) + rounding) << i;
    EXPECT_LE(std::abs(linear.v), proof.first_order().v() * (1 + 1e-9) + rounding) << i;
    if (proof.remainder().v() > 1e3 * rounding)
      tally.tightest = std::max(tally.tightest, std::abs(real.v - linear.v) / proof.remainder().v());
  }
}

void report(const Tally& tally) {
  std::cout << tally.proved << " proved, " << tally.refused << " refused; " << tally.touched << " touches, "
            << tally.renewed << " renewed, " << tally.impacts << " impacts, " << tally.from_within
            << " from within; tightest " << tally.tightest << ", largest " << tally.large << "\n";
}

template <class Draw>
Tally enclose(std::uint64_t seed, Draw&& draw) {
  Tally tally;
  const auto [from, to] = support::scene_range(1500);
  for (std::uint64_t i = from; i < to; ++i) check(draw(seed, i), i, tally);
  report(tally);
  return tally;
}

/// A proof that refuses nearly all is of no use, one that refuses nothing is none, and its bounds have to be tight.
void expect_useful(const Tally& tally, double least_proved, double least_refused) {
  const double all = tally.proved + tally.refused;
  EXPECT_GT(tally.proved, least_proved * all);
  EXPECT_GT(tally.refused, least_refused * all);
  EXPECT_GT(tally.tightest, 0.3);
}

TEST(SoftNeighbourhood, encloses_all_motions_that_begin_in_it) {
  const Tally tally = enclose(31, any_case);
  expect_useful(tally, 0.4, 0.2);
  EXPECT_GT(tally.touched, tally.proved);
  EXPECT_GT(tally.impacts, tally.proved / 10);  // on rigid stops beside soft ones
  EXPECT_GT(tally.from_within, tally.proved / 20);
}

TEST(SoftNeighbourhood, encloses_motions_near_a_graze) {
  const Tally tally = enclose(32, grazing_case);
  expect_useful(tally, 0.3, 0.3);
  EXPECT_GT(tally.touched, tally.proved / 4);
}

TEST(SoftNeighbourhood, encloses_motions_that_are_pressed_again_within_a_stop) {
  const Tally tally = enclose(33, shaken_case);
  expect_useful(tally, 0.4, 0.2);
  EXPECT_GT(tally.renewed, tally.proved / 50);
}

TEST(SoftNeighbourhood, encloses_motions_that_begin_or_end_near_an_event) {
  const Tally tally = enclose(34, close_case);
  expect_useful(tally, 0.2, 0.4);
  EXPECT_GT(tally.touched, tally.proved / 2);
}

TEST(SoftNeighbourhood, counts_the_velocity_in_the_margin_of_a_force_that_nearly_falls_to_zero) {
  Tally tally;
  for (const std::uint64_t i : {6126u, 9630u}) check(close_case(34, i), i, tally);
}

/// A displacement and a velocity in 50 digits.
struct Exactly {
  FiftyDigits x, v;
};

/// The ends of motions that begin a little beside that of a case.
class Ends {
 public:
  explicit Ends(const Case& any) : any_(any) {}

  /// Of a run that is longer by a part of a forcing period.
  [[nodiscard]] Exactly operator()(const FiftyDigits& dx, const FiftyDigits& dv, const FiftyDigits& longer = 0) const {
    const auto run =
        support::run_from<FiftyDigits>(any_.scene, any_.from.x + dx, any_.from.v + dv, any_.turns + longer);
    EXPECT_EQ(run.outcome, stepping::Outcome::completed);
    return {run.end.x, run.end.v};
  }
  /// The derivative along a change, by central differences: their error is of the order of the step, 1e-25, if a damper
  /// begins to push, and rounding adds as much.
  [[nodiscard]] Exactly along(const Perturbation& change) const {
    const FiftyDigits step("1e-25");
    const Exactly after = (*this)(step * change.x, step * change.v),
                  before = (*this)(-step * change.x, -step * change.v);
    return {(after.x - before.x) / (2 * step), (after.v - before.v) / (2 * step)};
  }

 private:
  const Case& any_;
};

/// Checks the enclosure of the second order without any allowance for rounding; false if nothing is proved.
bool check_exactly(const Case& any, std::uint64_t i) {
  const double size = any.size, skew = any.skew, wide = any.wide;
  const SoftNeighbourhood proof = neighbourhood_of(any.scene, any.from, any.turns,
                                                   Ellipse(size * size * wide, size * size * skew, size * size / wide));
  if (!proof.holds()) return false;
  const Ends ends(any);
  const Exactly end = ends(0, 0);
  for (int k = 0; k < 6; ++k) {
    const Perturbation change = change_of(any, k * pi<double>() / 3, 1.0);
    const Exactly other = ends(change.x, change.v), linear = ends.along(change);
    const auto x = static_cast<double>(abs(other.x - end.x - linear.x)),
               v = static_cast<double>(abs(other.v - end.v - linear.v));
    EXPECT_LE(x, proof.remainder().x() * (1 + 1e-9) + 1e-21) << i << " change " << size;
    EXPECT_LE(v, proof.remainder().v() * (1 + 1e-9) + 1e-21) << i << " change " << size;
  }
  return true;
}

TEST(SoftNeighbourhood, its_bounds_hold_in_fifty_digits_without_an_allowance_for_rounding) {
  const auto [from, to] = support::scene_range(60);
  std::uint64_t proved = 0;
  for (std::uint64_t i = from; i < to; ++i)
    proved += check_exactly(i % 3 == 0 ? any_case(35, i) : i % 3 == 1 ? shaken_case(35, i) : close_case(35, i), i);
  EXPECT_GT(proved, (to - from) / 3);
}

/// Those of 200 000 scenes with the largest differences beyond the bounds: their runs end in contact.
TEST(SoftNeighbourhood, rounding_at_the_end_of_a_contact_is_that_of_the_clock) {
  for (const std::uint64_t i : {1911u, 8330u, 133603u}) {
    const Case any = any_case(31, i);
    EXPECT_TRUE(check_exactly(any, i)) << i;
    const auto seen = run(any.scene, any.from, any.turns);
    ASSERT_TRUE(seen);
    const Ends ends(any);
    const FiftyDigits step("1e-25");
    const double period = period_of(any.scene.oscillator), unit = ulp * (1 + std::abs(any.from.v));
    const Exactly end = ends(0, 0), later = ends(0, 0, step), earlier = ends(0, 0, -step);
    const auto acceleration = static_cast<double>((later.v - earlier.v) / (2 * step) / period);
    const auto off_x = static_cast<double>(seen->end.x - end.x), off_v = static_cast<double>(seen->end.v - end.v);
    // an error of the clock moves the end along the motion: by v in displacement, by the acceleration in velocity
    const double clock = off_v / acceleration;
    EXPECT_GT(std::abs(off_v), 16 * unit) << i;
    EXPECT_LT(std::abs(clock), 4 * ulp * period) << i;
    EXPECT_NEAR(off_x, seen->end.v * clock, 4 * unit) << i;
  }
}

}  // namespace
}  // namespace clatter::motion::soft_neighbourhood_test
