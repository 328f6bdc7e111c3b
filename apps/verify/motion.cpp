#include "motion.hpp"

namespace verify {

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::impact:
      return "impact";
    case Kind::touch:
      return "touch";
    case Kind::separation:
      return "separation";
    case Kind::renewal:
      return "renewal";
    case Kind::chatter:
      return "chatter";
    case Kind::rest:
      return "rest";
    default:
      return "end";
  }
}

namespace {

std::vector<Flow> flows_of(const Scene& scene) {
  std::vector<Flow> flows{Flow::free(scene)};
  for (const auto& stop : scene.stops)
    flows.push_back(stop && stop->soft ? Flow::in_contact(scene, *stop) : flows.front());
  return flows;
}

}  // namespace

Motion::Motion(const Scene& scene, const Start& start, const Vector& width)
    : scene_(scene), flows_(std::make_shared<const std::vector<Flow>>(flows_of(scene))), start_time_(start.time) {
  if (start.released) {
    release(start.side, start.time, true);
    start_time_ = time_;
    return;
  }
  set_ = MovingSet({start.x, start.v}, width), time_ = start.time;
  start_on_stop(start);
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
      const Ball press = scene_.pressing(side, sin_cos(scene_.nu * start.time + scene_.phase).first);
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
  if (!on_surface_) return {time_, y.x, y.y};
  return {y.x, q_.is_zero() ? place_ : place_ - q_ * y.y, factor_ * y.y};
}

std::vector<Margin> Motion::margins() const {
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
  return {-start.v, -q_, -start.a, factor_};
}

Event Motion::next(const Ball& end) {
  if (resting_) throw Undecided("motion goes on while a stop holds the mass");
  if (hits_at_start_) return hit_at_start();
  const State state = state_of(set_.hull());
  const Flow::Flight all(flow(), state.time, state.x, state.v);
  const std::vector<Margin> list = margins();
  const Ball horizon = end - state.time;
  const auto crossing = first_crossing(flow(), all, list, horizon);
  if (crossing) {
    const Margin& margin = list[crossing->margin];
    const Ball instant = instant_of(all, margin, Ball::hull(crossing->from, crossing->to));
    if (instant < horizon) {
      stretches_.push_back({all, instant});
      const Event event = move_to_event(all, margin, instant, crossing->margin);
      return event.kind == Kind::end ? next(end) : event;  // leaving the region beyond a stop is no event
    }
    if (!(instant > horizon)) throw Undecided("whether an event comes before the end");
  }
  stretches_.push_back({all, horizon});
  move_to_end(all, end);
  return {Kind::end, side_, end, Ball(0), Ball(0)};
}

/// The impact or touch of a start on a stop that moves into it.
Event Motion::hit_at_start() {
  hits_at_start_ = false;
  const Stop& stop = scene_.stop(side_);
  const Ball v = set_.centre().y;
  if (stop.soft) {
    begin(Mode::contact, side_, stop.h_s.is_zero() ? 1 : 0);
    return {Kind::touch, side_, time_, v, Ball(0)};
  }
  set_ = MovingSet({stop.position, -stop.R * v}, {Ball(0), Ball(0)});
  begin(Mode::free, side_, stop.R.is_zero() ? 2 : 1);
  return {Kind::impact, side_, time_, v, Ball(0)};
}

void Motion::move_to_end(const Flow::Flight& all, const Ball& end) {
  const State centre = state_of(set_.centre());
  const State hull = state_of(set_.hull());
  const Flow::Instant image = Flow::Flight(flow(), centre.time, centre.x, centre.v).at(end - centre.time);
  const Matrix derivative = all.derivative(end - hull.time) * into_flight(all.at(Ball(0)));
  set_.move({image.x, image.v}, derivative);
  on_surface_ = false, time_ = end;
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
  set_.move({centre.time + middle_instant, image.v}, out * all.derivative(instant) * into_flight(all.at(Ball(0))));
  return pass(index, margin);
}

/// The event that crossing a margin is, and the mode after it.
Event Motion::pass(std::size_t index, const Margin& surface) {
  on_surface_ = true, place_ = surface.place, q_ = surface.q, factor_ = Ball(1);
  const Vector hull = set_.hull();
  if (!hull.x.is_finite() || !hull.y.is_finite()) throw Undecided("an event whose bounds are lost");
  Event event{Kind::end, side_, hull.x, hull.y, Ball(0)};
  if (mode_ == Mode::free) {
    event.side = surface.sign < 0 ? Side::upper : Side::lower;
    const Stop& stop = scene_.stop(event.side);
    if (stop.soft) {
      event.kind = Kind::touch;
      begin(Mode::contact, event.side, stop.h_s.is_zero() ? 1 : 0);
      return event;
    }
    event.kind = Kind::impact, factor_ = -stop.R;
    begin(Mode::free, event.side, stop.R.is_zero() ? 2 : 1);
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

/// Puts the mass on a stop at the instant at which the force that presses it falls to 0: sin(theta) is what balances
/// it, and decreases for the force that presses. The first such instant after a time, or the nearest one.
void Motion::release(Side side, const Ball& after, bool nearest) {
  const Ball u = (scene_.k * scene_.stop(side).position - scene_.load) / scene_.f;
  if (!(abs(u) < Ball(1))) throw Undecided("whether the force ever releases the mass");
  const bool falls = (scene_.f * Ball(sign_of(side))).is_positive();
  const Ball theta = falls ? Ball::pi() - asin(u) : asin(u), turn = Ball(2) * Ball::pi();
  const Ball turns = (scene_.nu * after + scene_.phase - theta) / turn;
  turns_ = nearest ? (turns + Ball(0.5)).floor() : turns.floor() + 1;
  time_ = (theta + Ball(static_cast<double>(turns_)) * turn - scene_.phase) / scene_.nu;
  set_.collapse({scene_.stop(side).position, Ball(0)});
  on_surface_ = false, was_exact_ = true, resting_ = false;
  begin(Mode::free, side, 3);
}

/// The time that infinitely many impacts take from a rebound at speed w: with a- <= y'' <= a+ towards the stop a flight
/// lasts 2w/a+ ... 2w/a-, and returns with w (a-/a+)^(1/2) ... w (a+/a-)^(1/2), so the times are within geometric
/// series. Throws Undecided if that isn't proved.
Ball Motion::chatter_time(Side side, const Ball& time, const Ball& w) const {
  const Stop& stop = scene_.stop(side);
  if (w.is_zero()) return Ball(0);
  const auto press = [&](const Ball& at) {
    return scene_.pressing(side, sin_cos(scene_.nu * at + scene_.phase).first);
  };
  const Ball now = press(time), fastest = Ball(2) * w.upper();
  if (!now.is_positive() || !(stop.R < Ball(1))) throw Undecided("whether a chatter ends");
  const Ball longest = (Ball(4) * w / (now * (Ball(1) - stop.R))).upper();
  const Ball during = press(time + Ball::hull(Ball(0), longest));
  const Ball height = (square(w) / now).upper();  // twice that of the first flight under the present force
  const Ball other = Ball::around_zero(Ball(2) * scene_.h * fastest + abs(scene_.k) * height);
  const Ball least = (during + other).lower(), most = (during + other).upper();
  if (!least.is_positive() || !(most < Ball(4) * least) || !(square(w) / (Ball(2) * least) <= height))
    throw Undecided("whether a chatter ends");
  if (const auto& far = scene_.stops[index_of(opposite(side))])
    if (!(height < abs(far->position - stop.position))) throw Undecided("whether a chatter reaches the other stop");
  const Ball slowest = stop.R * sqrt(most / least), quickest = stop.R * sqrt(least / most);
  if (!(slowest < Ball(1))) throw Undecided("whether a chatter ends");
  const Ball lasts = Ball(2) * w / least / (Ball(1) - slowest);
  if (!(lasts <= longest)) throw Undecided("whether a chatter ends");
  return Ball::hull(Ball(2) * w / most / (Ball(1) - quickest), lasts);
}

Event Motion::finish_chatter(double accuracy, const Ball& latest) {
  const Side side = side_;
  if (mode_ != Mode::free || vanishing_ == 0) throw Undecided("a chatter begins with an impact");
  const Ball begin_time = state_of(set_.hull()).time;
  for (int impacts = 0; impacts < 4000; ++impacts) {
    const State state = state_of(set_.hull());
    std::optional<Ball> left;
    try {
      left = chatter_time(side, state.time, abs(state.v));
    } catch (const Undecided&) {
      if (impacts > 1000) throw;
    }
    if (left) {
      const Ball until = state.time + *left;
      if (until.radius() <= accuracy) {
        resting_ = true, rest_begin_ = until;
        return {Kind::chatter, side, begin_time, Ball(0), until};
      }
    }
    const Event event = next((state.time + Ball(100) * scene_.period()).upper());
    if (event.kind != Kind::impact || event.side != side || event.time > latest) return event;
  }
  throw Undecided("the end of a chatter");
}

Event Motion::finish_rest(const Ball& end) {
  if (!resting_) throw Undecided("whether the mass rests");
  Event event{Kind::rest, side_, rest_begin_, Ball(0), end};
  const Side side = side_;
  const Stop& stop = scene_.stop(side);
  const Ball least = Ball(sign_of(side)) * (scene_.load - scene_.k * stop.position) - abs(scene_.f);
  if (least.is_positive()) {  // for ever
    set_.collapse({stop.position, Ball(0)}), time_ = end, on_surface_ = false, was_exact_ = true;
    return event;
  }
  release(side, rest_begin_, false);
  if (time_ <= end || time_.overlaps(end)) {
    event.until = time_;
    return event;
  }
  resting_ = true, time_ = end;
  return event;
}

}  // namespace verify
