#include "loose_motion.hpp"

#include <utility>

namespace verify {
namespace {

Scene both_of(Scene scene) {
  const LooseMass& loose = *scene.loose;
  const Ball both = Ball(1) + loose.mass;
  scene.h = scene.h / both, scene.k = scene.k / both, scene.f = scene.f / both;
  scene.load = (scene.load + loose.mass * loose.load) / both;
  return scene;
}

}  // namespace

LooseMotion::Flows::Flows(const Scene& scene)
    : both(both_of(scene)), alone(Flow::free(scene)), as_one(Flow::free(both)) {}

LooseMotion::LooseMotion(const Scene& scene, const Start& start, const Four& width)
    : scene_(scene), loose_(*scene.loose), flows_(std::make_shared<const Flows>(scene)), time_(start.time) {
  if (start.pressed) {
    set_ =
        FourSet({{start.x, start.v, loose_.wall(*start.pressed), Ball(0)}}, {{width[0], width[1], Ball(0), Ball(0)}});
    wall_ = *start.pressed, pressed_ = true, press_begin_ = start.time;
    return;
  }
  set_ = FourSet({{start.x, start.v, start.z, start.w}}, width);
  const Four hull = set_.hull();
  for (const Side side : {Side::lower, Side::upper}) {
    if (!loose_.walls[index_of(side)]) continue;
    const Ball depth = Ball(sign_of(side)) * (hull[2] - loose_.wall(side));
    if (depth.is_negative()) continue;
    if (!depth.is_zero()) throw Undecided("on which side of a wall the motion starts");
    begin_at_wall(side, hull[3]);
  }
}

/// The start of a loose mass on a wall.
void LooseMotion::begin_at_wall(Side side, const Ball& w) {
  const Ball into = Ball(sign_of(side)) * w;
  wall_ = side, vanishing_ = 1;
  if (into.is_negative()) return;
  if (into.is_zero()) return rest_or_leave();
  if (!into.is_positive() || !set_.is_a_point()) throw Undecided("a start at a wall");
  hits_at_start_ = true;
}

LooseMotion::State LooseMotion::state_of(const Four& y) const {
  if (!on_surface_) return {time_, y[0], y[1], y[2], y[3]};
  return {y[0], y[1], y[2] + kick_ * y[3], loose_.wall(wall_), turn_ * y[3]};
}

Ball LooseMotion::pressing() const {
  const State state = state_of(set_.hull());
  const Ball a = Flow::Flight(flows_->alone, state.time, state.x, state.v).at(Ball(0)).a;
  return Ball(sign_of(wall_)) * (loose_.load - a);
}

std::vector<Margin> LooseMotion::margins() const {
  std::vector<Margin> list;
  for (const Side side : {Side::lower, Side::upper})
    if (loose_.walls[index_of(side)])
      list.push_back({-sign_of(side), loose_.wall(side), Ball(0), side == wall_ ? vanishing_ : 0});
  return list;
}

/// The derivative of the state in flight, at a fixed time, by the coordinates of the set.
FourByFour LooseMotion::into_flight(const Flow::Instant& start, const Ball& w) const {
  if (!on_surface_) return FourByFour::identity();
  const Ball zero(0), one(1);
  return {{{{{-start.v, one, zero, zero}},
            {{-start.a, zero, one, kick_}},
            {{-w, zero, zero, zero}},
            {{start.a - loose_.load, zero, zero, turn_}}}}};
}

/// The derivative of the state after a time by the state (eq. 7): z = y - x, of which y moves with y' = x' + z'.
FourByFour LooseMotion::over(const Ball& s) const {
  const Matrix p = flow().propagator(s);
  const Ball zero(0), one(1);
  FourByFour m = FourByFour::zero();
  m[0] = {{p.a, p.b, zero, zero}}, m[1] = {{p.c, p.d, zero, zero}};
  if (pressed_) return m;
  m[2] = {{one - p.a, s - p.b, one, s}}, m[3] = {{-p.c, one - p.d, zero, one}};
  return m;
}

Event LooseMotion::next(const Ball& end) {
  if (pressed_) throw Undecided("motion goes on while a wall presses the loose mass");
  if (hits_at_start_) return hit_at_start();
  const State state = state_of(set_.hull());
  const Flow::Flight main(flow(), state.time, state.x, state.v);
  const FlightInHousing all = in_housing(main, state);
  const std::vector<Margin> list = margins();
  const Ball horizon = end - state.time;
  if (const auto crossing = first_crossing(flow().rate(), all, list, horizon)) {
    const Margin& margin = list[crossing->margin];
    const Ball instant = instant_of(all, margin, Ball::hull(crossing->from, crossing->to));
    if (instant < horizon) {
      stretches_.push_back({main, instant});
      return strike(main, all, margin, instant);
    }
    if (!(instant > horizon)) throw Undecided("whether an event comes before the end");
  }
  stretches_.push_back({main, horizon});
  move_to_end(main, end);
  at_end_ = true;
  return {Kind::end, wall_, end, Ball(0), Ball(0)};
}

bool LooseMotion::is_clear_until(const Ball& time) const {
  if (pressed_ || hits_at_start_) return false;
  const State state = state_of(set_.hull());
  const Ball horizon = time - state.time;
  if (!horizon.is_positive()) return horizon.is_negative();
  const Flow::Flight main(flow(), state.time, state.x, state.v);
  try {
    return !first_crossing(flow().rate(), in_housing(main, state), margins(), horizon);
  } catch (const Undecided&) {
    return false;
  }
}

Event LooseMotion::graze(Side, const Ball&, const Ball&) { throw Undecided("a graze of a wall"); }

void LooseMotion::require_bounds() const {
  const Four hull = set_.hull();
  if (!hull.all(hull, [](const Ball& x, const Ball&) { return x.is_finite(); }))
    throw Undecided("a state whose bounds are lost");
}

void LooseMotion::move_to_end(const Flow::Flight& main, const Ball& end) {
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  const Flow::Flight middle(flow(), centre.time, centre.x, centre.v);
  const Ball duration = end - centre.time;
  const Flow::Instant image = middle.at(duration);
  Four there{{image.x, image.v, loose_.walls[index_of(wall_)].value_or(Ball(0)), Ball(0)}};
  if (!pressed_) {
    const Flow::Instant place = in_housing(middle, centre).at(duration);
    there[2] = place.x, there[3] = place.v;
  }
  set_.move(there, over(end - hull.time) * into_flight(main.at(Ball(0)), hull.w));
  on_surface_ = false, time_ = end;
  if (!pressed_) vanishing_ = 0;
  require_bounds();
}

Event LooseMotion::strike(const Flow::Flight& main, const FlightInHousing& all, const Margin& margin,
                          const Ball& instant) {
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  const Flow::Flight middle(flow(), centre.time, centre.x, centre.v);
  const FlightInHousing in_middle = in_housing(middle, centre);
  const Ball middle_instant = instant_of(in_middle, margin, instant);
  const Flow::Instant image = middle.at(middle_instant), there = main.at(instant), place = all.at(instant);
  const Ball zero(0), one(1), late = Ball(-1) / place.v;  // the later, the farther z is from the wall
  const FourByFour out{{{{{zero, zero, late, zero}},
                         {{one, zero, late * there.v, zero}},
                         {{zero, one, late * there.a, zero}},
                         {{zero, zero, late * place.a, one}}}}};
  set_.move({{centre.time + middle_instant, image.x, image.v, in_middle.at(middle_instant).v}},
            out * over(instant) * into_flight(main.at(Ball(0)), hull.w));
  on_surface_ = true;
  require_bounds();
  const Four struck = set_.hull();
  rebound(margin.sign < 0 ? Side::upper : Side::lower);
  return {Kind::impact, wall_, struck[0], struck[3], Ball(0)};
}

/// The impact of a start on a wall that moves into it.
Event LooseMotion::hit_at_start() {
  hits_at_start_ = false;
  const Four before = set_.centre();
  const Ball w = before[3];
  set_ = FourSet({{time_, before[0], before[1], w}}, Four::zero()), on_surface_ = true;
  rebound(wall_);
  return {Kind::impact, wall_, time_, w, Ball(0)};
}

/// An impact (eq. 70). Without a rebound the wall presses the loose mass, or is left at once.
void LooseMotion::rebound(Side side) {
  wall_ = side, vanishing_ = 1;
  const Ball& R = loose_.restitution(side);
  kick_ = (Ball(1) + R) * loose_.share(), turn_ = -R;
  if (R.is_zero()) rest_or_leave();
}

/// A loose mass on a wall with z' = 0.
void LooseMotion::rest_or_leave() {
  const Ball press = pressing();
  if (press.is_negative()) {
    vanishing_ = 2;
    return;
  }
  if (!press.is_positive()) throw Undecided("whether a wall presses the loose mass");
  pressed_ = true, press_begin_ = state_of(set_.hull()).time;
}

}  // namespace verify
