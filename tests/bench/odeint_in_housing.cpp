// A loose mass by Boost.Odeint, as a user who wants speed writes it: a controlled step with dense output of both
// masses; if the loose one is beyond a wall at its end, or at a turning point within it, the crossing by bracketed
// secants on the dense output; the law of impact; a new start from there with the controller's step size, or one well
// below the flight that the impact leaves. Rebounds within the tolerance end in a press, in which both masses are
// one until the force of the wall changes its sign at the end of a step.
#include <algorithm>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

#include "bench/housing.hpp"

namespace clatter::bench {
namespace {

namespace odeint = boost::numeric::odeint;

using State = std::array<double, 4>;  // x, x', z, z'
using Stepper = odeint::result_of::make_dense_output<odeint::runge_kutta_dopri5<State>>::type;

class Run {
 public:
  Run(const point::Problem& scene, double tolerance)
      : oscillator_(scene.oscillator),
        loose_(scene.loose),
        phase_(scene.start.phase),
        duration_(scene.time.duration),
        tolerance_(tolerance),
        stepper_(odeint::make_dense_output(tolerance, tolerance, odeint::runge_kutta_dopri5<State>())) {
    const Start& start = scene.start;
    stepper_.initialize(State{start.displacement, start.velocity, loose_.place, loose_.velocity}, 0.0,
                        std::pow(tolerance, 0.2));
  }

  InHousing to_end() {
    const auto rate = [this](const State& y, State& dy, double tau) { dy = derivative(tau, y); };
    while (true) {
      const auto [from, to] = stepper_.do_step(rate);
      const double event = pressed_by_ != 0 ? release(from, to) : impact(from, to);
      if (std::min(event, to) >= duration_) break;
      if (event >= to) continue;
      pressed_by_ != 0 ? let_go(event) : strike(event);
    }
    end_.state = at(duration_);
    return end_;
  }

 private:
  static constexpr double never = HUGE_VAL;

  /// x'' of the main mass, or of both as one.
  [[nodiscard]] double acceleration(double tau, const State& y) const {
    const double force = oscillator_.forcing * std::sin(oscillator_.frequency * tau + phase_) + oscillator_.load -
                         2 * oscillator_.damping * y[1] - y[0];
    return pressed_by_ != 0 ? (force + loose_.ratio * loose_.load) / (1 + loose_.ratio) : force;
  }
  [[nodiscard]] State derivative(double tau, const State& y) const {
    const double a = acceleration(tau, y);
    return pressed_by_ != 0 ? State{y[1], a, 0, 0} : State{y[1], a, y[3], loose_.load - a};
  }
  [[nodiscard]] State at(double tau) const {
    State y;
    stepper_.calc_state(tau, y);
    return y;
  }
  [[nodiscard]] double wall(double side) const { return side > 0 ? loose_.upper : loose_.lower; }

  /// The time in a bracket at which a quantity that is above 0 at its beginning falls to 0.
  template <class Quantity>
  [[nodiscard]] static double crossing(double from, double to, const Quantity& quantity, double below) {
    double above = quantity(from), tau = to;
    for (int side = 0; to - from > 1e-16 * to;) {  // by the Illinois rule
      tau = from + (to - from) * above / (above - below);
      if (!(tau > from && tau < to)) break;
      const double value = quantity(tau);
      if (value == 0) break;
      if (value > 0) {
        from = tau, above = value;
        if (side == 1) below /= 2;
        side = 1;
      } else {
        to = tau, below = value;
        if (side == -1) above /= 2;
        side = -1;
      }
    }
    return tau;
  }

  /// The first impact within the last step.
  double impact(double from, double to) {
    const State &begin = stepper_.previous_state(), &end = stepper_.current_state();
    const auto gap = [this](double tau) { return side_ * (wall(side_) - at(tau)[2]); };
    double until = to, depth = -1;
    for (side_ = -1; side_ < 2; side_ += 2) {
      until = to, depth = side_ * (wall(side_) - end[2]);
      const double turn = from + (to - from) * begin[3] / (begin[3] - end[3]);  // if it turns within the step
      if (!(depth < 0) && side_ * begin[3] > 0 && side_ * end[3] < 0) until = turn, depth = gap(turn);
      if (depth < 0) break;
    }
    if (!(depth < 0)) return never;
    const double away = gap(from) > 0 ? from : leaves(from, until, gap);
    return away < until ? crossing(away, until, gap, depth) : from;
  }
  /// A time after the beginning of a flight on a wall at which it is off that.
  template <class Gap>
  [[nodiscard]] static double leaves(double from, double until, const Gap& gap) {
    for (double step = (until - from) / 2; from + step > from; step /= 2)
      if (gap(from + step) > 0) return from + step;
    return until;
  }
  void strike(double tau) {
    State y = at(tau);
    const double w = y[3], share = loose_.ratio / (1 + loose_.ratio);
    double after = -(w > 0 ? loose_.restitution_upper : loose_.restitution_lower).R * w;
    y[1] += share * (w - after), ++end_.impacts;
    const double pressing = side_ * (loose_.load - acceleration(tau, y));
    const bool rests = pressing > 0 && std::abs(after) <= tolerance_;
    if (rests) y[1] += share * after, after = 0, pressed_by_ = side_;
    y[2] = wall(side_), y[3] = after;
    const double flight = pressing > 0 && !rests ? std::abs(after) / pressing : never;  // half of it
    stepper_.initialize(y, tau, std::min(stepper_.current_time_step(), flight));
  }

  /// The end of a press within the last step.
  [[nodiscard]] double release(double from, double to) const {
    const auto force = [this](double tau) { return pressed_by_ * (loose_.load - acceleration(tau, at(tau))); };
    const double last = force(to);
    return last < 0 && force(from) > 0 ? crossing(from, to, force, last) : last < 0 ? from : never;
  }
  void let_go(double tau) {
    const State y = at(tau);
    pressed_by_ = 0;
    stepper_.initialize(y, tau, std::pow(tolerance_, 0.2) / 10);
  }

  Oscillator oscillator_;
  LooseMass loose_;
  double phase_, duration_, tolerance_;
  Stepper stepper_;
  double pressed_by_ = 0, side_ = 0;  ///< the wall that presses, the one that is struck: -1 the lower, +1 the upper one
  InHousing end_{};
};

}  // namespace

InHousing odeint_in_housing(const point::Problem& scene, double tolerance) { return Run(scene, tolerance).to_end(); }

}  // namespace clatter::bench
