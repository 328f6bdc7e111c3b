#include "bench/sweeps.hpp"

#include <cmath>
#include <numbers>

namespace clatter::bench {
namespace {

point::Problem scene_between(double xs) {
  point::Problem scene;
  scene.oscillator = {.damping = 0.1, .forcing = -1.0};
  scene.stops = {-xs, xs, 0.7, 0.7};
  scene.observe.extrema = true;
  return scene;
}

sweep::Sweep transients_over(const std::vector<double>& frequencies, double xs, double periods) {
  sweep::Sweep sweep;
  sweep.problem = scene_between(xs);
  sweep.problem.time.mode = steady::Mode::transient;
  sweep.problem.time.duration = periods * 2 * std::numbers::pi;
  sweep.dimensions = {{{Parameter("nu"), frequencies}}};
  return sweep;
}

sweep::Sweep map_between(std::size_t n, double nearest, double farthest) {
  sweep::Sweep sweep;
  sweep.problem = scene_between(1.0);
  sweep.problem.time.max_periods = 500;
  sweep.problem.observe.harmonics = 3;
  sweep.problem.observe.harmonics_method = observables::HarmonicsMethod::exact;
  sweep.problem.observe.period = true;
  sweep.dimensions = {{{Parameter("nu"), linspace(0.5, 1.5, n)}}, {{Parameter("xs"), linspace(nearest, farthest, n)}}};
  return sweep;
}

}  // namespace

std::vector<double> linspace(double a, double b, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = std::lerp(a, b, static_cast<double>(i) / static_cast<double>(n - 1));
  return values;
}

sweep::Sweep transients(double xs, std::size_t points, double periods) {
  return transients_over(linspace(0.5, 1.5, points), xs, periods);
}

sweep::Sweep transients_that_keep_hitting(std::size_t points, double periods) {
  return transients_over(linspace(0.88, 1.11, points), xs_23, periods);
}

sweep::Sweep map(std::size_t n) { return map_between(n, 0.2, 4.0); }

sweep::Sweep map_out_of_reach(std::size_t n) { return map_between(n, 8.0, 12.0); }

Work work_of(const sweep::RunResult& result) {
  Work work;
  for (const sweep::WorkStats& part : result.work) work.impacts += part.impacts, work.periods += part.periods;
  return work;
}

}  // namespace clatter::bench
