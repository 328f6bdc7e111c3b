#include "sweep/rounding_fingerprint.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "observables/harmonics/fourier_transform.hpp"

namespace clatter::sweep {
namespace {

/// FNV-1a over the bits of numbers.
class Digest {
 public:
  void add(double value) { state_ = (state_ ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3U; }
  [[nodiscard]] std::string text() const {
    std::array<char, 9> text{};
    std::snprintf(text.data(), text.size(), "%08x", static_cast<unsigned>(state_ ^ state_ >> 32U));
    return text.data();
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

/// Numbers from 0 to 1, evenly spread.
double sample(int i) {
  constexpr double golden = 0.6180339887498949;
  return i * golden - std::floor(i * golden);
}

/// Two implementations of a function round differently at about one argument in some hundreds.
void add_functions(Digest& digest) {
  for (int i = 0; i < 1024; ++i) {
    const double x = sample(i), angle = 40 * (x - 0.5);
    digest.add(std::sin(angle)), digest.add(std::cos(angle)), digest.add(std::tan(angle));
    digest.add(std::exp(-20 * x)), digest.add(std::expm1(-x)), digest.add(std::log(x + 1e-3)),
        digest.add(std::log1p(x));
    digest.add(std::atan2(x - 0.3, sample(i + 1) - 0.5)), digest.add(std::hypot(x, 3 * x - 1));
    digest.add(std::sinh(x)), digest.add(std::cosh(x)), digest.add(std::pow(x, 1.7));
  }
}

void add_transform(Digest& digest) {
  constexpr std::size_t size = 512;
  const observables::FourierTransform transform(size);
  const auto workspace = transform.workspace();
  const auto [x, v] = transform.samples(*workspace);
  for (std::size_t i = 0; i < size; ++i) x[i] = sample(static_cast<int>(i)), v[i] = sample(static_cast<int>(i + size));
  for (const auto& row : transform.transform(*workspace))
    for (const std::complex<double>& value : row) digest.add(value.real()), digest.add(value.imag());
}

}  // namespace

std::string rounding_fingerprint(const Sweep& sweep, lanes::InstructionSet arch) {
  Digest digest;
  add_functions(digest);
  if (observables::Harmonics::from_samples(sweep.problem.observe)) add_transform(digest);
  return std::string(name_of_bits(arch)).append(", functions ").append(digest.text());
}

}  // namespace clatter::sweep
