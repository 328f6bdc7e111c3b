// Boost.Odeint has no events. A user who wants speed writes: a controlled step with dense output; if the displacement
// at its end is beyond a stop, the crossing by Newton's iteration on the dense output, which has the velocity too; the
// law of impact; a new start from there with the controller's step size. If the velocity changes sign within a step and
// the motion may exceed its extrema there, one evaluation at the turning point gives the extremum and, if users think
// of it, shows a stop that is met and left within the step. Nothing is allocated in a run.
#include <algorithm>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

#include "bench/transient.hpp"

namespace clatter::bench {
namespace {

namespace odeint = boost::numeric::odeint;

using Pair = odeint::runge_kutta_dopri5<Phase>;
using Stepper = odeint::result_of::make_dense_output<Pair>::type;

/// The time at which the mass is on a stop, and its velocity then.
struct Crossing {
  double tau, v;
};

class Run {
 public:
  Run(const point::Problem& scene, double tolerance, Looks looks)
      : equation_(scene),
        stops_(scene.stops),
        duration_(scene.time.duration),
        tolerance_(tolerance),
        looks_(looks),
        stepper_(odeint::make_dense_output(tolerance, tolerance, Pair())),
        run_{scene.start.displacement, scene.start.displacement} {
    stepper_.initialize(Phase{scene.start.displacement, scene.start.velocity}, 0.0, std::pow(tolerance, 0.2));
  }

  Transient to_end() {
    const auto rate = [this](const Phase& y, Phase& dy, double tau) {
      dy = {y[1], equation_.acceleration(tau, y[0], y[1])};
    };
    while (true) {
      const auto [from, to] = stepper_.do_step(rate);
      const double until = first_beyond(from, to);
      if (until > from) {
        if (!rebound(from, until)) break;
      } else {
        if (to >= duration_) break;
        run_.pass(stepper_.current_state()[0]);
      }
    }
    const auto [x, v] = at(duration_);
    run_.x = x, run_.v = v;
    return run_;
  }

 private:
  /// The motion within the last step.
  [[nodiscard]] Phase at(double tau) const {
    Phase y;
    stepper_.calc_state(tau, y);
    return y;
  }

  [[nodiscard]] bool beyond(double x) const { return x > stops_.upper || x < stops_.lower; }

  /// A time in the last step at which the mass is beyond a stop: its turning point or its end; else its beginning.
  double first_beyond(double from, double to) {
    const Phase &begin = stepper_.previous_state(), &end = stepper_.current_state();
    if (beyond(end[0])) return to;
    if (begin[1] * end[1] >= 0) return from;
    const double slope = (end[1] - begin[1]) / (to - from);
    const double further = 0.5 * (to - from) * std::max(std::abs(begin[1]), std::abs(end[1]));
    const auto [least, greatest] = std::minmax(begin[0], end[0]);
    if (slope < 0 ? greatest + further <= run_.x_max : least - further >= run_.x_min) return from;
    return beyond_at_turn(from, from - begin[1] / slope, slope);
  }

  /// Evaluates the motion near a turning point, at the vertex of a parabola.
  double beyond_at_turn(double from, double near, double slope) {
    const auto [x, v] = at(near);
    const double turn = near - v / slope, position = x - v * v / (2 * slope);
    if (looks_ == Looks::turns && beyond(position) && beyond(at(turn)[0])) return turn;
    if (turn < duration_) run_.pass(position);
    return from;
  }

  /// The impact between two times in the last step, and a new start from it; false if the run ends before.
  bool rebound(double from, double to) {
    const Phase y = at(to);
    const bool upper = y[0] > stops_.upper;
    const double position = upper ? stops_.upper : stops_.lower;
    const auto [tau, v] = crossing(from, to, y, position);
    if (tau >= duration_) return false;
    run_.pass(position);
    const double restitution = (upper ? stops_.restitution_upper : stops_.restitution_lower).R;
    stepper_.initialize(Phase{position, -restitution * v}, tau, stepper_.current_time_step());
    return true;
  }

  /// The crossing, from y at `beyond`, at which the mass is beyond a stop.
  [[nodiscard]] Crossing crossing(double inside, double beyond, Phase y, double position) const {
    const bool upper = y[0] > position;
    for (double tau = beyond;;) {
      double next = tau - (y[0] - position) / y[1];
      if (!(next > inside && next < beyond)) next = inside + (beyond - inside) / 2;
      if (std::abs(next - tau) <= 0.01 * tolerance_ || next == inside || next == beyond) return {next, y[1]};
      tau = next, y = at(tau);
      ((y[0] > position) == upper ? beyond : inside) = tau;
    }
  }

  Equation equation_;
  Stops stops_;
  double duration_, tolerance_;
  Looks looks_;
  Stepper stepper_;
  Transient run_;
};

}  // namespace

Transient odeint_transient(const point::Problem& scene, double tolerance, Looks looks) {
  return Run(scene, tolerance, looks).to_end();
}

}  // namespace clatter::bench
