#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "motion/polynomial_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "stepping/coupled_steps.hpp"
#include "stepping/dense_events.hpp"
#include "stepping/event_driven.hpp"
#include "stepping/integration.hpp"

namespace clatter::stepping {

/// The usual choice among general solvers: the pair of orders 5 and 4 (Dormand & Prince 1980) of Boost.Odeint, with
/// step size control and dense output, and contacts found on the dense output.
///
/// Over a step the dense output of the displacement is a polynomial of degree 5, so its first contact is found for
/// certain: the Bernstein form shows two crossings of a stop within one step as well as one. A step that touches a stop
/// without crossing it counts as free of contact. A contact that the polynomial misses by its own error is lost.
/// Chatter, rest and release follow the exact integrator's rules; displacement is carried as the distance from the last
/// stop, so that the shortest flights keep their digits.
///
/// The flight of a loose mass is its parabola less the dense output of the main mass, which counts from the beginning
/// of the flight, so that the shortest keep their digits. On that its impacts are found, on that of z' where friction
/// stops it, and on the polynomial of x'' the end of a time for which a wall presses it, or friction holds it.
///
/// Each flight and each forcing period begins with a step whose size depends on the state alone: a period is a function
/// of the state at its beginning, so a motion can repeat.
template <Effects E>
class DormandPrince : public EventDriven<DormandPrince<E>, DenseArcs, double, E> {
  using Base = EventDriven<DormandPrince<E>, DenseArcs, double, E>;

 public:
  static constexpr bool in_closed_form = false;
  using DenseArc = motion::PolynomialArc<E.arc()>;

  explicit DormandPrince(const Scene& scene, const Integration& integration = {}, const Limits& limits = {})
      : Base(scene, scene.stops, limits, {{low_rebound(integration), low_rebound(integration)}}),
        tolerance_(integration.tolerance),
        size_(size_of(scene)),
        stepper_(boost::numeric::odeint::make_dense_output(tolerance_ * size_, tolerance_, Pair())) {}

  /// The next step's arc and its first contact; without a contact it ends with the step, or at the horizon.
  template <Effects Of>
  [[nodiscard]] ArcToEvent<motion::PolynomialArc<Of>> fly(const motion::ArcConstants<double, Of>& constants,
                                                          const motion::State<double>& state,
                                                          const motion::Motion<double>& start, double anchor,
                                                          double horizon) {
    go_on(constants, state, start, anchor);
    ArcToEvent<motion::PolynomialArc<Of>> flight{standing(constants, state), {0, Side::none, 0.0, start}};
    if (const Side side = entered(this->stops(), anchor_, here_[0], here_[1]); side != Side::none) {
      flight.crossing.side = side;
      flight.crossing.motion.x =
          motion::stop_at<double>(this->stops(), side).position;  // the step ended there, to rounding
      return flight;
    }
    if (!take_step(flight, constants, state, start.a)) return flight;
    motion::Crossing<double>& contact = flight.crossing = first_contact(flight.arc, this->stops(), horizon);
    conclude(contact, contact.side != Side::none, state, horizon);
    return flight;
  }

  /// The same beyond the position of a soft stop, with the first of some margins that falls to 0.
  template <Effects Within, std::size_t count>
  [[nodiscard]] ArcToEvent<motion::PolynomialArc<Within>> fly_within(
      const motion::ArcConstants<double, Within>& constants, const motion::State<double>& state,
      const motion::Motion<double>& start, double anchor, std::array<motion::Margin<double>, count> margins,
      double horizon) {
    go_on(constants, state, start, anchor);
    ArcToEvent<motion::PolynomialArc<Within>> flight{standing(constants, state), {count, Side::none, 0.0, start}};
    for (std::size_t i = 0; i < count; ++i) {
      if (!falls_at_once(constants, margins[i], start)) continue;
      flight.crossing.margin = i;
      return flight;
    }
    if (!take_step(flight, constants, state, start.a)) return flight;
    const double moved = anchor_ - anchor;  // since the first step of the flight
    for (motion::Margin<double>& margin : margins) margin.constant += margin.place * moved;
    motion::Crossing<double>& crossing = flight.crossing = first_crossing(flight.arc, margins, horizon);
    crossing.motion.offset += moved;
    conclude(crossing, crossing.margin < count, state, horizon);
    return flight;
  }

  /// The motion of a loose mass beside a step of the main one.
  template <Effects Of>
  [[nodiscard]] static motion::PolynomialInHousing<Of> beside(const motion::PolynomialArc<Of>& main,
                                                              const motion::RelativeStart<double>& start, double load) {
    return motion::PolynomialInHousing<Of>::beside(main, start, load);
  }
  template <Effects Of>
  [[nodiscard]] motion::Crossing<double> meet_wall(const motion::PolynomialInHousing<Of>& beside, const Stops& walls,
                                                   double horizon) const {
    const motion::Motion<double> start = beside.start();
    motion::Crossing<double> contact{0, entered(walls, beside.anchor(), start.offset, start.v), 0.0, start};
    for (const Side side : {Side::lower, Side::upper})
      if (lies_on(walls, beside.anchor() + start.offset, side) && start.v == 0 && start.a == 0 &&
          sign_of(side) * beside.constants().jerk(beside.main().start()) < 0)
        contact.side = side;  // it lies on a wall that begins to press it
    if (contact.side == Side::none) contact = first_contact(beside, walls, horizon);
    contact.resolved = this->finite(contact.motion.x);
    return contact;
  }
  template <Effects Of>
  [[nodiscard]] motion::Crossing<double> come_to_stop(const motion::PolynomialInHousing<Of>& beside, Side towards,
                                                      double horizon) {
    const motion::Motion<double> start = beside.start();
    const double sign = sign_of(towards),
                 rate = start.a != 0 ? start.a : -beside.constants().jerk(beside.main().start());
    const bool at_once = sign * start.v <= 0 && sign * rate < 0;
    const motion::Crossing<double> end =
        at_once ? motion::Crossing<double>{0, Side::none, 0.0, start} : end_of_slide(beside, towards, horizon);
    if (end.margin == 0) reached_ = nowhere;  // friction turns, so that the next step is the first of a flight
    return end;
  }
  template <Effects Of>
  [[nodiscard]] static motion::Crossing<double> let_go(const motion::PolynomialArc<Of>& main,
                                                       const Pressing<double>& pressing, double horizon) {
    const motion::Motion<double> start = main.start();
    const double sign = sign_of(pressing.wall);
    if (sign * (pressing.load - start.a) <= 0 && sign * main.constants().jerk(start) > 0)
      return {0, Side::none, 0.0, start};
    return end_of_press(main, pressing, horizon);
  }
  /// A step of both masses beside a soft wall.
  template <Effects Of>
  [[nodiscard]] motion::CoupledInHousing<double> couple(const motion::ArcConstants<double, Of>& constants,
                                                        const motion::Coupling<double>& coupling,
                                                        const motion::Motion<double>& start, double anchor,
                                                        const motion::RelativeStart<double>& from, double load,
                                                        double horizon) {
    reached_ = nowhere;
    const CoupledSteps steps(tolerance_, size_);
    return steps.step(constants, coupling, start, anchor, from, load, horizon,
                      [this](double count) { this->count_evaluations(count); });
  }
  [[nodiscard]] motion::PolynomialArc<HeldConstants<double>::effects> held_arc(const HeldConstants<double>& constants,
                                                                               const motion::State<double>& state,
                                                                               const motion::Motion<double>& start,
                                                                               double anchor, double length) const {
    return {constants, anchor, this->start_turns() + state.phase_turns, length, constant(start.offset), constant(0.0)};
  }

 private:
  using Values = std::array<double, 2>;  ///< distance from the anchor, velocity
  using Place = std::array<double, 3>;   ///< x, v, turns
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr Place nowhere{nan, nan, nan};  // equal to no Place
  using Pair = boost::numeric::odeint::runge_kutta_dopri5<Values>;
  using Stepper = typename boost::numeric::odeint::result_of::make_dense_output<Pair>::type;

  /// Whether a margin is used up and falls: by the motion's rate, or that of a mass which friction lets go.
  template <Effects Of>
  [[nodiscard]] static bool falls_at_once(const motion::ArcConstants<double, Of>& constants,
                                          const motion::Margin<double>& margin, const motion::Motion<double>& start) {
    if (!(margin.of(start) <= 0)) return false;
    const double slope = margin.slope(start), rate = constants.f * constants.nu * constants.drive(start).cosine;
    return slope < 0 || (slope == 0 && start.v == 0 && margin.place * (start.a != 0 ? start.a : rate) < 0);
  }

  /// Rebounds within the tolerance can't be told from rest.
  [[nodiscard]] static double low_rebound(const Integration& integration) {
    return std::max(integration.tolerance, motion::low_rebound<double>(0.0));
  }

  /// The scale of the absolute tolerance: half the distance between the stops, or the size of motion that start and
  /// forces suggest, if that is less.
  [[nodiscard]] static double size_of(const Scene& scene) {
    const Oscillator& o = scene.oscillator;
    const double response = std::abs(o.forcing) / std::max(1.0, o.frequency * o.frequency);
    const double moves =
        std::max({response, std::abs(o.load), std::abs(scene.start.displacement), std::abs(scene.start.velocity)});
    const double size = std::min((scene.stops.upper - scene.stops.lower) / 2, moves);
    if constexpr (E.loose) {
      const LooseMass& loose = scene.loose;
      const double both = std::max({size, std::abs(loose.load), std::abs(loose.velocity)});
      const double in_housing = std::min((loose.upper - loose.lower) / 2, both);
      return in_housing > 0 ? in_housing : 1.0;
    }
    return size > 0 ? size : 1.0;
  }

  /// Begins the steps of a flight, unless the state is the one that the last step reached.
  template <Effects Of>
  void go_on(const motion::ArcConstants<double, Of>& constants, const motion::State<double>& state,
             const motion::Motion<double>& start, double anchor) {
    const bool begins_piece = constants.is_in_pieces() && state.phase_turns >= next_knot_;
    const bool goes_on = Place{state.x, state.v, state.phase_turns} == reached_ && !begins_piece;
    reached_ = nowhere;
    if (goes_on) return;
    anchor_ = anchor, angle_ = 2 * pi<double>() * (this->start_turns() + state.phase_turns);
    phase_ = {start.sine, start.cosine}, next_knot_ = this->next_knot(state.phase_turns);
    double first_step = std::pow(tolerance_, 0.2) / constants.rate / 2;
    const bool is_on_stop = state.from_stop != Side::none && start.offset == 0;
    const double sign = is_on_stop ? sign_of(state.from_stop) : 0, leaving = -sign * start.v, pressed = sign * start.a;
    if (leaving > 0 && pressed > 0)  // no longer than the flight, if the force ends it soon
      first_step = std::min(first_step, 2 * leaving / pressed);
    here_ = {start.offset, start.v};
    stepper_.initialize(here_, 0.0, first_step);
  }

  template <Effects Of>
  [[nodiscard]] double acceleration(const motion::ArcConstants<double, Of>& constants, const Values& y, double s) {
    this->count_evaluations(1);
    const double drive = constants.f == 0            ? 0.0
                         : constants.shape.is_sine() ? std::sin(angle_ + constants.nu * s)
                                                     : constants.drive(constants.phase_after(phase_, s)).sine;
    const double y_balanced = constants.from_equilibrium(anchor_ + y[0], anchor_, y[0]);
    return constants.equation().acceleration(y_balanced, y[1], drive);
  }

  [[nodiscard]] static Bernstein<double> constant(double value) {
    Bernstein<double> c;
    c.fill(value);
    return c;
  }
  template <Effects Of>
  [[nodiscard]] motion::PolynomialArc<Of> standing(const motion::ArcConstants<double, Of>& constants,
                                                   const motion::State<double>& state) const {
    const double turns = this->start_turns() + state.phase_turns;
    return {constants, anchor_, turns, 0.0, constant(here_[0]), constant(here_[1])};
  }

  /// A step and its dense output.
  struct Dense {
    double length = 0.0;  ///< in tau
    double a_end = 0.0;   ///< acceleration at its end
    Values begin{}, end{}, third{}, two_thirds{};

    /// One of the values over the step, by its rates at both ends, too.
    [[nodiscard]] Bernstein<double> over(std::size_t i, double rate, double rate_end) const {
      return quintic(length, {begin[i], rate}, {end[i], rate_end}, {third[i], two_thirds[i]});
    }
  };
  /// Makes a step from here.
  template <Effects Of>
  [[nodiscard]] Dense dense_step(const motion::ArcConstants<double, Of>& constants) {
    const auto equation = [&](const Values& y, Values& rate, double s) {
      rate = {y[1], acceleration(constants, y, s)};
    };
    const auto [from, to] = stepper_.do_step(equation);
    Dense dense{.length = to - from, .begin = std::exchange(here_, stepper_.current_state())};
    stepper_.calc_state(from + dense.length / 3, dense.third);
    stepper_.calc_state(from + 2 * dense.length / 3, dense.two_thirds);
    dense.end = here_, dense.a_end = acceleration(constants, here_, to);
    return dense;
  }
  /// The arc of a step, with acceleration a at its beginning.
  template <Effects Of>
  [[nodiscard]] motion::PolynomialArc<Of> arc_of(const motion::ArcConstants<double, Of>& constants,
                                                 const motion::State<double>& state, const Dense& dense,
                                                 double a) const {
    const double turns = this->start_turns() + state.phase_turns;
    return {constants,
            anchor_,
            turns,
            dense.length,
            dense.over(0, dense.begin[1], dense.end[1]),
            dense.over(1, a, dense.a_end)};
  }
  /// Makes the next step of a flight, with acceleration a at its beginning; false if no step is short enough.
  template <Effects Of>
  [[nodiscard]] bool take_step(ArcToEvent<motion::PolynomialArc<Of>>& flight,
                               const motion::ArcConstants<double, Of>& constants, const motion::State<double>& state,
                               double a) {
    try {
      flight.arc = arc_of(constants, state, dense_step(constants), a);
    } catch (const boost::numeric::odeint::odeint_error&) {
      flight.crossing.resolved = false;
    }
    return flight.crossing.resolved;
  }
  /// Ends a flight at an event, which it may begin with, or goes on where the step ends.
  void conclude(motion::Crossing<double>& crossing, bool is_event, const motion::State<double>& state, double horizon) {
    const double turns = state.phase_turns + crossing.elapsed / this->period();
    crossing.resolved = this->finite(crossing.motion.x) && (is_event || turns > state.phase_turns);
    if (!is_event && crossing.elapsed < horizon) reached_ = {crossing.motion.x, crossing.motion.v, turns};
  }

  double tolerance_, size_;  ///< relative, and the length that the absolute one counts by
  Stepper stepper_;
  double anchor_ = 0.0, angle_ = 0.0;  ///< of the present flight: its anchor, and the forcing phase at its beginning
  SineCosine<double> phase_{};         ///< the same of a force in pieces,
  double next_knot_ = 0.0;             ///< and the end of its piece, in turns since the section
  Values here_{};                      ///< the beginning of its next step
  Place reached_ = nowhere;            ///< the state from which the flight continues
};

}  // namespace clatter::stepping
