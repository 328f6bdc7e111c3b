#pragma once

#include <array>
#include <cmath>

#include "motion/arc_constants.hpp"
#include "motion/linear_maps.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "scene/scene.hpp"

namespace clatter::motion {

/// Impacts between a loose mass and the main mass (eq. 70): both momenta change by the same impulse.
template <class Number>
struct WallRule {
  Number ratio;                      ///< eps
  Restitution<Number> lower, upper;  ///< of the walls

  template <class Other>
  explicit WallRule(const BasicLooseMass<Other>& loose)
      : ratio(loose.ratio), lower(loose.restitution_lower), upper(loose.restitution_upper) {}

  [[nodiscard]] const Restitution<Number>& law(Side wall) const { return wall == Side::upper ? upper : lower; }
  /// That of the wall that a loose mass meets with z' = w.
  [[nodiscard]] const Restitution<Number>& law_for(const Number& w) const { return w > 0 ? upper : lower; }
  [[nodiscard]] bool loses() const { return lower.loses() || upper.loses(); }

  /// The share of a change of z' that the main mass takes: x' changes by this times (1 + R) z'.
  [[nodiscard]] Number share() const { return ratio / (1 + ratio); }
  /// x' after an impact at which z' is w.
  [[nodiscard]] Number main_after(const Number& v, const Number& w) const { return v - share() * law_for(w).jump(w); }
  /// x' once the two move as one.
  [[nodiscard]] Number main_with(const Number& v, const Number& w) const { return v + share() * w; }
  /// The energy over the main mass that is lost if z' changes from one speed to another.
  [[nodiscard]] Number loss(const Number& before, const Number& after) const {
    return share() * (before - after) * (before + after) / 2;
  }
};

/// y'' of a loose mass that slides towards a side, or flies (eq. 80).
template <class Number>
[[nodiscard]] Number load_of_slide(const BasicLooseMass<Number>& loose, Side towards) {
  return towards == Side::none ? loose.load : Number(loose.load - sign_of(towards) * loose.friction / loose.ratio);
}
/// The constants of the main mass beside a loose one that slides towards a side: friction draws it along (eq. 80).
template <class Number, Effects E>
[[nodiscard]] ArcConstants<Number, E> drawn(const ArcConstants<Number, E>& free, const Number& friction, Side towards) {
  const Number force = sign_of(towards) * friction;
  auto constants = ArcConstants<Number, E>::of(free.h, free.f, free.nu, free.load + force, free.k, free.shape);
  constants.rubbing = force, constants.period = free.period;
  return constants;
}
/// The constants of the main mass with a loose mass that a wall presses: (1 + eps) x'' + 2 h x' + k x = f sin(theta) +
/// load + eps y'' (eq. 71).
template <class Constants, class Number, Effects E, class Other>
[[nodiscard]] Constants carrying(const ArcConstants<Number, E>& free, const BasicLooseMass<Other>& loose) {
  const Number eps(loose.ratio), both = 1 + eps;
  Constants constants = Constants::of(free.h / both, free.f / both, free.nu,
                                      (free.load + eps * Number(loose.load)) / both, free.k / both, free.shape);
  constants.carried = eps, constants.period = free.period;
  return constants;
}
/// Soft stops, and friction, of a main mass with a loose one of so many times its mass.
template <class Number>
[[nodiscard]] BasicStops<Number> stops_of_both(BasicStops<Number> stops, const Number& ratio) {
  using std::sqrt;
  const Number both = 1 + ratio, root = sqrt(both);
  for (Number* const stiffness : {&stops.stiffness_lower, &stops.stiffness_upper})
    if (is_finite(*stiffness)) *stiffness = *stiffness / both;
  stops.damping_lower = stops.damping_lower / root, stops.damping_upper = stops.damping_upper / root;  // ratios
  return stops;
}
template <class Number>
[[nodiscard]] BasicFriction<Number> friction_of_both(const BasicFriction<Number>& friction, const Number& ratio) {
  return {friction.kinetic / (1 + ratio), friction.static_level / (1 + ratio)};
}
/// Whether free motion of both masses as one is a decaying rotation.
template <class Number, Effects E, class Other>
[[nodiscard]] bool rotates_carrying(const ArcConstants<Number, E>& free, const BasicLooseMass<Other>& loose) {
  const Number both = 1 + Number(loose.ratio);
  const double h = static_cast<double>(free.h / both), k = static_cast<double>(free.k / both);
  return h * h < k;
}

/// A soft wall: a spring and a damper without mass between both masses, whose damping ratio counts by the mass of both
/// that they move. Without `side` the wall is rigid, or there is none.
template <class Number, class Given>
[[nodiscard]] SoftStop<Number> soft_wall_at(const BasicLooseMass<Given>& loose, Side side) {
  using std::sqrt;
  if (!is_soft(loose, side)) return {};
  const bool upper = side == Side::upper;
  const Number ratio(loose.ratio), stiffness(upper ? loose.stiffness_upper : loose.stiffness_lower);
  return {side, Number(upper ? loose.upper : loose.lower), stiffness,
          Number(upper ? loose.damping_upper : loose.damping_lower) * sqrt(Number(stiffness * (ratio / (1 + ratio))))};
}

/// The housing of a loose mass, whose walls stop it, and on which it may rub.
template <class Number>
struct Walls {
  template <class Other = double>
  explicit Walls(const BasicLooseMass<Other>& loose)
      : rule(loose),
        load(loose.load),
        places{.lower = static_cast<double>(loose.lower), .upper = static_cast<double>(loose.upper)},
        soft{soft_wall_at<Number>(loose, Side::lower), soft_wall_at<Number>(loose, Side::upper)} {
    if (!has_loose_friction(loose)) return;
    hold = Number(loose.friction_static) / rule.ratio;
  }

  /// The same for a loose mass that slides towards a side: friction brakes it (eq. 80).
  template <class Other>
  [[nodiscard]] static Walls of_slide(const BasicLooseMass<Other>& loose, Side towards) {
    Walls walls(loose);
    const Number kinetic(loose.friction), more = Number(loose.friction_static) - kinetic;
    walls.slides_to = towards;
    walls.load -= sign_of(towards) * kinetic / walls.rule.ratio;
    walls.jump = -sign_of(towards) * more / walls.rule.share();
    return walls;
  }

  [[nodiscard]] Number place(Side side) const { return Number(side == Side::upper ? places.upper : places.lower); }
  /// Whether the loose mass rubs on its housing.
  [[nodiscard]] bool is_rough() const { return hold > 0; }
  [[nodiscard]] bool is_soft(Side side) const { return side != Side::none && soft[index_of(side)].side == side; }
  /// Whether a loose mass lies on a rigid wall.
  [[nodiscard]] bool lies_on_wall(const LooseState<Number>& loose) const {
    return loose.wall != Side::none && loose.place == 0 && !is_soft(loose.wall);
  }
  /// The push of the soft wall that a loose mass is in contact with, along x on the main mass, over that.
  [[nodiscard]] Number push(const LooseState<Number>& loose) const {
    if (!loose.pushed) return Number(0);
    const SoftStop<Number>& wall = soft[index_of(loose.wall)];
    return wall.stiffness * loose.place + 2 * wall.damping * loose.speed;
  }
  /// Its rate beside a main mass that stands.
  [[nodiscard]] Number rate_of_push(const LooseState<Number>& loose) const {
    const SoftStop<Number>& wall = soft[index_of(loose.wall)];
    return wall.stiffness * loose.speed + 2 * wall.damping * (load - push(loose) / rule.ratio);
  }

  WallRule<Number> rule;
  Number load;                           ///< y''; of a loose mass that slides with the friction
  Stops places;                          ///< of the walls
  std::array<SoftStop<Number>, 2> soft;  ///< [wall]; of a rigid one without a side
  Number hold{};                         ///< the static level of the friction, as an acceleration of the loose mass
  Side slides_to = Side::none;           ///< the side to which the loose mass slides
  Number jump{};  ///< by how much x'' differs from y'' at the instant at which friction lets it slide
};

/// The place of a loose mass in its housing, z, and z'.
template <class Number>
struct PlaceInHousing {
  Number z, w;
};
template <class Number>
[[nodiscard]] PlaceInHousing<Number> place_in_housing(const State<Number>& state, const LooseMass& loose) {
  const LooseState<Number>& own = state.loose;
  if (own.wall == Side::none) return {own.place - state.x, own.speed - state.v};
  return {Number(own.wall == Side::upper ? loose.upper : loose.lower) + own.place, own.speed};
}

/// Displacement and velocity of the main mass and of the loose one.
template <class Number>
[[nodiscard]] Four<Number> numbers_of(const State<Number>& state, const LooseMass& loose) {
  if (state.loose.wall == Side::none) return {state.x, state.v, state.loose.place, state.loose.speed};
  const auto [z, w] = place_in_housing(state, loose);
  return {state.x, state.v, Number(state.x + z), Number(state.v + w)};
}
/// The state that a small change makes of one. A loose mass that a wall presses stays on it, and one that friction
/// holds keeps z' = 0.
template <class Number>
[[nodiscard]] State<Number> moved(State<Number> state, const Four<double>& by) {
  if (by == Four<double>{}) return state;
  state.x += by[0], state.offset += by[0], state.v += by[1], state.released = false;
  state.within = Side::none, state.pressed = false;  // which the next arc finds out
  LooseState<Number>& loose = state.loose;
  const bool is_of_wall = loose.wall != Side::none;
  if (is_of_wall && loose.place == 0 && loose.speed == 0) return state;
  loose.place += is_of_wall ? by[2] - by[0] : by[2];
  if (!loose.pressed) loose.speed += is_of_wall ? by[3] - by[1] : by[3];
  loose.released = false;
  return state;
}

/// The wall from which the place of a loose mass that rubs counts at its start: the nearer one, else that to which the
/// scene leans, so that the mirror image of a motion is one to the last bit.
[[nodiscard]] inline Side nearer_wall(const Scene& scene) {
  const LooseMass& loose = scene.loose;
  const Oscillator& o = scene.oscillator;
  const double nearer = (loose.place - loose.lower) - (loose.upper - loose.place);  // infinite with one wall
  for (const double sign :
       {nearer, loose.velocity, scene.start.velocity, scene.start.displacement, loose.load, o.load, o.forcing})
    if (sign != 0) return sign > 0 ? Side::upper : Side::lower;
  return Side::lower;
}
/// The start of a loose mass, from that of the main mass. Where friction may hold it, it counts from a wall at once, so
/// that its place in the housing stays exactly the same.
template <class Number>
[[nodiscard]] LooseState<Number> loose_start(const Scene& scene) {
  const LooseMass& loose = scene.loose;
  for (const Side side : {Side::lower, Side::upper})
    if (loose.place == (side == Side::upper ? loose.upper : loose.lower))
      return {side, Number(0), Number(loose.velocity)};
  if (has_loose_friction(loose)) {
    const Side wall = nearer_wall(scene);
    const double from = wall == Side::upper ? loose.upper : loose.lower;
    return {wall, Number(loose.place) - Number(from), Number(loose.velocity)};
  }
  return {Side::none, Number(scene.start.displacement) + Number(loose.place),
          Number(scene.start.velocity) + Number(loose.velocity)};
}

}  // namespace clatter::motion
