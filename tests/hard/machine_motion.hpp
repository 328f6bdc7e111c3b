#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hard/machine.hpp"
#include "hard/machine_force.hpp"
#include "hard/machine_series.hpp"
#include "hard/machine_stops.hpp"

namespace clatter::hard::machine {

/// A quantity that ends a mode when it falls to 0.
struct Guard {
  enum class Of : std::uint8_t {
    stop,
    wall,
    still,
    hold,
    force_gone,
    force_back,
    left,
    press,
    loose_still,
    wall_force_gone,
    wall_force_back,
    wall_left
  };
  Of of;
  int side;
  Series p;
  Quad size;          ///< of the forces in it: terms far below are rounding
  std::size_t level;  ///< the power of u at which forces come in
};

/// Takes rounding for 0 where a guard starts at 0, so that its first derivative that isn't 0 tells its sign.
[[nodiscard]] inline Guard cleaned(Guard guard) {
  for (std::size_t n = 0; n < terms; ++n) {
    if (guard.p[n] != 0 && (n < guard.level || size_of(guard.p[n]) > Quad(1e-30) * guard.size)) break;
    guard.p[n] = 0;
  }
  return guard;
}
/// The sign of a guard right after the start of a step, 0 if it stays 0.
[[nodiscard]] inline int sign_after_start(const Guard& guard) {
  for (const Quad term : cleaned(guard).p)
    if (term != 0) return term > 0 ? 1 : -1;
  return 0;
}

/// How the masses move, but for soft stops.
struct Mode {
  bool held = false;   ///< the main mass doesn't move
  int slip = 0;        ///< the side to which it moves, against friction
  int pressed = 0;     ///< the wall that takes the loose mass along; 0: none
  bool stuck = false;  ///< friction takes the loose mass along
  int slide = 0;       ///< the side to which the loose mass moves in its housing, against friction

  [[nodiscard]] bool takes_along() const { return pressed != 0 || stuck; }
};

/// A scene, the state of its masses at an instant, and what becomes of it in a mode.
struct Motion {
  explicit Motion(const MachineScene& s) : scene(s), periodic(s), anchor(s.x), v(s.v), wall_anchor(s.z), w(s.w) {
    mus = std::max(scene.static_friction, scene.friction);
    loose_mus = std::max(scene.loose_static, scene.loose_friction);
    const Quad nu = scene.frequency, phase = scene.phase;
    stops = {contact(scene.lower, {scene.restitution_lower, scene.law_lower}, scene.kappa_lower, scene.zeta_lower, 1,
                     {scene.shake_lower, nu, phase + scene.shake_phase_lower}),
             contact(scene.upper, {scene.restitution_upper, scene.law_upper}, scene.kappa_upper, scene.zeta_upper, 1,
                     {scene.shake_upper, nu, phase + scene.shake_phase_upper})};
    const Quad reduced = Quad(scene.loose_mass) / (1 + Quad(scene.loose_mass));
    walls = {contact(scene.wall_lower, {scene.wall_R_lower, scene.wall_law_lower}, scene.wall_kappa_lower,
                     scene.wall_zeta_lower, reduced),
             contact(scene.wall_upper, {scene.wall_R_upper, scene.wall_law_upper}, scene.wall_kappa_upper,
                     scene.wall_zeta_upper, reduced)};
    has_loose = scene.loose_mass > 0 && (walls[0].exists || walls[1].exists);
    if (!has_loose) walls[0].exists = walls[1].exists = false;
    for (Contact& stop : stops)
      if (!stop.exists) stop.motion = {};
    for (const Contact& stop : stops) of_stops += stop.motion.push_size(scene.damping, scene.stiffness);
    assert(of_stops == 0 || (mus == 0 && !has_loose));
    for (const int side : {-1, 1}) {
      if (is_close(side)) count_from(side), v = follows(side) ? 0 : v;
      const Quad depth = x() - place_of(side);
      if (!stop(side).exists || !stop(side).is_soft || !(side * depth > 0) || is_close(side)) continue;
      count_from(side), q = depth, around = side;
      has_force = side * (stop(side).kappa * q + stop(side).damper * v) > 0;
    }
  }

  [[nodiscard]] const Contact& stop(int side) const { return stops[side > 0]; }
  [[nodiscard]] const Contact& wall(int side) const { return walls[side > 0]; }
  [[nodiscard]] bool is_on_rigid(int side) const {
    return stop(side).exists && !stop(side).is_soft && q == 0 && anchor == stop(side).place &&
           carrier == carrier_of(side);
  }
  [[nodiscard]] bool is_on_wall(int side) const {
    return wall(side).exists && !wall(side).is_soft && r == 0 && wall_anchor == wall(side).place;
  }
  /// The force of the soft wall that pushes, along x on the main mass, by the place and the speed beyond that of it.
  [[nodiscard]] Quad wall_push(Quad place, Quad speed) const {
    return wall_pushes ? wall(wall_around).kappa * place + wall(wall_around).damper * speed : Quad(0);
  }
  /// The term n of that force over a step.
  [[nodiscard]] Quad wall_push(const Series& way, std::size_t n, Quad step) const {
    return n + 1 < terms ? wall_push(way[n], number(n + 1) * way[n + 1] / step) : Quad(0);
  }
  [[nodiscard]] bool is_coupled(const Mode& mode) const { return wall_pushes && !mode.takes_along(); }
  [[nodiscard]] Quad x() const { return carrier == 0 ? anchor + q : anchor + q + frame().place(time); }
  [[nodiscard]] Quad z() const { return wall_anchor + r; }
  [[nodiscard]] Quad kappa() const { return has_force ? stop(around).kappa : 0; }
  [[nodiscard]] Quad damper() const { return has_force ? stop(around).damper : 0; }
  [[nodiscard]] Quad stiffness() const { return scene.stiffness + kappa(); }
  [[nodiscard]] Quad twice_damping() const { return 2 * Quad(scene.damping) + damper(); }

  // Moving stops.

  [[nodiscard]] int carrier_of(int side) const { return stop(side).motion.moves() ? side : 0; }
  /// The motion of what the place and the velocity of the main mass count from.
  [[nodiscard]] const StopMotion& frame() const { return stop(carrier).motion; }
  /// Where a stop is.
  [[nodiscard]] Quad place_of(int side) const {
    return stop(side).motion.moves() ? stop(side).place + stop(side).motion.place(time) : stop(side).place;
  }
  /// x' for a velocity that counts as v does.
  [[nodiscard]] Quad speed_of(Quad own) const { return carrier == 0 ? own : own + frame().speed(time); }
  /// Puts the main mass on a stop and into the frame of that, with the velocity that it has.
  void count_from(int side) {
    const Quad speed = speed_of(v);
    anchor = stop(side).place, q = 0;
    if (carrier == carrier_of(side)) return;
    carrier = carrier_of(side);
    v = carrier == 0 ? speed : speed - frame().speed(time);
  }
  /// Whether a start is within rounding of a moving stop.
  [[nodiscard]] bool is_close(int side) const {
    const Quad most = size_of(scene.x) + size_of(stop(side).place) + size_of(stop(side).motion.amplitude);
    return carrier_of(side) != 0 && size_of(x() - place_of(side)) <= Quad(0x1p-48) * most;
  }
  /// Whether it has the velocity of that, too.
  [[nodiscard]] bool follows(int side) const {
    const auto& [amplitude, frequency, phase] = stop(side).motion;
    return size_of(v) <= Quad(0x1p-48) * (size_of(scene.v) + frequency * size_of(amplitude));
  }
  /// Over a step, x but for the anchor.
  [[nodiscard]] Series in_base(const Series& own, Quad step) const {
    return carrier == 0 ? own : sum_of(own, frame().series(time, step));
  }
  /// The same as seen from a stop.
  [[nodiscard]] Series seen_from(int side, const Series& own, Quad step) const {
    if (carrier == carrier_of(side)) return own;
    return sum_of(in_base(own, step), negative(stop(side).motion.series(time, step)));
  }
  /// The size of what a gap is the difference of.
  [[nodiscard]] Quad place_size() const {
    return size_of(x()) + size_of(stops[0].motion.amplitude) + size_of(stops[1].motion.amplitude);
  }

  // Forces.

  /// All that doesn't depend on the motion within a step.
  [[nodiscard]] Series push(const Mode& mode, Quad step) const {
    Series force = periodic.series(time, step);
    force[0] += constant_push(mode);
    return carrier == 0 ? force : sum_of(force, frame().push(scene.damping, scene.stiffness, time, step));
  }
  [[nodiscard]] Quad constant_push(const Mode& mode) const {
    const Quad loose = mode.takes_along() ? Quad(scene.loose_mass) * scene.loose_load : 0;
    const Quad drawn = mode.slide * Quad(scene.loose_friction);
    return scene.load - scene.stiffness * anchor - mode.slip * Quad(scene.friction) + loose + drawn;
  }
  /// Of the loose mass alone, y''.
  [[nodiscard]] Quad loose_push(int slide) const {
    return scene.loose_load - (slide == 0 ? Quad(0) : slide * Quad(scene.loose_friction) / scene.loose_mass);
  }
  /// Whether the loose mass rubs.
  [[nodiscard]] bool rubs() const { return has_loose && loose_mus > 0; }
  /// The sum of the sizes of all forces.
  [[nodiscard]] Quad force_size() const {
    const Quad own = size_of(scene.loose_load) + (rubs() ? loose_mus / Quad(scene.loose_mass) : Quad(0));
    const Quad loose = has_loose ? (1 + Quad(scene.loose_mass)) * own : 0;
    const Quad elastic = size_of(scene.stiffness * anchor) + size_of(stiffness() * q);
    const Quad pushed =
        wall_around == 0 ? Quad(0) : wall(wall_around).kappa * size_of(r) + wall(wall_around).damper * size_of(w);
    return size_of(scene.forcing) + size_of(scene.load) + elastic + size_of(twice_damping() * v) + mus + loose +
           (wall_around == 0 ? Quad(0) : pushed * (1 + 1 / Quad(scene.loose_mass))) + of_stops;
  }
  /// Of the main mass, alone, as v counts.
  [[nodiscard]] Quad acceleration(int slip, int slide) const {
    const Quad own = periodic.at(time) + constant_push({false, slip, 0, false, slide}) - stiffness() * q -
                     twice_damping() * v + wall_push(r, w);
    return carrier == 0 ? own : own + frame().push(scene.damping, scene.stiffness, time, 0)[0];
  }

  // The motion in a mode.

  /// How long its Taylor series hold enough digits, of the force as it is until the next knot.
  [[nodiscard]] Quad step_of(const Mode& mode) const {
    const Quad own = mode.held ? Quad(0) : sqrtq(size_of(stiffness())) + twice_damping();
    const Quad reduced = Quad(scene.loose_mass) / (1 + Quad(scene.loose_mass));
    const Quad coupled =
        is_coupled(mode) ? sqrtq(wall(wall_around).kappa / reduced) + wall(wall_around).damper / reduced : Quad(0);
    const Quad of_motion = of_stops == 0 ? 0 : scene.frequency;
    return Quad(scene.step) / std::max({periodic.rate(), of_motion, own + coupled, Quad(1e-3)});
  }
  [[nodiscard]] Series main_series(const Mode& mode, Quad step) const {
    Series x{q, v * step}, way{r, w * step};
    if (mode.held) return x;
    const Series force = push(mode, step);
    const Quad mass = mode.takes_along() ? 1 + Quad(scene.loose_mass) : 1;
    const Quad pulled = step * step / mass, damped = twice_damping() * step / mass, k = stiffness();
    for (std::size_t n = 0; n + 2 < terms; ++n) {
      const Quad pushed = is_coupled(mode) ? wall_push(way, n, step) : Quad(0);
      x[n + 2] = (pulled * (force[n] - k * x[n] + pushed) / number(n + 1) - damped * x[n + 1]) / number(n + 2);
      if (is_coupled(mode)) way[n + 2] = loose_term(mode, x, way, n, step);
    }
    return x;
  }
  /// The term n + 2 of the way of a loose mass, by those before and that of the main one.
  [[nodiscard]] Quad loose_term(const Mode& mode, const Series& x, const Series& way, std::size_t n, Quad step) const {
    const Quad pushed = is_coupled(mode) ? wall_push(way, n, step) / Quad(scene.loose_mass) : Quad(0);
    const Quad own = (n == 0 ? loose_push(mode.slide) : Quad(0)) - pushed;
    return own * step * step / number((n + 1) * (n + 2)) - x[n + 2];
  }
  [[nodiscard]] Series loose_series(const Mode& mode, const Series& x, Quad step) const {
    Series way{r, w * step};
    if (mode.takes_along() || !has_loose) return way;
    for (std::size_t n = 0; n + 2 < terms; ++n) way[n + 2] = loose_term(mode, x, way, n, step);
    return way;
  }

  // Guards.

  [[nodiscard]] Guard gap(Guard::Of of, int side, const Series& way, Quad room, Quad step) const {
    Guard guard{of, side, {}, force_size() * step * step, 2};
    for (std::size_t n = 0; n < terms; ++n) guard.p[n] = -side * way[n];
    guard.p[0] += side * room;
    return guard;
  }
  [[nodiscard]] Guard wall_gap(int side, const Series& way, Quad step) const {
    return gap(Guard::Of::wall, side, way, wall(side).place - wall_anchor, step);
  }
  /// What is left of the static level for a push to a side.
  [[nodiscard]] Guard hold(int side, const Mode& mode, Quad step) const {
    Guard guard{Guard::Of::hold, side, push(mode, step), force_size(), 0};
    guard.p[0] -= stiffness() * q;
    if (is_coupled(mode)) {
      const Series way = loose_series(mode, Series{q}, step);
      for (std::size_t n = 0; n + 1 < terms; ++n) guard.p[n] += wall_push(way, n, step);
    }
    for (Quad& term : guard.p) term *= -side;
    guard.p[0] += mus;
    return guard;
  }
  [[nodiscard]] Guard still(int side, const Series& x, Quad step, Guard::Of of = Guard::Of::still) const {
    Guard guard{of, side, {}, force_size() * step * step, 1};
    for (std::size_t n = 0; n + 1 < terms; ++n) guard.p[n] = side * number(n + 1) * x[n + 1];
    return guard;
  }
  /// The force of the soft stop around, in its direction or against it.
  [[nodiscard]] Guard force(Guard::Of of, int sign, const Series& x, Quad step) const {
    const Quad kappa = stop(around).kappa, damper = stop(around).damper;
    Guard guard{of, around, {}, kappa * size_of(q) + damper * size_of(v), 0};
    for (std::size_t n = 0; n + 1 < terms; ++n)
      guard.p[n] = sign * around * (kappa * x[n] + damper * number(n + 1) * x[n + 1] / step);
    return guard;
  }
  /// The same of the soft wall.
  [[nodiscard]] Guard wall_force(Guard::Of of, int sign, const Series& way, Quad step) const {
    const Quad kappa = wall(wall_around).kappa, damper = wall(wall_around).damper;
    Guard guard{of, wall_around, {}, kappa * size_of(r) + damper * size_of(w), 0};
    for (std::size_t n = 0; n + 1 < terms; ++n)
      guard.p[n] = sign * wall_around * (kappa * way[n] + damper * number(n + 1) * way[n + 1] / step);
    return guard;
  }
  /// What is left until the loose mass leaves to the other side: of the force of a wall, of friction, or both.
  [[nodiscard]] Guard press(int side, const Series& x, Quad step) const {
    Guard guard{Guard::Of::press, side, {}, force_size(), 0};
    for (std::size_t n = 0; n + 2 < terms; ++n)
      guard.p[n] = -side * number((n + 1) * (n + 2)) * x[n + 2] / (step * step);
    guard.p[0] += side * Quad(scene.loose_load);
    if (wall_pushes) guard.p[0] -= side * wall_push(r, 0) / Quad(scene.loose_mass);
    if (rubs()) guard.p[0] += loose_mus / Quad(scene.loose_mass);
    return guard;
  }
  /// The sides to which forces take it along: all but that of a wall it is on, which is as strong as need be.
  [[nodiscard]] bool is_taken_along(const Mode& mode, int side) const {
    return mode.pressed != 0 ? side == mode.pressed : mode.stuck;
  }
  [[nodiscard]] std::vector<Guard> guards(const Mode& mode, const Series& x, const Series& way, Quad step) const {
    using Of = Guard::Of;
    std::vector<Guard> rows;
    for (const int side : {-1, 1}) {
      if (mode.held && !is_on_rigid(side)) rows.push_back(hold(side, mode, step));
      if (!mode.held && around == 0 && stop(side).exists)
        rows.push_back(gap(Of::stop, side, seen_from(side, x, step), stop(side).place - anchor, step));
      if (!mode.takes_along() && wall(side).exists && wall_around == 0) rows.push_back(wall_gap(side, way, step));
      if (!mode.held && is_taken_along(mode, side)) rows.push_back(press(side, x, step));
    }
    if (mode.slide != 0) rows.push_back(still(mode.slide, way, step, Of::loose_still));
    if (!mode.held && mus > 0) rows.push_back(still(mode.slip, x, step));
    if (!mode.held && has_force) rows.push_back(force(Of::force_gone, 1, x, step));
    if (!mode.held && around != 0 && !has_force) {
      rows.push_back(force(Of::force_back, -1, x, step));
      rows.push_back(gap(Of::left, -around, x, 0, step));
    }
    if (!mode.takes_along() && wall_around != 0 && wall_pushes)
      rows.push_back(wall_force(Of::wall_force_gone, 1, way, step));
    if (!mode.takes_along() && wall_around != 0 && !wall_pushes) {
      rows.push_back(wall_force(Of::wall_force_back, -1, way, step));
      rows.push_back(gap(Of::wall_left, -wall_around, way, 0, step));
    }
    for (Guard& guard : rows) guard = cleaned(guard);
    return rows;
  }

  // The state.

  MachineScene scene;
  PeriodicForce periodic;
  Quad mus = 0, loose_mus = 0, time = 0;
  Quad of_stops = 0;  ///< the size of the forces that their motions are in frames that move with them
  std::array<Contact, 2> stops{}, walls{};
  bool has_loose = false;
  Quad anchor, q = 0, v;       ///< of the main mass: its place counts from a stop, for the digits of short flights
  int carrier = 0;             ///< the moving stop from which, and from whose velocity, they count; 0: the base
  Quad wall_anchor, r = 0, w;  ///< of the loose mass, as seen from the main one, likewise
  int around = 0;              ///< the soft stop beyond whose place the main mass is; then it is the anchor
  bool has_force = false;      ///< and that stop pushes
  int wall_around = 0;         ///< the soft wall beyond whose place the loose mass is; then it is the wall anchor
  bool wall_pushes = false;    ///< and that wall pushes
};

}  // namespace clatter::hard::machine
