#include <algorithm>
#include <cmath>

#include "loose_motion.hpp"

namespace verify {

// A wall that presses: chatter up to it, the two masses as one, and the release.

/// The infinitely many rebounds from an impact on. Both masses together have the centre X = x + share zeta, zeta being
/// the distance from the wall. It moves as if the wall pressed at once, but for a push of q (k zeta + 2h zeta').
class LooseMotion::Chatter {
 public:
  explicit Chatter(const LooseMotion& motion);
  /// Throws Undecided if it isn't proved to end in a press.
  [[nodiscard]] Rebounds rebounds() const;

 private:
  /// What a small change of the impact does to all later ones.
  struct Change {
    Ball late, speeds, push;  ///< the most that one is late; sum of the changes of speeds; the most of that of zeta''
  };
  /// Before there is a rebound: of its time, its speed, and of the centre at a fixed time.
  struct FirstChange {
    Ball late, speed, x, v;
  };
  [[nodiscard]] Ball bound_of_place(const Change& change) const;
  [[nodiscard]] Change grown(const FirstChange& first, const Change& change) const;
  [[nodiscard]] Ball area(const FirstChange& first) const;

  const LooseMass& loose_;
  const Scene& scene_;
  Side side_;
  Ball R_;                        ///< of the wall
  Ball time_, w_, now_;           ///< of the impact; the speed after it; -zeta'' there
  Ball longest_, height_, fast_;  ///< bounds of the time of all rebounds, of zeta and of its rate
  Ball least_, most_, jerk_;      ///< bounds of -zeta'' and of its rate
  Ball q_;
  Vector centre_speed_;  ///< bounds of X' and X''
  Matrix along_;         ///< of the two as one, over all times of the rebounds
  Vector kick_;          ///< bounds of what zeta does to X and X', over its time integral
};

LooseMotion::Chatter::Chatter(const LooseMotion& motion)
    : loose_(motion.loose_), scene_(motion.scene_), side_(motion.wall_), R_(loose_.restitution(side_)) {
  const Four before = motion.set_.hull();
  time_ = before[0], w_ = abs(motion.turn_ * before[3]), now_ = motion.pressing();
  q_ = loose_.share() / (Ball(1) + loose_.mass);
  if (!now_.is_positive() || !(R_ < Ball(1))) throw Undecided("whether a chatter ends");
  longest_ = (Ball(4) * w_ / (now_ * (Ball(1) - R_))).upper();
  height_ = (square(w_) / now_).upper(), fast_ = Ball(2) * w_.upper();
  const Flow& both = motion.flows_->as_one;
  const Ball window = Ball::hull(Ball(0), longest_);
  along_ = both.propagator(window);
  const Flow::Flight centre(both, time_, before[1], before[2] + loose_.share() * before[3]);
  const Flow::Instant slow = centre.at(window);
  const Ball push = q_ * (abs(scene_.k) * height_ + Ball(2) * scene_.h * fast_), part = push * longest_;
  const Ball x = slow.x + Ball::around_zero(abs(along_.b) * part + loose_.share() * height_);
  const Ball v = slow.v + Ball::around_zero(abs(along_.d) * part + loose_.share() * fast_);
  centre_speed_ = {abs(v), abs(slow.a) + push};
  const Ball sine = sin_cos(scene_.nu * (time_ + window) + scene_.phase).first;
  const Ball a = scene_.f * sine + scene_.load - Ball(2) * scene_.h * v - scene_.k * x;
  const Ball during = Ball(sign_of(side_)) * (loose_.load - a);
  least_ = during.lower(), most_ = during.upper();
  jerk_ = abs(scene_.f * scene_.nu) + Ball(2) * scene_.h * abs(a) + abs(scene_.k) * abs(v);
  const Ball bend = -motion.flows_->both.k * along_.b - Ball(2) * motion.flows_->both.h * along_.d;
  kick_ = {q_ * (abs(scene_.k * along_.b) + Ball(2) * scene_.h * abs(along_.d)),
           q_ * (abs(scene_.k * along_.d) + Ball(2) * scene_.h * abs(bend))};
}

/// As of a chatter on a stop: with a- <= -zeta'' <= a+ the times are within geometric series.
LooseMotion::Rebounds LooseMotion::Chatter::rebounds() const {
  if (!least_.is_positive() || !(square(w_) / (Ball(2) * least_) <= height_)) throw Undecided("whether a chatter ends");
  if (const auto& far = loose_.walls[index_of(opposite(side_))])
    if (!(height_ < abs(*far - loose_.wall(side_)))) throw Undecided("whether a chatter reaches the other wall");
  const Ball slowest = R_ * sqrt(most_ / least_), quickest = R_ * sqrt(least_ / most_);
  const Ball narrow = jerk_ * longest_ / least_;
  if (!(slowest < Ball(1)) || !(narrow < Ball(0.125)) || !(R_ * (Ball(1) + Ball(4) * narrow) < Ball(1)))
    throw Undecided("whether a chatter ends");
  const Ball shortest = Ball(2) * w_ / (most_ * (Ball(1) - quickest)),
             lasts = Ball(2) * w_ / (least_ * (Ball(1) - slowest));
  Rebounds left{Ball::hull(shortest, lasts), height_, Four::zero(), FourByFour::zero()};
  if (!((time_ + left.time).upper() - time_ <= longest_)) throw Undecided("whether a chatter ends");
  const Ball most_of_zeta = longest_ * height_;
  left.shift[0] = Ball::around_zero(kick_.x * most_of_zeta), left.shift[1] = Ball::around_zero(kick_.y * most_of_zeta);
  const Ball zero(0), one(1);
  const FirstChange by[4] = {{one, zero, centre_speed_.x, centre_speed_.y},
                             {zero, zero, one, zero},
                             {zero, zero, zero, one},
                             {zero, R_, zero, loose_.share()}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Ball change = area(by[i]);
    left.uncertainty[0][i] = Ball::around_zero(kick_.x * change);
    left.uncertainty[1][i] = Ball::around_zero(kick_.y * change);
  }
  return left;
}

/// How much zeta changes at a fixed time, at most: in a flight from a rebound at w, d zeta = -w dt + tau (dw + a dt) to
/// first order in its length tau, and w/a is half of that.
Ball LooseMotion::Chatter::bound_of_place(const Change& change) const {
  return Ball(4) * fast_ * change.late + longest_ * (change.speeds + longest_ * change.push);
}

/// Bounds of a change that grows from a first one, if it has the given bounds up to an impact. Over a flight in which
/// -zeta'' varies by its share e the time and the speed of the next impact change by dt (1 + 3e) + (2/a)(1 + e) dw and
/// R (1 + 4e) dw + 5 R a e dt at most, besides what the change of zeta'' does; the sum of e is jerk longest/least.
LooseMotion::Chatter::Change LooseMotion::Chatter::grown(const FirstChange& first, const Change& change) const {
  const Ball e = jerk_ * longest_ / least_, per_speed = Ball(2) * (Ball(1) + e) / least_;
  const Ball pushed = longest_ * change.push, place = bound_of_place(change);
  const Ball rate = change.speeds + most_ * change.late + pushed;
  const Ball two_h = Ball(2) * scene_.h, k = abs(scene_.k);
  const Ball push = longest_ * (q_ * (k * place + two_h * rate) + Ball(2) * q_ * two_h * most_ * change.late);
  const Ball x = abs(along_.a) * first.x + abs(along_.b) * (first.v + push);
  const Ball v = abs(along_.c) * first.x + abs(along_.d) * (first.v + push);
  const Ball speeds =
      (first.speed + R_ * (Ball(5) * most_ * e * change.late + (Ball(1) + most_ * per_speed) * pushed)) /
      (Ball(1) - R_ * (Ball(1) + Ball(4) * e));
  return {first.late + Ball(3) * e * change.late + per_speed * (change.speeds + pushed), speeds,
          k * (x + loose_.share() * place) + two_h * (v + loose_.share() * rate)};
}

/// A bound of the change of the time integral of zeta.
Ball LooseMotion::Chatter::area(const FirstChange& first) const {
  Change change{Ball(0), Ball(0), Ball(0)};
  const auto more = [](const Ball& x) { return (Ball(2) * x + Ball(1e-100)).upper(); };
  for (int i = 0; i < 16; ++i) {  // any bounds are right that are above those that they lead to
    change = grown(first, change);
    change = {more(change.late), more(change.speeds), more(change.push)};
  }
  const Change next = grown(first, change);
  if (!(next.late < change.late && next.speeds < change.speeds && next.push < change.push))
    throw Undecided("how a chatter depends on its start");
  return longest_ * bound_of_place(change);
}

Event LooseMotion::finish_chatter(const ChatterAim& aim) {
  const double narrow = std::max(std::exp2(-static_cast<double>(bits) / 3), 1e-26);  // of its derivative
  const Side side = wall_;
  const Ball begin = state_of(set_.hull()).time;
  if (!on_surface_ || vanishing_ != 1) return next(aim.end);  // it begins with an impact
  for (int impacts = 0; impacts < 4000; ++impacts) {
    std::optional<Rebounds> left;
    try {
      left = Chatter(*this).rebounds();
    } catch (const Undecided&) {
      if (impacts > 1000) throw;
    }
    if (left) {
      const Ball until = state_of(set_.hull()).time + left->time;
      double wide = 0;
      for (const Four& row : left->uncertainty.rows)
        for (const Ball& entry : row.at) wide = std::max(wide, entry.radius());
      if (until > aim.end) return {Kind::end, side, aim.end, Ball(0), Ball(0)};
      if (until < aim.end && until.radius() <= aim.accuracy && loose_.share() * left->height <= Ball(aim.height) &&
          wide <= narrow) {
        press(*left);
        return {Kind::chatter, side, begin, Ball(0), until};
      }
    }
    const Event event = next(aim.end);
    if (event.kind != Kind::impact || event.side != side || event.time > aim.latest) return event;
  }
  throw Undecided("the end of a chatter");
}

/// The state after all rebounds: that of a motion which the wall presses at once, and bounds of the difference.
void LooseMotion::press(const Rebounds& left) {
  kick_ = loose_.share(), turn_ = Ball(0), pressed_ = true;
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  press_begin_ = hull.time + left.time;
  const Ball end = press_begin_.upper(), duration = end - hull.time;
  const Flow::Instant image = Flow::Flight(flow(), centre.time, centre.x, centre.v).at(end - centre.time);
  const Flow::Flight main(flow(), hull.time, hull.x, hull.v);
  if (!(flow().propagator(Ball::hull(Ball(0), duration.upper())).a > Ball(0.5))) throw Undecided("a long chatter");
  const Ball apart = Ball(2) * (abs(left.shift[0]) + loose_.share() * left.height).upper();
  stretches_.push_back({Flow::Flight(flow(), hull.time, hull.x + Ball::around_zero(apart), hull.v), duration});
  const Four there{{image.x, image.v, loose_.wall(wall_), Ball(0)}};
  set_.move(there + left.shift, over(duration) * into_flight(main.at(Ball(0)), Ball(0)) + left.uncertainty);
  on_surface_ = false, time_ = end;
  require_bounds();
}

Event LooseMotion::finish_rest(const Ball& end) {
  if (!pressed_) throw Undecided("whether a wall presses the loose mass");
  Event event{Kind::press, wall_, press_begin_, Ball(0), end};
  const State state = state_of(set_.hull());
  const Flow::Flight main(flow(), state.time, state.x, state.v);
  const WallForce all(main, flows_->both, state.time, loose_.load);
  const Margin force{sign_of(wall_), Ball(0), Ball(0), 0};
  const Ball horizon = end - state.time;
  if (!horizon.is_positive() || !pressing().is_positive()) throw Undecided("whether a wall presses the loose mass");
  if (const auto crossing = first_crossing(flow().rate(), all, std::span(&force, 1), horizon)) {
    const Ball instant = instant_of(all, force, Ball::hull(crossing->from, crossing->to));
    if (instant < horizon) {
      stretches_.push_back({main, instant});
      release(main, force, instant);
      event.until = set_.hull()[0];
      return event;
    }
    if (!(instant > horizon)) throw Undecided("whether a wall lets the loose mass go before the end");
  }
  stretches_.push_back({main, horizon});
  move_to_end(main, end);
  at_end_ = true;
  return event;
}

/// The instant at which x'' of both masses as one is the acceleration of the loose mass in flight.
void LooseMotion::release(const Flow::Flight& main, const Margin& force, const Ball& instant) {
  const State centre = state_of(set_.centre());
  const Flow::Flight middle(flow(), centre.time, centre.x, centre.v);
  const Ball middle_instant = instant_of(WallForce(middle, flows_->both, centre.time, loose_.load), force, instant);
  const Flow::Instant image = middle.at(middle_instant), there = main.at(instant);
  const Ball zero(0), one(1), by_x = flows_->both.k / there.j, by_v = Ball(2) * flows_->both.h / there.j;
  const FourByFour out{{{{{by_x, by_v, zero, zero}},
                         {{one + there.v * by_x, there.v * by_v, zero, zero}},
                         {{there.a * by_x, one + there.a * by_v, zero, zero}},
                         {{zero, zero, zero, zero}}}}};
  set_.move({{centre.time + middle_instant, image.x, image.v, zero}},
            out * over(instant) * into_flight(main.at(Ball(0)), zero));
  on_surface_ = true, pressed_ = false, vanishing_ = 3;
  require_bounds();
}

}  // namespace verify
