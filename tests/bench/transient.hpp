#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "point/problem.hpp"

namespace clatter::bench {

/// The results of a motion from its start to its end.
struct Transient {
  double x_min = 0.0, x_max = 0.0;
  double x = 0.0, v = 0.0;  ///< at the end

  void pass(double position) { x_min = std::min(x_min, position), x_max = std::max(x_max, position); }
};

/// Displacement and velocity.
using Phase = std::array<double, 2>;

/// x'' = f sin(nu tau + phase) - 2 h x' - x + load (eq. 3), as a user writes it for a general solver.
class Equation {
 public:
  explicit Equation(const point::Problem& scene) : of_(scene.oscillator), phase_(scene.start.phase) {}

  [[nodiscard]] double acceleration(double tau, double x, double v) const {
    return of_.forcing * std::sin(of_.frequency * tau + phase_) - 2 * of_.damping * v - x + of_.load;
  }

 private:
  Oscillator of_;
  double phase_;
};

/// The points at which a user of Boost.Odeint looks for impacts: the ends of steps, or turning points within steps too.
enum class Looks : std::uint8_t { ends, turns };

/// Boost.Odeint: Dormand and Prince's pair of orders 5 and 4, impacts on its dense output.
[[nodiscard]] Transient odeint_transient(const point::Problem& scene, double tolerance, Looks looks);

/// SUNDIALS CVODE: Adams' methods, the gaps and the velocity as root functions; only if CLATTER_CVODE is defined.
[[nodiscard]] Transient cvode_transient(const point::Problem& scene, double tolerance);

}  // namespace clatter::bench
