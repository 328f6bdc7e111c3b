#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "motion/arc.hpp"
#include "motion/chatter.hpp"
#include "motion/event.hpp"
#include "scene/shaking.hpp"
#include "stepping/other_mass.hpp"

/// Stops that move by themselves. As one of them sees it, it stands, and the mass belongs to the same oscillator under
/// another sine (eq. 92): there its contacts are found, and its laws hold. Observers see all of it from the base.
namespace clatter::stepping {

/// An arc as the base sees it, which knows how the stop sees it.
template <class Number, Effects E>
class ArcOverBase : public motion::Arc<Number, E> {
  using Base = motion::Arc<Number, E>;

 public:
  using Base::Base;
  ArcOverBase(const motion::ArcConstants<Number, E>& constants, const motion::Motion<Number>& start, const Base* seen)
      : Base(constants, start), seen_(seen) {}

  /// Null of a mass that stays on the stop.
  [[nodiscard]] const Base* as_stop_sees() const { return seen_; }

 private:
  const Base* seen_ = nullptr;
};

/// The mass as a stop sees it that moves by itself, with no other stop; or as the base sees it, with none.
template <class N, Effects E>
class StopFrame {
 public:
  using Number = N;
  using Mass = MainMass<Number, E>;
  using State = motion::State<Number>;

  StopFrame(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, Side side,
            const motion::ChatterRule<Number>& rule)
      : StopFrame(scene, in_reach, side, side == Side::none ? BasicStopMotion<Number>{} : motion_of(in_reach, side)) {
    if (side == Side::none) return;
    BasicScene<Number> seen = scene;
    seen.oscillator.forcing = mass_.constants().f;
    using std::abs;
    const Number displacements = seen.oscillator.forcing != 0 ? Number(motion::displacements_beside(seen, side))
                                                              : Number(abs(motion_of(in_reach, side).amplitude));
    low_ = Number(rule.low[index_of(side)]) * displacements;
  }

  [[nodiscard]] const Mass& mass() const { return mass_; }
  [[nodiscard]] Side side() const { return side_; }
  [[nodiscard]] const Number& low() const { return low_; }  ///< rebounds of chatter that is summed aren't higher
  [[nodiscard]] motion::Stop<Number> stop() const { return motion::stop_at<Number>(mass_.stops(), side_); }

  /// The motion of the stop over the base: displacement, velocity, acceleration.
  struct Carried {
    Number x{}, v{}, a{};
  };
  /// At a phase, in turns since the section.
  [[nodiscard]] Carried at(const Number& phase_turns) const {
    State state;
    state.phase_turns = phase_turns;
    return by_phase(mass_.phase(state));
  }

  /// Calls `function(arc)` with an arc of this frame as the base sees it.
  template <Effects Of, class Function>
  void show_arc(const motion::Arc<Number, Of>& arc, Function&& function) const {
    const auto& c = arc.constants();
    const motion::Motion<Number>& m = arc.start();
    const auto [x, v, a] = by_phase({m.sine, m.cosine});
    const motion::Motion<Number> start{Number(0), m.x + x, m.v + v, m.a + a, m.sine, m.cosine};
    if constexpr (Of == Mass::Constants::effects)
      if (c.stop.side == Side::none) return show_by(free_, start, &arc, function);
    show_by(over_base(c), start, &arc, function);
  }
  /// The same with the motion of a mass that stays on the stop, from a phase on.
  template <class Function>
  void show_rest(const Number& phase_turns, Function&& function) const {
    State state;
    state.phase_turns = phase_turns;
    const Number place = stop().position, &nu = mass_.constants().nu;
    const auto [sine, cosine] = mass_.phase(state);
    const auto [x, v, a] = by_phase({sine, cosine});
    const motion::Motion<Number> start{Number(0), place + x, v, a, sine, cosine};
    using Constants = typename Mass::Constants;
    const motion::Arc<Number, Constants::effects>* const none = nullptr;
    // of an oscillator that turns with the stop, or, where the class of damping has none, of a free mass under a force
    if constexpr (E.damping == Damping::light)
      show_by(OverBase<Constants::effects>{Constants::of(Number(0), Number(0), nu, nu * nu * place, nu * nu),
                                           {Number(0), Number(1)}},
              start, none, function);
    else
      show_by(over_base(Constants::of(Number(0), Number(0), nu, Number(0), Number(0))), start, none, function);
  }

 private:
  StopFrame(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, Side side,
            const BasicStopMotion<Number>& motion)
      : StopFrame(scene, in_reach, side, motion,
                  with_force_in_frame(scene.oscillator,
                                      BasicShaking<Number>{.stops = motion.amplitude, .phase = motion.phase})) {}
  StopFrame(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach, Side side,
            const BasicStopMotion<Number>& motion, const LeadingOscillator<Number>& in_frame)
      : mass_(typename Mass::Constants(in_frame.oscillator), alone(in_reach, side), {},
              turns_of(Number(scene.start.phase + in_frame.lead))),
        side_(side),
        amplitude_(motion.amplitude),
        lead_(sine_cosine_of_turns(turns_of(Number(motion.phase - in_frame.lead)))),
        free_(over_base(mass_.constants())) {}

  [[nodiscard]] static BasicStops<Number> alone(BasicStops<Number> stops, Side side) {
    if (side != Side::lower) stops.lower = -std::numeric_limits<double>::infinity();
    if (side != Side::upper) stops.upper = std::numeric_limits<double>::infinity();
    return stops;
  }

  /// The motion of the stop, by the phase of the force of this frame.
  [[nodiscard]] Carried by_phase(const SineCosine<Number>& force) const {
    const Number sine = force.sine * lead_.cosine + force.cosine * lead_.sine,
                 cosine = force.cosine * lead_.cosine - force.sine * lead_.sine, &nu = mass_.constants().nu;
    return {amplitude_ * sine, amplitude_ * nu * cosine, -amplitude_ * nu * nu * sine};
  }
  /// An oscillator as the base sees it.
  template <Effects Of>
  struct OverBase {
    motion::ArcConstants<Number, Of> constants;
    SineCosine<Number> lead;  ///< of the force on it over that of this frame
  };
  /// That of this frame, or one of its soft stop, or a mass that no force of this frame moves.
  template <Effects Of>
  [[nodiscard]] OverBase<Of> over_base(const motion::ArcConstants<Number, Of>& c) const {
    using std::cos, std::sin;
    using Constants = motion::ArcConstants<Number, Of>;
    const Number &b = amplitude_, P = b * (c.k - c.nu * c.nu), Q = 2 * c.h * c.nu * b;
    const ForceOrder<Number> part = leading(P, Q, lead_);
    if (c.has_orders()) {
      const BasicOscillator<Number> on_base =
          with_part(BasicOscillator<Number>{c.h, c.f, c.nu, c.load, c.k, c.shape}, part);
      OverBase<Of> over{Constants::of(c.h, on_base.forcing, c.nu, c.load, c.k, on_base.shape), {Number(0), Number(1)}};
      over.constants.stop = c.stop;
      return over;
    }
    const LeadingForce<Number> force = leading_force(Number(c.f + part.in_phase), part.quadrature);
    OverBase<Of> over{Constants::of(c.h, force.amplitude, c.nu, c.load, c.k), {sin(force.lead), cos(force.lead)}};
    over.constants.stop = c.stop;
    return over;
  }
  /// Shows an arc of it, of which `start` has the phase of the force of this frame.
  template <Effects Of, class Function>
  static void show_by(const OverBase<Of>& over, motion::Motion<Number> start, const motion::Arc<Number, Of>* seen,
                      Function&& function) {
    const Number sine = start.sine, cosine = start.cosine;
    start.sine = sine * over.lead.cosine + cosine * over.lead.sine;
    start.cosine = cosine * over.lead.cosine - sine * over.lead.sine;
    function(ArcOverBase<Number, Of>(over.constants, start, seen));
  }

  Mass mass_;
  Side side_;
  Number amplitude_, low_{};
  SineCosine<Number> lead_;                  ///< of the stop over the force of this frame
  OverBase<Mass::Constants::effects> free_;  ///< the mass that no soft stop pushes
};

/// The frames of the stops of a scene, and that of the base.
template <class Number, Effects E>
class StopFrames {
 public:
  using State = motion::State<Number>;

  StopFrames(const BasicScene<Number>& scene, const BasicStops<Number>& in_reach,
             const motion::ChatterRule<Number>& rule)
      : base_(scene, in_reach, Side::none, rule),
        lower_(scene, in_reach, Side::lower, rule),
        upper_(scene, in_reach, Side::upper, rule) {}

  [[nodiscard]] const StopFrame<Number, E>& of(Side side) const {
    return side == Side::none ? base_ : side == Side::lower ? lower_ : upper_;
  }

  /// Takes a state, as the base sees it, to the frame of the stop that it has left last, or that it begins on or in.
  void enter(State& state) const {
    using std::abs;
    if (state.from_stop == Side::none) {
      for (const Side side : {Side::lower, Side::upper}) {
        const auto stop = of(side).stop();
        if (!is_finite(stop.position)) continue;
        const auto carried = of(side).at(state.phase_turns);
        const Number place = stop.position + carried.x, depth = stop.into(Number(state.x - place)),
                     rounding = 8 * epsilon<Number>() * (abs(stop.position) + abs(carried.x));
        if (!(depth >= -rounding)) continue;
        const bool is_in = depth > rounding && is_soft(of(side).mass().stops(), side);  // a rigid one isn't passed
        state.from_stop = side, state.offset = is_in ? Number(state.x - place) : Number(0);
        state.departure = state.v - carried.v;
        const Number slow = 8 * epsilon<Number>() * (abs(state.v) + abs(carried.v));
        if (abs(state.departure) <= slow) state.departure = 0;
        break;
      }
      if (state.from_stop == Side::none) return;
    }
    state.x = of(state.from_stop).stop().position + state.offset, state.v = state.departure;
  }
  /// And back.
  void leave(State& state) const {
    if (state.from_stop == Side::none) return;
    const auto carried = of(state.from_stop).at(state.phase_turns);
    state.departure = state.v;
    state.x += carried.x, state.v += carried.v;
  }
  /// A state as another stop sees it, in flight.
  [[nodiscard]] State seen_from(Side side, State state) const {
    const auto from = of(state.from_stop).at(state.phase_turns), to = of(side).at(state.phase_turns);
    state.x += from.x - to.x, state.v += from.v - to.v;
    state.from_stop = Side::none, state.offset = 0, state.released = false;
    return state;
  }

 private:
  StopFrame<Number, E> base_, lower_, upper_;
};

/// Shows an observer the arcs and events of a frame as the base sees them. A rest is shown by an arc, too, as the mass
/// moves with the stop.
template <class Frame, class Observer>
class SeenFromBase {
 public:
  using Number = typename Frame::Number;

  SeenFromBase(const Frame& frame, Observer& observer) : frame_(frame), observer_(observer) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (frame_.side() == Side::none) return observer_.arc(arc, begin, length);
    frame_.show_arc(arc, [&](const auto& seen) { observer_.arc(seen, begin, length); });
  }
  void event(motion::Event event) {
    const Number turns = event.lasts() ? Number(event.time) / frame_.mass().period() : Number(event.turns);
    const auto carried = frame_.at(turns);
    event.place += static_cast<double>(carried.x);
    event.stop = {static_cast<double>(carried.v), static_cast<double>(carried.a)};
    event.has_arc = event.lasts();
    observer_.event(event);
    if (event.length > 0)
      frame_.show_rest(turns, [&](const auto& seen) { observer_.arc(seen, event.time, event.length); });
  }

 private:
  const Frame& frame_;
  Observer& observer_;
};

/// The loop in the frame of a stop, which modes take in place of it.
template <class Loop, class Frame>
class InFrame : public WithOtherMass<Loop, typename Frame::Mass> {
  using Base = WithOtherMass<Loop, typename Frame::Mass>;

 public:
  using Number = typename Base::Number;
  using State = typename Base::State;

  InFrame(Loop& loop, const Frame& frame) : Base(loop, frame.mass()), frame_(frame) {}

  [[nodiscard]] const InFrame& method() const { return *this; }
  template <class Constants>
  [[nodiscard]] auto fly(const Constants& constants, const State&, const motion::Motion<Number>& start,
                         const Number& anchor, const Number& horizon) const {
    return this->loop_.method().fly_between(this->stops(), constants, start, anchor, horizon);
  }
  template <class Constants, class Margins>
  [[nodiscard]] auto fly_within(const Constants& constants, const State& state, const motion::Motion<Number>& start,
                                const Number& anchor, const Margins& margins, const Number& horizon) const {
    return this->loop_.method().fly_within(constants, state, start, anchor, margins, horizon);
  }
  [[nodiscard]] std::optional<Number> chatter_time(const State& state, const motion::Stop<Number>& stop) const {
    return this->loop_.chatter_time_of(this->mass_, frame_.low(), state, stop);
  }

 private:
  const Frame& frame_;
};

/// In place of frames if no stop moves by itself.
struct NoStopFrames {};

}  // namespace clatter::stepping
