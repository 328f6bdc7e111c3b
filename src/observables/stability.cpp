#include "observables/stability.hpp"

#include <cstdint>

namespace clatter::observables {

std::vector<Column<Stability::Values>> Stability::columns(const Settings&) {
  const Coordinate multiplier{"multiplier", 2, std::vector<std::int8_t>{1, 2},
                              "number of the multiplier, 1: the larger modulus"};
  return {pair("multiplier_re", "real part of the period's multipliers", multiplier, &Values::multiplier_re),
          pair("multiplier_im", "imaginary part of the period's multipliers", multiplier, &Values::multiplier_im),
          in_si("largest Lyapunov exponent",
                scalar("lyapunov", "largest Lyapunov exponent per tau", &Values::lyapunov, Quantity::rate))};
}

}  // namespace clatter::observables
