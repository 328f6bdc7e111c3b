#include <algorithm>

#include "sweep/result_store.hpp"

namespace clatter::sweep {
namespace {

using Scalar = double point::PointResult::*;

OutputVariable scalar(std::string name, std::string long_name, Scalar member) {
  return {std::move(name), std::move(long_name), "1", {}, 1, [member](const point::PointResult& r, double* out) {
            *out = r.*member;
          }};
}

/// Two values, over `stop` or `multiplier`.
OutputVariable pair(std::string name, std::string long_name, std::string dimension,
                    double (point::PointResult::*member)[2]) {
  const auto put = [member](const point::PointResult& r, double* out) { std::copy_n(r.*member, 2, out); };
  return {std::move(name), std::move(long_name), "1", {std::move(dimension)}, 2, put};
}

/// Values of a vector of the result, NaN where the point has none.
template <class Get>
OutputVariable row(std::string name, std::string long_name, std::string units, std::string dimension, std::size_t width,
                   Get get) {
  const auto put = [width, get](const point::PointResult& r, double* out) {
    const std::vector<double>& values = get(r);
    std::fill_n(std::copy_n(values.begin(), std::min(width, values.size()), out),
                width - std::min(width, values.size()), point::no_value);
  };
  return {std::move(name), std::move(long_name), std::move(units), {std::move(dimension)}, width, put};
}

void add_harmonics(std::vector<OutputVariable>& outputs, std::size_t count) {
  const auto add = [&](const char* name, const char* long_name, const char* units,
                       observables::Spectrum point::PointResult::*of,
                       std::vector<double> observables::Spectrum::*what) {
    outputs.push_back(
        row(name, long_name, units, "harmonic", count,
            [of, what](const point::PointResult& r) -> const std::vector<double>& { return r.*of.*what; }));
  };
  add("x_amplitude", "amplitude of the harmonics of displacement", "1", &point::PointResult::x_spectrum,
      &observables::Spectrum::amplitude);
  add("x_phase", "phase of the harmonics of displacement at tau = 0", "rad", &point::PointResult::x_spectrum,
      &observables::Spectrum::phase);
  add("v_amplitude", "amplitude of the harmonics of velocity", "1", &point::PointResult::v_spectrum,
      &observables::Spectrum::amplitude);
  add("v_phase", "phase of the harmonics of velocity at tau = 0", "rad", &point::PointResult::v_spectrum,
      &observables::Spectrum::phase);
  outputs.push_back(
      scalar("base_frequency", "frequency whose multiples the harmonics are", &point::PointResult::base_frequency));
}

void add_trajectory(std::vector<OutputVariable>& outputs, std::size_t count) {
  const auto add = [&](const char* name, const char* long_name, std::vector<double> point::PointResult::*what) {
    outputs.push_back(row(name, long_name, "1", "sample", count,
                          [what](const point::PointResult& r) -> const std::vector<double>& { return r.*what; }));
  };
  add("tau", "time since the beginning of the observed time", &point::PointResult::tau);
  add("x", "displacement", &point::PointResult::x);
  add("v", "velocity", &point::PointResult::v);
}

}  // namespace

std::vector<OutputVariable> outputs_of(const point::Problem& scene) {
  const observables::Observe& observe = scene.observe;
  std::vector<OutputVariable> outputs;
  if (scene.time.mode == steady::Mode::steady)
    outputs.push_back(scalar("settling_estimate", "forcing periods until within the tolerance of the steady motion",
                             &point::PointResult::settling_estimate));
  if (observe.extrema) {
    outputs.push_back(scalar("x_min", "minimum displacement", &point::PointResult::x_min));
    outputs.push_back(scalar("x_max", "maximum displacement", &point::PointResult::x_max));
    outputs.push_back(scalar("v_min", "minimum velocity", &point::PointResult::v_min));
    outputs.push_back(scalar("v_max", "maximum velocity", &point::PointResult::v_max));
  }
  if (observe.harmonics > 0) add_harmonics(outputs, static_cast<std::size_t>(observe.harmonics) + 1);
  if (observe.impacts) {
    outputs.push_back(
        pair("impacts_per_period", "impacts per forcing period", "stop", &point::PointResult::impacts_per_period));
    outputs.push_back(pair("v_before", "velocity before the first impact", "stop", &point::PointResult::v_before));
    outputs.push_back(pair("v_after", "velocity after the first impact", "stop", &point::PointResult::v_after));
    outputs.push_back(
        pair("rest_fraction", "share of time at rest on the stop", "stop", &point::PointResult::rest_fraction));
  }
  if (observe.trajectory > 0) add_trajectory(outputs, static_cast<std::size_t>(observe.trajectory));
  if (observe.period) {
    outputs.push_back(scalar("period", "period of the motion", &point::PointResult::period));
    outputs.push_back(
        scalar("period_ratio", "period of the motion in forcing periods", &point::PointResult::period_ratio));
    outputs.push_back(
        scalar("eigenfrequency", "2 pi over the period of unforced motion", &point::PointResult::eigenfrequency));
    outputs.push_back(scalar("velocity_ratio", "|velocity before impact / xs|", &point::PointResult::velocity_ratio));
  }
  if (observe.stability) {
    outputs.push_back(pair("multiplier_re", "real part of the period's multipliers", "multiplier",
                           &point::PointResult::multiplier_re));
    outputs.push_back(pair("multiplier_im", "imaginary part of the period's multipliers", "multiplier",
                           &point::PointResult::multiplier_im));
    outputs.push_back(scalar("lyapunov", "largest Lyapunov exponent per tau", &point::PointResult::lyapunov));
  }
  return outputs;
}

}  // namespace clatter::sweep
