#include "bench/sweeps.hpp"

#include <cmath>
#include <numbers>

namespace clatter::bench {
namespace {

Scene scene_between(double xs) {
  Scene scene;
  scene.oscillator = {.damping = 0.1, .forcing = -1.0};
  set(scene, Parameter::xs, xs);
  set(scene, Parameter::R, 0.7);
  scene.observe.extrema = true;
  return scene;
}

}  // namespace

std::vector<double> linspace(double a, double b, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = std::lerp(a, b, static_cast<double>(i) / static_cast<double>(n - 1));
  return values;
}

Sweep transients(double xs, std::size_t points, double periods) {
  Sweep sweep;
  sweep.scene = scene_between(xs);
  sweep.scene.time.mode = Mode::transient;
  sweep.scene.time.duration = periods * 2 * std::numbers::pi;
  sweep.dimensions = {{{Parameter::nu, linspace(0.5, 1.5, points)}}};
  return sweep;
}

Sweep map(std::size_t n) {
  Sweep sweep;
  sweep.scene = scene_between(1.0);
  sweep.scene.time.max_periods = 500;
  sweep.scene.observe.harmonics = 3;
  sweep.scene.observe.harmonics_method = HarmonicsMethod::exact;
  sweep.scene.observe.period = true;
  sweep.dimensions = {{{Parameter::nu, linspace(0.5, 1.5, n)}}, {{Parameter::xs, linspace(0.2, 4.0, n)}}};
  return sweep;
}

Work work_of(const RunResult& result) {
  Work work;
  for (const Usage& usage : result.usage) work.impacts += usage.impacts, work.periods += usage.periods;
  return work;
}

}  // namespace clatter::bench
