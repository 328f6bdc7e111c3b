#pragma once

#include <array>
#include <cstdint>

#include "stepping/flights.hpp"

namespace clatter::stepping {

/// The phases of a mass beyond the position of a soft stop, in contact with it or not, and the ways there and back.
template <class Method, class N, Effects E>
class SoftPhases : public Flights<Method, N, E> {
  using Base = Flights<Method, N, E>;

 public:
  using Number = N;

  SoftPhases(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, const Limits& limits)
      : Base(scene, in_reach, limits), soft_stops_(has_soft_stop(scene.stops)) {}

 protected:
  using typename Base::Kind;

  [[nodiscard]] bool has_soft_stops() const { return soft_stops_; }

  /// The soft stop beyond whose position the mass is.
  [[nodiscard]] Side soft_stop_around(motion::State<Number>& state) const {
    if (state.within != Side::none) return state.within;
    const auto [side, offset, pressed] = motion::soft_stop_around(this->stops(), state.x, state.v);
    if (side != Side::none) state.within = state.from_stop = side, state.offset = offset, state.pressed = pressed;
    return side;
  }

  /// Keeps a flight that is cut just where it comes to a soft stop between the stops: rounding may put it beyond, and
  /// the touch would be passed.
  void keep_before_touch(motion::State<Number>& state) const {
    if (!soft_stops_ || state.within != Side::none) return;
    const BasicStops<Number>& stops = this->stops();
    if (is_soft(stops, Side::lower) && state.x < stops.lower) state.x = stops.lower;
    if (is_soft(stops, Side::upper) && state.x > stops.upper) state.x = stops.upper;
  }

  /// Begins a contact with a soft stop at its position. A mass that only touches, without speed, flies on.
  template <class Observer>
  [[nodiscard]] Outcome touch(motion::State<Number>& state, Side side, std::int64_t origin, Observer& observer) {
    state.from_stop = side, state.offset = 0;
    if (state.v == 0) return Outcome::completed;
    state.within = side, state.pressed = true;
    this->show_contact(Kind::touch, state, side, origin, observer);
    return this->count_impact() ? Outcome::completed : Outcome::event_budget;
  }
  /// Presses a mass without speed into the soft stop that it is on, if the force does so.
  [[nodiscard]] bool begin_pressed(motion::State<Number>& state, const motion::Crossing<Number>& contact) const {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), contact.side);
    if (!(stop.into(contact.motion.a) > 0)) return false;
    state.x = stop.position, state.offset = 0, state.from_stop = state.within = contact.side, state.pressed = true;
    return true;
  }

  /// In contact with a soft stop until its force falls to 0 (eqs. 50 and 51).
  template <class Observer>
  [[nodiscard]] Outcome run_in_contact(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                       Observer& observer) {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), state.within);
    const motion::Margin<Number> force{Number(0), stop.into(Number(1)), stop.into(stop.relaxation())};
    return this->in_contact(state.within, [&](const auto& constants) {
      const Number offset = state.offset, v = state.v;
      const auto crossing = this->cross(constants, state, std::array{force}, end, origin, observer);
      if (crossing.resolved && crossing.margin == 0) {
        if (constants.h == 0 && constants.f == 0) state.v = stop.into(-constants.speed_at_stop(offset, v));
        separate(state, stop, origin, observer);
      }
      return this->outcome_at(crossing);
    });
  }
  /// Free beyond a soft stop's position until the mass comes back to that, or the stop, which relaxes at once, pushes
  /// again.
  template <class Observer>
  [[nodiscard]] Outcome run_beyond(motion::State<Number>& state, const Number& end, std::int64_t origin,
                                   Observer& observer) {
    const auto stop = motion::soft_stop_at<Number>(this->stops(), state.within);
    const Number one = stop.into(Number(1));
    const motion::Margin<Number> depth{Number(0), one, Number(0)}, pull{Number(0), -one, -stop.into(stop.relaxation())};
    const auto crossing = this->cross(free_constants(state), state, std::array{depth, pull}, end, origin, observer);
    if (crossing.resolved && crossing.margin == 0) leave(state, stop);
    if (crossing.resolved && crossing.margin == 1) {
      state.pressed = true;
      this->show_contact(Kind::renewal, state, stop.side, origin, observer);
      if (!this->count_impact()) return Outcome::event_budget;
    }
    return this->outcome_at(crossing);
  }
  /// The constants of a mass that moves freely: with friction those of its slip.
  [[nodiscard]] const auto& free_constants(const motion::State<Number>& state) const {
    if constexpr (E.friction)
      if (this->is_rough()) return this->slips().towards(this->heading(state));
    return this->constants();
  }
  /// Ends a contact. Without a damper the stop's force falls to 0 at its position.
  template <class Observer>
  void separate(motion::State<Number>& state, const motion::SoftStop<Number>& stop, std::int64_t origin,
                Observer& observer) const {
    state.pressed = false;
    this->show_contact(Kind::separation, state, stop.side, origin, observer);
    if (stop.damping == 0 || !(stop.into(state.offset) > 0)) leave(state, stop);
  }
  /// Leaves the region beyond a soft stop's position.
  static void leave(motion::State<Number>& state, const motion::SoftStop<Number>& stop) {
    state.x = stop.position, state.offset = 0, state.within = Side::none, state.pressed = false;
  }

 private:
  bool soft_stops_;  ///< asked at each arc: general methods have one set of effects for soft and rigid stops
};

}  // namespace clatter::stepping
