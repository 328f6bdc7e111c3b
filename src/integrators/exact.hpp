#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "dynamics/arc.hpp"
#include "dynamics/contact.hpp"
#include "dynamics/impact.hpp"
#include "dynamics/scene.hpp"

namespace clatter {

/// What stopped an integrator before its time.
enum class Outcome : std::uint8_t { completed, event_budget, not_finite, unresolved };

/// Sees nothing; what integrators call where nothing is observed.
struct NoObserver {
  template <class A>
  void arc(const A&, double, double) {}
  void rest(const Rest&) {}
  void impact(const Impact&) {}
};

/// Event-driven integration: closed-form arcs, proved first contacts, chatter completed, rests released at their exact
/// time. Of these what the effects E have.
template <class Number, Effects E>
class Exact {
 public:
  explicit Exact(const Scene& scene) : Exact(scene, scene.stops) {}

  /// Looks for contacts with the given stops only, the others being out of reach.
  Exact(const Scene& scene, const Stops& in_reach)
      : flow_(scene.oscillator),
        stops_(in_reach),
        budget_(scene.time.max_impacts),
        start_turns_(turns_of(scene.start.phase)) {}

  [[nodiscard]] const Flow<Number, E.arc()>& flow() const { return flow_; }
  [[nodiscard]] const Stops& stops() const { return stops_; }          ///< that contacts are looked for with
  [[nodiscard]] const Number& period() const { return flow_.period; }  ///< forcing period in tau; without forcing 2 pi
  [[nodiscard]] double impacts() const { return impacts_; }            ///< impacts simulated so far
  [[nodiscard]] double evaluations() const { return evaluations_; }

  /// Runs from `state` to the phase `end`, in turns 0 ... 1 since the last section, and shows observers every arc, rest
  /// and impact with its time since the section `origin`.
  template <class Observer>
  [[nodiscard]] Outcome advance(State<Number>& state, const Number& end, std::int64_t origin, Observer& observer) {
    while (end - state.turns > 2 * epsilon<Number>()) {  // fly, find the contact, rebound: the whole algorithm
      if (const auto stop = holding_stop(state)) {
        rest(state, *stop, end, origin, observer);
        continue;
      }
      const Arc<Number, E.arc()> arc{flow_, motion(state), anchor(state)};
      const Contact<Number> contact = end_of(arc, Number((end - state.turns) * flow_.period));
      evaluations_ += contact.evaluations;
      if (!contact.resolved)
        return std::isfinite(static_cast<double>(contact.motion.x)) ? Outcome::unresolved : Outcome::not_finite;
      if (contact.side != Side::none && contact.elapsed == 0 && state.v == 0) {
        hover(state, stop_at<Number>(stops_, contact.side), end, origin, observer);
        continue;
      }
      observer.arc(arc, time(state, origin), static_cast<double>(contact.elapsed));
      pass(state, contact.elapsed);
      state.x = contact.motion.x, state.v = contact.motion.v, state.rise = contact.motion.rise, state.released = false;
      if (contact.side == Side::none) break;
      rebound(state, stop_at<Number>(stops_, contact.side), end, origin, observer);
      if (++impacts_ > budget_) return Outcome::event_budget;
    }
    state.turns = end;
    return std::isfinite(static_cast<double>(state.x)) && std::isfinite(static_cast<double>(state.v))
               ? Outcome::completed
               : Outcome::not_finite;
  }

  /// The stop that holds a mass at rest, if one does.
  [[nodiscard]] std::optional<Stop<Number>> holding_stop(const State<Number>& state) const {
    if (!E.rest || state.v != 0 || state.released) return std::nullopt;
    for (const Side side : {Side::lower, Side::upper}) {
      const auto stop = stop_at<Number>(stops_, side);
      if (state.x == stop.place && holds(flow_, stop, phase(state))) return stop;
    }
    return std::nullopt;
  }

  /// Of the force.
  [[nodiscard]] SineCosine<Number> phase(const State<Number>& state) const {
    return sine_cosine_of_turns(Number(start_turns_ + state.turns));
  }

  /// Time since the section `origin`.
  [[nodiscard]] double time(const State<Number>& state, std::int64_t origin) const {
    return static_cast<double>((static_cast<double>(state.periods - origin) + state.turns) * flow_.period);
  }

 private:
  [[nodiscard]] static Number turns_of(double phase) {
    using std::atan2, std::cos, std::sin;
    const Number angle(phase);
    return atan2(Number(sin(angle)), Number(cos(angle))) / (2 * pi<Number>());
  }
  [[nodiscard]] Motion<Number> motion(const State<Number>& state) const {
    const auto [sine, cosine] = phase(state);
    const Number rise = state.left == Side::none ? Number(0) : state.rise;
    const Number offset = flow_.offset(state.x, anchor(state), rise);
    const Number a = state.released ? Number(0) : flow_.acceleration(offset, state.v, sine);
    return {rise, state.x, state.v, a, sine, cosine};
  }
  /// The place that the rise of the present flight counts from.
  [[nodiscard]] Number anchor(const State<Number>& state) const {
    return state.left == Side::none ? state.x : stop_at<Number>(stops_, state.left).place;
  }
  /// The first contact of an arc, or its end at the horizon.
  [[nodiscard]] Contact<Number> end_of(const Arc<Number, E.arc()>& arc, const Number& horizon) const {
    if constexpr (E.stops()) return next_contact(arc, stops_, horizon);
    const Motion<Number> there = arc.at(horizon);
    return {Side::none, horizon, there, 1, std::isfinite(static_cast<double>(there.x))};
  }
  void pass(State<Number>& state, const Number& elapsed) const { state.turns += elapsed / flow_.period; }

  /// Reverses the velocity and completes the chatter that may follow.
  template <class Observer>
  void rebound(State<Number>& state, const Stop<Number>& stop, const Number& end, std::int64_t origin,
               Observer& observer) {
    const Number before = state.v;
    state.left = stop.side, state.rise = 0;
    if (stop.into(before) > 0) state.v = -stop.restitution * before;
    if (state.v == 0) state.v = 0;  // no negative zero
    observer.impact(Impact{time(state, origin), stop.side, static_cast<double>(before), static_cast<double>(state.v),
                           static_cast<double>(stop.place)});
    if (!E.rest || state.v == 0) return;
    const auto left = chatter_time(flow_, stop, pressing(flow_, stop, phase(state)), Number(-stop.into(state.v)));
    if (!left || state.turns + *left / flow_.period > end) return;  // a run that ends in a chatter ends in a flight
    show_rest(state, stop, Number(*left / flow_.period), false, origin, observer);
    pass(state, *left);
    state.v = 0;
  }

  /// Holds the mass until its release or until `end`, whichever is first.
  template <class Observer>
  void rest(State<Number>& state, const Stop<Number>& stop, const Number& end, std::int64_t origin,
            Observer& observer) {
    using std::floor;
    Number until = end;
    state.left = stop.side, state.rise = 0;
    if (const auto phase_of_release = release_phase(flow_, stop)) {
      Number release = *phase_of_release - start_turns_;  // the same number after every rest
      release -= floor(release);
      if (release == 1) release = 0;  // rounded up
      const Number ahead = release - state.turns + (release < state.turns ? 1 : 0);
      if (ahead > 1 - 16 * epsilon<Number>())
        release = state.turns;  // it passed within rounding of now, not a whole turn ahead
      if (release >= state.turns && release <= end) until = release, state.released = true;
    }
    show_rest(state, stop, Number(until - state.turns), true, origin, observer);
    state.turns = until;
  }

  /// Lets time move on where a mass at rest on a stop is neither held nor leaves: the force on it is within rounding of
  /// 0, out of which it grows in the square root of rounding, while the mass moves by far less than rounding.
  template <class Observer>
  void hover(State<Number>& state, const Stop<Number>& stop, const Number& end, std::int64_t origin,
             Observer& observer) {
    using std::min, std::sqrt;
    const Number turns = min(Number(end - state.turns), Number(sqrt(epsilon<Number>())));
    show_rest(state, stop, turns, false, origin, observer);
    state.turns += turns, state.released = false;
  }

  template <class Observer>
  void show_rest(const State<Number>& state, const Stop<Number>& stop, const Number& turns, bool held,
                 std::int64_t origin, Observer& observer) const {
    observer.rest(Rest{time(state, origin), static_cast<double>(turns * flow_.period), stop.side,
                       static_cast<double>(stop.place), held});
  }

  Flow<Number, E.arc()> flow_;
  Stops stops_;
  double budget_;
  Number start_turns_;
  double impacts_ = 0.0;
  double evaluations_ = 0.0;
};

}  // namespace clatter
