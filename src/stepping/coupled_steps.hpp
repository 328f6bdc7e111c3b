#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

#include "math/bernstein.hpp"
#include "motion/coupled_arc.hpp"

namespace clatter::stepping {

/// Steps of both masses beside a soft wall by the pair of orders 5 and 4 (Dormand & Prince 1980) of Boost.Odeint. Each
/// begins anew with a length by the fastest rate of both, so that it depends on the state alone.
class CoupledSteps {
 public:
  /// Relative tolerance, and the length by which the absolute one counts.
  CoupledSteps(double tolerance, double size) : tolerance_(tolerance), size_(size) {}

  /// A step from a start, as `motion::coupled`; `count` is told how often the equation was evaluated.
  template <Effects E, class Count>
  [[nodiscard]] motion::CoupledInHousing<double> step(const motion::ArcConstants<double, E>& constants,
                                                      const motion::Coupling<double>& coupling,
                                                      const motion::Motion<double>& start, double anchor,
                                                      const motion::RelativeStart<double>& from, double load,
                                                      double horizon, const Count& count) const {
    namespace odeint = boost::numeric::odeint;
    const motion::AnyConstants<double> any = motion::as_any(constants);
    const auto equation = [&](const Values& y, Values& rate, double s) {
      count(1);
      const double push = coupling.push(y[2], y[3]);
      const double free =
          constants.acceleration(constants.from_equilibrium(anchor + y[0], anchor, y[0]), y[1], phase(any, start, s));
      const double a = coupling.is_held ? 0.0 : free + push;
      rate = {y[1], a, y[3], load - push / coupling.ratio - a};
    };
    auto stepper = odeint::make_dense_output(tolerance_ * size_, tolerance_, odeint::runge_kutta_dopri5<Values>());
    const Values begin{start.offset, start.v, from.offset, from.w};
    stepper.initialize(begin, 0.0, std::fmin(horizon, std::pow(tolerance_, 0.2) / coupling.rate(any) / 2));
    const std::pair<double, double> interval = stepper.do_step(equation);
    const double length = interval.second;  // from 0 on
    const Values end = stepper.current_state();
    Values third, two_thirds, rate, rate_end;
    stepper.calc_state(length / 3, third), stepper.calc_state(2 * length / 3, two_thirds);
    equation(begin, rate, 0.0), equation(end, rate_end, length);
    const auto over = [&](std::size_t i) {
      Bernstein<double> y = quintic(length, {begin[i], rate[i]}, {end[i], rate_end[i]}, {third[i], two_thirds[i]});
      const double at_begin = y[0];
      for (double& c : y) c -= at_begin;
      motion::Powers<double> powers{};
      const auto of_it = to_powers(y);
      for (std::size_t k = 0; k < of_it.size(); ++k) powers[k] = of_it[k];
      return powers;
    };
    const auto course = [&](std::size_t i) {
      motion::Course<double> of{over(i), over(i + 1)};
      of.velocity[0] = begin[i + 1];
      return of;
    };
    motion::Motion<double> at_begin = start;
    at_begin.a = rate[1];
    return {motion::CoupledArc<double>(any, at_begin, anchor, length, course(0)), coupling, from, load, course(2)};
  }

 private:
  using Values = std::array<double, 4>;  ///< offset and velocity of the main mass, and z less the wall's place, and z'

  [[nodiscard]] static SineCosine<double> phase(const motion::AnyConstants<double>& constants,
                                                const motion::Motion<double>& start, double s) {
    return constants.phase_after({start.sine, start.cosine}, s);
  }

  double tolerance_, size_;
};

}  // namespace clatter::stepping
