#include "observables/harmonics.hpp"

#include <cmath>
#include <complex>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "observables/harmonics_observer.hpp"

namespace clatter::observables {
namespace {

constexpr double nan = no_value;

/// Harmonics k of the base frequency from the sums of the transform of `count` samples of an observed time in which it
/// turns `turns` times. NaN from half the sampling rate on; all, the constant part too, if the base frequency itself is
/// beyond it.
Spectrum sampled_spectrum(std::span<const std::complex<double>> sums, std::size_t count, double turns,
                          std::size_t highest) {
  const auto samples = static_cast<double>(count);
  std::vector<std::complex<double>> harmonics(highest + 1, {nan, nan});
  for (std::size_t k = 0; k <= highest; ++k) {
    const double index = std::round(turns * static_cast<double>(k)), needed = std::max(index, turns);
    if (2 * needed < samples) harmonics[k] = sums[static_cast<std::size_t>(index)] / samples;
  }
  return Spectrum::of(harmonics);
}

Coordinate harmonic_coordinate(std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return {"harmonic", count, std::move(numbers), "number of the harmonic, 0: constant part"};
}

}  // namespace

std::vector<Column<Harmonics::Values>> Harmonics::columns(const Settings& settings) {
  const Coordinate harmonic = harmonic_coordinate(count_of(settings));
  const auto of = [&](const char* name, const char* long_name, Quantity quantity, Spectrum Values::*spectrum,
                      std::vector<double> Spectrum::*part) {
    return series<Values>(
        name, long_name, quantity, harmonic,
        [spectrum, part](const Values& v) -> const std::vector<double>& { return v.*spectrum.*part; });
  };
  constexpr std::string_view beyond = "the harmonic is above half the rate of the samples (method fft)",
                             constant = "it is that of the constant part, or above half the rate of the samples";
  return {missing_if(beyond, in_observed_frame(of("x_amplitude", "amplitude of the harmonics of displacement",
                                                  Quantity::length, &Values::x_spectrum, &Spectrum::amplitude))),
          missing_if(constant, in_observed_frame(of("x_phase", "phase of the harmonics of displacement at tau = 0",
                                                    Quantity::angle, &Values::x_spectrum, &Spectrum::phase))),
          missing_if(beyond, in_observed_frame(of("v_amplitude", "amplitude of the harmonics of velocity",
                                                  Quantity::velocity, &Values::v_spectrum, &Spectrum::amplitude))),
          missing_if(constant, in_observed_frame(of("v_phase", "phase of the harmonics of velocity at tau = 0",
                                                    Quantity::angle, &Values::v_spectrum, &Spectrum::phase))),
          scalar("base_frequency", "frequency whose multiples the harmonics are", &Values::base_frequency,
                 Quantity::frequency)};
}

FourierScratch Harmonics::scratch_for(const Settings& settings) {
  if (!from_samples(settings)) return {};
  auto transform = std::make_shared<const FourierTransform>(static_cast<std::size_t>(settings.harmonics_samples));
  auto workspace = transform->workspace();
  return {std::move(transform), std::move(workspace)};
}

bool Harmonics::in_lanes(const Settings& settings, const ObservedSpan& span) {
  if (settings.harmonics_method != HarmonicsMethod::exact || settings.harmonics > most_in_lanes) return false;
  const Oscillator& o = span.scene.oscillator;
  const bool of_force = settings.base_frequency == 0 ? !span.transient : settings.base_frequency == o.frequency;
  if (!of_force || !span.has_whole_turns()) return false;
  for (std::int64_t k = 0; k <= settings.harmonics; ++k) {
    const double w = static_cast<double>(k) * o.frequency;
    if (ExactHarmonics::resonates(ExactHarmonics::impedance(o.damping, w, o.stiffness))) return false;
  }
  return true;
}

Harmonics::Values Harmonics::Observer::finish(const ObservedSpan& span, double x, double v) {
  if (exact_) {
    exact_->finish(x, span.total);
    if (span.frame) exact_->add(*span.frame, span.total);
    return {Spectrum::of(exact_->displacement()), Spectrum::of(exact_->velocity()), span.base_frequency};
  }
  samples_->finish(x, v, span.total, span.periodic);
  if (span.frame) samples_->add(*span.frame);
  const std::vector<double>&displacement = samples_->displacement(), &velocity = samples_->velocity();
  const auto sums = span.fourier->transform->transform({displacement, velocity}, *span.fourier->workspace);
  return {sampled_spectrum(sums[0], displacement.size(), span.base_turns, highest_),
          sampled_spectrum(sums[1], velocity.size(), span.base_turns, highest_), span.base_frequency};
}

}  // namespace clatter::observables
