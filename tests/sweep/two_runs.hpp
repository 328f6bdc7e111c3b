#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "support/random.hpp"
#include "sweep/figures.hpp"

namespace clatter::sweep {

/// Scenes that share their time plan and observers, each a point of a sweep.
inline Sweep sweep_over(const std::vector<point::Problem>& scenes) {
  const auto axis = [&scenes](Parameter parameter, const auto& value) {
    Axis one{parameter, {}};
    for (const point::Problem& scene : scenes) one.values.push_back(value(scene));
    return one;
  };
  Dimension dimension{axis(Parameter("nu"), [](const point::Problem& s) { return s.oscillator.frequency; }),
                      axis(Parameter("h"), [](const point::Problem& s) { return s.oscillator.damping; }),
                      axis(Parameter("f"), [](const point::Problem& s) { return s.oscillator.forcing; }),
                      axis(Parameter("load"), [](const point::Problem& s) { return s.oscillator.load; }),
                      axis(Parameter("stiffness"), [](const point::Problem& s) { return s.oscillator.stiffness; }),
                      axis(Parameter("stop_lower"), [](const point::Problem& s) { return s.stops.lower; }),
                      axis(Parameter("stop_upper"), [](const point::Problem& s) { return s.stops.upper; }),
                      axis(Parameter("R_lower"), [](const point::Problem& s) { return s.stops.restitution_lower.R; }),
                      axis(Parameter("R_upper"), [](const point::Problem& s) { return s.stops.restitution_upper.R; }),
                      axis(Parameter("x0"), [](const point::Problem& s) { return s.start.displacement; }),
                      axis(Parameter("v0"), [](const point::Problem& s) { return s.start.velocity; }),
                      axis(Parameter("phase"), [](const point::Problem& s) { return s.start.phase; })};
  if (std::ranges::any_of(scenes, [](const point::Problem& s) { return has_soft_stop(s.stops); })) {
    const auto add = [&](Parameter parameter, double Stops::*value) {
      dimension.push_back(axis(parameter, [value](const point::Problem& s) { return s.stops.*value; }));
    };
    add(Parameter("stop_stiffness_lower"), &Stops::stiffness_lower);
    add(Parameter("stop_stiffness_upper"), &Stops::stiffness_upper);
    add(Parameter("stop_damping_lower"), &Stops::damping_lower);
    add(Parameter("stop_damping_upper"), &Stops::damping_upper);
  }
  return {.problem = scenes.front(), .dimensions = {dimension}, .follow = {}};
}

/// A point's place in the figure of a run.
struct RunPoint {
  const results::Dataset& figure;
  std::size_t index;

  [[nodiscard]] std::uint8_t status() const { return statuses(figure)[index]; }
  [[nodiscard]] std::int64_t impacts() const {
    return std::get<std::vector<std::int64_t>>(find(figure, "impact_total")->values)[index];
  }
  [[nodiscard]] bool has(const std::string& name) const { return find(figure, name) != nullptr; }
  [[nodiscard]] std::vector<double> of(const std::string& name) const {
    const std::vector<double>& all = values(figure, name);
    const std::size_t width = all.size() / statuses(figure).size();
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(index * width);
    return {begin, begin + static_cast<std::ptrdiff_t>(width)};
  }
};

/// How far two runs of a point are apart.
struct Apart {
  bool alike = true;   ///< the same status, counts, and values that there are none of
  std::string what{};  ///< the first thing that isn't alike, else what is farthest apart
  double by = 0.0;     ///< the largest difference of a value, over the largest displacement or velocity

  void differ(const std::string& name) {
    if (alike) what = name;
    alike = false, by = std::numeric_limits<double>::infinity();
  }
  void raise(double difference, const std::string& name) {
    if (std::isnan(difference)) return differ(name);
    if (difference > by) by = difference, what = name;
  }
};

/// Compares amplitudes with their phases, since a vanishing one has none.
inline void compare_spectra(const RunPoint& a, const RunPoint& b, const std::string& of, double scale, Apart& apart) {
  if (!b.has(of + "_amplitude")) return;
  const auto harmonics = [&of](const RunPoint& point) {
    const std::vector<double> amplitude = point.of(of + "_amplitude"), phase = point.of(of + "_phase");
    std::vector<std::complex<double>> all;
    for (std::size_t k = 0; k < amplitude.size(); ++k)
      all.push_back(amplitude[k] * std::exp(std::complex<double>(0, std::isnan(phase[k]) ? 0 : phase[k])));
    return all;
  };
  const auto left = harmonics(a), right = harmonics(b);
  for (std::size_t k = 0; k < left.size(); ++k) apart.raise(std::abs(left[k] - right[k]) / scale, of + "_amplitude");
}

/// Compares all that is observed of a point, the second run giving the scale.
inline Apart compare(const RunPoint& a, const RunPoint& b) {
  Apart apart;
  if (a.status() != b.status()) apart.differ("status");
  if (!apart.alike || b.status() >= 16) return apart;
  if (b.status() == 2 && a.impacts() != b.impacts()) apart.differ("impact_total");
  for (const std::string name : {"impacts_per_period", "period_ratio"}) {
    if (!b.has(name)) continue;
    const auto x = a.of(name), y = b.of(name);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (x[i] != y[i] && !(std::isnan(x[i]) && std::isnan(y[i]))) apart.differ(name);
  }
  if (!apart.alike) return apart;
  const double size_x = std::max(std::abs(b.of("x_min")[0]), std::abs(b.of("x_max")[0]));
  const double size_v = std::max({size_x, std::abs(b.of("v_min")[0]), std::abs(b.of("v_max")[0])});
  const auto measure = [&](const std::string& name, double scale) {
    if (!b.has(name)) return;
    const auto x = a.of(name), y = b.of(name);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (!(std::isnan(x[i]) && std::isnan(y[i]))) apart.raise(std::abs(x[i] - y[i]) / scale, name);
  };
  for (const char* name : {"x_min", "x_max"}) measure(name, size_x);
  for (const char* name : {"v_min", "v_max", "v_before", "v_after", "impact_speed"}) measure(name, size_v);
  if (b.has("period") && !std::isnan(b.of("period")[0])) measure("period", b.of("period")[0]);
  measure("rest_fraction", 1.0);
  compare_spectra(a, b, "x", size_x, apart), compare_spectra(a, b, "v", size_v, apart);
  return apart;
}

/// The scene with its inputs moved by 1e-15 of them, up or down as the index has it.
inline point::Problem moved(point::Problem scene, std::uint64_t index) {
  support::Random random(15, index);
  Oscillator& o = scene.oscillator;
  Stops& stops = scene.stops;
  Start& start = scene.start;
  start.phase += random.sign() * 1e-15;
  for (double* value : {&o.damping, &o.forcing, &o.frequency, &o.load, &stops.restitution_lower.R,
                        &stops.restitution_upper.R, &start.velocity})
    *value *= 1 + random.sign() * 1e-15;
  for (double* R : {&stops.restitution_lower.R, &stops.restitution_upper.R}) *R = std::min(*R, 1.0);
  const bool on_lower = start.displacement == stops.lower, on_upper = start.displacement == stops.upper;
  for (double* value : {&stops.lower, &stops.upper, &start.displacement}) *value *= 1 + random.sign() * 1e-15;
  if (has_soft_stop(stops))
    for (double* value : {&stops.stiffness_lower, &stops.stiffness_upper, &stops.damping_lower, &stops.damping_upper})
      *value *= 1 + random.sign() * 1e-15;
  const Stops rigid = rigid_ones(stops);
  start.displacement = std::clamp(start.displacement, rigid.lower, rigid.upper);
  if (on_lower) start.displacement = stops.lower;
  if (on_upper) start.displacement = stops.upper;
  return scene;
}

/// The change of the scalar loop's results if the inputs move by 1e-15; infinite if it changes the status or a
/// count.
inline double sensitivity(const point::Problem& scene, const RunPoint& unmoved) {
  double worst = 0;
  for (std::uint64_t index = 0; index < 8 && std::isfinite(worst); ++index) {
    const results::Dataset other =
        run(sweep_of(moved(scene, index), {}), {.threads = 1, .arch = lanes::InstructionSet::scalar}).dataset;
    worst = std::max(worst, compare({other, 0}, unmoved).by);
  }
  return worst;
}

}  // namespace clatter::sweep
