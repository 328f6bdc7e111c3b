#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "motion/polynomial_arc.hpp"
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
/// Each flight and each forcing period begins with a step whose size depends on the state alone: a period is a function
/// of the state at its beginning, so a motion can repeat.
template <Effects E>
class DormandPrince : public EventDriven<DormandPrince<E>, double, E> {
  using Base = EventDriven<DormandPrince<E>, double, E>;

 public:
  static constexpr bool in_closed_form = false;
  using DenseArc = motion::PolynomialArc<E.arc()>;

  explicit DormandPrince(const Scene& scene, const Integration& integration = {}, const Limits& limits = {})
      : Base(scene, scene.stops, limits, {{low_rebound(integration), low_rebound(integration)}}),
        tolerance_(integration.tolerance),
        stepper_(boost::numeric::odeint::make_dense_output(tolerance_ * size_of(scene), tolerance_, Pair())) {}

  /// The next step's arc and its first contact; without a contact it ends with the step, or at the horizon.
  [[nodiscard]] ArcToEvent<DenseArc> fly(const motion::State<double>& state, const motion::Motion<double>& start,
                                         double anchor, double horizon) {
    go_on(this->constants(), state, start, anchor);
    ArcToEvent<DenseArc> flight{standing(this->constants(), state)};
    if (const Side side = entered(); side != Side::none) {
      flight.crossing = {0, side, 0.0, start};
      flight.crossing.motion.x =
          motion::stop_at<double>(this->stops(), side).position;  // the step ended there, to rounding
      return flight;
    }
    try {
      flight.arc = step(this->constants(), state, start.a);
    } catch (const boost::numeric::odeint::odeint_error&) {  // no step is short enough
      flight.crossing = {0, Side::none, 0.0, start, 0, false};
      return flight;
    }
    motion::Crossing<double>& contact = flight.crossing = first_contact(flight.arc, horizon);
    const double turns = state.phase_turns + contact.elapsed / this->period();
    contact.resolved = this->finite(contact.motion.x) && (contact.side != Side::none || turns > state.phase_turns);
    if (contact.side == Side::none && contact.elapsed < horizon) reached_ = {contact.motion.x, contact.motion.v, turns};
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
    try {
      flight.arc = step(constants, state, start.a);
    } catch (const boost::numeric::odeint::odeint_error&) {  // no step is short enough
      flight.crossing.resolved = false;
      return flight;
    }
    const double moved = anchor_ - anchor;  // since the first step of the flight
    for (motion::Margin<double>& margin : margins) margin.constant += margin.place * moved;
    motion::Crossing<double>& crossing = flight.crossing = first_crossing(flight.arc, margins, horizon);
    crossing.motion.offset += moved;
    const double turns = state.phase_turns + crossing.elapsed / this->period();
    crossing.resolved = this->finite(crossing.motion.x) && (crossing.margin < count || turns > state.phase_turns);
    if (crossing.margin == count && crossing.elapsed < horizon)
      reached_ = {crossing.motion.x, crossing.motion.v, turns};
    return flight;
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
    const double slope = margin.slope(start), rate = constants.f * constants.nu * start.cosine;
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
    return size > 0 ? size : 1.0;
  }

  /// Begins the steps of a flight, unless the state is the one that the last step reached.
  template <Effects Of>
  void go_on(const motion::ArcConstants<double, Of>& constants, const motion::State<double>& state,
             const motion::Motion<double>& start, double anchor) {
    const bool goes_on = Place{state.x, state.v, state.phase_turns} == reached_;
    if (!goes_on) begin(constants, state, start, anchor);
    reached_ = nowhere;
  }
  template <Effects Of>
  void begin(const motion::ArcConstants<double, Of>& constants, const motion::State<double>& state,
             const motion::Motion<double>& start, double anchor) {
    anchor_ = anchor, angle_ = 2 * pi<double>() * (this->start_turns() + state.phase_turns);
    double first_step = std::pow(tolerance_, 0.2) / constants.rate / 2;
    if (state.from_stop != Side::none && start.offset == 0) {  // no longer than the flight, if the force ends it soon
      const double leaving = -sign_of(state.from_stop) * start.v, pressed = sign_of(state.from_stop) * start.a;
      if (leaving > 0 && pressed > 0) first_step = std::min(first_step, 2 * leaving / pressed);
    }
    here_ = {start.offset, start.v};
    stepper_.initialize(here_, 0.0, first_step);
  }

  template <Effects Of>
  [[nodiscard]] double acceleration(const motion::ArcConstants<double, Of>& constants, const Values& y, double s) {
    this->count_evaluations(1);
    const double sine = constants.f == 0 ? 0.0 : std::sin(angle_ + constants.nu * s);
    return constants.acceleration(constants.from_equilibrium(anchor_ + y[0], anchor_, y[0]), y[1], sine);
  }

  template <Effects Of>
  [[nodiscard]] motion::PolynomialArc<Of> standing(const motion::ArcConstants<double, Of>& constants,
                                                   const motion::State<double>& state) const {
    Bernstein<double> offset, velocity;
    offset.fill(here_[0]), velocity.fill(here_[1]);
    return {constants, anchor_, this->start_turns() + state.phase_turns, 0.0, offset, velocity};
  }

  /// Makes a step from here, with acceleration a at its beginning, and returns its dense output as an arc.
  template <Effects Of>
  [[nodiscard]] motion::PolynomialArc<Of> step(const motion::ArcConstants<double, Of>& constants,
                                               const motion::State<double>& state, double a) {
    const auto equation = [&](const Values& y, Values& rate, double s) {
      rate = {y[1], acceleration(constants, y, s)};
    };
    const auto [from, to] = stepper_.do_step(equation);
    const double length = to - from;
    const Values begin = std::exchange(here_, stepper_.current_state());
    Values third, two_thirds;
    stepper_.calc_state(from + length / 3, third), stepper_.calc_state(from + 2 * length / 3, two_thirds);
    const double a_end = acceleration(constants, here_, to);
    return {constants,
            anchor_,
            this->start_turns() + state.phase_turns,
            length,
            quintic(length, {begin[0], begin[1]}, {here_[0], here_[1]}, {third[0], two_thirds[0]}),
            quintic(length, {begin[1], a}, {here_[1], a_end}, {third[1], two_thirds[1]})};
  }

  /// Distance from the anchor to a stop, positive inside.
  [[nodiscard]] double gap(Side side) const {
    return side == Side::upper ? this->stops().upper - anchor_ : anchor_ - this->stops().lower;
  }

  /// The stop that the mass is on and moves into; none if there isn't one.
  [[nodiscard]] Side entered() const {
    for (const Side side : {Side::lower, Side::upper})
      if (gap(side) - sign_of(side) * here_[0] <= 0 && sign_of(side) * here_[1] > 0) return side;
    return Side::none;
  }

  /// The first crossing of a stop by the polynomial; else its end, or the horizon.
  [[nodiscard]] motion::Crossing<double> first_contact(const DenseArc& arc, double horizon) const {
    motion::Crossing<double> first{0, Side::none, std::min(arc.length(), horizon), {}};
    for (const Side side : {Side::lower, Side::upper}) {
      if (std::isinf(gap(side))) continue;
      Bernstein<double> c = arc.offset();
      for (double& y : c) y = gap(side) - sign_of(side) * y;
      c[0] = std::max(c[0], 0.0);
      if (c[0] == 0 && arc.velocity()[0] == 0)  // released: the force leads away, but the polynomial's error may not
        c[1] = 0, c[2] = std::max(c[2], 0.0);
      const auto root = FirstRoot<double>::of(c);
      if (root && *root * arc.length() <= first.elapsed) first.side = side, first.elapsed = *root * arc.length();
    }
    first.motion = arc.at(first.elapsed);
    if (first.side == Side::none) return first;
    first.motion.x = motion::stop_at<double>(this->stops(), first.side).position;
    if (sign_of(first.side) * first.motion.v <= 0) first.motion.v = 0;  // the two polynomials differ by their errors
    return first;
  }

  /// The first of some margins that the polynomial carries below 0; else its end, or the horizon.
  template <Effects Of, std::size_t count>
  [[nodiscard]] static motion::Crossing<double> first_crossing(const motion::PolynomialArc<Of>& arc,
                                                               const std::array<motion::Margin<double>, count>& margins,
                                                               double horizon) {
    motion::Crossing<double> first{count, Side::none, std::min(arc.length(), horizon), {}};
    for (std::size_t i = 0; i < count; ++i) {
      Bernstein<double> c;
      for (std::size_t j = 0; j < c.size(); ++j)
        c[j] = margins[i].constant + margins[i].place * arc.offset()[j] + margins[i].speed * arc.velocity()[j];
      c[0] = std::max(c[0], 0.0);
      const auto root = FirstRoot<double>::of(c);
      if (root && *root * arc.length() <= first.elapsed) first.margin = i, first.elapsed = *root * arc.length();
    }
    first.motion = arc.at(first.elapsed);
    return first;
  }

  double tolerance_;
  Stepper stepper_;
  double anchor_ = 0.0, angle_ = 0.0;  ///< of the present flight: its anchor, and the forcing phase at its beginning
  Values here_{};                      ///< the beginning of its next step
  Place reached_ = nowhere;            ///< the state from which the flight continues
};

}  // namespace clatter::stepping
