// Random scenes with a loose mass, and with rigid and soft stops and friction: the program against the simulator of
// `machine.hpp`, which knows no kinds of scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "hard/any_carrying_scene.hpp"
#include "hard/any_sliding_scene.hpp"
#include "hard/as_machine.hpp"
#include "hard/machine.hpp"
#include "hard/tally.hpp"
#include "point/point.hpp"

namespace clatter::hard::machines_test {
namespace {

constexpr std::size_t most_contacts = 4000;

/// A contact that is faster than the last of a chatter.
struct Contact {
  int where;  ///< -1, 1: a stop; -2, 2: a wall
  double time, before;
};
/// x, x', z, z'.
using State = std::array<double, 4>;

struct Motion {
  std::vector<Contact> contacts{};
  State end{};
  bool is_complete = false;
};

/// Impacts slower than this share of the fastest may belong to the end of a chatter, of which programs take as many as
/// they like.
constexpr double slow = 1e-7;

[[nodiscard]] std::vector<Contact> without_slow(std::vector<Contact> contacts) {
  double fastest = 0;
  for (const Contact& contact : contacts) fastest = std::max(fastest, std::abs(contact.before));
  std::erase_if(contacts, [&](const Contact& contact) { return !(std::abs(contact.before) > slow * fastest); });
  return contacts;
}

[[nodiscard]] Motion simulated(const MachineScene& scene, double duration) {
  using Kind = MachineEvent::Kind;
  const MachineRun run = run_machine(scene, duration, most_contacts);
  Motion motion;
  for (const MachineEvent& e : run.events)
    if (e.kind == Kind::stop_impact || e.kind == Kind::wall_impact || e.kind == Kind::touch)
      motion.contacts.push_back({e.kind == Kind::wall_impact ? 2 * e.side : e.side, static_cast<double>(e.time),
                                 static_cast<double>(e.before)});
  motion.contacts = without_slow(std::move(motion.contacts));
  motion.end = {static_cast<double>(run.x), static_cast<double>(run.v), static_cast<double>(run.z),
                static_cast<double>(run.w)};
  motion.is_complete = run.finished;
  return motion;
}

[[nodiscard]] Motion told(point::Problem problem) {
  problem.time.max_impacts = most_contacts;
  problem.observe.full_log = true;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  Motion motion;
  const int part = has_loose_mass(problem.loose) ? 2 : 1;
  for (const auto& impact : result.log)
    motion.contacts.push_back({part * sign_of(impact.side), impact.time, impact.before});
  motion.contacts = without_slow(std::move(motion.contacts));
  const auto& end = result.end;
  motion.end = {end.displacement, end.velocity, end.loose_place, end.loose_velocity};
  motion.is_complete = result.status == steady::Status::transient;
  return motion;
}

/// The first contact that is another one, or so much earlier or later; none: the number of them.
[[nodiscard]] std::size_t first_difference(const Motion& a, const Motion& b, double time) {
  const std::size_t count = std::min(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < count; ++i)
    if (a.contacts[i].where != b.contacts[i].where || !(std::abs(a.contacts[i].time - b.contacts[i].time) <= time))
      return i;
  return count;
}
[[nodiscard]] bool are_alike(const Motion& a, const Motion& b, double time) {
  return a.contacts.size() == b.contacts.size() && first_difference(a, b, time) == a.contacts.size();
}
[[nodiscard]] double distance(const State& a, const State& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) raise(most, std::abs(a[i] - b[i]));
  return most;
}

/// The scene with each input moved by some roundings.
[[nodiscard]] MachineScene moved(const AnyScene& any, std::uint64_t way, double roundings) {
  support::Random random(20702, 8 * any.index + way);
  MachineScene scene = as_machine(any.scene);
  const MachineScene given = scene;
  for (double* value : {&scene.damping, &scene.stiffness, &scene.forcing, &scene.frequency, &scene.load,
                        &scene.friction, &scene.lower, &scene.upper, &scene.loose_mass, &scene.wall_lower,
                        &scene.wall_upper, &scene.loose_load, &scene.x, &scene.v, &scene.z, &scene.w})
    *value *= 1 + random.sign() * roundings * epsilon<double>();
  scene.phase += random.sign() * roundings * epsilon<double>();
  scene.static_friction = std::max(scene.friction, given.static_friction);
  if (given.z == given.wall_lower) scene.z = scene.wall_lower;
  if (given.z == given.wall_upper) scene.z = scene.wall_upper;
  if (given.x == given.lower) scene.x = scene.lower;
  if (given.x == given.upper) scene.x = scene.upper;
  return scene;
}

/// Compares the state at the end if roundings of the inputs don't change it much, and the contacts unless the program
/// sums those of a chatter. The program rounds at each event, so it may be off by what some roundings of all inputs do.
void compare(const Kind& kind, bool sums_chatter) {
  Tally same("the same contacts", kind), off("state at the end", kind);
  std::uint64_t scenes = 0, decided = 0, contacts = 0;
  in_every_scene(kind, [&](const AnyScene& any) {
    constexpr double roundings = 64, instant = 1e-6;
    const Motion reference = simulated(as_machine(any.scene), any.duration);
    const Motion program = told(any.scene);
    double growth = 0;
    bool is_decided = reference.is_complete;
    std::size_t known = reference.contacts.size();
    for (std::uint64_t way = 0; way < 3; ++way) {
      const Motion other = simulated(moved(any, way, roundings), any.duration);
      known = std::min(known, first_difference(other, reference, instant));
      is_decided = is_decided && are_alike(other, reference, instant);
      raise(growth, distance(other.end, reference.end));
    }
    ++scenes, contacts += program.contacts.size();
    if (!sums_chatter) {
      const bool agrees = first_difference(program, reference, instant) >= known;
      same.take(any, agrees ? 0 : std::numeric_limits<double>::infinity());
    }
    if (!is_decided || growth > 1e-6) return;
    ++decided;
    double size = 1e-3;
    for (const double part : reference.end) size = std::max(size, std::abs(part));
    off.take(any, program.is_complete ? distance(program.end, reference.end) / (growth + 1e-12 * size)
                                      : std::numeric_limits<double>::infinity());
  });
  same.conclude(sums_chatter ? 0 : 1), off.conclude(0.5);
  std::cout << decided << " of " << scenes << " " << kind.name << " scenes decided; contacts: " << contacts << "\n";
}

TEST(Machines, with_a_loose_mass_are_told_as_taylor_series_tell_them) {
  compare({"carrying", any_carrying_scene, 30}, false);
}
TEST(Machines, with_stops_and_friction_are_told_as_taylor_series_tell_them) {
  compare({"sliding", any_sliding_scene, 30}, true);
}

}  // namespace
}  // namespace clatter::hard::machines_test
