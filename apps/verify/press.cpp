#include <algorithm>
#include <cmath>

#include "motion.hpp"

namespace verify {

// A wall that presses: chatter up to it, the two masses as one, and the release.

/// The infinitely many rebounds from an impact on. Both masses together have the centre X = x + share zeta, zeta being
/// the distance from the wall. It moves as if the wall pressed at once, but for a push of q (k zeta + 2h zeta').
class Motion::ChatterInHousing {
 public:
  explicit ChatterInHousing(const Motion& motion);
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
  [[nodiscard]] Ball share_of_rebounds(Side side) const;

  const LooseMass& loose_;
  Side side_;
  Ball h_, k_;                    ///< of the main mass alone
  Ball R_, first_;                ///< of the rebounds; how the first speed changes with that before
  Ball time_, w_, now_;           ///< of the impact; the speed after it; -zeta'' there
  Ball longest_, height_, fast_;  ///< bounds of the time of all rebounds, of zeta and of its rate
  Ball least_, most_, jerk_;      ///< bounds of -zeta'' and of its rate
  Ball q_;
  Vector centre_speed_;  ///< bounds of X' and X''
  Matrix along_;         ///< of the two as one, over all times of the rebounds
  Vector kick_;          ///< bounds of what zeta does to X and X', over its time integral
};

Motion::ChatterInHousing::ChatterInHousing(const Motion& motion) : loose_(*motion.scene_.loose), side_(motion.wall_) {
  const Scene& scene = motion.scene_;
  if (loose_.is_rough()) throw Undecided("a chatter on a wall under friction in the housing");
  const Flow &alone = motion.flow(), &both = motion.flows_->as_one[motion.number_of_flow()];
  const Four before = motion.set_.hull();
  time_ = before[2], w_ = abs(motion.loose_.after(before[3])), now_ = (Ball(1) + loose_.mass) * motion.pressing();
  fast_ = Ball(2) * w_.upper(), R_ = share_of_rebounds(side_), first_ = abs(motion.loose_.slope(before[3]));
  h_ = alone.damping(), k_ = alone.stiffness(), q_ = loose_.share() / (Ball(1) + loose_.mass);
  if (!now_.is_positive() || !(R_ < Ball(1))) throw Undecided("whether a chatter ends");
  longest_ = (Ball(4) * w_ / (now_ * (Ball(1) - R_))).upper(), height_ = (square(w_) / now_).upper();
  const Ball window = Ball::hull(Ball(0), longest_);
  along_ = both.propagator(window);
  const Flow::Flight centre(both, time_, before[0], before[1] + loose_.share() * before[3]);
  const Flow::Instant slow = centre.at(window);
  const Ball push = q_ * (abs(k_) * height_ + Ball(2) * h_ * fast_), part = push * longest_;
  const Ball x = slow.x + Ball::around_zero(abs(along_.b) * part + loose_.share() * height_);
  const Ball v = slow.v + Ball::around_zero(abs(along_.d) * part + loose_.share() * fast_);
  for (const Margin& margin : motion.margins())
    if (margin.which == Of::main && !margin.of(x, v).is_positive())
      throw Undecided("whether a chatter is over before an event of the main mass");
  centre_speed_ = {abs(v), abs(slow.a) + push};
  const Ball a = scene.force_at(time_ + window) + alone.load() - Ball(2) * h_ * v - k_ * x;
  const Ball during = Ball(sign_of(side_)) * (loose_.load - a);
  least_ = during.lower(), most_ = during.upper();
  jerk_ = scene.force.steepest() * scene.nu + Ball(2) * h_ * abs(a) + abs(k_) * abs(v);
  const Ball bend = -both.stiffness() * along_.b - Ball(2) * both.damping() * along_.d;
  kick_ = {q_ * (abs(k_ * along_.b) + Ball(2) * h_ * abs(along_.d)),
           q_ * (abs(k_ * along_.d) + Ball(2) * h_ * abs(bend))};
}

/// R of the wall, which must be the same for all rebounds: none comes back faster than twice the first one's speed.
Ball Motion::ChatterInHousing::share_of_rebounds(Side side) const {
  if (!loose_.law(side)) return loose_.restitution(side);
  const auto share = loose_.law(side)->only_share_up_to(fast_);
  if (!share) throw Undecided("a chatter on a wall whose restitution depends on the speed");
  return *share;
}

/// As of a chatter on a stop: with a- <= -zeta'' <= a+ the times are within geometric series.
Motion::Rebounds Motion::ChatterInHousing::rebounds() const {
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
  const FirstChange by[4] = {{zero, zero, one, zero},
                             {zero, zero, zero, one},
                             {one, zero, centre_speed_.x, centre_speed_.y},
                             {zero, first_, zero, loose_.share()}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Ball change = area(by[i]);
    left.uncertainty[0][i] = Ball::around_zero(kick_.x * change);
    left.uncertainty[1][i] = Ball::around_zero(kick_.y * change);
  }
  return left;
}

/// How much zeta changes at a fixed time, at most: in a flight from a rebound at w, d zeta = -w dt + tau (dw + a dt) to
/// first order in its length tau, and w/a is half of that.
Ball Motion::ChatterInHousing::bound_of_place(const Change& change) const {
  return Ball(4) * fast_ * change.late + longest_ * (change.speeds + longest_ * change.push);
}

/// Bounds of a change that grows from a first one, if it has the given bounds up to an impact. Over a flight in which
/// -zeta'' varies by its share e the time and the speed of the next impact change by dt (1 + 3e) + (2/a)(1 + e) dw and
/// R (1 + 4e) dw + 5 R a e dt at most, besides what the change of zeta'' does; the sum of e is jerk longest/least.
Motion::ChatterInHousing::Change Motion::ChatterInHousing::grown(const FirstChange& first, const Change& change) const {
  const Ball e = jerk_ * longest_ / least_, per_speed = Ball(2) * (Ball(1) + e) / least_;
  const Ball pushed = longest_ * change.push, place = bound_of_place(change);
  const Ball rate = change.speeds + most_ * change.late + pushed;
  const Ball two_h = Ball(2) * h_, k = abs(k_);
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
Ball Motion::ChatterInHousing::area(const FirstChange& first) const {
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

Event Motion::finish_chatter_in_housing(const ChatterAim& aim) {
  const double narrow = std::max(std::exp2(-static_cast<double>(bits) / 3), 1e-26);  // of its derivative
  Event chatter{Kind::chatter, wall_, state_of(set_.hull()).time, Ball(0), Ball(0)};
  chatter.of_wall = true;
  for (int impacts = 0; impacts < 4000; ++impacts) {
    std::optional<Rebounds> left;
    try {
      left = ChatterInHousing(*this).rebounds();
    } catch (const Undecided&) {
      if (impacts > 1000) throw;
    }
    if (left) {
      chatter.until = state_of(set_.hull()).time + left->time;
      double wide = 0;
      for (const Four& row : left->uncertainty.rows)
        for (const Ball& entry : row.at) wide = std::max(wide, entry.radius());
      if (chatter.until > aim.end) return {Kind::end, wall_, aim.end, Ball(0), Ball(0)};
      if (chatter.until < aim.end && chatter.until.radius() <= aim.accuracy &&
          scene_.loose->share() * left->height <= Ball(aim.height) && wide <= narrow) {
        press_at_last(*left);
        return chatter;
      }
    }
    const Event event = next(aim.end);
    if (event.kind != Kind::impact || !event.of_wall || event.side != chatter.side || event.time > aim.latest)
      return event;
  }
  throw Undecided("the end of a chatter");
}

/// The state after all rebounds: that of a motion which the wall presses at once, and bounds of the difference.
void Motion::press_at_last(const Rebounds& left) {
  const Ball& share = scene_.loose->share();
  loose_ = Rebound{Dual(0)}, pressed_ = true;
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  press_begin_ = hull.time + left.time;
  const Ball end = press_begin_.upper(), duration = end - hull.time;
  const MachineFlight all = flight_from(hull);
  const Four there = state_at(flight_from(centre).at(end - centre.time));
  if (!(flow().propagator(Ball::hull(Ball(0), duration.upper())).a > Ball(0.5))) throw Undecided("a long chatter");
  const Ball apart = Ball(2) * (abs(left.shift[0]) + share * left.height).upper();
  stretches_.push_back({Flow::Flight(flow(), hull.time, hull.y[0] + Ball::around_zero(apart), hull.y[1]), duration});
  set_.move(there + left.shift, over(duration) * into_flight(all.at(Ball(0))) + left.uncertainty);
  surface_.reset(), time_ = end;
  require_bounds();
}

Event Motion::finish_press(const Ball& end) {
  const State state = state_of(set_.hull());
  Event press{on_wall_ ? Kind::press : Kind::hold, on_wall_ ? wall_ : Side::lower, press_begin_, Ball(0), end};
  press.of_wall = true, press.x = state.y[2];
  if (!(end - state.time).is_positive()) throw Undecided("whether a wall presses the loose mass");
  for (const int sign : {-1, 1})
    if ((!on_wall_ || sign == sign_of(wall_)) && !hold_left(sign).is_positive())
      throw Undecided("whether a wall presses the loose mass, or friction holds it");
  const Event after = fly(end);
  if (after.kind != Kind::end) press.until = after.time;
  if (after.kind != Kind::end && after.kind != Kind::release) due_ = after;
  return press;
}

/// y'' of a loose mass between the walls (eq. 80).
Ball Motion::loose_load() const {
  const LooseMass& loose = *scene_.loose;
  return slide_ == 0 ? loose.load : loose.load - Ball(slide_) * loose.friction / loose.mass;
}

/// How much force against leaving to one side is left, as an acceleration of the loose mass, while both move as one
/// (eqs. 72 and 81).
Ball Motion::hold_left(int sign) const {
  const State state = state_of(set_.hull());
  const LooseMass& loose = *scene_.loose;
  const Ball a = Flow::Flight(flows_->as_one[number_of_flow()], state.time, state.y[0], state.y[1]).at(Ball(0)).a;
  return Ball(sign) * (loose.load - a) + loose.friction_static / loose.mass;
}

void Motion::add_loose_margins(std::vector<Margin>& list) const {
  if (!scene_.loose) return;
  const LooseMass& loose = *scene_.loose;
  for (const Side side : {Side::lower, Side::upper}) {
    const int sign = sign_of(side);
    if (pressed_ && (!on_wall_ || side == wall_))
      list.push_back({sign, Ball(-sign) * loose.friction_static / loose.mass, Ball(0), 0, false, Of::loose});
    if (!pressed_ && slide_ != -sign && loose.walls[index_of(side)])
      list.push_back({-sign, loose.wall(side), Ball(0), side == wall_ ? loose_vanishing_ : 0, false, Of::loose});
  }
  if (!pressed_ && slide_ != 0) list.push_back({slide_, Ball(0), Ball(0), loose_still_for_, true, Of::loose});
}

/// Where a loose mass with z' = 0 slides to, +1 or -1, away from walls; 0: friction holds it.
int Motion::way_in_housing() const {
  const Ball up = hold_left(-1), down = hold_left(1);
  if (up.is_negative()) return 1;
  if (down.is_negative()) return -1;
  if (!up.is_positive() || !down.is_positive()) throw Undecided("whether friction holds the loose mass");
  return 0;
}

/// The loose mass is let go to a side, if it rubs as one that slides there.
void Motion::slide_to(int way, int wall_vanishing, int still_for) {
  pressed_ = false, loose_vanishing_ = wall_vanishing;
  if (rubs()) slide_ = way, loose_still_for_ = still_for;
}

/// A loose mass with z' = 0, on a wall or where friction may hold it.
void Motion::press_or_leave() {
  if (on_wall_) {
    const Ball press = pressing();
    if (press.is_negative()) return slide_to(-sign_of(wall_), 2, 1);
    if (!press.is_positive()) throw Undecided("whether a wall presses the loose mass");
  } else if (const int way = way_in_housing(); way != 0) {
    return slide_to(way, 0, 1);
  }
  pressed_ = true, slide_ = 0, press_begin_ = state_of(set_.hull()).time;
}

/// z' has fallen to 0: friction holds the loose mass where it is, or it turns back at once.
Event Motion::stop_in_housing(const Ball& end) {
  const Four hull = set_.hull();
  const int before = slide_;
  on_wall_ = false, press_or_leave();
  if (pressed_) return finish_press(end);
  if (slide_ == before) throw Undecided("whether the loose mass stops at all");
  Event event{Kind::turn, Side::lower, hull[3], Ball(0), Ball(0)};
  event.of_wall = true, event.x = hull[2];
  return event;
}

/// The start of a loose mass on a wall.
void Motion::start_in_housing() {
  const Four hull = set_.hull();
  for (const Side side : {Side::lower, Side::upper}) {
    if (!scene_.loose->walls[index_of(side)]) continue;
    const Ball depth = Ball(sign_of(side)) * (hull[2] - scene_.loose->wall(side));
    if (depth.is_negative()) continue;
    if (!depth.is_zero()) throw Undecided("on which side of a wall the motion starts");
    const Ball into = Ball(sign_of(side)) * hull[3];
    wall_ = side, loose_vanishing_ = 1;
    if (into.is_negative()) return;
    if (hits_at_start_ || resting_) throw Undecided("a start on a wall beside an event of the main mass");
    if (into.is_zero() && !sticks_) {
      press_or_leave();
    } else if (into.is_positive() && set_.is_a_point()) {
      hits_at_start_ = 2, sticks_ = false;  // it moves before friction has held it for any time
    } else {
      throw Undecided("a start at a wall");
    }
    return;
  }
  if (!rubs() || slide_ != 0) return;
  on_wall_ = false;  // at the start its z' is 0
  press_or_leave();
}

/// An impact on a wall (eq. 70). Without a rebound the wall presses the loose mass, or is left at once.
Event Motion::strike(Side side) {
  wall_ = side, loose_vanishing_ = 1;
  const Four before = set_.hull();
  Event event{Kind::impact, side, before[2], before[3], Ball(0)};
  event.of_wall = true;
  loose_ = scene_.loose->rebound(side, event.v);
  const Ball v = state_of(set_.hull()).y[1];
  if (resting_) {
    if (!(Ball(sign_of(side_)) * v).is_negative()) throw Undecided("whether both masses strike at one instant");
    begin(Mode::free, side_, 1);
  }
  resting_ = sticks_ = false;
  if (scene_.is_rough()) {
    if (!v.is_positive() && !v.is_negative()) throw Undecided("whether friction holds the mass after a strike");
    heading_ = v.is_positive() ? 1 : -1;
  }
  on_wall_ = true;
  if (loose_.is_none())
    press_or_leave();
  else
    slide_to(-sign_of(side), 1, 0);
  return event;
}

/// The instant at which x'' of both masses as one is the acceleration of the loose mass in flight, or friction at its
/// level is too weak against leaving it to a side.
Event Motion::let_go(int sign) {
  const bool gently = scene_.loose->is_let_go_gently;
  slide_to(-sign, on_wall_ ? (gently ? 3 : 2) : 0, gently ? 2 : 1);
  return {Kind::release, wall_, set_.hull()[*surface_], Ball(0), Ball(0)};
}

/// What an event of the main mass that keeps its velocity does to a press.
void Motion::press_on() { press_or_leave(); }

/// In an impact of the main mass on a stop the loose one keeps its velocity y'.
void Motion::shake(const Event& event) {
  const Ball w = state_of(set_.hull()).y[3];
  if (pressed_ && on_wall_ && !(Ball(sign_of(wall_)) * main_.change(event.v)).is_positive())
    throw Undecided("whether both masses strike at one instant");
  if (rubs() && !w.is_positive() && !w.is_negative()) throw Undecided("whether the loose mass stops in an impact");
  slide_to(w.is_positive() ? 1 : -1, !pressed_ ? loose_vanishing_ : on_wall_ ? 1 : 0, 0);
}

}  // namespace verify
