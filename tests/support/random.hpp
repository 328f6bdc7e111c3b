#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace clatter::support {

/// Random numbers for the i-th of a family of test scenes: any scene can be drawn again without those before it.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t i) : engine_(seed ^ (0x9e3779b97f4a7c15u * (i + 1))) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  double logarithmic(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  double sign() { return uniform(0, 1) < 0.5 ? -1 : 1; }
  bool happens(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace clatter::support
