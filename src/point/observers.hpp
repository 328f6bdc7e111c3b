#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "observables/extrema.hpp"
#include "observables/harmonics.hpp"
#include "observables/impacts.hpp"
#include "observables/samples.hpp"
#include "observables/stability.hpp"
#include "point/point.hpp"

namespace clatter::point {

/// The observers that a scene asks for; each is called once an arc, and costs nothing where it is absent.
class Observers {
 public:
  Observers(const Problem& scene, const steady::ObservedTime& observed, double total, double base_frequency) {
    const observables::Observe& observe = scene.observe;
    if (observe.extrema) extrema.emplace();
    if (observe.impacts || observe.period) impacts.emplace();
    if (observe.impact_log) log.emplace();
    if (observe.full_log) rests.emplace();
    if (observe.trajectory > 0) {
      const auto count = static_cast<std::size_t>(observe.trajectory);
      trajectory.emplace(count, total / static_cast<double>(count - 1), observables::AtImpact::after, scene.stops);
    }
    if (observe.stability) stability.emplace(scene.stops, uncertainty_of(scene, observed));
    if (observe.harmonics == 0) return;
    if (observe.harmonics_method == observables::HarmonicsMethod::exact) {
      exact_harmonics.emplace(static_cast<std::size_t>(observe.harmonics), base_frequency);
    } else {
      const auto count = static_cast<std::size_t>(observe.harmonics_samples);
      samples.emplace(count, total / static_cast<double>(count), observables::AtImpact::mean, scene.stops);
    }
  }

  /// Takes a time `total` of the steady response to the force, whole periods that no stop interrupts, from displacement
  /// x on: by its amplitude and phase, but for what needs its course.
  void response(const Problem& scene, double x, double total) {
    const Oscillator& o = scene.oscillator;
    const double amplitude = steady_response(o.damping, o.forcing, o.frequency).amplitude, v = o.frequency * amplitude;
    if (extrema) extrema->include({o.load - amplitude, o.load + amplitude}, {-v, v});
    if (impacts) impacts->include({}, no_value);
    if (exact_harmonics) exact_harmonics->response(o, scene.start.phase, x, total);
    in_closed_form_ = true;
  }
  /// Whether anything still has to see the flights.
  [[nodiscard]] bool need_flights() const { return !in_closed_form_ || trajectory || samples || stability; }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    each([&](auto& observer) { observer.arc(arc, begin, length); });
  }
  void rest(const motion::Rest& rest) {
    each([&](auto& observer) { observer.rest(rest); });
  }
  void impact(const motion::Impact& impact) {
    if (!(impact.time > 0.0)) {  // the observed time begins after t0: an impact there belongs to what was before
      if (rests && log) log->impact(impact);
      return;
    }
    each([&](auto& observer) { observer.impact(impact); });
  }
  void finish(double x, double v, double total, bool periodic, bool autonomous) {
    if (stability && periodic) stability->finish_period(total, autonomous);
    if (stability && !periodic) stability->finish_window(total);
    if (trajectory) trajectory->finish(x, v, total, periodic);
    if (samples) samples->finish(x, v, total, periodic);
    if (exact_harmonics) exact_harmonics->finish(x, total);
  }

  /// Of arcs, by all observers together.
  [[nodiscard]] double evaluations() const {
    const auto of = [](const auto& observer) { return observer ? observer->evaluations() : 0.0; };
    return of(extrema) + of(trajectory) + of(samples) + of(exact_harmonics) + of(stability);
  }

  std::optional<observables::Extrema> extrema;
  std::optional<observables::Impacts> impacts;
  std::optional<observables::ImpactLog> log;
  std::optional<observables::RestLog> rests;
  std::optional<observables::Samples> trajectory, samples;
  std::optional<observables::ExactHarmonics> exact_harmonics;
  std::optional<observables::Stability> stability;

 private:
  /// How far displacements and velocities may be off: by rounding, and after a repeat by the tolerance of that.
  [[nodiscard]] static double uncertainty_of(const Problem& scene, const steady::ObservedTime& observed) {
    double size = std::abs(observed.from.x) + std::abs(observed.from.v);
    for (const double stop : {scene.stops.lower, scene.stops.upper})
      if (std::isfinite(stop)) size = std::max(size, std::abs(stop));
    const double tolerance = observed.found_by == steady::FoundBy::repetition ? scene.time.tolerance : 0.0;
    return (64 * epsilon<double>() + tolerance) * size;
  }

  template <class Function>
  void each(Function&& function) {
    if (extrema && !in_closed_form_) function(*extrema);
    if (impacts && !in_closed_form_) function(*impacts);
    if (exact_harmonics && !in_closed_form_) function(*exact_harmonics);
    if (log) function(*log);
    if (rests) function(*rests);
    if (trajectory) function(*trajectory);
    if (samples) function(*samples);
    if (stability) function(*stability);
  }

  bool in_closed_form_ = false;  ///< extrema, impacts and exact harmonics are known already
};

/// Harmonics k of the base frequency from the sums of the transform of `count` samples of an observed time in which it
/// turns `turns` times. NaN from half the sampling rate on; all, the constant part too, where the base frequency itself
/// is beyond it.
[[nodiscard]] inline observables::Spectrum sampled_spectrum(std::span<const std::complex<double>> sums,
                                                            std::size_t count, double turns, std::size_t highest) {
  const double nan = no_value, samples = static_cast<double>(count);
  std::vector<std::complex<double>> harmonics(highest + 1, {nan, nan});
  for (std::size_t k = 0; k <= highest; ++k) {
    const double index = std::round(turns * static_cast<double>(k)), needed = std::max(index, turns);
    if (2 * needed < samples) harmonics[k] = sums[static_cast<std::size_t>(index)] / samples;
  }
  return observables::Spectrum::of(harmonics);
}

}  // namespace clatter::point
