#pragma once

#include <type_traits>

#include "motion/arc.hpp"
#include "motion/coupled_arc.hpp"
#include "motion/state.hpp"
#include "stepping/carrying.hpp"

namespace clatter::point {

/// A state in more digits, rounded to double.
template <class Number>
[[nodiscard]] motion::State<double> rounded(const motion::State<Number>& state) {
  return {.x = static_cast<double>(state.x),
          .v = static_cast<double>(state.v),
          .phase_turns = static_cast<double>(state.phase_turns),
          .periods = state.periods,
          .released = state.released,
          .from_stop = state.from_stop,
          .offset = static_cast<double>(state.offset),
          .departure = static_cast<double>(state.departure),
          .within = state.within,
          .pressed = state.pressed,
          .chatters = state.chatters,
          .loose = {state.loose.wall, static_cast<double>(state.loose.place), static_cast<double>(state.loose.speed),
                    state.loose.pressed, state.loose.released, state.loose.may_part, state.loose.within,
                    state.loose.pushed}};
}

/// A step beside a soft wall in more digits, rounded to double.
template <class Number>
[[nodiscard]] motion::CoupledArc<double> in_double(const motion::CoupledArc<Number>& arc) {
  const auto d = [](const Number& y) { return static_cast<double>(y); };
  const motion::Motion<Number>& m = arc.start();
  const auto& of = arc.constants();
  auto constants =
      motion::AnyConstants<double>::of(d(of.h), d(of.f), d(of.nu), d(of.load), d(of.k), with_numbers<double>(of.shape));
  constants.stop = {of.stop.side, d(of.stop.position), d(of.stop.stiffness), d(of.stop.damping)};
  constants.carried = d(of.carried), constants.friction = d(of.friction), constants.rubbing = d(of.rubbing);
  constants.origin = d(of.origin), constants.balance = d(of.balance), constants.equilibrium = d(of.equilibrium);
  constants.period = d(of.period);
  motion::Course<double> course{};
  for (std::size_t k = 0; k < course.way.size(); ++k)
    course.way[k] = d(arc.course().way[k]), course.velocity[k] = d(arc.course().velocity[k]);
  return {constants,
          {d(m.offset), d(m.x), d(m.v), d(m.a), d(m.sine), d(m.cosine)},
          d(arc.anchor()),
          d(arc.length()),
          course};
}

/// Shows the arcs of a run in more digits in double, each rounded at its start: an error of a few roundings, which
/// doesn't grow. E is the set of effects of the run.
template <Effects E>
class InDouble {
 public:
  explicit InDouble(const Scene& scene)
      : alone_(motion::ArcConstants<double, E.arc()>(scene.oscillator), scene.stops, scene.friction, 0.0),
        housing_(alone_, scene) {}

  /// Calls `function(arc)` with an arc in double.
  template <class Number, Effects Of, class Function>
  void show(const motion::Arc<Number, Of>& arc, Function&& function) const {
    if constexpr (E.loose) {
      if (arc.constants().carried != 0)
        return housing_.carrying.with_mass([&](const auto& mass) { show_of(mass, arc, function); });
      if (const Number& rubbing = arc.constants().rubbing; rubbing != 0)
        return show_of(housing_.slide(rubbing > 0 ? Side::upper : Side::lower).mass, arc, function);
    }
    show_of(alone_, arc, function);
  }

 private:
  template <class Mass, class Number, Effects Of, class Function>
  void show_of(const Mass& mass, const motion::Arc<Number, Of>& arc, Function& function) const {
    if constexpr (E.own_motion)
      if (move_by_themselves(mass.stops())) return show_seen(arc, function);
    if constexpr (E.soft)
      if (const Side side = arc.constants().stop.side; side != Side::none) {
        const auto stop = motion::soft_stop_at<double>(mass.stops(), side);
        return show_with(arc, motion::ArcConstants<double, Of>::in_contact(free(mass, arc), stop), function);
      }
    if constexpr (E.loose && Of == stepping::HeldConstants<double>::effects)
      if (const auto& c = arc.constants(); c.h == 0 && c.k == 0 && c.f == 0 && c.load == 0)
        return show_with(arc, housing_.held(c.carried != 0), function);
    if constexpr (Of == Mass::effects.arc()) show_with(arc, free(mass, arc), function);
  }
  /// Between stops that move by themselves an arc may be of a mass on a stop, or of one that a stop pushes, over the
  /// base.
  template <class Number, Effects Of, class Function>
  static void show_seen(const motion::Arc<Number, Of>& arc, Function& function) {
    const auto d = [](const Number& y) { return static_cast<double>(y); };
    const auto& c = arc.constants();
    auto constants = motion::ArcConstants<double, Of>::of(d(c.h), d(c.f), d(c.nu), d(c.load), d(c.k));
    constants.stop = {c.stop.side, d(c.stop.position), d(c.stop.stiffness), d(c.stop.damping)};
    show_with(arc, constants, function);
  }
  /// The constants of a free mass, in the direction of an arc's slip if friction acts on it.
  template <class Mass, class A>
  [[nodiscard]] static const auto& free(const Mass& mass, const A& arc) {
    if constexpr (E.friction)
      if (arc.constants().friction != 0)
        return mass.slips().towards(arc.constants().friction < 0 ? Side::upper : Side::lower);
    return mass.constants();
  }
  template <class Number, Effects Of, class Function>
  static void show_with(const motion::Arc<Number, Of>& arc, const motion::ArcConstants<double, Of>& constants,
                        Function& function) {
    const auto d = [](const Number& y) { return static_cast<double>(y); };
    const motion::Motion<Number>& start = arc.start();
    const motion::Motion<double> in_double{d(start.offset), d(start.x),    d(start.v),
                                           d(start.a),      d(start.sine), d(start.cosine)};
    function(motion::Arc<double, Of>(constants, in_double, d(arc.anchor())));
  }

  stepping::MainMass<double, E> alone_;
  [[no_unique_address]] std::conditional_t<E.loose, stepping::Housing<double, E>, stepping::NoHousing> housing_;
};

}  // namespace clatter::point
