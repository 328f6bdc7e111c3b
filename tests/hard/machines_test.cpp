// Random scenes with a loose mass, rigid and soft stops and friction at once: the program against the simulator of
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

#include "hard/any_force_in_pieces.hpp"
#include "hard/any_force_orders.hpp"
#include "hard/any_law_of_speed.hpp"
#include "hard/any_machine.hpp"
#include "hard/any_moving_stops.hpp"
#include "hard/any_rubbing_machine.hpp"
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

/// Less of them by a power of the speed, under which they fall so slowly.
[[nodiscard]] MachineScene without_faint(MachineScene scene) {
  for (const Law* law : {&scene.law_lower, &scene.law_upper, &scene.wall_law_lower, &scene.wall_law_upper})
    if (law->exponent > 0) scene.still = 1e-16;
  return scene;
}

[[nodiscard]] Motion simulated(const MachineScene& given, double duration) {
  using Kind = MachineEvent::Kind;
  const MachineScene scene = without_faint(given);
  const MachineRun run = run_machine(scene, duration, most_contacts);
  Motion motion;
  for (const MachineEvent& e : run.events)
    if (e.kind == Kind::stop_impact || e.kind == Kind::wall_impact || e.kind == Kind::touch ||
        e.kind == Kind::wall_touch)
      motion.contacts.push_back({e.kind == Kind::wall_impact || e.kind == Kind::wall_touch ? 2 * e.side : e.side,
                                 static_cast<double>(e.time), static_cast<double>(e.before)});
  motion.contacts = without_slow(std::move(motion.contacts));
  motion.end = {static_cast<double>(run.x), static_cast<double>(run.v), static_cast<double>(run.z),
                static_cast<double>(run.w)};
  motion.is_complete = run.finished;
  return motion;
}

[[nodiscard]] Motion told(point::Problem problem) {
  problem.time.max_impacts = most_contacts;
  problem.observe.full_log = problem.observe.wall_log = true;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  Motion motion;
  for (const auto& impact : result.log) motion.contacts.push_back({impact.stop, impact.time, impact.before});
  motion.contacts = without_slow(std::move(motion.contacts));
  const auto& end = result.end;
  motion.end = {end.displacement, end.velocity, end.loose_place, end.loose_velocity};
  motion.is_complete = result.status == steady::Status::transient;
  return motion;
}

/// Whether contacts are the same, to so much of the time.
[[nodiscard]] bool are_alike(const Motion& a, const Motion& b, double time) {
  return std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    [&](const Contact& one, const Contact& other) {
                      return one.where == other.where && std::abs(one.time - other.time) <= time;
                    });
}
[[nodiscard]] double distance(const State& a, const State& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) raise(most, std::abs(a[i] - b[i]));
  return most;
}

/// Works, losses and growth of the energy balance; losses on walls and rigid stops are those of the logged impacts.
void expect_balance(const Kind& kind) {
  Tally residual("energy residual", kind), walls("losses on walls", kind);
  in_every_scene(kind, [&](const AnyScene& any) {
    point::Problem problem = any.scene;
    problem.time.max_impacts = most_contacts;
    problem.observe.full_log = problem.observe.wall_log = problem.observe.energy = problem.observe.wall_energy = true;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(problem, scratch);
    if (result.status != steady::Status::transient) return;
    const double eps = problem.loose.ratio;
    double lost = 0, size = 1e-3;
    for (const auto& impact : result.log) {
      size += impact.before * impact.before;
      if (std::abs(impact.stop) == 2 && impact.time > 0)  // energies count from after an impact at the start
        lost += eps / (1 + eps) * (impact.before - impact.after) * (impact.before + impact.after) / 2;
    }
    size += std::abs(result.work_in) + result.loss_damping + result.loss_friction;
    constexpr double rounding = 1e-11;
    residual.take(any, std::abs(result.energy_residual) / (rounding * size));
    walls.take(any, std::abs(result.wall_loss_impact[0] + result.wall_loss_impact[1] - lost) / (rounding * size));
  });
  residual.conclude(0.9), walls.conclude(0.9);
}

TEST(Machines, keep_their_energy_but_for_work_and_losses) { expect_balance({"combined", any_machine, 100}); }

TEST(Machines, that_rub_in_the_housing_keep_their_energy_but_for_work_and_losses) {
  expect_balance({"rubbing", any_rubbing_machine, 100});
}

/// Without stops and friction of the main mass the ledger is another one.
TEST(Machines, that_only_rub_in_the_housing_keep_their_energy_but_for_work_and_losses) {
  const Kind kind{"rubbing alone", any_rubbing_scene, 100};
  Tally residual("energy residual", kind), rubbed("loss by friction", kind);
  in_every_scene(kind, [&](const AnyScene& any) {
    point::Problem problem = any.scene;
    problem.time.max_impacts = most_contacts;
    problem.observe.energy = true;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(problem, scratch);
    const MachineRun reference = run_machine(as_machine(any.scene), any.duration, most_contacts);
    if (result.status != steady::Status::transient || !reference.finished) return;
    const double most = std::max({1.0, problem.loose.ratio, static_cast<double>(reference.fastest)});
    const double size = std::abs(result.work_in) + result.loss_damping + result.loss_friction + most * most * most;
    residual.take(any, std::abs(result.energy_residual) / (1e-11 * size));
    const auto expected = static_cast<double>(reference.rubbed_in_housing);
    rubbed.take(any, std::abs(result.loss_friction - expected) / (1e-6 * size));
  });
  residual.conclude(0.9), rubbed.conclude(0.9);
}

/// A machine of `any_machine` that a force drives, and damping settles.
[[nodiscard]] AnyScene any_driven_machine(std::uint64_t index) {
  support::Random random(20703, index);
  AnyScene any = any_machine(index);
  Oscillator& o = any.scene.oscillator;
  if (o.forcing == 0) o.forcing = 1;
  o.damping = std::max(o.damping, random.uniform(0.02, 0.3));
  any.scene.time.mode = steady::Mode::steady, any.scene.time.max_periods = 500;
  return any;
}

/// The reference brings steady motion back to where it is after its period, with the contacts of its log unless those
/// become ever slower.
TEST(Machines, in_steady_motion_come_back) {
  const Kind kind{"driven", any_driven_machine, 40};
  Tally back("the state after a period", kind), same("the contacts of a period", kind);
  std::uint64_t periodic = 0;
  in_every_scene(kind, [&](const AnyScene& any) {
    AnyScene there = any;
    there.scene.observe.full_log = there.scene.observe.wall_log = there.scene.observe.period = true;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(there.scene, scratch);
    if (result.status != steady::Status::periodic || !(result.period_ratio > 0)) return;
    ++periodic;
    there.duration = static_cast<double>(result.period_ratio) * period_of(there.scene.oscillator);
    there.scene.start.displacement = result.end.displacement, there.scene.start.velocity = result.end.velocity;
    there.scene.loose.place = result.end.loose_place, there.scene.loose.velocity = result.end.loose_velocity;
    constexpr double roundings = 5e4, instant = 1e-6;  // as far as the tolerance of the repeat
    const Motion round = simulated(as_machine(there.scene), there.duration);
    const State begin{result.end.displacement, result.end.velocity, result.end.loose_place, result.end.loose_velocity};
    double growth = 0, size = 1e-3;
    for (std::uint64_t way = 0; way < 3; ++way) {
      const Motion other = simulated(moved(there, way, roundings, 2 * roundings), there.duration);
      if (!other.is_complete || !are_alike(other, round, instant)) return;
      raise(growth, distance(other.end, round.end));
    }
    for (const double part : begin) size = std::max(size, std::abs(part));
    if (!round.is_complete || growth > 1e-6) return;
    back.take(any, distance(round.end, begin) / (growth + 1e-10 * size));
    Motion log;
    for (const auto& impact : result.log) log.contacts.push_back({impact.stop, impact.time, impact.before});
    const bool chatters = without_slow(log.contacts).size() < log.contacts.size();
    if (!chatters) same.take(any, are_alike(log, round, instant) ? 0 : std::numeric_limits<double>::infinity());
  });
  back.conclude(0.1), same.conclude(0.1);
  std::cout << periodic << " of the motions are periodic\n";
}

/// The steps that a run takes at most beside soft walls, each of which rounds the state: over none does anything turn
/// by more than a radian.
[[nodiscard]] double steps_at_soft_walls(const AnyScene& any) {
  const Scene& scene = any.scene;
  if (!has_soft_wall(scene.loose)) return 0;
  const double reduced = reduced_mass(scene.loose);
  double stiffness = std::abs(scene.oscillator.stiffness), damping = 2 * scene.oscillator.damping;
  const auto add = [&](const Stops& of, Side side, double mass) {
    const bool upper = side == Side::upper;
    if (!is_soft(of, side)) return;
    const double kappa = upper ? of.stiffness_upper : of.stiffness_lower;
    stiffness += kappa / mass;
    damping += 2 * (upper ? of.damping_upper : of.damping_lower) * std::sqrt(kappa / mass);
  };
  for (const Side side : {Side::lower, Side::upper})
    add(scene.stops, side, 1), add(walls_of(scene.loose), side, reduced);
  return any.duration * (scene.oscillator.frequency + std::sqrt(stiffness) + damping);
}

[[nodiscard]] std::vector<Contact> after_start(std::vector<Contact> contacts) {
  std::erase_if(contacts, [](const Contact& contact) { return !(contact.time > 0); });
  return contacts;
}
/// The difference of the contacts after the start and before the first one that may belong to a chatter, of which the
/// program sums impacts slower than a millionth of what the forces make.
[[nodiscard]] double distance_of_contacts(const Motion& of, const Motion& of_reference) {
  const std::vector<Contact> found = after_start(of.contacts), reference = after_start(of_reference.contacts);
  constexpr double of_chatter = 1e-4;
  double fastest = 0, most = 0;
  for (const Contact& contact : reference) fastest = std::max(fastest, std::abs(contact.before));
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Contact& known = reference[i];
    if (!(std::abs(known.before) > of_chatter * fastest)) break;
    if (i >= found.size() || found[i].where != known.where) return std::numeric_limits<double>::infinity();
    raise(most, std::abs(found[i].time - known.time)), raise(most, std::abs(found[i].before - known.before));
  }
  return most;
}

/// Compares the contacts and the state at the end if roundings of the inputs don't change them much. The program rounds
/// at each event, so it may be off by what some roundings of all inputs do.
void expect_told_as_by_taylor_series(const Kind& kind) {
  Tally off("state at the end", kind), contacts_off("contacts", kind);
  std::uint64_t scenes = 0, decided = 0, contacts = 0;
  in_every_scene(kind, [&](const AnyScene& any) {
    const Motion reference = simulated(as_machine(any.scene), any.duration);
    const Motion program = told(any.scene);
    double growth = 0, of_contacts = 0;
    bool is_decided = reference.is_complete;
    for (std::uint64_t way = 0; way < 3 && is_decided; ++way) {
      constexpr double roundings = 16, instant = 1e-6;
      const Motion other = simulated(moved(any, way, roundings, 4 * roundings), any.duration);
      is_decided = are_alike(other, reference, instant);
      raise(growth, distance(other.end, reference.end));
      raise(of_contacts, distance_of_contacts(other, reference));
    }
    ++scenes, contacts += program.contacts.size();
    if (!is_decided || growth > 1e-6) return;
    ++decided;
    double size = 1e-3;
    for (const double part : reference.end) size = std::max(size, std::abs(part));
    const double rounding = 1e-12 + epsilon<double>() * steps_at_soft_walls(any);
    off.take(any, program.is_complete ? distance(program.end, reference.end) / (growth + rounding * size)
                                      : std::numeric_limits<double>::infinity());
    for (const Contact& contact : reference.contacts) size = std::max({size, contact.time, std::abs(contact.before)});
    contacts_off.take(any, distance_of_contacts(program, reference) / (of_contacts + rounding * size));
  });
  off.conclude(0.5), contacts_off.conclude(0.5);
  std::cout << decided << " of " << scenes << " scenes decided; contacts: " << contacts << "\n";
}

TEST(Machines, with_a_loose_mass_beside_stops_and_friction_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"combined", any_machine, 12});
}

TEST(Machines, that_rub_in_the_housing_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"rubbing", any_rubbing_machine, 12});
}

TEST(Machines, that_only_rub_in_the_housing_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"rubbing alone", any_rubbing_scene, 24});
}

TEST(Machines, with_soft_walls_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"soft walls", any_soft_walled_machine, 10});
}

TEST(Machines, of_which_the_restitution_depends_on_the_speed_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"combined, by speed", by_speed<any_machine>, 5});
  expect_told_as_by_taylor_series({"rubbing, by speed", by_speed<any_rubbing_machine>, 5});
  expect_told_as_by_taylor_series({"soft walls, by speed", by_speed<any_soft_walled_machine>, 5});
}

TEST(Machines, of_which_the_restitution_depends_on_the_speed_keep_their_energy_but_for_work_and_losses) {
  expect_balance({"combined, by speed", by_speed<any_machine>, 100});
  expect_balance({"rubbing, by speed", by_speed<any_rubbing_machine>, 100});
}

TEST(Machines, under_a_force_in_pieces_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"combined, in pieces", in_pieces<any_machine>, 10});
  expect_told_as_by_taylor_series({"rubbing, in pieces", in_pieces<any_rubbing_machine>, 5});
  expect_told_as_by_taylor_series({"soft walls, in pieces", in_pieces<any_soft_walled_machine>, 5});
}

TEST(Machines, under_a_sum_of_sines_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"combined, of orders", of_orders<any_machine>, 10});
  expect_told_as_by_taylor_series({"rubbing, of orders", of_orders<any_rubbing_machine>, 5});
  expect_told_as_by_taylor_series({"soft walls, of orders", of_orders<any_soft_walled_machine>, 5});
}

TEST(Machines, of_which_stops_move_by_themselves_are_told_as_taylor_series_tell_them) {
  expect_told_as_by_taylor_series({"moving stops", any_moving_stops, 60});
}

TEST(Machines, under_a_force_in_pieces_keep_their_energy_but_for_work_and_losses) {
  expect_balance({"combined, in pieces", in_pieces<any_machine>, 100});
  expect_balance({"rubbing, in pieces", in_pieces<any_rubbing_machine>, 100});
}

TEST(Machines, under_a_sum_of_sines_keep_their_energy_but_for_work_and_losses) {
  expect_balance({"combined, of orders", of_orders<any_machine>, 100});
  expect_balance({"rubbing, of orders", of_orders<any_rubbing_machine>, 100});
}

TEST(Machines, with_soft_walls_keep_their_energy_but_for_work_and_losses) {
  const Kind kind{"soft walls", any_soft_walled_machine, 100};
  Tally residual("energy residual", kind);
  in_every_scene(kind, [&](const AnyScene& any) {
    point::Problem problem = any.scene;
    problem.time.max_impacts = most_contacts;
    problem.observe.energy = problem.observe.wall_energy = problem.observe.impacts = true;
    point::ThreadScratch scratch;
    const point::PointResult result = run_point(problem, scratch);
    if (result.status != steady::Status::transient) return;
    double size = 1e-3 + std::abs(result.work_in) + result.loss_damping + result.loss_friction;
    for (const auto& stops : {result.impact_speed, result.wall_impact_speed})
      for (const double speed : stops) size += std::isnan(speed) ? 0 : speed * speed;
    residual.take(any, std::abs(result.energy_residual) / (1e-10 * size));
  });
  residual.conclude(0.9);
}

}  // namespace
}  // namespace clatter::hard::machines_test
