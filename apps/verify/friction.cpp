#include "motion.hpp"

namespace verify {

// Dry friction: x'' has the term -mu sgn x', and at x' = 0 friction holds the mass against any force up to mu_s.

/// The mass moves to the side of a positive velocity; without one friction holds it, or lets it go where it is pushed.
void Motion::begin_rough(const Start& start) {
  const Ball v = set_.hull()[1];
  still_for_ = 0;
  if (resting_ || hits_at_start_) return;
  if (v.is_positive() || v.is_negative()) {
    heading_ = v.is_positive() ? 1 : -1;
  } else if (v.is_zero()) {
    become_still(start.time);
    const int way = way_of_push();
    if (way == 0) sticks_ = true;
    if (way != 0) heading_ = way, still_for_ = 1;
  } else {
    throw Undecided("whether the mass moves at the start");
  }
}

/// Describes a mass without speed by the time and its place.
void Motion::become_still(const Ball& time) {
  Four there = set_.centre();
  there[1] = time;
  FourByFour derivative = FourByFour::identity();
  derivative[1][1] = Ball(0);
  set_.move(there, derivative);
  surface_ = 1;
}

/// The spring and the constant force that act on a still mass, those of a soft stop included.
Motion::Spring Motion::spring() const {
  const Scene& scene = acting();
  if (mode_ == Mode::free) return {scene.k, scene.load};
  const Stop& stop = scene.stop(side_);  // it has come up to a still mass
  return {scene.k + stop.kappa, scene.load + stop.kappa * stop.position};
}

/// The side to which a still mass is let go, +1 or -1; 0: friction holds it.
int Motion::way_of_push() const {
  const Four hull = set_.hull();
  const Scene& scene = acting();
  const Spring spring_now = spring();
  const Ball push = scene.force_at(hull[1]) + spring_now.load - spring_now.k * hull[0];
  if (push > scene.friction_static) return 1;
  if (push < -scene.friction_static) return -1;
  if (!(abs(push) < scene.friction_static)) throw Undecided("whether friction holds the mass");
  return 0;
}

/// The velocity has fallen to 0: the mass turns back at once, or sticks.
Event Motion::stop_moving(const Ball& end) {
  const Four hull = set_.hull();
  const int way = way_of_push();
  if (way == 0 && pressed_) throw Undecided("friction that holds both masses");
  if (way == 0) return stay(end);
  if (way == heading_) throw Undecided("whether the motion stops at all");
  heading_ = way, still_for_ = 1;
  Event event{Kind::reversal, Side::lower, hull[1], Ball(0), Ball(0)};
  event.x = hull[0];
  if (pressed_) press_on();
  return event;
}

/// The first phase from a time on at which the force passes the level of friction at a place (eqs. 26 and 65); nothing
/// if it never does.
std::optional<Motion::Release> Motion::release_to(int way, const Ball& time, const Ball& x) const {
  const Spring acting = spring();
  const Press<Ball> press{scene_.force, Ball(-way), scene_.friction_static - Ball(way) * (acting.load - acting.k * x)};
  const std::vector<Ball> phases = falls_of(press);
  if (phases.empty()) return std::nullopt;
  const PhaseOfRelease release = first_after(phases, scene_.nu * time + scene_.phase);
  const Ball rate = scene_.nu * scene_.force.at(phases[release.number]).second;
  return Release{way, (release.of(phases) - scene_.phase) / scene_.nu, acting.k / rate};
}

/// Friction holds the mass up to its release, a strike of a loose mass or a time.
Event Motion::stay(const Ball& end) {
  const Four hull = set_.hull();
  Event event{Kind::stick, Side::lower, hull[1], Ball(0), end};
  event.x = hull[0];
  other_places_.push_back(hull[0]);
  sticks_ = true;
  const auto up = release_to(1, hull[1], hull[0]), down = release_to(-1, hull[1], hull[0]);
  auto first = up ? up : down;
  if (up && down) {
    if (!(up->time < down->time) && !(down->time < up->time)) throw Undecided("to which side friction lets go");
    first = up->time < down->time ? up : down;
  }
  const bool goes_on = !first || first->time > end;
  if (!goes_on && !(first->time < end)) throw Undecided("whether friction lets the mass go before the end");
  if (strikes_before(goes_on ? end : first->time)) {
    event.until = due_->time;
  } else if (goes_on) {
    move_to_end(flight_from(state_of(hull)), end, Ball(0));
    at_end_ = true;
  } else {
    move_to_release(*first);
    sticks_ = false;
    heading_ = first->way, still_for_ = scene_.is_let_go_gently ? 2 : 1;
    event.until = set_.hull()[1];
  }
  return event;
}

/// The later, the further the spring has to be overcome.
void Motion::move_to_release(const Release& all) {
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  const auto of_centre = release_to(all.way, centre.time, centre.y[0]);
  if (!of_centre) throw Undecided("when friction lets the mass go");
  Four there = state_at(flight_from(centre).at(of_centre->time - centre.time));
  const MachineFlight flight = flight_from(hull);
  const Four rates = rates_at(flight.at(all.time - hull.time));
  FourByFour derivative = over(all.time - hull.time) * into_flight(flight.at(Ball(0)));
  for (std::size_t i = 2; i < 4; ++i) derivative[i][0] = derivative[i][0] + rates[i] * all.slope;
  there[1] = of_centre->time, derivative[1] = {{all.slope, Ball(0), Ball(0), Ball(0)}};
  set_.move(there, derivative);
  surface_ = 1, loose_vanishing_ = loose_still_for_ = 0;
}

/// What a slip must stay clear of: the stop ahead, or the end of its contact with a soft one, and standstill.
std::vector<Margin> Motion::rough_margins() const {
  std::vector<Margin> list;
  const Margin speed{heading_, Ball(0), Ball(0), still_for_, true};
  if (mode_ == Mode::free) {
    const Side ahead = heading_ > 0 ? Side::upper : Side::lower;
    if (scene_.stops[index_of(ahead)]) list.push_back({-heading_, scene_.stop(ahead).position, Ball(0), 0});
    list.push_back(speed);
    return list;
  }
  const Stop& stop = scene_.stop(side_);
  if (mode_ == Mode::contact) {
    list.push_back({sign_of(side_), stop.position, stop.q(), vanishing_});
    list.push_back(speed);
  } else {  // a mass that outruns the stop meets it before it stands still
    list.push_back({sign_of(side_), stop.position, Ball(0), 0});
    list.push_back({-sign_of(side_), stop.position, stop.q(), vanishing_});
  }
  return list;
}

}  // namespace verify
