// Boost.Odeint has no events. A careful user writes:
//   1. one step of the controlled stepper, at tolerances 1e-10;
//   2. the signs of both gaps at the end of the step: one below 0 has been crossed;
//   3. the crossing by TOMS 748 on the dense output, to the last bit; of two the earlier one;
//   4. the law of impact, and a new start of the stepper from there, with a step well below the length of the flight.
// A flight that begins on a stop and ends beyond it within one step crosses, too: a time with a gap above 0 in between
// is found by halving the step towards its beginning. If there is none, the mass has not left: the next impact is now.
// Two crossings of one stop within a step leave both signs unchanged and are missed.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/util/odeint_error.hpp>
#include <cmath>

#include "bench/solver_run.hpp"

namespace clatter::bench {
namespace {

namespace odeint = boost::numeric::odeint;

using Pair = odeint::runge_kutta_dopri5<Values>;
using Stepper = odeint::result_of::make_dense_output<Pair>::type;

/// The contact of a step, or of its part before the run's end, with a stop.
struct Crossing {
  Side side = Side::none;
  double tau;
};

Values at(const Stepper& stepper, double tau) {
  Values y;
  stepper.calc_state(tau, y);
  return y;
}

/// The time in a step at which a gap that is below 0 at its end falls to 0.
double crossing_time(const Stepper& stepper, const SolverRun& run, Side side, double from, double to) {
  const auto gap = [&](double tau) { return run.gap(side, at(stepper, tau)[0]); };
  double inside = from, beyond = to, step = to - from;
  while (!(gap(inside) > 0)) {
    step /= 2;
    if (inside > from) beyond = inside;
    inside = from + step;
    if (inside == from) return from;
  }
  std::uintmax_t iterations = 200;
  return boost::math::tools::toms748_solve(gap, inside, beyond, boost::math::tools::eps_tolerance<double>(), iterations)
      .second;
}

Crossing first_crossing(const Stepper& stepper, const SolverRun& run, double from, double to) {
  Crossing first{Side::none, to};
  const double x = at(stepper, to)[0];
  for (const Side side : {Side::lower, Side::upper}) {
    if (!(run.gap(side, x) < 0)) continue;
    const double tau = crossing_time(stepper, run, side, from, to);
    if (first.side == Side::none || tau < first.tau) first = {side, tau};
  }
  return first;
}

/// From the stepper's start to the end of the run.
void integrate(Stepper& stepper, SolverRun& run) {
  const auto equation = [&run](const Values& y, Values& rate, double tau) { rate = run.derivative(tau, y); };
  while (run.goes_on(stepper.current_time())) {
    const auto [from, reached] = stepper.do_step(equation);
    const double to = std::min(reached, run.duration());
    const Crossing crossing = first_crossing(stepper, run, from, to);
    for (int i = 1; i <= looks_per_step; ++i) {
      const double tau = from + (crossing.tau - from) * i / looks_per_step;
      run.see(tau, at(stepper, tau)[0]);
    }
    if (crossing.side != Side::none) {
      const Values y = run.contact(crossing.tau, crossing.side, at(stepper, crossing.tau)[1]);
      stepper.initialize(y, crossing.tau, run.first_step(crossing.tau, y));
    } else if (to == run.duration()) {
      run.complete(at(stepper, to)[0]);
    }
  }
}

}  // namespace

void run_odeint(SolverRun& run) {
  Stepper stepper = odeint::make_dense_output(run.absolute_tolerance(), run.relative_tolerance(), Pair());
  stepper.initialize(run.start(), 0.0, run.first_step(0.0, run.start()));
  try {
    integrate(stepper, run);
  } catch (const odeint::step_adjustment_error&) {
    run.fail(stepper.current_time(), "step_adjustment_error");
  }
}

}  // namespace clatter::bench
