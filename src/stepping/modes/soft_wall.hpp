#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>

#include "motion/coupled_arc.hpp"
#include "motion/dry_friction.hpp"
#include "motion/housed_arc.hpp"
#include "stepping/modes/flight.hpp"
#include "stepping/modes/housing.hpp"

/// A loose mass beyond the place of a soft wall, beside every mode of the main one: the wall couples both masses, or
/// relaxes.
namespace clatter::stepping {

/// The loose mass is in contact with a soft wall.
inline constexpr Row in_wall_row{"in a soft wall", "both masses, with the wall between them (eq. 85)",
                                 "force of the wall; its velocity in the housing, under friction", Search::series,
                                 "separation; stick in the housing, reversal"};
/// The loose mass outruns a soft wall, which relaxes.
inline constexpr Row beyond_wall_row{"beyond a soft wall", "its parabola, beside the mode's",
                                     "depth; pull of the wall; its velocity in the housing, under friction",
                                     Search::series, "back between the walls; renewal"};

namespace modes {

/// What ends a step of both masses beside a soft wall, as series over it that stay positive before: the guards of the
/// main mass, and those of the loose one.
template <class Number>
class GuardsAtWall {
  using Series = motion::Powers<Number>;

 public:
  enum class Kind { none, of_main, separation, back, renewal, still };
  struct First {
    Kind kind = Kind::none;
    std::size_t margin = 0;  ///< of the main mass
    Side side = Side::none;  ///< of a stop, or to which the main mass is let go
    Number elapsed{};
  };

  GuardsAtWall(const motion::CoupledInHousing<Number>& step, const Number& horizon) : step_(step) {
    using std::min;
    first_.elapsed = min(step.length(), horizon);
    const motion::Coupling<Number>& coupling = step.coupling();
    const Number out(-sign_of(coupling.wall.side));
    const Series z = step.offset_powers();
    const Series pull = sum(out * coupling.wall.stiffness, z, out * 2 * coupling.wall.damping, step.velocity_powers());
    if (coupling.pushes) {
      see(sum(Number(-1), pull, Number(0), pull), {Kind::separation});
    } else {
      see(sum(-out, z, Number(0), z), {Kind::back}), see(pull, {Kind::renewal});
    }
  }
  /// The velocity of a loose mass that slides to a side. At the instant at which friction lets it go, its acceleration
  /// leads there, whatever the rounding of the forces says.
  void slides(Side side, bool is_let_go) {
    using std::max;
    if (side == Side::none) return;
    const Series w = step_.velocity_powers();
    Series speed = sum(Number(sign_of(side)), w, Number(0), w);
    if (is_let_go) speed[1] = max(speed[1], Number(0));
    see(speed, {Kind::still});
  }
  /// A guard of the main mass; a gap with the stop's side.
  void margin(const motion::Margin<Number>& margin, std::size_t index, Side stop = Side::none) {
    Series y = sum(margin.place, step_.main().offset_powers(), margin.speed, step_.main().course().velocity);
    y[0] += margin.constant;
    see(y, {Kind::of_main, index, stop});
  }
  void gap(const BasicStops<Number>& stops, Side side) {
    const Number place(side == Side::upper ? stops.upper : stops.lower), sign(sign_of(side));
    if (is_finite(place)) margin({sign * (place - step_.main().anchor()), -sign, Number(0)}, 0, side);
  }
  /// What holds a main mass, on which a force f sin(theta) acts beside the constant one without the wall's.
  void holds(const motion::Holding<Number>& holding, const Number& constant, const Number& f) {
    const motion::Motion<Number>& start = step_.main().start();
    Series force = step_.push_powers();
    const SineCosine<Number> phase{start.sine, start.cosine};
    force[0] += constant + f * step_.constants().drive(phase).sine;
    motion::with_force_terms<std::tuple_size_v<Series>>(step_.constants(), f, phase, step_.length(), [&](auto&& term) {
      for (std::size_t k = 1; k < force.size(); ++k) force[k] += term(k);
    });
    for (const Side side : {Side::lower, Side::upper}) {
      if (!holding.may_go(side)) continue;
      Series left = sum(Number(-sign_of(side)), force, Number(0), force);
      left[0] += holding.level;
      see(left, {Kind::of_main, 0, side});
    }
  }

  [[nodiscard]] const First& first() const { return first_; }

 private:
  [[nodiscard]] static Series sum(const Number& a, const Series& one, const Number& b, const Series& other) {
    Series y;
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = a * one[k] + b * other[k];
    return y;
  }
  /// One that begins at 0 must increase, or it ends the step at once.
  void see(Series y, First guard) {
    using std::max;
    y[0] = max(y[0], Number(0));
    const auto root = FirstRoot<Number, std::tuple_size_v<Series> - 1>::of(from_powers(y));
    if (!root) return;
    guard.elapsed = *root * step_.length();
    if (guard.elapsed < first_.elapsed || (guard.elapsed == first_.elapsed && first_.kind == Kind::none))
      first_ = guard;
  }

  const motion::CoupledInHousing<Number>& step_;
  First first_{};
};

/// A step of both masses, the main one beginning with `start` as it would without the wall.
template <class Loop, class State, class Constants, class Number>
[[nodiscard]] motion::CoupledInHousing<Number> step_at_wall(Loop& loop, const State& state, const Constants& constants,
                                                            motion::Motion<Number> start, const Number& anchor,
                                                            const Number& horizon, bool is_held) {
  const motion::Walls<Number>& walls = loop.walls();
  const Number push = walls.push(state.loose), &ratio = walls.rule.ratio;
  if (state.loose.released)
    start.a -= push * ((1 + ratio) / ratio);  // both accelerations differ by a jump alone
  else if (state.released && !(walls.is_rough() && state.loose.speed == 0))
    start.a -= push;  // which is among the forces that let it go, but between two that were let go as one
  const motion::Coupling<Number> coupling{walls.soft[index_of(state.loose.wall)], ratio, state.loose.pushed, is_held};
  return loop.method().couple(constants, coupling, start, anchor, loose_start_of(loop, state), walls.load, horizon);
}
/// The state of a loose mass, and the law of the event of its own that ends a step.
template <class Loop, class Stage>
[[nodiscard]] Outcome end_of_loose_at_wall(Loop& loop, Stage& stage,
                                           typename GuardsAtWall<typename Loop::Number>::Kind kind) {
  using Number = typename Loop::Number;
  using Kind = typename GuardsAtWall<Number>::Kind;
  motion::LooseState<Number>& loose = stage.state.loose;
  const auto& wall = loop.walls().soft[index_of(loose.wall)];
  if (kind == Kind::still) loose.speed = Number(0);
  switch (kind) {
    case Kind::separation:
      loose.pushed = false;
      laws::tell_of_soft_wall(loop, stage, Stage::Kind::wall_separation);
      if (wall.damping == 0 || !(wall.into(loose.place) > 0)) loose.place = Number(0), loose.within = false;
      return Outcome::completed;
    case Kind::back:
      loose.place = Number(0), loose.within = false;
      return Outcome::completed;
    case Kind::renewal:
      loose.pushed = true;
      laws::tell_of_soft_wall(loop, stage, Stage::Kind::wall_renewal);
      return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
    default:
      return Outcome::completed;
  }
}

/// Runs a mode in which the main mass moves, beside a loose one that is beyond the place of a soft wall: over a step of
/// the series of both, or up to the first event.
template <class Mode, class Loop, class Stage>
[[nodiscard]] Outcome fly_at_wall(const Mode& mode, Loop& loop, Stage& stage) {
  using Number = typename Loop::Number;
  using Kind = typename GuardsAtWall<Number>::Kind;
  auto& state = stage.state;
  return mode.with_oscillator([&](const auto& constants) {
    const Number horizon = stage.time_left(), anchor = loop.anchor(state);
    const motion::Motion<Number> start = start_of(mode, loop, constants, state);
    const auto step = step_at_wall(loop, state, constants, start, anchor, horizon, false);
    GuardsAtWall<Number> guards(step, horizon);
    std::size_t count = 0;
    if constexpr (Mode::row.search == Search::gaps) {
      for (const Side side : {Side::lower, Side::upper}) guards.gap(loop.stops(), side);
    } else {
      for (const motion::Margin<Number>& margin : mode.margins()) guards.margin(margin, count++);
    }
    guards.slides(loop.walls().slides_to, state.loose.released);
    const auto& first = guards.first();
    motion::Crossing<Number> crossing{count, Side::none, first.elapsed, step.main().at(first.elapsed)};
    crossing.resolved = loop.finite(crossing.motion.x) && loop.finite(step.load());
    if (!crossing.resolved) return loop.outcome_at(crossing);
    if (first.kind == Kind::of_main) {
      crossing.margin = first.margin, crossing.side = first.side;
      if (first.side != Side::none) crossing.motion.x = motion::stop_at<Number>(loop.stops(), first.side).position;
      if constexpr (requires { mode.is_none(crossing); })
        if (mode.is_none(crossing)) return mode.wait(stage, crossing);
    }
    const motion::Motion<Number> z = step.at(first.elapsed);
    stage.show(motion::HousedArc{step.main(), step}, first.elapsed);
    auto& loose = state.loose;
    loose.place = z.offset, loose.speed = z.v, loose.released = loose.may_part = false;
    const Flown<Number, std::remove_cvref_t<decltype(constants)>> flown{constants, start, crossing, horizon, count};
    const Outcome outcome = end_main(mode, stage, flown);
    if (outcome != Outcome::completed || first.kind == Kind::of_main) return outcome;
    return end_of_loose_at_wall(loop, stage, first.kind);
  });
}

/// The same of a main mass that something holds: over a step, at most up to the phase `until`. Without `holding` it is
/// held all that time.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome stay_at_wall(Loop& loop, Stage& stage, Side side,
                                   const std::optional<motion::Holding<Number>>& holding, const Number& until,
                                   bool held) {
  using Kind = typename GuardsAtWall<Number>::Kind;
  auto& state = stage.state;
  auto& loose = state.loose;
  const auto& constants = loop.held_constants(false);
  const Number horizon = (until - state.phase_turns) * loop.period();
  const auto step =
      step_at_wall(loop, state, constants, loop.motion(constants, state), loop.anchor(state), horizon, true);
  GuardsAtWall<Number> guards(step, horizon);
  if (holding) guards.holds(*holding, Number(holding->constant - loop.walls().push(loose)), loop.constants().f);
  guards.slides(loop.walls().slides_to, loose.released);
  const auto& first = guards.first();
  stage.show_rest(side, Number(first.elapsed / loop.period()), held, 0.0,
                  static_cast<double>(loop.constants().rubbing));
  stage.show(motion::HousedArc{step.main(), step}, first.elapsed);
  const motion::Motion<Number> z = step.at(first.elapsed);
  loose.place = z.offset, loose.speed = z.v, loose.released = loose.may_part = false;
  if (first.elapsed == horizon)
    state.phase_turns = until;
  else
    stage.pass(first.elapsed);
  if (first.kind == Kind::of_main) {
    state.released = true;
    return Outcome::completed;
  }
  return end_of_loose_at_wall(loop, stage, first.kind);
}

/// Finds the soft wall that a loose mass is beyond.
template <class Number>
void find_soft_wall(const motion::Walls<Number>& walls, motion::State<Number>& state) {
  motion::LooseState<Number>& loose = state.loose;
  if (loose.pressed) return;
  for (const Side side : {Side::lower, Side::upper}) {
    if (!walls.is_soft(side) || loose.wall == side) continue;
    const bool counts = loose.wall != Side::none;
    const Number from = (counts ? walls.place(loose.wall) : Number(0)) - walls.place(side);
    const Number z = from + loose.place - (counts ? Number(0) : state.x);
    if (!(sign_of(side) * z > 0)) continue;
    loose = {side, z, counts ? loose.speed : Number(loose.speed - state.v)};
  }
  const Number depth = sign_of(loose.wall) * loose.place;
  if (!walls.is_soft(loose.wall) || depth < 0) {
    loose.within = loose.pushed = false;
  } else if (depth > 0 && !loose.within) {
    loose.within = loose.pushed = true;
    loose.pushed = sign_of(loose.wall) * walls.push(loose) > 0;
  }
}

}  // namespace modes
}  // namespace clatter::stepping
