#pragma once

#include <cstdint>

namespace clatter::observables {

enum class HarmonicsMethod : std::uint8_t { fft, exact };

/// What is computed and stored; nothing else is.
struct Observe {
  bool extrema = false;
  std::int64_t harmonics = 0;  ///< highest harmonic K, 0: none observed
  HarmonicsMethod harmonics_method = HarmonicsMethod::fft;
  std::int64_t harmonics_samples = 4096;  ///< FFT samples over the observed time
  double base_frequency = 0.0;            ///< of harmonics; 0: the force's, without forcing the motion's own
  bool impacts = false;
  bool impact_log = false;
  bool full_log = false;        ///< with the impact log: every rest and completed chatter, and an impact at t0 itself
  std::int64_t trajectory = 0;  ///< samples over the observed time, both ends included; 0: none
  bool period = false;
  bool stability = false;
};

}  // namespace clatter::observables
