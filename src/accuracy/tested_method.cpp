#include "accuracy/tested_method.hpp"

#include <cmath>
#include <limits>

namespace clatter::accuracy {
namespace {

/// Adds trials at the settings 10^-first ... 10^-last.
void add_decades(std::vector<Trial>& trials, TestedMethod method, int first, int last) {
  for (int digits = first; digits <= last; ++digits) trials.push_back({method, 1 / std::pow(10.0, digits)});
}

}  // namespace

std::vector<Trial> trials_of(steady::Mode mode, lanes::InstructionSet arch) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool lanes = arch != lanes::InstructionSet::scalar;
  std::vector<Trial> trials{{TestedMethod::exact, none}};
  if (lanes) trials.push_back({TestedMethod::exact, none, arch});
  add_decades(trials, TestedMethod::dopri5, 3, 13);
  add_decades(trials, TestedMethod::moreau, 1, 5);
  trials.push_back({TestedMethod::harmonics_exact, none});
  for (int power = 4; power <= 20; ++power) trials.push_back({TestedMethod::harmonics_fft, std::ldexp(1.0, power)});
  if (mode == steady::Mode::transient) return trials;
  add_decades(trials, TestedMethod::steady, 3, 14);
  if (lanes) trials.push_back({TestedMethod::steady, 1e-12, arch});
  add_decades(trials, TestedMethod::steady_repetition, 3, 14);
  return trials;
}

}  // namespace clatter::accuracy
