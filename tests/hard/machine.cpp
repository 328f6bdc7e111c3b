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
      if (run_.impacts > most_impacts) break;
      change_to(chosen_mode());
      run_.finished = !(m_.time < end_);
      if (run_.finished) break;
      const Quad before = m_.time;
      go();
      idle = m_.time > before ? 0 : idle + 1;
    }
    run_.x = to_long(m_.anchor + m_.q), run_.v = to_long(m_.v);
    run_.z = to_long(m_.wall_anchor + m_.r), run_.w = to_long(m_.w);
    return std::move(run_);
  }

 private:
  static constexpr std::size_t most_steps = 50'000'000, most_idle = 10'000;

  [[nodiscard]] static long double to_long(Quad value) { return static_cast<long double>(value); }
  void tell(Kind kind, int side, Quad before, Quad after) {
    run_.events.push_back({kind, side, to_long(m_.time), to_long(before), to_long(after)});
  }
  void tell(Kind kind, int side) { tell(kind, side, m_.v, m_.v); }
  /// Takes a margin in parts of the largest.
  void note(Quad margin, Quad largest) {
    if (largest > 0) run_.closest = std::min(run_.closest, to_long(size_of(margin) / largest));
  }

  // The mode at an instant.

  [[nodiscard]] Mode chosen_mode() {
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
  /// Tells the events that a change of the mode is.
  void change_to(const Mode& mode) {
    const int on = m_.is_on_rigid(1) ? 1 : m_.is_on_rigid(-1) ? -1 : 0;
    if (mode_.held && !mode.held) tell(held_on_ != 0 ? Kind::rest_end : Kind::stick_end, held_on_);
    if (!mode_.held && mode.held) tell(on != 0 ? Kind::rest : Kind::stick, on), held_on_ = on;
    if (is_turning_ && !mode.held) tell(Kind::reversal, 0);
    if (mode_.pressed != 0 && mode.pressed != mode_.pressed) tell(Kind::release, mode_.pressed);
    if (mode.pressed != 0 && mode.pressed != mode_.pressed) tell(Kind::press, mode.pressed);
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
  }
  /// Ends the endless row of contacts of both masses beside a stop: each pair alone would pass the momentum on.
  void come_to_rest() {
    const bool on_both = (m_.is_on_rigid(1) || m_.is_on_rigid(-1)) && (m_.is_on_wall(1) || m_.is_on_wall(-1));
    if (on_both && is_slow(size_of(m_.v), 0) && is_slow(size_of(m_.w), 0)) m_.v = m_.w = 0;
  }
  void take_speeds() { fastest_ = std::max({fastest_, size_of(m_.v), m_.has_loose ? size_of(m_.w) : Quad(0)}); }
  /// Whether nothing can tell a rebound from rest.
  [[nodiscard]] bool is_slow(Quad speed, Quad back) const {
    return speed <= Quad(1e-26) * fastest_ || 2 * speed < Quad(1e-27) * back;
  }
  void strike_stop(int side) {
    const Quad before = m_.v;
    m_.v *= -m_.stop(side).restitution;
    if (is_slow(size_of(m_.v), side * m_.acceleration(-side))) m_.v = 0;
    if (m_.has_loose) m_.w += before - m_.v;
    tell(Kind::stop_impact, side, before, m_.v);
  }
  void strike_wall(int side) {
    const Quad before = m_.w, share = Quad(m_.scene.loose_mass) / (1 + Quad(m_.scene.loose_mass)), v = m_.v;
    for (const Quad R : {m_.wall(side).restitution, Quad(0)}) {
      m_.w = -R * before, m_.v = v + share * (1 + R) * before;
      const Quad back = side * (m_.scene.loose_load - m_.acceleration(m_.v > 0 ? 1 : m_.v < 0 ? -1 : 0));
      if (!is_slow(size_of(m_.w), back)) break;
    }
    tell(Kind::wall_impact, side, before, m_.w);
  }

  // One step.

  /// One Taylor step in the present mode, or less if a guard falls before.
  void go() {
    const Quad step = std::min(end_ - m_.time, m_.step_of(mode_));
    const Series x = m_.main_series(mode_, step), r = m_.loose_series(mode_, x, step);
    const std::vector<Guard> rows = m_.guards(mode_, x, r, step);
    std::vector<std::optional<Quad>> falls;
    std::optional<Quad> first;
    for (const Guard& guard : rows) {
      falls.push_back(first_fall(guard.p));
      if (falls.back() && (!first || *falls.back() < *first)) first = falls.back();
    }
    const Quad u = first.value_or(1), same = Quad(1e-30) * std::max(Quad(1), m_.time);
    for (const Guard& guard : rows) watch(guard, u, step);
    pass(x, r, step, u);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (falls[i] && (*falls[i] - u) * step <= same) conclude(rows[i], u > 0, step);
  }
  void pass(const Series& x, const Series& r, Quad step, Quad u) {
    if (u == 0) return;
    const auto [q, slope] = jet(x, u);
    m_.q = q, m_.v = mode_.held ? 0 : slope / step;
    if (mode_.pressed == 0 && m_.has_loose) {
      const auto [place, speed] = jet(r, u);
      m_.r = place, m_.w = speed / step;
    }
    m_.time = u == 1 && step == end_ - m_.time ? end_ : m_.time + u * step;
  }
  /// Notes how near a guard comes to 0 without falling to it: at a zero of its slope, or where that jumps.
  void watch(const Guard& guard, Quad u, Quad step) {
    Watch& seen = watches_[2 * static_cast<std::size_t>(guard.of) + (guard.side > 0)];
    const auto [value, slope] = jet(guard.p, u);
    const bool goes_on = seen.until == m_.time;
    seen.high = std::max({seen.high, size_of(guard.p[0]), size_of(value)});
    seen.fast = std::max({seen.fast, size_of(guard.p[1] / step), size_of(slope / step)});
    if (goes_on && seen.last_slope < 0 && guard.p[1] > 0) note(guard.p[0], seen.high);
    if (guard.p[1] < 0 && slope > 0) {
      Quad low = 0, high = u;
      for (int i = 0; i < 60; ++i) {
        const Quad middle = (low + high) / 2;
        (jet(guard.p, middle).second < 0 ? low : high) = middle;
      }
      note(jet(guard.p, high).first, seen.high);
    }
    seen.last_slope = slope, seen.until = m_.time + u * step;
  }
  /// What happens when a guard has fallen to 0.
  void conclude(const Guard& guard, bool has_moved, Quad step) {
    Watch& seen = watches_[2 * static_cast<std::size_t>(guard.of) + (guard.side > 0)];
    if (has_moved) note(seen.last_slope / step, seen.fast);
    seen = {};
    switch (guard.of) {
      case Guard::Of::stop:
        return meet(guard.side);
      case Guard::Of::wall:
        m_.wall_anchor = m_.wall(guard.side).place, m_.r = 0;
        return;
      case Guard::Of::still:
        m_.v = 0, is_fresh_ = is_turning_ = true;
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
    m_.anchor = m_.stop(side).place, m_.q = 0;
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
  bool is_fresh_ = false;    ///< something has just come to rest
  bool is_turning_ = false;  ///< the velocity of the main mass has just fallen to 0
  std::array<Watch, 16> watches_{};
  MachineRun run_{};
};

}  // namespace
}  // namespace machine

MachineRun run_machine(const MachineScene& scene, double duration, std::size_t most_impacts) {
  return machine::Machine(scene, duration).run(most_impacts);
}

}  // namespace clatter::hard
