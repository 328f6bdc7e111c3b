#include "motion.hpp"

#include <utility>

namespace verify {
namespace {

template <class Number>
std::vector<BasicFlow<Number>> flows_of(const BasicScene<Number>& scene) {
  std::vector<BasicFlow<Number>> flows;
  for (const int heading : {-1, 1}) {
    BasicScene<Number> slip = scene;
    slip.load = scene.load - Number(heading) * scene.friction;
    const auto free = BasicFlow<Number>::free(slip);
    flows.push_back(free);
    for (const auto& stop : scene.stops)
      flows.push_back(stop && stop->soft ? BasicFlow<Number>::in_contact(slip, *stop) : free);
    if (!scene.is_rough()) break;
  }
  return flows;
}

/// The scene of a main mass that carries the loose one along.
Scene both_of(Scene scene) {
  const LooseMass& loose = *scene.loose;
  const Ball both = Ball(1) + loose.mass;
  scene.h = scene.h / both, scene.k = scene.k / both, scene.force = scene.force.over(both);
  scene.load = (scene.load + loose.mass * loose.load) / both;
  scene.friction = scene.friction / both, scene.friction_static = scene.friction_static / both;
  for (auto& stop : scene.stops)
    if (stop && stop->soft) stop->kappa = stop->kappa / both, stop->h_s = stop->h_s / both;
  return scene;
}

Flow still_flow(Scene scene) {
  scene.force = {};
  return {Ball(0), Ball(0), Ball(0), scene};
}

}  // namespace

Motion::Flows::Flows(const Scene& scene) : alone(flows_of(scene)), held(still_flow(scene)) {
  if (!scene.loose) return;
  both = both_of(scene), as_one = flows_of(*both);
  if (!scene.loose->is_rough()) return;
  alone.clear();
  for (const int way : {-1, 1}) {
    Scene& beside = drawn.emplace_back(scene);
    beside.load = scene.load + Ball(way) * scene.loose->friction;
    for (Flow& flow : flows_of(beside)) alone.push_back(std::move(flow));
  }
}

Motion::Motion(const Scene& scene, const Start& start, const Four& width)
    : scene_(scene), flows_(std::make_shared<const Flows>(scene)), start_time_(start.time) {
  begin_at(start, width);
}

Motion::Motion(const Scene& scene, const Family& family, const Start& start)
    : scene_(scene),
      family_(&family),
      flows_(std::make_shared<const Flows>(scene)),
      moving_flows_(std::make_shared<const std::vector<BasicFlow<Dual>>>(flows_of(family.scene))),
      start_time_(start.time) {
  begin_at(start, Four::zero());
}

void Motion::begin_at(const Start& start, const Four& width) {
  if (start.released) return start_with_release(start);
  Four from{{start.x, start.v, start.z, start.w}}, apart = width;
  if (start.pressed) {
    from[2] = scene_.loose->wall(*start.pressed), from[3] = apart[2] = apart[3] = Ball(0);
    wall_ = *start.pressed, pressed_ = true, press_begin_ = start.time;
  }
  set_ = MovingSet(from, apart), time_ = start.time;
  if (rubs() && !pressed_) {
    const Ball v = set_.hull()[1], w = set_.hull()[3];
    if (w.is_positive() || w.is_negative())
      slide_ = w.is_positive() ? 1 : -1;
    else if (!w.is_zero() || (scene_.is_rough() && !v.is_positive() && !v.is_negative()))
      throw Undecided("whether friction holds a mass at the start");
  }
  start_on_stop(start);
  if (scene_.is_rough()) begin_rough(start);
  if (scene_.loose && !pressed_) start_in_housing();
  if (pressed_ && (resting_ || sticks_)) throw Undecided("a start at which both masses are held");
}

/// The mode of a state at a stop's position or beyond it.
void Motion::start_on_stop(const Start& start) {
  const Four hull = set_.hull();
  for (const Side side : {Side::lower, Side::upper}) {
    if (!scene_.stops[index_of(side)]) continue;
    const Stop& stop = scene_.stop(side);
    const Ball n(sign_of(side)), depth = n * (hull[0] - stop.position), into = n * hull[1];
    if (depth.is_negative()) continue;
    if (stop.soft) {
      const Ball force = depth + stop.q() * into;
      if (depth.is_positive() && force.is_positive()) return begin(Mode::contact, side, 0);
      if (depth.is_positive() && force.is_negative()) return begin(Mode::beyond, side, 0);
    }
    if (!depth.is_zero()) throw Undecided("on which side of a stop the motion starts");
    if (into.is_negative()) return begin(Mode::free, side, 1);
    if (into.is_positive() && set_.is_a_point()) {
      side_ = side, hits_at_start_ = 0;
      return;
    }
    if (hull[1].is_zero()) {
      if (pressed_ || (rubs() && slide_ == 0))
        throw Undecided("a start on a stop while something holds the loose mass");
      const Ball push = acting().pressing(side, start.time);
      const Ball press = stop.soft ? push : push + scene_.friction_static;
      if (press.is_negative()) return begin(Mode::free, side, 2);
      if (!press.is_positive()) throw Undecided("whether a stop holds the mass at the start");
      if (stop.soft) return begin(Mode::contact, side, stop.h_s.is_zero() ? 2 : 1);
      resting_ = true, side_ = side, rest_begin_ = start.time;
      return;
    }
    throw Undecided("a start at a stop");
  }
}

std::vector<Margin> Motion::margins() const {
  std::vector<Margin> list;
  if (resting_ || sticks_) {
    // only a strike of the loose mass moves it
  } else if (scene_.is_rough()) {
    list = rough_margins();
  } else if (mode_ == Mode::free) {
    for (const Side side : {Side::lower, Side::upper})
      if (scene_.stops[index_of(side)])
        list.push_back({-sign_of(side), scene_.stop(side).position, Ball(0), side == side_ ? vanishing_ : 0});
  } else {
    const Stop& stop = scene_.stop(side_);
    const bool beyond = mode_ == Mode::beyond;
    if (beyond) list.push_back({sign_of(side_), stop.position, Ball(0), 0});
    list.push_back({(beyond ? -1 : 1) * sign_of(side_), stop.position, stop.q(), vanishing_});
  }
  add_loose_margins(list);
  return list;
}

Event Motion::next(const Ball& end) {
  if (is_resting()) throw Undecided("motion goes on while something holds a mass");
  if (due_) return *std::exchange(due_, std::nullopt);
  if (hits_at_start_) return hit_at_start();
  if (sticks_) return stay(end);
  return fly(end);
}

/// Up to the next event, also while a wall presses the loose mass.
Event Motion::fly(const Ball& end) {
  const State state = state_of(set_.hull());
  const MachineFlight all = flight_from(state);
  const std::vector<Margin> list = margins();
  require_inside(all, list);
  const Ball horizon = end - state.time;
  if (const auto crossing = first_crossing(flow().rate(), all, list, horizon)) {
    const Margin& margin = list[crossing->margin];
    const Ball instant = instant_of(all, margin, Ball::hull(crossing->from, crossing->to));
    if (instant < horizon) {
      stretches_.push_back({all.main(), instant});
      move_to_surface(all, margin, instant);
      if (margin.of_velocity) return margin.which == Of::loose ? stop_in_housing(end) : stop_moving(end);
      const Event event = pass(crossing->margin, margin);
      return event.kind == Kind::end ? fly(end) : event;  // leaving the region beyond a stop is no event
    }
    if (!(instant > horizon)) throw Undecided("whether an event comes before the end");
  }
  stretches_.push_back({all.main(), horizon});
  move_to_end(all, end, family_ != nullptr ? family_->end_slope : Ball(0));
  at_end_ = true;
  return {Kind::end, side_, end, Ball(0), Ball(0)};
}

bool Motion::is_clear_until(const Ball& time) const {
  if (resting_ || pressed_ || due_ || hits_at_start_ || sticks_) return false;
  const State state = state_of(set_.hull());
  const Ball horizon = time - state.time;
  if (!horizon.is_positive()) return horizon.is_negative();
  try {
    const MachineFlight all = flight_from(state);
    const std::vector<Margin> list = margins();
    require_inside(all, list);
    return !first_crossing(flow().rate(), all, list, horizon);
  } catch (const Undecided&) {
    return false;
  }
}

Event Motion::graze(Side side, const Ball& about, const Ball& end) {
  if (scene_.is_rough() || scene_.loose || resting_ || hits_at_start_ || mode_ == Mode::beyond ||
      (mode_ == Mode::contact && side != side_))
    throw Undecided("a graze of a stop that the mass isn't before");
  const State state = state_of(set_.hull());
  const MachineFlight all = flight_from(state);
  const std::vector<Margin> list = margins();
  const std::size_t own = mode_ == Mode::contact ? 0 : list.size() == 2 ? index_of(side) : 0;
  const Margin& margin = list[own];
  Ball half = Ball(0.25 / flow().rate()), from, to, until;
  const auto turns_within = [&] {
    from = (about - half - state.time).middle(), until = (about + half).middle(), to = (until - state.time).upper();
    if (!from.is_positive() || !(until < end)) return false;
    const Piece piece(all, from, to);
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!piece.range(list[i], i == own ? 2 : 0).is_positive()) return false;
    return margin.rate(all.at(from)).is_negative() && margin.rate(all.at(to)).is_positive();
  };
  for (int halvings = 0; !turns_within(); half = half / Ball(2))
    if (++halvings > 30) {
      const Ball until_then = smaller(about, end) - state.time;
      if (until_then.is_positive() && first_crossing(flow().rate(), all, list, until_then)) return next(end);
      throw Undecided("whether the motion turns at the stop");
    }
  if (first_crossing(flow().rate(), all, list, from)) return next(end);
  const auto turn = turn_of(all, margin, Ball::hull(from, to));
  if (!turn) throw Undecided("when the motion turns at the stop");
  Event event{Kind::graze, side, state.time + *turn, Ball(0), Ball(0)};
  event.gap = Piece(all, turn->lower(), turn->upper()).range(margin, 0);
  stretches_.push_back({all.main(), until - state.time});
  move_to_end(all, until, Ball(0));
  return event;
}

/// The impact or touch of a start that moves into a stop, or a wall.
Event Motion::hit_at_start() {
  Four before = state_of(set_.centre()).y;
  surface_ = *std::exchange(hits_at_start_, std::nullopt);
  before[*surface_] = time_.value;
  set_ = MovingSet(before, Four::zero());  // as after any impact, from which a chatter may go on
  still_for_ = loose_still_for_ = 0;
  if (*surface_ == 2) return strike(wall_);
  const Stop& stop = scene_.stop(side_);
  heading_ = scene_.is_rough() ? sign_of(side_) : 0;
  place_ = Dual(stop.position), q_ = Dual(0), mode_ = Mode::free;
  return pass(0, {-sign_of(side_), stop.position, Ball(0)});
}

Event Motion::finish_rest(const Ball& end) { return pressed_ ? finish_press(end) : finish_rest_on_stop(end); }

Event Motion::finish_chatter(const ChatterAim& aim) {
  if (due_ || hits_at_start_) return next(aim.end);
  const bool in_housing = surface_ == std::size_t{2} && loose_vanishing_ == 1;
  return in_housing ? finish_chatter_in_housing(aim) : finish_chatter_on_stop(aim);
}

}  // namespace verify
