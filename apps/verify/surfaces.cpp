#include "motion.hpp"

namespace verify {

// On the surface of an event its time is one of the coordinates of a set, in place of the number that the surface
// gives. They describe the state before the event; what it does to the velocities is a linear map.

Motion::State Motion::state_of(const Four& coordinates) const {
  State state{time_.value, coordinates};
  if (!surface_) return state;
  Four& y = state.y;
  state.time = coordinates[*surface_];
  y[*surface_] = *surface_ == 2 ? scene_.loose->wall(wall_) : Ball(0);
  if (*surface_ == 0) y[0] = q_.is_zero() ? place_.value : place_.value - q_.value * y[1];
  const Ball v = y[1], w = y[3];
  y[1] = main_.after(v);
  if (!scene_.loose) return state;
  y[1] = y[1] - scene_.loose->share() * loose_.change(w), y[3] = loose_.after(w) - main_.change(v);
  return state;
}

MachineFlight Motion::flight_from(const State& state) const {
  const Flow::Flight main(flow(), state.time, state.y[0], state.y[1]);
  if (!scene_.loose) return main;
  return pressed_ ? MachineFlight::pressed(main, state.y[2], scene_.loose->load)
                  : MachineFlight::flying(main, state.y[2], state.y[3], loose_load());
}

Four Motion::state_at(const Moment& moment) const {
  const auto& [main, loose, held_at] = moment;
  if (pressed_) return {{main.x, main.v, moment.held_at, Ball(0)}};
  return {{main.x, main.v, loose.x, loose.v}};
}
Four Motion::rates_at(const Moment& moment) const {
  const auto& [main, loose, held_at] = moment;
  if (pressed_) return {{main.v, main.a, Ball(0), Ball(0)}};
  return {{main.v, main.a, loose.v, loose.a}};
}

/// The derivative of the state in flight, at a fixed time, by the coordinates of the set.
FourByFour Motion::into_flight(const Moment& start) const {
  FourByFour by = FourByFour::identity();
  if (!surface_) return by;
  const Four before = set_.hull();
  by[1][1] = main_.slope(before[1]);
  if (scene_.loose) {
    const Ball turn = loose_.slope(before[3]);
    by[1][3] = scene_.loose->share() * (Ball(1) - turn), by[3][3] = turn, by[3][1] = Ball(1) - by[1][1];
  }
  if (*surface_ == 0 && !q_.is_zero()) by[0][1] = -q_.value;
  const Four rates = rates_at(start);
  for (std::size_t i = 0; i < 4; ++i) by[i][*surface_] = -rates[i];
  return by;
}

/// The derivative of the state after a time by the state (eq. 7): z = y - x, of which y moves with y' = x' + z'.
FourByFour Motion::over(const Ball& s) const {
  const Matrix p = flow().propagator(s);
  const Ball zero(0), one(1);
  FourByFour m = FourByFour::zero();
  m[0] = {{p.a, p.b, zero, zero}}, m[1] = {{p.c, p.d, zero, zero}};
  if (pressed_ && !on_wall_) m[2][2] = one;
  if (!scene_.loose || pressed_) return m;
  m[2] = {{one - p.a, s - p.b, one, s}}, m[3] = {{-p.c, one - p.d, zero, one}};
  return m;
}

Four Motion::by_parameter_after(const Ball& duration, const Ball& slope) const {
  Four by = Four::zero();
  if (family_ == nullptr) return by;
  const Four hull = set_.hull();
  const Dual time = surface_ ? Dual(hull[*surface_]) : time_, v(hull[1]);
  const Dual x = surface_ ? place_ - q_ * v : Dual(hull[0]);
  const BasicFlow<Dual>& flow = (*moving_flows_)[number_of_flow()];
  const auto there =
      BasicFlow<Dual>::Flight(flow, time, x, surface_ ? main_.after(v) : v).at({duration, slope - time.slope});
  by[0] = there.x.slope, by[1] = there.v.slope;
  return by;
}

void Motion::require_bounds() const {
  const Four hull = set_.hull();
  if (!hull.all(hull, [](const Ball& x, const Ball&) { return x.is_finite(); }))
    throw Undecided("a state whose bounds are lost");
}

/// An impact of one mass may end what the other one does, at the same instant.
void Motion::require_inside(const MachineFlight& all, const std::vector<Margin>& list) const {
  if (!scene_.loose) return;
  const Moment start = all.at(Ball(0));
  for (const Margin& margin : list)
    if (margin.vanishing == 0 && !margin.at(start).is_positive())
      throw Undecided("whether two events come at one instant");
}

void Motion::move_to_end(const MachineFlight& all, const Ball& end, const Ball& slope) {
  const State centre = state_of(set_.centre()), hull = state_of(set_.hull());
  const Four image = state_at(flight_from(centre).at(end - centre.time));
  set_.move(image, over(end - hull.time) * into_flight(all.at(Ball(0))), by_parameter_after(end - hull.time, slope));
  surface_.reset(), time_ = end, vanishing_ = still_for_ = loose_vanishing_ = loose_still_for_ = 0;
  require_bounds();
}

/// Moves the set to where a margin is 0: each state comes the later, the farther it is from there.
void Motion::move_to_surface(const MachineFlight& all, const Margin& margin, const Ball& instant) {
  const State centre = state_of(set_.centre());
  const MachineFlight middle = flight_from(centre);
  const Ball middle_instant = instant_of(middle, margin, instant);
  Four image = state_at(middle.at(middle_instant));
  const Moment there = all.at(instant);
  Four slope = Four::zero();  // of the margin, but for its sign
  const bool at_speed_zero = margin.of_velocity || (pressed_ && !on_wall_);
  const std::size_t surface = margin.which == Of::main ? (margin.of_velocity ? 1 : 0) : at_speed_zero ? 3 : 2;
  if (margin.which == Of::main || !pressed_)
    slope[surface] = Ball(1);
  else
    slope[0] = flow().stiffness(), slope[1] = Ball(2) * flow().damping();  // of -x''
  if (!margin.q.is_zero()) slope[1] = margin.q;
  const Ball rate = Ball(margin.sign) * margin.rate(there);
  const Four late = slope.each([&](const Ball& by) { return by.is_zero() ? by : -by / rate; });
  Four rates = rates_at(there);
  if (margin.of_velocity) rates[surface - 1] = Ball(0);
  FourByFour out = FourByFour::identity();
  for (std::size_t i = 0; i < 4; ++i)
    out[i] = i == surface ? late : out[i] + late.each([&](const Ball& by) { return rates[i] * by; });
  const FourByFour derivative = out * over(instant) * into_flight(all.at(Ball(0)));
  Four by_parameter = by_parameter_after(instant, Ball(0));
  Dual place(margin.place), q(margin.q);
  if (family_ != nullptr) {
    const BasicStop<Dual>& stop = family_->scene.stop(mode_ != Mode::free ? side_
                                                      : margin.sign < 0   ? Side::upper
                                                                          : Side::lower);
    place = stop.position;
    if (!margin.q.is_zero()) q = stop.q();
    const Ball later = (by_parameter[0] + q.value * by_parameter[1] + q.slope * there.main.v - place.slope) / rate;
    by_parameter[0] = -later, by_parameter[1] = by_parameter[1] - later * there.main.a;
  }
  image[surface] = centre.time + middle_instant;
  set_.move(image, derivative, by_parameter);
  surface_ = surface, place_ = place, q_ = q, main_ = loose_ = Rebound();
  vanishing_ = still_for_ = loose_vanishing_ = loose_still_for_ = 0;
  require_bounds();
}

/// The event that crossing a margin is, and the mode after it.
Event Motion::pass(std::size_t index, const Margin& margin) {
  const Side side = mode_ != Mode::free ? side_ : margin.sign < 0 ? Side::upper : Side::lower;
  if (margin.which == Of::loose)
    return pressed_ ? let_go(margin.sign) : strike(margin.sign < 0 ? Side::upper : Side::lower);
  const Four hull = set_.hull();
  Event event{Kind::end, side, hull[0], hull[1], Ball(0)};
  if (family_ != nullptr) {
    const FourByFour by = set_.derivative();
    event.slopes = {by[1][0], by[1][1], set_.by_parameter()[1]};
  }
  if (mode_ == Mode::free) {
    const Stop& stop = scene_.stop(side);
    if (stop.soft) {
      event.kind = Kind::touch;
      begin(Mode::contact, side, stop.h_s.is_zero() ? 1 : 0);
    } else {
      event.kind = Kind::impact;
      main_ = family_ != nullptr ? Rebound{-family_->scene.stop(side).R} : stop.rebound(event.v);
      if (scene_.loose) shake(event);
      rebound(side, event.time);
    }
  } else if (mode_ == Mode::contact) {
    event.kind = Kind::separation;
    begin(scene_.stop(side_).h_s.is_zero() ? Mode::free : Mode::beyond, side_, 1);
  } else {
    event.kind = index == 1 ? Kind::renewal : Kind::end;
    begin(index == 1 ? Mode::contact : Mode::free, side_, 1);
  }
  if (pressed_ && event.kind != Kind::end) press_on();
  return event;
}

}  // namespace verify
