#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "math/number.hpp"
#include "motion/walls.hpp"
#include "point/point.hpp"
#include "stepping/integration.hpp"
#include "support/random.hpp"

namespace clatter::support {

/// A main mass from rest that carries a loose one between walls at -gap and +gap.
[[nodiscard]] inline point::Problem loose_scene(double eps, double h, double f, double nu, double gap, double R) {
  point::Problem scene;
  scene.oscillator = {.damping = h, .forcing = f, .frequency = nu};
  scene.loose = {.ratio = eps, .lower = -gap, .upper = gap, .restitution_lower = R, .restitution_upper = R};
  return scene;
}

/// An impact damper that settles from rest on two impacts a period, half a period apart, with this z' (Masri & Caughey
/// 1966).
[[nodiscard]] inline point::Problem impact_damper() { return loose_scene(0.02, 0.005, 0.01, 1, 0.4, 0.8); }
inline constexpr double impact_damper_speed = 0.418893828273064;

/// Impacts, chatter on the lower wall and a time for which that presses, in each period.
[[nodiscard]] inline point::Problem pressed_scene() {
  point::Problem scene = loose_scene(0.5, 0.1, 0.4, 0.6, 1, 0.3);
  scene.loose.load = -0.3, scene.loose.lower = -0.1;
  return scene;
}

/// Scenes with a loose mass that differ in what it does. The names say how.
struct NamedLooseScene {
  const char* name;
  point::Problem scene;
};
[[nodiscard]] inline std::vector<NamedLooseScene> every_loose_kind() {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<NamedLooseScene> scenes{{"impact damper", impact_damper()},
                                      {"heavy mass", loose_scene(0.8, 0.05, 0.4, 1.7, 0.3, 0.7)},
                                      {"pressed", pressed_scene()},
                                      {"pressed for good", loose_scene(0.3, 0.02, 0.05, 1.7, 0.3, 0.7)},
                                      {"one wall", loose_scene(0.2, 0.1, 0.6, 1.3, 1, 0.6)},
                                      {"heavy damping", loose_scene(0.1, 1.4, 1.5, 0.8, 0.5, 0.5)},
                                      {"inelastic", loose_scene(0.1, 0.1, 0.5, 1.2, 0.4, 0)},
                                      {"free and elastic", loose_scene(0.4, 0, 0, 1, 0.5, 1)},
                                      {"at rest on a wall", loose_scene(0.3, 0.1, 0.5, 1.2, 0.4, 0.5)},
                                      {"stands until it is met", loose_scene(0.1, 0.05, 0.6, 1.3, 0.3, 0.6)}};
  scenes[3].scene.loose.load = 0.2;
  scenes[4].scene.loose.load = -0.4, scenes[4].scene.loose.upper = none;
  scenes[7].scene.start.velocity = 0.3, scenes[7].scene.loose.velocity = 0.2;
  scenes[8].scene.loose.place = scenes[8].scene.loose.lower;  // which doesn't press at the start, but from then on
  return scenes;
}

/// A random scene whose loose mass strikes its walls every now and then.
[[nodiscard]] inline point::Problem random_loose_scene(std::uint64_t index) {
  Random random(20611, index);
  point::Problem scene = loose_scene(random.logarithmic(1e-2, 1), random.uniform(0.02, 0.5), random.uniform(0.2, 1),
                                     random.uniform(0.5, 2), random.logarithmic(0.1, 1), random.uniform(0.2, 0.9));
  scene.start = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0, 6)};
  scene.oscillator.load = random.uniform(-0.2, 0.2);
  scene.loose.place = random.uniform(scene.loose.lower, scene.loose.upper);
  scene.loose.velocity = random.uniform(-0.5, 0.5);
  if (random.happens(0.5)) scene.loose.load = random.uniform(-0.4, 0.4);
  return scene;
}

/// Records the impacts of a loose mass, and the times in which a wall presses it.
struct LooseRecorder {
  std::vector<motion::Event> strikes{};
  std::vector<motion::Event> presses{};
  std::vector<motion::Event> holds{};

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind == Kind::strike) strikes.push_back(event);
    if (event.kind == Kind::press) presses.push_back(event);
    if (event.kind == Kind::hold) holds.push_back(event);
  }
};

/// A run from the start of a scene for a time in tau.
struct LooseRun {
  LooseRecorder record{};
  motion::State<double> end{};
  double z = 0.0, w = 0.0;  ///< at the end
  stepping::Outcome outcome = stepping::Outcome::unresolved;
};
[[nodiscard]] LooseRun run_loose(const point::Problem& scene, double duration);

/// The steady motion of a scene, with all that is observed of a loose mass.
[[nodiscard]] inline point::PointResult observed(point::Problem scene) {
  scene.observe.extrema = scene.observe.impacts = scene.observe.impact_log = scene.observe.stability = true;
  scene.observe.word = scene.observe.period = scene.observe.energy = true;
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

}  // namespace clatter::support
