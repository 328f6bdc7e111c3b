#pragma once

#include <cstdint>

#include "motion/contact_force.hpp"
#include "motion/event.hpp"
#include "motion/state.hpp"

namespace clatter::stepping {

/// A part of a run: its state, the phase up to which it goes, and the observer that is told of it.
template <class Integrator, class Observer>
class Stage {
 public:
  using Number = typename Integrator::Number;
  using State = motion::State<Number>;
  using Kind = motion::Event::Kind;

  /// Up to the phase `end`, in turns 0 ... 1 since the last section; times are told since the section `origin`.
  Stage(const Integrator& integrator, State& state_, const Number& end_, std::int64_t origin, Observer& observer)
      : state(state_), end(end_), integrator_(integrator), origin_(origin), observer_(observer) {}

  State& state;
  const Number& end;
  bool keeps_pressed = false;  ///< a loose mass stays on the wall that it is on

  /// The same up to another phase.
  [[nodiscard]] Stage up_to(const Number& other) const { return {integrator_, state, other, origin_, observer_}; }

  [[nodiscard]] std::int64_t origin() const { return origin_; }
  [[nodiscard]] double time() const { return integrator_.time(state, origin_); }
  [[nodiscard]] Number time_left() const { return (end - state.phase_turns) * integrator_.period(); }
  void pass(const Number& elapsed) const { state.phase_turns += elapsed / integrator_.period(); }

  template <class A>
  void show(const A& arc, const Number& length) const {
    observer_.arc(arc, time(), static_cast<double>(length));
  }
  void show(const motion::Event& event) const { observer_.event(event); }
  void show_impact(const motion::Stop<Number>& stop, const Number& before) const {
    show({Kind::impact, stop.side, time(), static_cast<double>(before), 0.0, static_cast<double>(state.v),
          static_cast<double>(stop.position), static_cast<double>(state.phase_turns)});
  }
  /// A contact with a soft stop begins or ends.
  void show_contact(Kind kind, Side side) const {
    const double v = static_cast<double>(state.v);
    const auto& stops = integrator_.stops();
    show({kind, side, time(), v, 0.0, v, static_cast<double>(side == Side::upper ? stops.upper : stops.lower),
          static_cast<double>(state.phase_turns)});
  }
  /// A mass stays where it is: on a stop, or by friction alone. With a loose mass an arc tells so, too.
  void show_rest(Side side, const Number& turns, bool held, double carried = 0.0, double rubbing = 0.0) const {
    const Kind kind = side == Side::none ? Kind::stick : held ? Kind::rest : Kind::chatter;
    show({kind, side, time(), 0.0, static_cast<double>(turns * integrator_.period()), 0.0, static_cast<double>(state.x),
          0.0, held, Integrator::effects.loose, carried, rubbing});
  }
  /// Of a slip, with the accelerations on both sides.
  void show_reversal(const Number& before, const Number& after) const {
    show({.kind = Kind::reversal,
          .time = time(),
          .place = static_cast<double>(state.x),
          .a_before = static_cast<double>(before),
          .a_after = static_cast<double>(after)});
  }
  /// A chatter's summed end, or a part of that, from its beginning on.
  void show_chatter(const State& begin, const motion::Stop<Number>& stop, const Number& turns,
                    const Number& v_end) const {
    show({Kind::chatter, stop.side, integrator_.time(begin, origin_), static_cast<double>(begin.v),
          static_cast<double>(turns * integrator_.period()), static_cast<double>(v_end),
          static_cast<double>(stop.position), 0.0, false});
  }

 private:
  const Integrator& integrator_;
  std::int64_t origin_;
  Observer& observer_;
};

}  // namespace clatter::stepping
