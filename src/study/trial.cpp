#include "study/trial.hpp"

#include <cmath>
#include <limits>

namespace clatter {
namespace {

/// 10^-first ... 10^-last.
void add_decades(std::vector<Trial>& trials, Studied studied, int first, int last) {
  for (int digits = first; digits <= last; ++digits) trials.push_back({studied, 1 / std::pow(10.0, digits)});
}

}  // namespace

std::vector<Trial> trials_of(Mode mode, Arch arch) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool lanes = arch != Arch::scalar;
  std::vector<Trial> trials{{Studied::exact, none}};
  if (lanes) trials.push_back({Studied::exact, none, arch});
  add_decades(trials, Studied::dopri5, 3, 13);
  add_decades(trials, Studied::moreau, 1, 5);
  trials.push_back({Studied::harmonics_exact, none});
  for (int power = 4; power <= 20; ++power) trials.push_back({Studied::harmonics_fft, std::ldexp(1.0, power)});
  if (mode == Mode::transient) return trials;
  add_decades(trials, Studied::steady, 3, 14);
  if (lanes) trials.push_back({Studied::steady, 1e-12, arch});
  add_decades(trials, Studied::steady_repetition, 3, 14);
  return trials;
}

}  // namespace clatter
