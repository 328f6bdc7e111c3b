#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "observables/harmonics/fourier_transform.hpp"
#include "observables/harmonics/spectrum.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

enum class HarmonicsMethod : std::uint8_t { fft, exact };

/// Amplitude and phase of the constant part and the harmonics of displacement and velocity, from samples or from the
/// arcs themselves.
struct Harmonics {
  struct Settings {
    std::int64_t harmonics = 0;  ///< highest harmonic K, 0: none observed
    HarmonicsMethod harmonics_method = HarmonicsMethod::fft;
    bool loose_harmonics = false;           ///< with them: those of the place of a loose mass
    std::int64_t harmonics_samples = 4096;  ///< FFT samples over the observed time
    double base_frequency = 0.0;            ///< of harmonics; 0: the force's, without forcing the motion's own
  };
  struct Values {
    Spectrum x_spectrum{}, v_spectrum{};  ///< shape [harmonic]
    Spectrum z_spectrum{}, w_spectrum{};  ///< shape [harmonic]: of the place of a loose mass in its housing, and of z'
    double base_frequency = no_value;
  };

  static constexpr std::array<std::string_view, 2> methods{"fft", "exact"};  ///< in the order of HarmonicsMethod
  static constexpr std::string_view observed = "harmonics = 3\n";
  static constexpr std::tuple fields{
      Field{Key{"observe",
                "harmonics",
                Kind::integer,
                "0",
                "3",
                "constant part and amplitudes 1 ... K of x and of x', with a loose mass of its place z and of z', too; "
                "0: none",
                {.low = 0, .high = 1e5}},
            &Settings::harmonics},
      Field{with(observed, one_of(methods, Key{"observe", "harmonics_method", Kind::choice, "fft", "exact",
                                               "fft: from samples, by FFTW; exact: from the arcs, without aliasing"})),
            &Settings::harmonics_method},
      Field{with(observed, Key{"observe",
                               "harmonics_samples",
                               Kind::integer,
                               "4096",
                               "8192",
                               "FFT samples over the observed time",
                               {.low = 2, .high = 16777216}}),
            &Settings::harmonics_samples}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.harmonics > 0; }
  [[nodiscard]] static bool from_samples(const Settings& settings) {
    return wanted(settings) && settings.harmonics_method == HarmonicsMethod::fft;
  }
  [[nodiscard]] static std::string description(const Settings& settings) {
    return "harmonics 0 ... " + std::to_string(settings.harmonics) +
           (from_samples(settings) ? " by FFT of " + std::to_string(settings.harmonics_samples) + " samples"
                                   : " from the arcs");
  }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings);
  /// Of the harmonics, the constant part among them.
  [[nodiscard]] static std::size_t count_of(const Settings& settings) {
    return static_cast<std::size_t>(settings.harmonics) + 1;
  }

  /// Each point's rows of samples of x and v, and of their sums, with a loose mass of samples of z and z', too; the
  /// factors of the transform are common to all.
  [[nodiscard]] static double values_held(const Settings& settings, int points) {
    const int rows = settings.loose_harmonics ? 6 : 4;
    return from_samples(settings) ? (rows * points + 1) * static_cast<double>(settings.harmonics_samples) : 0.0;
  }
  /// The transform and a thread's memory for it, if samples are taken. Throws std::bad_alloc.
  [[nodiscard]] static FourierScratch scratch_for(const Settings& settings);

  static constexpr std::int64_t most_in_lanes = 8;  ///< the highest harmonic that lanes sum
  /// Lanes sum the jumps of the velocity at impacts: for the exact method, the force's own frequency, harmonics of it
  /// that nothing resonates with; over whole forcing periods. The base frequency of a transient is its own unless it is
  /// given.
  [[nodiscard]] static bool in_lanes(const Settings& settings, const ObservedSpan& span);

  class Observer;  ///< in harmonics_observer.hpp
};

}  // namespace clatter::observables
