#include "hard/cases.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "scene/shaking.hpp"

namespace clatter::hard {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

point::Problem symmetric(const Oscillator& oscillator, double xs, double R) {
  point::Problem scene;
  scene.oscillator = oscillator;
  scene.stops = {-xs, xs, R, R};
  return scene;
}

/// Soft stops of one kind at -xs and xs.
point::Problem soft(const Oscillator& oscillator, double xs, double kappa, double zeta) {
  point::Problem scene = symmetric(oscillator, xs, 1.0);
  scene.stops.stiffness_lower = scene.stops.stiffness_upper = kappa;
  scene.stops.damping_lower = scene.stops.damping_upper = zeta;
  return scene;
}

/// A ball under gravity on a table at x = 0 with the acceleration f sin(theta).
point::Problem on_table(double f, double R, const Start& start) {
  point::Problem scene = symmetric({0.0, f, 1.0, -1.0, 0.0}, infinity, R);
  scene.stops.lower = 0.0, scene.start = start;
  return scene;
}

/// The same motion in the frame of shaken stops, which move as b sin(theta).
point::Problem between_shaken(point::Problem scene, double b) {
  const auto [amplitude, lead] = force_in_frame(scene.oscillator, Shaking{.stops = b});
  scene.oscillator.forcing = amplitude, scene.start.phase += lead;
  return scene;
}

point::Problem starting(point::Problem scene, const Start& start) {
  scene.start = start;
  return scene;
}

/// A start on the linear steady state of h = 0.1, f = 1, nu = 1.5, with stops at its amplitude times 1 - past.
point::Problem grazing(double past) {
  const double amplitude = 0.777909841584413976;
  return starting(symmetric({0.1, 1.0, 1.5, 0.0}, amplitude * (1 - past), 0.7),
                  {-0.181543116490166415, -1.13464447806354009, 0.0});
}

/// A mass that a load presses onto the upper stop, from the middle between the stops.
point::Problem pressed(double R) { return symmetric({0.0, 0.0, 1.0, 1.0}, 0.5, R); }

/// Free vibration through |x'| = 1.5 between stops at 0.75: a contact at asin(0.5) and then every 2 asin(0.5).
point::Problem free_vibration() { return starting(symmetric({0.0, 0.0, 1.0, 0.0}, 0.75, 1.0), {0.0, 1.5, 0.0}); }

/// From rest at a place, under dry friction and without stops.
point::Problem rubbing(const Oscillator& oscillator, double kinetic, double static_level, double place = 0.0) {
  point::Problem scene = starting(symmetric(oscillator, infinity, 1.0), {place, 0.0, 0.0});
  scene.friction = {kinetic, static_level};
  return scene;
}
point::Problem between_stops(point::Problem scene, double xs, double R) {
  scene.stops = {-xs, xs, R, R};
  return scene;
}

constexpr double ulp = std::numeric_limits<double>::epsilon() / 2;  // of numbers just below 1

const Oscillator slow_force{0.1, 1.0, 0.5, 0.0};  // with stops at 0.5: chatter and rest
const double chatter_end = 4.4158803670592697;    // of slow_force, R = 0.5, from rest

std::vector<Case> all_cases() {
  const double graze_period = 2 * pi_ / 1.5, half_period = 2 * pi_;
  std::vector<Case> all;
  const auto add = [&all](const char* row, const char* what, const point::Problem& scene, double duration) {
    all.push_back({row, what, scene, duration});
  };
  add("graze", "1e-2 past", grazing(1e-2), 4 * graze_period);
  add("graze", "1e-6 past", grazing(1e-6), 4 * graze_period);
  add("graze", "1e-10 past", grazing(1e-10), 4 * graze_period);
  add("graze", "missed by 1e-12", grazing(-1e-12), 1e4 * graze_period);

  add("graze_from_rest", "1e-2 past", symmetric({0.0, 1.0, 2.0, 0.0}, std::sqrt(0.75) * (1 - 1e-2), 0.7), pi_);
  add("graze_from_rest", "1e-6 past", symmetric({0.0, 1.0, 2.0, 0.0}, std::sqrt(0.75) * (1 - 1e-6), 0.7), pi_);
  add("graze_from_rest", "1e-12 past", symmetric({0.0, 1.0, 2.0, 0.0}, std::sqrt(0.75) * (1 - 1e-12), 0.7), pi_);
  add("graze_from_rest", "missed by 1e-12", symmetric({0.0, 1.0, 2.0, 0.0}, std::sqrt(0.75) * (1 + 1e-12), 0.7), 3.0);

  add("chatter_and_rest", "R = 0.5", symmetric(slow_force, 0.5, 0.5), 16 * pi_);
  add("chatter_and_rest", "R = 0.9", symmetric(slow_force, 0.5, 0.9), 16 * pi_);
  add(
      "chatter_and_rest", "stops of unlike R",
      [] {
        point::Problem scene = symmetric({0.05, 1.0, 0.4, -0.2}, 0.3, 0.8);
        scene.stops.restitution_upper = 0.3;
        return scene;
      }(),
      20 * pi_);

  add("chatter_cut_by_end", "in its first flight", symmetric(slow_force, 0.5, 0.5), 2.5);
  add("chatter_cut_by_end", "1e-3 before its end", symmetric(slow_force, 0.5, 0.5), chatter_end - 1e-3);
  add("chatter_cut_by_end", "1e-9 before its end", symmetric(slow_force, 0.5, 0.5), chatter_end - 1e-9);
  add("chatter_cut_by_end", "1e-14 before its end", symmetric(slow_force, 0.5, 0.5), chatter_end - 1e-14);

  add("chatter_under_fast_force", "force turns once", symmetric({0.05, 1.0, 6.0, 0.1}, 0.05, 0.9), 4 * pi_);
  add("chatter_under_fast_force", "force turns often",
      starting(symmetric({0.01, 1.0, 40.0, 0.3}, 0.1, 0.95), {0.1, 0.05, 0.0}), 2 * pi_);
  add("chatter_under_fast_force", "nu = 1e4", starting(symmetric({0.1, 1.0, 1e4, 0.3}, 0.1, 0.8), {0.1, 0.05, 0.0}),
      0.2 * pi_);

  add("near_elastic_chatter", "R = 0.99", pressed(0.99), 500.0);
  add("near_elastic_chatter", "R = 0.999", pressed(0.999), 4000.0);
  add("near_elastic_chatter", "R = 0.99, slow force", symmetric({0.01, 1.0, 1e-4, 0.0}, 0.5, 0.99), 2e4 * pi_);
  add("near_elastic_chatter", "R = 0.99999", pressed(0.99999), 5e5);

  add("inelastic", "R = 0", symmetric(slow_force, 0.5, 0.0), 16 * pi_);
  add("inelastic", "R = 0, fast force", symmetric({0.1, 1.0, 20.0, 0.05}, 0.001, 0.0), 4 * pi_);

  add("tangent_release", "|f| = gap (1 + 1e-3)",
      starting(symmetric({0.1, 1.0, 0.5, 0.0}, 1 - 1e-3, 0.5), {1 - 1e-3, 0.0, pi_ / 2}), 8 * pi_);
  add("tangent_release", "|f| = gap (1 + 1e-9)",
      starting(symmetric({0.1, 1.0, 0.5, 0.0}, 1 - 1e-9, 0.5), {1 - 1e-9, 0.0, pi_ / 2}), 8 * pi_);
  add("tangent_release", "|f| = gap (1 + 1e-15)",
      starting(symmetric({0.1, 1.0, 0.5, 0.0}, 1 - 1e-15, 0.5), {1 - 1e-15, 0.0, pi_ / 2}), 8 * pi_);
  add("tangent_release", "|f| = gap", starting(symmetric({0.1, 1.0, 0.5, 0.0}, 1.0, 0.5), {1.0, 0.0, pi_ / 2}),
      8 * pi_);
  add("tangent_release", "load - gap = |f|", starting(symmetric({0.1, 1.0, 0.5, 1.5}, 0.5, 0.5), {0.5, 0.0, -pi_ / 2}),
      8 * pi_);

  add("second_contact", "back on its stop", symmetric({0.1, 1.0, 5.0, 0.9}, 0.1, 0.5), 4 * pi_);
  add("second_contact", "let go for 2e-3", starting(symmetric({0.1, 1.0, 5.0, 1.1 - 1e-5}, 0.1, 0.5), {0.1, 0.0, 0.0}),
      4 * pi_);
  add("second_contact", "let go for 1e-6", starting(symmetric({0.1, 1.0, 5.0, 1.1 - 1e-13}, 0.1, 0.5), {0.1, 0.0, 0.0}),
      4 * pi_);
  add("second_contact", "let go for 1e-8", starting(symmetric({0.1, 1.0, 5.0, 1.1 - 2e-16}, 0.1, 0.5), {0.1, 0.0, 0.0}),
      4 * pi_);
  add("second_contact", "on the other stop", symmetric({0.1, 1.0, 1.0, 0.0}, 1e-6, 0.5), 4 * pi_);

  add("close_stops", "2e-9 apart, R = 0.9", starting(symmetric({0.1, 1.0, 1.0, 0.0}, 1e-9, 0.9), {0.0, 1.0, 0.0}),
      1e-6);
  add("close_stops", "1e-9 apart, a period", symmetric({0.1, 1.0, 1.0, 0.0}, 5e-10, 0.7), 4 * pi_);
  add("close_stops", "2e-12 apart, a period", symmetric({0.1, 1.0, 1.0, 0.0}, 1e-12, 0.7), 4 * pi_);

  add("resonance", "h = 0, nu = 1", symmetric({0.0, 1.0, 1.0, 0.0}, infinity, 1.0), 200 * pi_);
  add("resonance", "h = 1e-300, nu = 1", symmetric({1e-300, 1.0, 1.0, 0.0}, infinity, 1.0), 200 * pi_);
  add("resonance", "h = 0, nu = 1 + ulp", symmetric({0.0, 1.0, std::nextafter(1.0, 2.0), 0.0}, infinity, 1.0),
      200 * pi_);
  add("resonance", "h = 1e-9, nu = 1 - 1e-9", symmetric({1e-9, 1.0, 1 - 1e-9, 0.0}, infinity, 1.0), 200 * pi_);
  add("resonance", "h = 0, nu = 1, stops at 3", symmetric({0.0, 1.0, 1.0, 0.0}, 3.0, 0.8), 20 * pi_);

  for (const auto& [what, h] : {std::pair{"h = 1 - 1e-12", 1 - 1e-12},
                                {"h = 1", 1.0},
                                {"h = 1 + 1e-12", 1 + 1e-12},
                                {"h = 10", 10.0},
                                {"h = 1000", 1000.0}})
    add("damping", what, symmetric({h, 2 * h, 0.5, 0.0}, 0.5, 0.6), 16 * pi_);

  add("scales", "xs = 1e-9", symmetric({0.1, 1.0, 0.5, 0.0}, 1e-9, 0.5), 4 * pi_);
  add("scales", "xs = 1e9, f = 2e9", symmetric({0.1, 2e9, 0.5, 0.0}, 1e9, 0.5), 16 * pi_);
  add("scales", "xs = 1e9, f = 1", symmetric({0.1, 1.0, 0.5, 0.0}, 1e9, 0.5), 16 * pi_);
  add("scales", "nu = 1e-3", symmetric({0.1, 1.0, 1e-3, 0.0}, 0.5, 0.5), 2e3 * pi_ * 2);
  add("scales", "nu = 1e3", symmetric({0.1, 1.0, 1e3, 0.2}, 1e-3, 0.5), 0.08 * pi_);
  add("scales", "f = 0", starting(symmetric({0.1, 0.0, 1.0, 0.0}, 0.5, 0.5), {0.0, 3.0, 0.0}), 100.0);
  add("scales", "f = 1e-300", starting(symmetric({0.1, 1e-300, 1.0, 0.0}, 0.5, 0.5), {0.0, 3.0, 0.0}), 100.0);

  add("edges", "start moving in", starting(symmetric(slow_force, 0.5, 0.5), {0.5, 0.25, 0.0}), half_period);
  add("edges", "start moving out", starting(symmetric(slow_force, 0.5, 0.5), {0.5, -0.25, 0.0}), half_period);
  add("edges", "start at rest, pressed", starting(symmetric(slow_force, 0.5, 0.5), {0.5, 0.0, pi_ / 2}), half_period);
  add("edges", "start at rest, pulled", starting(symmetric(slow_force, 0.5, 0.5), {0.5, 0.0, 0.0}), half_period);

  add("last_instant", "contact at the end", free_vibration(), 3 * std::asin(0.5));
  add("last_instant", "end 1e-12 later", free_vibration(), 3 * std::asin(0.5) * (1 + 1e-12));
  add("last_instant", "end 1e-12 sooner", free_vibration(), 3 * std::asin(0.5) * (1 - 1e-12));
  add("last_instant", "forced, at the end", symmetric(slow_force, 0.5, 0.5), 2.0515931595927638);

  add("long", "conservative impacts", free_vibration(), 1e6 * 2 * std::asin(0.5));
  add("long", "1e7 forcing periods", grazing(-1), 1e7 * graze_period);

  const Oscillator unsprung{0.05, 0.5, 1.0, 0.0, 0.0}, unstable{0.1, 1.0, 1.0, 0.0, -1.0};
  add("no_spring", "dropped, until it rests", on_table(0.0, 0.9, {1.0, 0.0, 0.0}), 40.0);
  add("no_spring", "rests, and is thrown again", on_table(1.5, 0.3, {0.0, 0.0, 0.0}), 40 * pi_);
  add("no_spring", "ball between walls", starting(symmetric(unsprung, 0.3, 0.9), {0.0, 1.0, 0.0}), 40 * pi_);
  add("no_spring", "k = 1e-300", starting(symmetric({0.05, 0.5, 1.0, 0.0, 1e-300}, 0.3, 0.9), {0.0, 1.0, 0.0}),
      40 * pi_);
  add("no_spring", "k = -1e-300", starting(symmetric({0.05, 0.5, 1.0, 0.0, -1e-300}, 0.3, 0.9), {0.0, 1.0, 0.0}),
      40 * pi_);
  add("no_spring", "h = 1e-300", starting(symmetric({1e-300, 0.5, 1.0, 0.0, 0.0}, 0.3, 0.7), {0.0, 1.0, 0.0}),
      10 * pi_);
  add("no_spring", "h = 100", symmetric({100.0, 200.0, 0.5, 0.0, 0.0}, 0.5, 0.6), 16 * pi_);

  add("unstable_spring", "thrown between walls", symmetric(unstable, 0.5, 0.8), 8 * pi_);
  add("unstable_spring", "at rest at the top, moved by an ulp",
      starting(symmetric({0.0, 0.0, 1.0, 0.0, -1.0}, 0.5, 0.5), {2.3e-16, 0.0, 0.0}), 60.0);
  add("unstable_spring", "over the top by 1e-12",
      starting(symmetric({0.0, 0.0, 1.0, 0.0, -1.0}, 0.5, 0.8), {-0.5 * (1 - 1e-12), 0.5, 0.0}), 60.0);
  add("unstable_spring", "k = -100, chatter and rest", symmetric({0.1, 10.0, 1.0, 0.0, -100.0}, 0.3, 0.5), 8 * pi_);

  const double contact = pi_ / std::sqrt(1e6 + 1);
  add("soft_stops", "kappa = 1e12", soft({0.1, 1.0, 1.3, 0.0}, 0.3, 1e12, 0.2), 8 * pi_);
  add("soft_stops", "kappa = 1e-3", soft({0.1, 1.0, 1.3, 0.0}, 0.3, 1e-3, 0.2), 8 * pi_);
  add("soft_stops", "zeta = 1", soft({0.1, 1.0, 1.3, 0.0}, 0.3, 1e4, 1.0), 8 * pi_);
  add("soft_stops", "zeta = 1e3", soft({0.1, 1.0, 1.3, 0.0}, 0.3, 1e4, 1e3), 8 * pi_);
  add(
      "soft_stops", "graze by 1e-10",
      [] {
        point::Problem scene = grazing(1e-10);
        scene.stops.stiffness_lower = scene.stops.stiffness_upper = 1e6,
        scene.stops.damping_lower = scene.stops.damping_upper = 0.3;
        return scene;
      }(),
      4 * graze_period);
  add("soft_stops", "force in resonance with the contact", soft({0.0, 1.0, 2.0, 0.5}, 0.1, 3.0, 0.0), 8 * pi_);
  add("soft_stops", "ends in the middle of a contact", starting(soft({}, 0.5, 1e6, 0.0), {0.5, 1.0, 0.0}), contact / 2);
  add("soft_stops", "pressed for ever, stiff", soft({0.1, 1.0, 0.7, 3.0}, 0.5, 1e6, 0.5), 8 * pi_);
  add("soft_stops", "k = -3, kappa = 3 + 1e-9", soft({0.2, 0.3, 1.0, 0.0, -3.0}, 0.5, 3 + 1e-9, 0.1), 2 * pi_);

  add("shaken_stops", "chatter and rest", between_shaken(symmetric({0.1, 0.5, 0.5, 0.0}, 0.5, 0.5), 0.8), 16 * pi_);
  add("shaken_stops", "nothing but the stops moves", between_shaken(symmetric({0.05, 0.0, 2.0, 0.0}, 0.2, 0.8), 0.3),
      8 * pi_);
  add("shaken_stops", "at the spring's frequency", between_shaken(symmetric({0.0, 1.0, 1.0, 0.0}, 0.5, 0.8), 1.0),
      8 * pi_);

  // free motion turns at x0 - 2n mu, n = 1, 2, ..., and sticks at the first such place within the static level over k
  for (const auto& [what, level] :
       {std::pair{"turn 200 just sticks", 1.5 * (1 + 1e-11)}, {"turn 200 just doesn't", 1.5 * (1 - 1e-11)}})
    add("dry_friction", what, rubbing({}, 1.0, level, 401.5), 210 * pi_);
  for (const auto& [what, kinetic, level] : {std::tuple{"let go at |f| = level (1 + 1e-9)", 0.5, 1 - 1e-9},
                                             {"let go at |f| = level (1 + 2 ulps)", 0.5, 1 - 2 * ulp},
                                             {"the same, mu = level", 1 - 2 * ulp, 1 - 2 * ulp},
                                             {"held at |f| = level (1 - 2 ulps)", 0.5, 1 + 4 * ulp}})
    add("dry_friction", what, between_stops(rubbing({0.05, 1.0, 0.5, 0.5}, kinetic, level, 0.5), 0.8, 0.7), 24 * pi_);
  add("dry_friction", "mu = f", between_stops(rubbing({0.1, 1.0, 0.7, 0.0}, 1.0, 1.0, 0.25), 0.5, 0.7), 40 * pi_);
  add("dry_friction", "mu = f, carried along by a load", rubbing({0.1, 1.0, 0.7, 0.3}, 1.0, 1.0), 80 * pi_);
  add("dry_friction", "static 100 times sliding", between_stops(rubbing({0.05, 1.0, 0.3, 0.0}, 9e-3, 0.9), 2.0, 0.7),
      40 * pi_);
  add("dry_friction", "chatter to rest, R = 1", between_stops(rubbing({0.0, 0.0, 1.0, 1.0}, 0.02, 0.1), 0.5, 1.0),
      200.0);
  add(
      "dry_friction", "chatter into a stick",
      [] {
        point::Problem scene = between_stops(rubbing({0.0, 0.5, 0.02, 0.9}, 0.01, 0.3), 0.2, 1.0);
        scene.start.phase = pi_;
        return scene;
      }(),
      50 * pi_);
  add("dry_friction", "stays off the stop", between_stops(rubbing({0.05, 0.0, 1.0, 1.0}, 0.1, 0.55), 0.5, 0.9), 20.0);

  add("chaos", "xs = 3, nu = 0.95", symmetric({0.1, -1.0, 0.95, 0.0}, 3.0, 0.7), 100 * 2 * pi_ / 0.95);
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = all_cases();
  return all;
}

std::vector<Case> cases_of(const std::string& row) {
  std::vector<Case> found;
  for (const Case& one : cases())
    if (one.row == row) found.push_back(one);
  if (found.empty()) throw std::out_of_range("no hard cases called " + row);
  return found;
}

const Case& case_of(const std::string& row, const std::string& what) {
  for (const Case& one : cases())
    if (one.row == row && one.what == what) return one;
  throw std::out_of_range("no hard case called " + row + ", " + what);
}

}  // namespace clatter::hard
