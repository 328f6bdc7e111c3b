#pragma once

#include <cmath>
#include <limits>

#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "stepping/modes/mode.hpp"

namespace clatter::stepping {

/// A wall that presses a loose mass.
template <class Number>
struct Pressing {
  Side wall;    ///< none: whatever its force is, nothing ends the time
  Number load;  ///< y'' of the loose mass alone
};

namespace modes {

/// The acceleration z'' with which a loose mass is driven into a wall that it is on.
template <class Loop, class State>
[[nodiscard]] auto into_wall(const Loop& loop, Side side, const State& state) {
  using Number = typename Loop::Number;
  const auto& load = loop.walls().load;
  return Number(sign_of(side) * (load - loop.motion(loop.constants(), state, load).a));
}
/// Whether it lies on a wall that presses it.
template <class Loop, class State>
[[nodiscard]] bool lies_pressed(const Loop& loop, const State& state) {
  const auto& loose = state.loose;
  if (loose.wall == Side::none || loose.place != 0 || loose.speed != 0 || state.released) return false;
  return into_wall(loop, loose.wall, state) > 0;
}
/// The share of a motion below which a rebound is lost in its rounding. In 50 digits, the reference for double, it
/// lies far below all that a double can tell, and above rounding, since each impact there takes up to a millisecond.
template <class Number>
[[nodiscard]] Number faded() {
  if constexpr (std::numeric_limits<Number>::digits10 <= std::numeric_limits<double>::digits10)
    return epsilon<Number>();
  return Number(1e-30);
}
/// The speed of the main mass, or what its displacement stands for.
template <class Loop, class State>
[[nodiscard]] auto extent(const Loop& loop, const State& state) {
  using std::abs;
  const auto& c = loop.constants();
  return typename Loop::Number(abs(state.v) + c.natural * abs(state.x - c.equilibrium));
}
/// Whether nothing can tell the rest of a chatter: a rebound with the speed w changes no digit of the motion, or
/// doesn't let time go on.
template <class Loop, class State, class Number>
[[nodiscard]] bool is_faded(const Loop& loop, const State& state, const Number& w, const Number& pressing) {
  if (!(pressing > 0)) return false;
  if (w == 0) return true;
  if (!loop.walls().rule.law.loses()) return false;
  return w <= faded<Number>() * extent(loop, state) || 2 * w <= pressing * epsilon<Number>() * loop.period();
}
/// To the end of a flight of both masses.
template <class Stage, class Number>
void go_on(Stage& stage, const Number& elapsed, const motion::Motion<Number>& there) {
  const bool ends = elapsed == stage.time_left();
  stage.pass(elapsed);
  auto& state = stage.state;
  if (ends) state.phase_turns = stage.end;
  state.x = there.x, state.v = there.v, state.released = false;
}
/// Both masses as one, for a time or until a wall would have to pull.
template <class Loop, class Stage, class Number>
motion::Crossing<Number> move_as_one(Loop& loop, Stage& stage, Side pulled_by, const Number& horizon) {
  return loop.walls().carrying.with_constants([&](const auto& constants) {
    auto& state = stage.state;
    const auto flight = loop.method().carry(constants, state, loop.motion(constants, state), loop.anchor(state),
                                            Pressing<Number>{pulled_by, loop.walls().load}, horizon);
    const motion::Crossing<Number>& crossing = flight.crossing;
    if (!crossing.resolved) return crossing;
    const Side side = state.loose.wall;
    const double place = static_cast<double>(loop.walls().place(side));
    stage.show(motion::HousedArc{flight.arc, motion::Pressed{side, place}}, crossing.elapsed);
    stage.show({Stage::Kind::hold, side, stage.time(), 0.0, static_cast<double>(crossing.elapsed), 0.0, place});
    go_on(stage, crossing.elapsed, crossing.motion);
    return crossing;
  });
}

}  // namespace modes

namespace laws {

/// The main mass at an event, before which it had the velocity `before`.
template <class Number>
[[nodiscard]] motion::Event::Main main_at(const motion::State<Number>& state, const Number& before) {
  return {static_cast<double>(state.x), static_cast<double>(before), static_cast<double>(state.v)};
}
/// A loose mass that meets a wall with z' = w stays on it: both keep their momentum.
template <class Loop, class Stage, class Number>
void press(const Loop& loop, Stage& stage, Side side, const Number& w) {
  auto& state = stage.state;
  const Number before = state.v;
  state.v = loop.walls().rule.main_with(state.v, w);
  state.loose = {side, Number(0), Number(0), true}, state.released = false;
  stage.show({.kind = Stage::Kind::press,
              .side = side,
              .time = stage.time(),
              .before = static_cast<double>(w),
              .place = static_cast<double>(loop.walls().place(side)),
              .main = main_at(state, before)});
}
/// An impact on a wall with z' = w (eq. 70), after which that may press the loose mass.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome strike(Loop& loop, Stage& stage, Side side, const Number& w) {
  if (!(sign_of(side) * w > 0)) return Outcome::completed;  // it touches
  auto& state = stage.state;
  const auto& rule = loop.walls().rule;
  const Number before = state.v, after = rule.law.after(w);
  state.v = rule.main_after(state.v, w);
  state.loose = {side, Number(0), after};
  stage.show({.kind = Stage::Kind::strike,
              .side = side,
              .time = stage.time(),
              .before = static_cast<double>(w),
              .after = static_cast<double>(after),
              .place = static_cast<double>(loop.walls().place(side)),
              .turns = static_cast<double>(state.phase_turns),
              .main = main_at(state, before)});
  if (modes::is_faded(loop, state, Number(-sign_of(side) * after), modes::into_wall(loop, side, state)))
    press(loop, stage, side, after);
  return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
}

}  // namespace laws

/// A wall presses the loose mass: both move as one until the wall would have to pull.
template <class Loop>
struct Pressed {
  static constexpr Row row{"pressed", "both masses as one", "force of the wall, in the acceleration", Search::pull,
                           "release"};
  static constexpr bool called_for = Loop::effects.loose;

  [[nodiscard]] static bool has(const Loop& loop, const motion::State<typename Loop::Number>& state) {
    return state.loose.pressed || modes::lies_pressed(loop, state);
  }
  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage) {
    using Number = typename Loop::Number;
    auto& state = stage.state;
    if (!state.loose.pressed) laws::press(loop, stage, state.loose.wall, Number(0));
    const auto crossing = modes::move_as_one(loop, stage, state.loose.wall, stage.time_left());
    if (!crossing.resolved) return loop.outcome_at(crossing);
    if (crossing.margin == 0) state.loose.pressed = false, state.released = true;
    return Outcome::completed;
  }
};

/// The loose mass flies between the walls of its housing.
template <class Loop>
struct InHousing {
  static constexpr Row row{"in a housing", "free; the loose mass on its parabola", "gaps to both walls", Search::gaps,
                           "impact of the loose mass, press"};
  static constexpr bool called_for = Pressed<Loop>::called_for;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  using Crossing = motion::Crossing<Number>;

  [[nodiscard]] static bool has(const Loop&, const State&) { return true; }

  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage) {
    State& state = stage.state;
    const auto& walls = loop.walls();
    const Number horizon = stage.time_left();
    const auto flight = loop.method().fly_in_housing(state, loop.motion(loop.constants(), state, walls.load),
                                                     loop.anchor(state), start_of(loop, state), walls, horizon);
    const auto& arc = flight.arc;
    const Crossing& contact = flight.crossing;
    if (!contact.resolved) return loop.outcome_at(contact);
    if (const Number& w = arc.start().v; contact.side != Side::none && is_lost(loop, state, contact, w)) {
      state.loose = {contact.side, Number(0), Number(0)};
      return wait(loop, stage, w);
    }
    stage.show(motion::HousedArc{arc.main(), arc}, contact.elapsed);
    move_loose(walls, state.loose, contact);
    modes::go_on(stage, contact.elapsed, arc.main().at(contact.elapsed));
    if (contact.side == Side::none) return Outcome::completed;
    return laws::strike(loop, stage, contact.side, contact.motion.v);
  }

 private:
  [[nodiscard]] static motion::RelativeStart<Number> start_of(const Loop& loop, const State& state) {
    const motion::LooseState<Number>& loose = state.loose;
    if (loose.wall == Side::none) return {Number(0), loose.place - state.x, loose.speed - state.v, loose.speed};
    return {loop.walls().place(loose.wall), loose.place, loose.speed, loose.speed + state.v};
  }
  /// Whether a flight that begins with z' = w ends where nothing tells it from a press: at once, or on the wall that it
  /// begins on, from which it rises by less than rounding. The force of the wall touches zero there, and its sign is
  /// that of rounding.
  [[nodiscard]] static bool is_lost(const Loop& loop, const State& state, const Crossing& contact, const Number& w) {
    using std::abs;
    if (contact.elapsed == 0 && w == 0) return true;
    const motion::LooseState<Number>& loose = state.loose;
    if (loose.wall != contact.side || loose.place != 0 || !(contact.elapsed <= loop.shortest_hop())) return false;
    return abs(w) <= modes::faded<Number>() * modes::extent(loop, state);
  }
  /// Holds the loose mass past an instant at which the force of its wall is zero to rounding, so its sign decides
  /// nothing. After sqrt(epsilon) of a period it is clear of rounding.
  template <class Stage>
  [[nodiscard]] static Outcome wait(Loop& loop, Stage& stage, const Number& w) {
    using std::min, std::sqrt;
    const Number time = min(stage.time_left(), Number(sqrt(epsilon<Number>()) * loop.period()));
    laws::press(loop, stage, stage.state.loose.wall, w);
    const Crossing crossing = modes::move_as_one(loop, stage, Side::none, time);
    stage.state.loose.pressed = false;
    return loop.outcome_at(crossing);
  }
  /// To the end of a flight.
  template <class Walls>
  static void move_loose(const Walls& walls, motion::LooseState<Number>& loose, const Crossing& contact) {
    if (contact.side != Side::none) {
      loose = {contact.side, Number(0), contact.motion.v};
    } else if (loose.wall != Side::none) {
      loose.place = contact.motion.offset, loose.speed = contact.motion.v;
    } else {
      loose.place += (loose.speed + walls.load * contact.elapsed / 2) * contact.elapsed;
      loose.speed += walls.load * contact.elapsed;
    }
  }
};

}  // namespace clatter::stepping
