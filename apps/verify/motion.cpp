#include "motion.hpp"

#include <utility>

namespace verify {

namespace {

template <class Number>
std::shared_ptr<const std::vector<BasicFlow<Number>>> flows_of(const BasicScene<Number>& scene) {
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
  return std::make_shared<const std::vector<BasicFlow<Number>>>(std::move(flows));
}

}  // namespace

Motion::Motion(const Scene& scene, const Start& start, const Vector& width)
    : scene_(scene), flows_(flows_of(scene)), start_time_(start.time) {
  begin_at(start, width);
}

Motion::Motion(const Scene& scene, const Family& family, const Start& start)
    : scene_(scene),
      family_(&family),
      flows_(flows_of(scene)),
      moving_flows_(flows_of(family.scene)),
      start_time_(start.time) {
  begin_at(start, {Ball(0), Ball(0)});
}

void Motion::begin_at(const Start& start, const Vector& width) {
  if (start.released) {
    release(start.side, start.time, true);
    start_time_ = time_.value;
    return;
  }
  set_ = MovingSet({start.x, start.v}, width), time_ = start.time;
  start_on_stop(start);
  if (scene_.is_rough()) begin_rough(start);
}

/// The mode of a state at a stop's position or beyond it.
void Motion::start_on_stop(const Start& start) {
  const Vector hull = set_.hull();
  for (const Side side : {Side::lower, Side::upper}) {
    if (!scene_.stops[index_of(side)]) continue;
    const Stop& stop = scene_.stop(side);
    const Ball n(sign_of(side)), depth = n * (hull.x - stop.position), into = n * hull.y;
    if (depth.is_negative()) continue;
    if (stop.soft) {
      const Ball force = depth + stop.q() * into;
      if (depth.is_positive() && force.is_positive()) return begin(Mode::contact, side, 0);
      if (depth.is_positive() && force.is_negative()) return begin(Mode::beyond, side, 0);
    }
    if (!depth.is_zero()) throw Undecided("on which side of a stop the motion starts");
    if (into.is_negative()) return begin(Mode::free, side, 1);
    if (into.is_positive() && set_.is_a_point()) {
      side_ = side, hits_at_start_ = true;
      return;
    }
    if (hull.y.is_zero()) {
      const Ball push = scene_.pressing(side, sin_cos(scene_.nu * start.time + scene_.phase).first);
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

Motion::State Motion::state_of(const Vector& y) const {
  if (!on_surface_) return {time_.value, y.x, y.y};
  if (still_) return {y.x, y.y, Ball(0)};
  return {y.x, q_.is_zero() ? place_.value : place_.value - q_.value * y.y, factor_.value * y.y};
}

std::vector<Margin> Motion::margins() const {
  if (scene_.is_rough()) return rough_margins();
  std::vector<Margin> list;
  if (mode_ == Mode::free) {
    for (const Side side : {Side::lower, Side::upper})
      if (scene_.stops[index_of(side)])
        list.push_back({-sign_of(side), scene_.stop(side).position, Ball(0), side == side_ ? vanishing_ : 0});
    return list;
  }
  const Stop& stop = scene_.stop(side_);
  if (mode_ == Mode::contact) {
    list.push_back({sign_of(side_), stop.position, stop.q(), vanishing_});
  } else {
    list.push_back({sign_of(side_), stop.position, Ball(0), 0});
    list.push_back({-sign_of(side_), stop.position, stop.q(), vanishing_});
  }
  return list;
}

/// The derivative of the state in flight, at a fixed time, by the coordinates of the set.
Matrix Motion::into_flight(const Flow::Instant& start) const {
  if (!on_surface_) return {Ball(1), Ball(0), Ball(0), Ball(1)};
  if (still_) return {Ball(0), Ball(1), -start.a, Ball(0)};
  return {-start.v, -q_.value, -start.a, factor_.value};
}

Vector Motion::by_parameter_after(const Ball& duration, const Ball& slope) const {
  if (family_ == nullptr) return {Ball(0), Ball(0)};
  const Vector hull = set_.hull();
  const Dual time = on_surface_ ? Dual(hull.x) : time_, v(hull.y);
  const Dual x = on_surface_ ? place_ - q_ * v : Dual(hull.x);
  const BasicFlow<Dual>& flow = (*moving_flows_)[number_of_flow()];
  const auto there =
      BasicFlow<Dual>::Flight(flow, time, x, on_surface_ ? factor_ * v : v).at({duration, slope - time.slope});
  return {there.x.slope, there.v.slope};
}

Event Motion::next(const Ball& end) {
  if (resting_) throw Undecided("motion goes on while a stop holds the mass");
  if (hits_at_start_) return hit_at_start();
  if (sticks_) return stay(end);
  const State state = state_of(set_.hull());
  const Flow::Flight all(flow(), state.time, state.x, state.v);
  const std::vector<Margin> list = margins();
  const Ball horizon = end - state.time;
  const auto crossing = first_crossing(flow().rate(), all, list, horizon);
  if (crossing) {
    const Margin& margin = list[crossing->margin];
    const Ball instant = instant_of(all, margin, Ball::hull(crossing->from, crossing->to));
    if (instant < horizon) {
      stretches_.push_back({all, instant});
      if (margin.of_velocity) return stop_moving(all, instant, margin, end);
      const Event event = move_to_event(all, margin, instant, crossing->margin);
      return event.kind == Kind::end ? next(end) : event;  // leaving the region beyond a stop is no event
    }
    if (!(instant > horizon)) throw Undecided("whether an event comes before the end");
  }
  stretches_.push_back({all, horizon});
  move_to_end(all, end, family_ != nullptr ? family_->end_slope : Ball(0));
  at_end_ = true;
  return {Kind::end, side_, end, Ball(0), Ball(0)};
}

bool Motion::is_clear_until(const Ball& time) const {
  if (resting_ || hits_at_start_ || sticks_) return false;
  const State state = state_of(set_.hull());
  const Ball horizon = time - state.time;
  if (!horizon.is_positive()) return horizon.is_negative();
  const Flow::Flight all(flow(), state.time, state.x, state.v);
  try {
    return !first_crossing(flow().rate(), all, margins(), horizon);
  } catch (const Undecided&) {
    return false;
  }
}

Event Motion::graze(Side side, const Ball& about, const Ball& end) {
  if (scene_.is_rough() || resting_ || hits_at_start_ || mode_ == Mode::beyond ||
      (mode_ == Mode::contact && side != side_))
    throw Undecided("a graze of a stop that the mass isn't before");
  const State state = state_of(set_.hull());
  const Flow::Flight all(flow(), state.time, state.x, state.v);
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
    const Flow::Instant first = all.at(from), last = all.at(to);
    return margin.derivative(first.v, first.a).is_negative() && margin.derivative(last.v, last.a).is_positive();
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
  stretches_.push_back({all, until - state.time});
  move_to_end(all, until, Ball(0));
  vanishing_ = 0;
  return event;
}

/// The impact or touch of a start on a stop that moves into it.
Event Motion::hit_at_start() {
  hits_at_start_ = false;
  const Stop& stop = scene_.stop(side_);
  const Ball v = set_.centre().y, time = time_.value;
  heading_ = scene_.is_rough() ? sign_of(side_) : 0;
  if (stop.soft) {
    begin(Mode::contact, side_, stop.h_s.is_zero() ? 1 : 0);
    return {Kind::touch, side_, time, v, Ball(0)};
  }
  set_ = MovingSet({time, v}, {Ball(0), Ball(0)});  // as after any impact, from which a chatter may go on
  on_surface_ = true, place_ = Dual(stop.position), q_ = Dual(0), factor_ = Dual(-stop.R);
  rebound(side_, time);
  return {Kind::impact, side_, time, v, Ball(0)};
}

void Motion::move_to_end(const Flow::Flight& all, const Ball& end, const Ball& slope) {
  const State centre = state_of(set_.centre());
  const State hull = state_of(set_.hull());
  const Flow::Instant image = Flow::Flight(flow(), centre.time, centre.x, centre.v).at(end - centre.time);
  const Matrix derivative = all.derivative(end - hull.time) * into_flight(all.at(Ball(0)));
  set_.move({image.x, image.v}, derivative, by_parameter_after(end - hull.time, slope));
  on_surface_ = still_ = false, still_for_ = 0, time_ = end;
  const Vector state = set_.hull();
  if (!state.x.is_finite() || !state.y.is_finite()) throw Undecided("a state whose bounds are lost");
}

Event Motion::move_to_event(const Flow::Flight& all, const Margin& margin, const Ball& instant, std::size_t index) {
  const State centre = state_of(set_.centre());
  const Flow::Flight middle(flow(), centre.time, centre.x, centre.v);
  const Ball middle_instant = instant_of(middle, margin, instant);
  const Flow::Instant image = middle.at(middle_instant), there = all.at(instant);
  const Ball rate = there.v + margin.q * there.a;
  const Matrix out{Ball(-1) / rate, -margin.q / rate, -there.a / rate, Ball(1) - there.a * margin.q / rate};
  const Side side = mode_ != Mode::free ? side_ : margin.sign < 0 ? Side::upper : Side::lower;
  Dual place(margin.place), q(margin.q);
  Vector by_parameter = by_parameter_after(instant, Ball(0));
  if (family_ != nullptr) {
    const BasicStop<Dual>& stop = family_->scene.stop(side);
    place = stop.position;
    if (!margin.q.is_zero()) q = stop.q();
    const Ball late = (by_parameter.x + q.value * by_parameter.y + q.slope * there.v - place.slope) / rate;
    by_parameter = {-late, by_parameter.y - late * there.a};
  }
  set_.move({centre.time + middle_instant, image.v}, out * all.derivative(instant) * into_flight(all.at(Ball(0))),
            by_parameter);
  place_ = place, q_ = q;
  return pass(index, side);
}

/// The event that crossing a margin is, and the mode after it.
Event Motion::pass(std::size_t index, Side side) {
  on_surface_ = true, still_ = false, still_for_ = 0, factor_ = Dual(1);
  const Vector hull = set_.hull();
  if (!hull.x.is_finite() || !hull.y.is_finite()) throw Undecided("an event whose bounds are lost");
  Event event{Kind::end, side, hull.x, hull.y, Ball(0)};
  if (family_ != nullptr) event.slopes = {set_.derivative().c, set_.derivative().d, set_.by_parameter().y};
  if (mode_ == Mode::free) {
    const Stop& stop = scene_.stop(event.side);
    if (stop.soft) {
      event.kind = Kind::touch;
      begin(Mode::contact, event.side, stop.h_s.is_zero() ? 1 : 0);
      return event;
    }
    event.kind = Kind::impact, factor_ = family_ != nullptr ? -family_->scene.stop(side).R : Dual(-stop.R);
    rebound(event.side, event.time);
    return event;
  }
  if (mode_ == Mode::contact) {
    event.kind = Kind::separation;
    begin(scene_.stop(side_).h_s.is_zero() ? Mode::free : Mode::beyond, side_, 1);
    return event;
  }
  event.kind = index == 1 ? Kind::renewal : Kind::end;
  begin(index == 1 ? Mode::contact : Mode::free, side_, 1);
  return event;
}

}  // namespace verify
