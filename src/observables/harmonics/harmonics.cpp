#include "observables/harmonics/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "observables/harmonics/harmonics_observer.hpp"

namespace clatter::observables {
namespace {

constexpr double nan = no_value;

/// The harmonics of a base frequency that turns `turns` times in an observed time of `count` samples; `harmonic(k, i)`
/// is the k-th, the i-th of the transform. NaN from half the sampling rate on; all, the constant part too, if the base
/// frequency itself is beyond it.
template <class Harmonic>
Spectrum sampled_spectrum(std::size_t count, double turns, std::size_t highest, const Harmonic& harmonic) {
  std::vector<std::complex<double>> harmonics(highest + 1, {nan, nan});
  for (std::size_t k = 0; k <= highest; ++k) {
    const double index = std::round(turns * static_cast<double>(k)), needed = std::max(index, turns);
    if (2 * needed < static_cast<double>(count)) harmonics[k] = harmonic(k, static_cast<std::size_t>(index));
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
  constexpr std::string_view beyond = "the harmonic is above half the rate of the samples (method fft)",
                             constant = "it is that of the constant part, or above half the rate of the samples";
  std::vector<Column<Values>> all;
  const auto add = [&](const std::string& letter, const std::string& words, Quantity quantity,
                       Spectrum Values::*spectrum) {
    const auto of = [&](const char* part_name, const std::string& long_name, Quantity unit,
                        std::vector<double> Spectrum::*part) {
      return series<Values>(
          letter + part_name, long_name, unit, harmonic,
          [spectrum, part](const Values& v) -> const std::vector<double>& { return v.*spectrum.*part; });
    };
    all.push_back(
        missing_if(beyond, of("_amplitude", "amplitude of the harmonics of " + words, quantity, &Spectrum::amplitude)));
    all.push_back(missing_if(constant, of("_phase", "phase of the harmonics of " + words + " at tau = 0",
                                          Quantity::angle, &Spectrum::phase)));
  };
  add("x", "displacement", Quantity::length, &Values::x_spectrum);
  add("v", "velocity", Quantity::velocity, &Values::v_spectrum);
  for (Column<Values>& column : all) column = in_observed_frame(std::move(column));
  if (settings.loose_harmonics) {
    add("z", "the place in the housing", Quantity::length, &Values::z_spectrum);
    add("w", "the velocity over the housing", Quantity::velocity, &Values::w_spectrum);
  }
  all.push_back(scalar("base_frequency", "frequency whose multiples the harmonics are", &Values::base_frequency,
                       Quantity::frequency));
  return all;
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
  return exact_ ? finish_exact(span, x) : finish_samples(span, x, v);
}

Harmonics::Values Harmonics::Observer::finish_exact(const ObservedSpan& span, double x) {
  exact_->finish(x, span.total);
  if (span.frame) exact_->add(*span.frame, span.total);
  const auto spectrum = [&](const std::vector<std::complex<double>>& harmonics) {
    if (!samples_) return Spectrum::of(harmonics);
    return sampled_spectrum(samples_->count(), span.base_turns, highest_,
                            [&](std::size_t k, std::size_t) { return harmonics[k]; });
  };
  Values values{.x_spectrum = spectrum(exact_->displacement()),
                .v_spectrum = spectrum(exact_->velocity()),
                .base_frequency = span.base_frequency};
  if (loose_exact_) {
    ExactHarmonics& loose = loose_exact_->of();
    loose.finish(loose_exact_->last_z(), span.total);
    values.z_spectrum = spectrum(loose.displacement()), values.w_spectrum = spectrum(loose.velocity());
  }
  return values;
}

Harmonics::Values Harmonics::Observer::finish_samples(const ObservedSpan& span, double x, double v) {
  samples_->finish(x, v, span.total, span.periodic);
  if (span.frame) samples_->add(*span.frame);
  const FourierScratch& fourier = *span.fourier;
  const std::size_t count = samples_->count();
  const auto spectrum = [&](std::span<const std::complex<double>> sums) {
    return sampled_spectrum(count, span.base_turns, highest_,
                            [&](std::size_t, std::size_t i) { return sums[i] / static_cast<double>(count); });
  };
  const auto transform = [&](Spectrum& displacement, Spectrum& velocity) {
    const auto sums = fourier.transform->transform(*fourier.workspace);
    displacement = spectrum(sums[0]), velocity = spectrum(sums[1]);
  };
  Values values{.base_frequency = span.base_frequency};
  transform(values.x_spectrum, values.v_spectrum);
  if (loose_samples_) {  // in the rows of x and v, whose sums have been read
    loose_samples_->finish(span.total, span.periodic);
    const auto rows = fourier.transform->samples(*fourier.workspace);
    std::ranges::copy(loose_samples_->place(), rows[0].begin());
    std::ranges::copy(loose_samples_->velocity(), rows[1].begin());
    transform(values.z_spectrum, values.w_spectrum);
  }
  return values;
}

}  // namespace clatter::observables
