#include "hard/machine.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "hard/machine_motion.hpp"
#include "hard/machine_series.hpp"

namespace clatter::hard {
namespace machine {
namespace {

using Kind = MachineEvent::Kind;

/// What a guard has been like since it last ended a mode.
struct Watch {
  Quad high = 0, fast = 0, last_slope = 0, until = -1;
};

class Machine {
 public:
  Machine(const MachineScene& scene, Quad duration) : m_(scene), end_(duration) {}

  MachineRun run(std::size_t most_impacts) {
    std::size_t idle = 0;
    for (std::size_t steps = 0; steps < most_steps && idle < most_idle; ++steps) {
      settle(most_impacts);
      if (steps == 0) run_.struck = 0, run_.stored = -energy();
      if (run_.impacts > most_impacts) break;
      change_to(chosen_mode());
      run_.finished = !(m_.time < end_);
      if (run_.finished) break;
      const Quad before = m_.time;
      go();
      idle = m_.time > before ? 0 : idle + 1;
    }
    run_.time = to_long(m_.time), run_.fastest = to_long(fastest_), run_.stored += energy();
    run_.x = to_long(m_.x()), run_.v = to_long(m_.speed_of(m_.v)), run_.z = to_long(m_.z()), run_.w = to_long(m_.w);
    return std::move(run_);
  }

 private:
  static constexpr std::size_t most_steps = 50'000'000, most_idle = 10'000;

  [[nodiscard]] static long double to_long(Quad value) { return static_cast<long double>(value); }
  [[nodiscard]] long double energy() const {
    const Quad mass = m_.scene.loose_mass, speed = m_.speed_of(m_.v), y_speed = speed + m_.w;
    return to_long((speed * speed + m_.scene.stiffness * m_.x() * m_.x() + mass * y_speed * y_speed) / 2);
  }
  void tell(Kind kind, int side, Quad before, Quad after, Quad main_before, Quad pull = 0) {
    run_.events.push_back({kind, side, to_long(m_.time), to_long(before), to_long(after), to_long(m_.x()),
                           to_long(m_.speed_of(main_before)), to_long(m_.speed_of(m_.v)), to_long(pull)});
  }
  void tell(Kind kind, int side, Quad pull = 0) { tell(kind, side, m_.v, m_.v, m_.v, pull); }
  /// Takes a margin in parts of the largest.
  void note(Quad margin, Quad largest) {
    if (largest > 0) run_.closest = std::min(run_.closest, to_long(size_of(margin) / largest));
  }

  // The mode at an instant.

  [[nodiscard]] Mode chosen_mode() {
    if (m_.rubs()) return rubbing_mode();
    const int on = m_.w != 0 ? 0 : m_.is_on_wall(1) ? 1 : m_.is_on_wall(-1) ? -1 : 0;
    Mode mode{false, m_.v > 0 ? 1 : m_.v < 0 ? -1 : 0, 0};
    if (m_.v == 0 && (m_.mus > 0 || m_.is_on_rigid(1) || m_.is_on_rigid(-1))) {
      const Mode held{true, 0, on * m_.scene.loose_load >= 0 ? on : 0};
      for (const int side : {-1, 1}) {
        if (m_.is_on_rigid(side)) continue;
        const Guard level = m_.hold(side, held, m_.step_of(held));
        if (is_fresh_) note(level.p[0], level.size);
        if (sign_after_start(level) < 0) mode.slip = side;
      }
      if (mode.slip == 0) return held;
    }
    if (on == 0) return mode;
    const Quad step = m_.step_of(mode);
    const Guard room = m_.wall_gap(on, m_.loose_series(mode, m_.main_series(mode, step), step), step);
    if (is_fresh_) note(room.p[2], room.size);
    if (sign_after_start(room) <= 0) mode.pressed = on;
    return mode;
  }
  /// The main mass is held, or slips, by the forces that it has in a mode of the loose one.
  [[nodiscard]] Mode with_main(Mode mode) {
    mode.held = false, mode.slip = m_.v > 0 ? 1 : m_.v < 0 ? -1 : 0;
    if (m_.v != 0 || (m_.mus == 0 && !m_.is_on_rigid(1) && !m_.is_on_rigid(-1))) return mode;
    Mode held = mode;
    held.held = true;
    for (const int side : {-1, 1}) {
      if (m_.is_on_rigid(side)) continue;
      const Guard level = m_.hold(side, held, m_.step_of(held));
      if (is_fresh_) note(level.p[0], level.size);
      if (sign_after_start(level) < 0) mode.slip = side;
    }
    return mode.slip == 0 ? held : mode;
  }
  /// Of a loose mass that rubs: at z' = 0 it is taken along if friction, or a wall with it, is strong enough; else it
  /// slides to the side to which z' grows. A main mass that has just been let go with it moves on.
  [[nodiscard]] Mode rubbing_mode() {
    if (m_.w != 0) return with_main({.slide = m_.w > 0 ? 1 : -1});
    const int on = m_.is_on_wall(1) ? 1 : m_.is_on_wall(-1) ? -1 : 0;
    const Mode together = with_main({.pressed = on, .stuck = true});
    const Quad step = m_.step_of(together);
    const Series x = m_.main_series(together, step);
    bool is_kept = true;
    for (const int side : {-1, 1}) {
      if (!m_.is_taken_along(together, side)) continue;
      const Guard level = m_.press(side, x, step);
      if (is_fresh_) note(level.p[0], level.size);
      is_kept = is_kept && sign_after_start(level) >= 0;
    }
    if (is_kept) return together;
    const bool is_let_go = mode_.held && mode_.takes_along() && !together.held;
    for (const int side : {-1, 1}) {
      if (side == on) continue;
      const Mode slides = is_let_go ? Mode{.slip = together.slip, .slide = side} : with_main({.slide = side});
      const Quad own = m_.step_of(slides);
      const Series way = m_.loose_series(slides, m_.main_series(slides, own), own);
      if (sign_after_start(m_.still(side, way, own, Guard::Of::loose_still)) > 0) return slides;
    }
    return together;
  }
  /// Tells the events that a change of the mode is.
  void change_to(const Mode& mode) {
    const int on = m_.is_on_rigid(1) ? 1 : m_.is_on_rigid(-1) ? -1 : 0;
    if (mode_.held && !mode.held) tell(held_on_ != 0 ? Kind::rest_end : Kind::stick_end, held_on_);
    const Quad braked = is_turning_ ? m_.acceleration(mode_.slip, mode_.slide) : 0;
    if (!mode_.held && mode.held) tell(on != 0 ? Kind::rest : Kind::stick, on, braked), held_on_ = on;
    if (is_turning_ && !mode.held) tell(Kind::reversal, 0, braked);
    if (mode_.pressed != 0 && mode.pressed != mode_.pressed) tell(Kind::release, mode_.pressed);
    if (mode.pressed != 0 && mode.pressed != mode_.pressed) {
      const Quad away = m_.scene.loose_load - (mode.held ? 0 : m_.acceleration(mode.slip, mode.slide));
      tell(Kind::press, mode.pressed, mode.pressed * away);
    }
    const bool was_stuck = mode_.stuck && mode_.pressed == 0, is_stuck = mode.stuck && mode.pressed == 0;
    if (was_stuck != is_stuck) tell(is_stuck ? Kind::hold : Kind::hold_end, 0);
    mode_ = mode;
    is_fresh_ = is_turning_ = false;
  }

  // Impacts.

  /// Carries out all contacts of an instant, the fastest first.
  void settle(std::size_t most_impacts) {
    take_speeds();
    while (run_.impacts <= most_impacts) {
      Quad fastest = 0;
      int stop_side = 0, wall_side = 0;
      for (const int side : {-1, 1}) {
        if (m_.is_on_rigid(side) && side * m_.v > fastest) fastest = side * m_.v, stop_side = side, wall_side = 0;
        if (m_.is_on_wall(side) && side * m_.w > fastest) fastest = side * m_.w, stop_side = 0, wall_side = side;
      }
      if (fastest == 0) break;
      if (stop_side != 0) strike_stop(stop_side);
      if (wall_side != 0) strike_wall(wall_side);
      take_speeds();
      come_to_rest();
      ++run_.impacts, is_fresh_ = true;
    }
    if (m_.around != 0 && m_.v == 0 && m_.q != 0) m_.has_force = true;
    if (m_.wall_around != 0 && m_.w == 0 && m_.r != 0) m_.wall_pushes = true;
  }
  /// Ends the endless row of contacts of both masses beside a stop: each pair alone would pass the momentum on.
  void come_to_rest() {
    const bool on_both = (m_.is_on_rigid(1) || m_.is_on_rigid(-1)) && (m_.is_on_wall(1) || m_.is_on_wall(-1));
    if (on_both && is_slow(size_of(m_.v), 0) && is_slow(size_of(m_.w), 0)) m_.v = m_.w = 0;
  }
  [[nodiscard]] static std::size_t place_of(const Guard& guard) {
    return 2 * static_cast<std::size_t>(guard.of) + (guard.side > 0);
  }
  void take_speeds() {
    fastest_ = std::max({fastest_, size_of(m_.v), size_of(m_.speed_of(m_.v)), m_.has_loose ? size_of(m_.w) : Quad(0)});
    run_.of_x.take(to_long(m_.x())), run_.of_z.take(to_long(m_.z())), run_.of_y.take(to_long(m_.x() + m_.z()));
  }
  /// Whether nothing can tell a rebound from rest.
  [[nodiscard]] bool is_slow(Quad speed, Quad back) const {
    return speed <= Quad(m_.scene.still) * fastest_ || 2 * speed < Quad(1e-27) * back;
  }
  /// The side to which the loose mass moves in its housing, if it rubs.
  [[nodiscard]] int slide() const { return !m_.rubs() || m_.w == 0 ? 0 : m_.w > 0 ? 1 : -1; }
  void strike_stop(int side) {
    const Quad before = std::exchange(m_.v, -m_.stop(side).rebound.share(size_of(m_.v)) * m_.v);
    if (is_slow(size_of(m_.v), side * m_.acceleration(-side, slide()))) m_.v = 0;
    if (m_.has_loose) m_.w += before - m_.v;
    run_.struck += to_long((before * before - m_.v * m_.v) / 2);
    tell(Kind::stop_impact, side, before, m_.v, before);
  }
  void strike_wall(int side) {
    const Quad before = m_.w, share = Quad(m_.scene.loose_mass) / (1 + Quad(m_.scene.loose_mass)), v = m_.v;
    for (const Quad R : {m_.wall(side).rebound.share(size_of(before)), Quad(0)}) {
      m_.w = -R * before, m_.v = v + share * (1 + R) * before;
      const int away = m_.rubs() ? -side : 0;
      const Quad back = side * (m_.loose_push(away) - m_.acceleration(m_.v > 0 ? 1 : m_.v < 0 ? -1 : 0, away));
      if (!is_slow(size_of(m_.w), back)) break;
    }
    run_.struck += to_long(share * (before * before - m_.w * m_.w) / 2);
    tell(Kind::wall_impact, side, before, m_.w, v);
  }

  // One step.

  /// One Taylor step in the present mode, to a knot of the force at most, or less if a guard falls before.
  void go() {
    const Quad step = std::min({end_ - m_.time, m_.periodic.knot() - m_.time, m_.step_of(mode_)});
    const Series x = m_.main_series(mode_, step), r = m_.loose_series(mode_, x, step);
    const std::vector<Guard> rows = m_.guards(mode_, x, r, step);
    std::vector<std::optional<Quad>> falls;
    std::optional<Quad> first;
    for (const Guard& guard : rows) {
      falls.push_back(first_fall(guard.p));
      if (falls.back() && (!first || *falls.back() < *first)) first = falls.back();
    }
    Quad u = first.value_or(1);
    const Quad same = Quad(1e-30) * std::max(Quad(1), m_.time);
    for (const Guard& guard : rows) watch(guard, u, step);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (first && falls[i] == *first) u = *first + late(rows[i], *first);
    pass(x, r, step, u);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (falls[i] && (*falls[i] - u) * step <= same) conclude(rows[i], u > 0, step);
  }
  /// The part of a step by which rounding delays what a guard tells.
  [[nodiscard]] Quad late(const Guard& guard, Quad u) const {
    if (m_.scene.rounding == 0 || guard.of == Guard::Of::still || guard.of == Guard::Of::loose_still) return 0;
    const Quad own = m_.scene.rounding * (guard.level == 2 ? m_.place_size() : guard.size);
    const Quad off = std::min(own, Quad(1e-6) * watches_[place_of(guard)].high);
    return off == 0 ? 0 : std::min({off / size_of(jet(guard.p, u).second), Quad(1e-6) * u, 1 - u});
  }
  void pass(const Series& x, const Series& r, Quad step, Quad u) {
    if (u == 0) return;
    const Quad x_before = m_.x(), x_anchor = m_.anchor;
    const Series in_base = m_.in_base(x, step);
    if (const double h = m_.scene.damping; h != 0)
      run_.damped += 2 * h * integral_of_square(slope_of(in_base), u) / to_long(step);
    const auto [q, slope] = jet(x, u);
    m_.q = q, m_.v = mode_.held ? 0 : slope / step;
    if (!mode_.takes_along() && m_.has_loose) {
      const auto [place, speed] = jet(r, u);
      run_.rubbed_in_housing += m_.scene.loose_friction * to_long(size_of(place - m_.r));
      m_.r = place, m_.w = speed / step;
    }
    take_turns(run_.of_x, x_anchor, in_base, u), take_turns(run_.of_z, m_.wall_anchor, r, u);
    if (m_.has_loose) take_turns(run_.of_y, x_anchor + m_.wall_anchor, sum_of(in_base, r), u);
    run_.rubbed += m_.scene.friction * to_long(size_of(m_.x() - x_before));
    const Quad knot = m_.periodic.knot();
    m_.time = m_.periodic.reached(u == 1 && step == end_ - m_.time ? end_ : m_.time + u * step);
    is_fresh_ = is_fresh_ || m_.periodic.knot() != knot;
  }
  /// Takes the values of a quantity at all zeros of its slope before an end.
  static void take_turns(Range& range, Quad anchor, const Series& p, Quad end) {
    for (const Quad u : turns_of(p, end)) range.take(to_long(anchor + jet(p, u).first));
  }
  /// Notes how near a guard comes to 0 without falling to it: at a zero of its slope, or where that jumps.
  void watch(const Guard& guard, Quad u, Quad step) {
    Watch& seen = watches_[place_of(guard)];
    const auto [value, slope] = jet(guard.p, u);
    const bool goes_on = seen.until == m_.time;
    seen.high = std::max({seen.high, size_of(guard.p[0]), size_of(value)});
    seen.fast = std::max({seen.fast, size_of(guard.p[1] / step), size_of(slope / step)});
    if (goes_on && seen.last_slope < 0 && guard.p[1] > 0) note(guard.p[0], seen.high);
    if (guard.p[1] < 0 && slope > 0) note(jet(guard.p, refined(negative(slope_of(guard.p)), 0, u)).first, seen.high);
    seen.last_slope = slope, seen.until = m_.time + u * step;
  }
  /// What happens when a guard has fallen to 0.
  void conclude(const Guard& guard, bool has_moved, Quad step) {
    Watch& seen = watches_[place_of(guard)];
    if (has_moved) note(seen.last_slope / step, seen.fast);
    seen = {};
    switch (guard.of) {
      case Guard::Of::stop:
        return meet(guard.side);
      case Guard::Of::wall:
        m_.wall_anchor = m_.wall(guard.side).place, m_.r = 0;
        if (!m_.wall(guard.side).is_soft) return;
        m_.wall_around = guard.side, m_.wall_pushes = true;
        ++run_.impacts;
        return tell(Kind::wall_touch, guard.side, m_.w, m_.w, m_.v);
      case Guard::Of::wall_force_gone:
        m_.wall_pushes = false;
        if (m_.wall(m_.wall_around).damper != 0) return;
        [[fallthrough]];
      case Guard::Of::wall_left:
        m_.r = 0, m_.wall_around = 0, m_.wall_pushes = false;
        return;
      case Guard::Of::wall_force_back:
        m_.wall_pushes = true;
        return;
      case Guard::Of::still:
        m_.v = 0, is_fresh_ = is_turning_ = true;
        m_.q += std::min(m_.scene.rounding * size_of(m_.x()), Quad(1e-6) * size_of(m_.q));
        return;
      case Guard::Of::loose_still:
        m_.w = 0, is_fresh_ = true;
        return;
      case Guard::Of::force_gone:
        return separate();
      case Guard::Of::force_back:
        m_.has_force = true;
        return tell(Kind::renewal, m_.around);
      case Guard::Of::left:
        return leave();
      case Guard::Of::hold:
      case Guard::Of::press:
        return;
    }
  }
  void meet(int side) {
    m_.count_from(side);
    if (!m_.stop(side).is_soft) return;
    m_.around = side, m_.has_force = true;
    tell(Kind::touch, side);
  }
  void separate() {
    m_.has_force = false;
    tell(Kind::separation, m_.around);
    if (m_.stop(m_.around).damper == 0) leave();
  }
  void leave() {
    tell(Kind::leave, m_.around);
    m_.q = 0, m_.around = 0, m_.has_force = false;
  }

  Motion m_;
  const Quad end_;
  Quad fastest_ = 0;
  Mode mode_{};
  int held_on_ = 0;
  bool is_fresh_ = false;    ///< something has just come to rest, or the force has just jumped or bent
  bool is_turning_ = false;  ///< the velocity of the main mass has just fallen to 0
  std::array<Watch, 24> watches_{};
  MachineRun run_{};
};

}  // namespace
}  // namespace machine

MachineRun run_machine(const MachineScene& scene, double duration, std::size_t most_impacts) {
  return machine::Machine(scene, duration).run(most_impacts);
}

}  // namespace clatter::hard
