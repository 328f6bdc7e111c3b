#include "branches/measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "math/dual.hpp"

namespace clatter::branches {
namespace {

using Along = Dual<double, 1>;  // with the derivative along a tangent

/// Calls `function(arc, length)` for each flight of an orbit in turn.
template <class Function>
void each_flight(const Scene& scene, const Orbit& orbit, Function&& function) {
  with_arcs(scene.oscillator, [&]<Effects E>() {
    const motion::ArcConstants<double, E> constants(scene.oscillator);
    const Parameters<double> p(scene);
    if (orbit.size() == 0) {
      const Response<double> response = steady_response(p.h, p.f, p.nu);
      const double x = p.load + response.displacement(0.0, 1.0), v = response.velocity(p.nu, 0.0, 1.0);
      const motion::Arc<double, E> arc(constants, {0.0, x, v, constants.acceleration(x - p.load, v, 0.0), 0.0, 1.0});
      return function(arc, 0.0, constants.period);
    }
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitImpact from = orbit.impact(i), to = orbit.impact(i + 1);
      function(arc_of(constants, p, {from.side, from.phase, from.before, to.side, to.phase}), from.phase,
               (to.phase - from.phase) / p.nu);
    }
  });
}

/// A scene's parameters and an orbit's impacts, as they change along a tangent.
struct Moving {
  Parameters<Along> p;
  struct Impact {
    Side side;
    Along phase, before;
  };
  std::vector<Impact> impacts;
  Along period;  ///< in tau
};

Moving moving(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  const Scene scene = equations.scene_at(point);
  const Orbit orbit = equations.orbit_at(point);
  Moving m{Parameters<Along>(scene), {}, {}};
  // the parameters are linear in the point, and so is a scene a small step along the tangent
  const Parameters<double> here(scene), there(equations.scene_at(sum(point, 1e-3, tangent)));
  const auto seed = [](Along& number, double from, double to) {
    number.slope[0] = std::isfinite(from) ? (to - from) / 1e-3 : 0.0;
  };
  seed(m.p.h, here.h, there.h), seed(m.p.f, here.f, there.f), seed(m.p.nu, here.nu, there.nu);
  seed(m.p.load, here.load, there.load), seed(m.p.lower, here.lower, there.lower);
  seed(m.p.upper, here.upper, there.upper), seed(m.p.R_lower, here.R_lower, there.R_lower);
  seed(m.p.R_upper, here.R_upper, there.R_upper);
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    Along phase(orbit.impacts[i].phase), before(orbit.impacts[i].before);
    phase.slope[0] = tangent[2 * i], before.slope[0] = tangent[2 * i + 1] * equations.speed_unit();
    m.impacts.push_back({orbit.impacts[i].side, phase, before});
  }
  m.period = Along(2 * std::numbers::pi * orbit.period_ratio()) / m.p.nu;
  return m;
}

}  // namespace

Multipliers multipliers(const Scene& scene, const Orbit& orbit) {
  const ImpactMap map = impact_map(scene, orbit);
  const double half = map.trace() / 2;
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - map.determinant));
  std::complex<double> first = half < 0 ? half - root : half + root;
  std::complex<double> second = first == 0.0 ? 0.0 : map.determinant / first;
  const bool stable = std::abs(first) < 1 && std::abs(second) < 1;
  if (orbit.mirrored) first *= first, second *= second;
  return {{first.real(), second.real()}, {first.imag(), second.imag()}, stable};
}

PhasePoint state_at_phase_zero(const Scene& scene, const Orbit& orbit) {
  std::optional<PhasePoint> state;
  const Orbit whole = orbit.whole();
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) {
    constexpr double turn = 2 * std::numbers::pi;
    const double nu = arc.constants().nu, next = std::ceil(begin / turn) * turn;
    if (state || (next > begin + nu * length && whole.size() > 0)) return;
    const motion::Motion<double> m = arc.at(whole.size() == 0 ? 0.0 : (next - begin) / nu);
    state = {m.x, m.v};
  });
  return *state;
}

observables::Extrema extrema(const Scene& scene, const Orbit& orbit) {
  observables::Extrema extrema;
  const Orbit whole = orbit.whole();
  each_flight(scene, whole, [&](const auto& arc, double begin, double length) { extrema.arc(arc, begin, length); });
  const Parameters<double> p(scene);
  for (const OrbitImpact& impact : whole.impacts) {
    const double x = p.position(impact.side);
    extrema.include({x, x}, {impact.before, impact.before});
  }
  return extrema;
}

Measure impact_speed(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  Measure fastest;
  for (const auto& [side, phase, before] : moving(equations, point, tangent).impacts) {
    const double speed = sign_of(side) * before.value;
    if (speed > fastest.value) fastest = {speed, sign_of(side) * before.slope[0]};
  }
  return fastest;
}

Measure impact_power(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  const Moving m = moving(equations, point, tangent);
  Along lost = 0;
  for (const auto& [side, phase, before] : m.impacts) {
    const Along& R = m.p.restitution(side);
    lost += (1 - R) * (1 + R) * before * before / 2;
  }
  const Along power = (equations.shape().mirrored ? 2 : 1) * lost / m.period;
  return {power.value, power.slope[0]};
}

Measure harmonic(const OrbitEquations& equations, const Vector& point, const Vector& tangent) {
  const Moving m = moving(equations, point, tangent);
  // (1 - nu^2 + 2 i h nu) X = F + (1/T) sum of (v+ - v-) e^{-i phase}, with F = -i f/2; mirror images add the same
  Along re = 0, im = -m.p.f / 2;
  for (const auto& [side, phase, before] : m.impacts) {
    const Along jump = -(1 + m.p.restitution(side)) * before * (equations.shape().mirrored ? 2 : 1) / m.period;
    re += jump * cos(phase), im -= jump * sin(phase);
  }
  const Along a = (1 - m.p.nu) * (1 + m.p.nu), b = 2 * m.p.h * m.p.nu;
  const Along amplitude = 2 * sqrt(re * re + im * im) / sqrt(a * a + b * b);
  return {amplitude.value, amplitude.slope[0]};
}

}  // namespace clatter::branches
