#include "motion.hpp"

namespace verify {
namespace {

/// What presses the mass into a stop, and what holds it there by friction.
template <class Number>
Press<Number> hold_on(const BasicScene<Number>& scene, Side side) {
  const Number sign(sign_of(side));
  return {scene.force, sign, sign * (scene.load - scene.k * scene.stop(side).position) + scene.friction_static};
}

}  // namespace

/// The instant at which the force that presses the mass into a stop falls to 0: the first one after a time, or the
/// nearest one. Nothing if it never does: what presses at one phase does so at all.
std::optional<Dual> Motion::time_of_release(Side side, const Ball& after, bool nearest) {
  const std::vector<Ball> phases = falls_of(hold_on(acting(), side));
  if (phases.empty()) return std::nullopt;
  const Ball here = scene_.nu * after + scene_.phase;
  release_ = nearest ? nearest_to(phases, here) : first_after(phases, here);
  if (family_ == nullptr) return (release_.of(phases) - scene_.phase) / scene_.nu;
  const MovingScene& moving = family_->scene;
  const std::vector<Dual> moved = falls_of(hold_on(moving, side));
  if (moved.size() != phases.size()) throw Undecided("whether the force ever releases the mass");
  return (release_.of(moved) - moving.phase) / moving.nu;
}

void Motion::let_main_go(Side side) {
  resting_ = false;
  begin(Mode::free, side, 3);
  if (!scene_.is_rough()) return;
  heading_ = -sign_of(side);
  still_for_ = scene_.is_let_go_gently ? 2 : 1;
}

void Motion::start_with_release(const Start& start) {
  const auto release = time_of_release(start.side, start.time, true);
  if (!release) throw Undecided("whether the force ever releases the mass");
  time_ = *release, start_time_ = time_.value;
  collapse_on(start.side);
  let_main_go(start.side);
}

/// Puts the main mass on a stop, whatever its state was.
void Motion::collapse_on(Side side) {
  Four there{{scene_.stop(side).position, Ball(0), Ball(0), Ball(0)}}, slope = Four::zero();
  if (family_ != nullptr) slope[0] = family_->scene.stop(side).position.slope;
  set_.collapse(there, slope), surface_.reset();
}

/// The mass after an impact: on its way back, or without speed, when the force holds it or pulls it away at once.
void Motion::rebound(Side side, const Ball& time) {
  heading_ = scene_.is_rough() ? -sign_of(side) : 0, still_for_ = 0;
  if (!main_.is_none()) return begin(Mode::free, side, 1);
  const Ball press = press_of(side, time) + scene_.friction_static;
  if (press.is_negative()) {
    if (scene_.is_rough()) still_for_ = 1;
    return begin(Mode::free, side, 2);
  }
  if (!press.is_positive()) throw Undecided("whether a stop holds the mass after an impact");
  resting_ = true, side_ = side, rest_begin_ = time;
}

Ball Motion::press_of(Side side, const Ball& time) const { return acting().pressing(side, time); }

/// y'' towards a stop in a chatter that stays within a height of it and is no faster than that. It must be more than
/// friction holds, so that each flight returns, and vary so little that none returns at more than twice the first
/// speed.
Motion::Pull Motion::pull_in(Side side, const Ball& window, const Ball& height, const Ball& fastest) const {
  const Ball during = press_of(side, window);
  const Ball other = Ball::around_zero(Ball(2) * abs(scene_.h) * fastest + abs(scene_.k) * height);
  const Pull pull{(during + other).lower(), (during + other).upper()};
  if (!(pull.least > scene_.friction_static) || !(pull.most < Ball(4) * pull.least))
    throw Undecided("whether a chatter ends");
  return pull;
}

void Motion::require_far_off(Side side, const Ball& height) const {
  if (const auto& far = scene_.stops[index_of(opposite(side))])
    if (!(height < abs(far->position - scene_.stop(side).position)))
      throw Undecided("whether a chatter reaches the other stop");
}

/// The infinitely many rebounds from one at speed w on: with a- <= y'' <= a+ towards the stop a flight lasts
/// 2w/a+ ... 2w/a-, rises to w^2/2a- at most, and returns with w (a-/a+)^(1/2) ... w (a+/a-)^(1/2), so the times are
/// within geometric series, of the least and the greatest R of these speeds. Friction mu slows the way up and the way
/// down, so these have y'' + mu and y'' - mu. Throws Undecided if that isn't proved.
Motion::Rebounds Motion::rebounds(Side side, const Ball& time, const Ball& w) const {
  const Stop& stop = scene_.stop(side);
  const Ball& mu = scene_.friction;
  if (stop.law && stop.law->is_power() && mu.is_zero()) return slowing_rebounds(side, time, w);
  const Ball now = press_of(side, time), fastest = Ball(2) * w.upper();
  if (!(now > scene_.friction_static)) throw Undecided("whether a chatter ends");
  const Ball R = stop.law ? stop.law->shares_up_to(fastest) : stop.R;
  const Ball up = now + mu, down = now - mu, returned = R.upper() * sqrt(down / up);
  if (!(returned < Ball(1))) throw Undecided("whether a chatter ends");
  const Ball flight = (w / up + w / sqrt(up * down)).upper();
  const Ball longest = (Ball(2) * flight / (Ball(1) - returned)).upper();
  const Ball height = (square(w) / now).upper();  // twice that of the first flight under the present force
  const auto [least, most] = pull_in(side, time + Ball::hull(Ball(0), longest), height, fastest);
  if (!(square(w) / (Ball(2) * least) <= height)) throw Undecided("whether a chatter ends");
  require_far_off(side, height);
  // up against a + mu, from a height of w^2/2(a + mu) down with a - mu
  const Ball slowest = R.upper() * sqrt((most - mu) / (least + mu)),
             quickest = R.lower() * sqrt((least - mu) / (most + mu));
  if (!(slowest < Ball(1))) throw Undecided("whether a chatter ends");
  const auto flight_in = [&](const Ball& a) { return w / (a + mu) + w / sqrt((a + mu) * (a - mu)); };
  const Ball lasts = flight_in(least) / (Ball(1) - slowest);
  if (!(lasts <= longest)) throw Undecided("whether a chatter ends");
  const Rebounds left{Ball::hull(flight_in(most) / (Ball(1) - quickest), lasts), height};
  if (scene_.loose) require_off_walls(left);
  return left;
}

/// The same under a restitution 1 - C v^p, whose rebounds slow down less and less. If y'' changes at a rate of j at
/// most, a+ <= a- + j t in a flight of t <= 2w/a-, which so returns with w (1 - w j/a-^2) ... w (1 + w j/a-^2).
Motion::Rebounds Motion::slowing_rebounds(Side side, const Ball& time, const Ball& w) const {
  const Law& law = *scene_.stop(side).law;
  const Ball now = press_of(side, time), fastest = Ball(2) * w.upper();
  if (!now.is_positive()) throw Undecided("whether a chatter ends");
  const Ball height = (square(w) / now).upper();
  const Ball longest = (Ball(4) * law.sum_of_rebounds(w, Ball(0)) / now).upper();
  const auto [least, most] = pull_in(side, time + Ball::hull(Ball(0), longest), height, fastest);
  if (!(square(w) / (Ball(2) * least) <= height)) throw Undecided("whether a chatter ends");
  require_far_off(side, height);
  const Ball rate = scene_.force.steepest() * scene_.nu + abs(scene_.k) * fastest + Ball(2) * scene_.h * most;
  const Ball speeds = law.sum_of_rebounds(w, rate / square(least));
  const Rebounds left{Ball::hull(Ball(2) * speeds.lower() / most, Ball(2) * speeds.upper() / least), height};
  if (!(left.time.upper() <= longest)) throw Undecided("whether a chatter ends");
  if (scene_.loose) require_off_walls(left);
  return left;
}

/// A loose mass flies on as if the main one rested at once, but for the height of the rebounds.
void Motion::require_off_walls(const Rebounds& left) const {
  const auto [time, y] = state_of(set_.hull());
  const Ball s = Ball::hull(Ball(0), left.time), off = Ball::around_zero(left.height);
  const Ball way = y[1] + y[3] + loose_load() * s, fastest = Ball::around_zero(Ball(2) * abs(y[1]).upper());
  if (slide_ != 0 && !(Ball(slide_) * (way - fastest)).is_positive())
    throw Undecided("whether a chatter is over before the loose mass stops in its housing");
  const Ball z = y[2] + s * (y[1] + y[3] + loose_load() * s / Ball(2)) + off;
  for (const Side side : {Side::lower, Side::upper})
    if (scene_.loose->walls[index_of(side)] && !(Ball(sign_of(side)) * (scene_.loose->wall(side) - z)).is_positive())
      throw Undecided("whether a chatter is over before the loose mass strikes");
}

Event Motion::finish_chatter_on_stop(const ChatterAim& aim) {
  const Side side = side_;
  const Ball begin_time = state_of(set_.hull()).time;
  if (mode_ != Mode::free || surface_ != std::size_t{0} || vanishing_ != 1)
    return next(aim.end);    // it begins with an impact
  bool rebounds_now = true;  // else it turns back at its peak, by friction
  for (int impacts = 0; impacts < 4000; ++impacts) {
    const State state = state_of(set_.hull());
    std::optional<Rebounds> left;
    try {
      if (rebounds_now) left = rebounds(side, state.time, abs(state.y[1]));
    } catch (const Undecided&) {
      if (impacts > 1000) throw;
    }
    if (left) {
      const Ball until = state.time + left->time;
      if (until > aim.end) return {Kind::end, side, aim.end, Ball(0), Ball(0)};
      if (until < aim.end && until.radius() <= aim.accuracy && left->height <= Ball(aim.height)) {
        const Ball place = scene_.stop(side).position;
        other_places_.push_back(Ball::hull(place, place - Ball(sign_of(side)) * left->height));
        resting_ = true, main_ = Rebound{Dual(0)}, rest_begin_ = until;
        return {Kind::chatter, side, begin_time, Ball(0), until};
      }
    }
    const Event event = next(aim.end);
    rebounds_now = event.kind != Kind::reversal;
    if (!rebounds_now && event.time < aim.latest) continue;
    if (event.kind != Kind::impact || event.of_wall || event.side != side || resting_ || event.time > aim.latest)
      return event;
  }
  throw Undecided("the end of a chatter");
}

/// Nothing of the motion of the main mass before a rest is left in its state; a loose one flies on.
Event Motion::finish_rest_on_stop(const Ball& end) {
  if (!resting_) throw Undecided("whether the mass rests");
  Event event{Kind::rest, side_, rest_begin_, Ball(0), end};
  const Side side = side_;
  const Stop& stop = scene_.stop(side);
  other_places_.push_back(stop.position);
  const std::optional<Dual> release = time_of_release(side, rest_begin_, false);
  if (release) event.release = release_.number;
  const bool lets_go = release && (release->value <= end || release->value.overlaps(end));
  if (strikes_before(lets_go ? release->value : end)) {
    event.until = due_->time;
    return event;
  }
  if (scene_.loose)
    move_to_end(flight_from(state_of(set_.hull())), lets_go ? release->value : end, Ball(0));
  else
    collapse_on(side);
  time_ = lets_go ? *release : Dual(end), event.until = time_.value;
  if (lets_go)
    let_main_go(side);
  else
    at_end_ = true;
  return event;
}

/// Whether a loose mass strikes a wall, and so moves the main one that something holds, before a time. Then that is
/// due.
bool Motion::strikes_before(const Ball& time) {
  const std::vector<Margin> list = margins();
  if (list.empty()) return false;
  const State state = state_of(set_.hull());
  const MachineFlight all = flight_from(state);
  require_inside(all, list);
  const Ball horizon = time - state.time;
  const auto crossing = first_crossing(flows_->alone.front().rate(), all, list, horizon);
  if (!crossing) return false;
  const Margin& margin = list[crossing->margin];
  if (margin.of_velocity) throw Undecided("a loose mass that stops in its housing while something holds the main one");
  const Ball instant = instant_of(all, margin, Ball::hull(crossing->from, crossing->to));
  if (instant > horizon) return false;
  if (!(instant < horizon)) throw Undecided("whether a strike comes before a release");
  move_to_surface(all, margin, instant);
  due_ = strike(margin.sign < 0 ? Side::upper : Side::lower);
  return true;
}

}  // namespace verify
