#include "dynamics/reach.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "dynamics/response.hpp"
#include "numbers/number.hpp"

namespace clatter {
namespace {

using Complex = std::complex<double>;

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

/// lambda = (1 - h^2)^(1/2) of light damping.
double root_of(const Oscillator& oscillator) { return std::sqrt((1 - oscillator.damping) * (1 + oscillator.damping)); }

bool rotates(const Oscillator& oscillator) { return oscillator.damping > 0 && oscillator.damping < 1; }

/// B of the transient Im(B e^{(-h + i lambda) t}).
Complex rotation(const Oscillator& oscillator, const PhasePoint& transient) {
  return {(transient.v + oscillator.damping * transient.x) / root_of(oscillator), transient.x};
}

/// Bound of |R + B e^{(-h + i delta) t}| for all t >= 0. In each part of the first turn the length of the second term
/// lies between its values at the ends, the modulus is convex in it, and so greatest at one of them; later turns
/// repeat the angles with shorter lengths. `slack` is what delta, relative, and the angles may be off by.
double beat_bound(const Complex& R, const Complex& B, double h, double delta) {
  constexpr int parts = 48;
  constexpr double slack = 1e-4;
  const double steady = std::abs(R), whole = std::abs(B), part = 2 * std::acos(-1.0) / parts;
  const double decay = std::exp(-h * part / (std::abs(delta) * (1 + slack)));
  const Complex turn = std::polar(1.0, part), between = B * std::conj(R) / (whole * steady);
  Complex from = delta > 0 ? between : std::conj(between);
  double square = steady * steady, length = whole;
  for (int i = 0; i < parts; ++i) {
    const Complex to = from * turn;
    const bool aligned = from.real() > 0 && from.imag() <= slack && to.imag() >= -slack;
    const double cosine = aligned ? 1.0 : std::max(from.real(), to.real()) + slack, shorter = length * decay;
    for (const double l : {length, shorter})
      square = std::max(square, steady * steady + l * l + 2 * steady * l * cosine);
    from = to, length = shorter;
  }
  return std::sqrt(square) + rounding * (steady + whole);
}

}  // namespace

PhasePoint response_at(const Oscillator& oscillator, double sine, double cosine) {
  const double nu = oscillator.frequency;
  const auto [P, Q, amplitude] = steady_response(oscillator.damping, oscillator.forcing, nu);
  if (amplitude == 0) return {0, 0};
  return {P * sine + Q * cosine, nu * (P * cosine - Q * sine)};
}

PhasePoint transient_of(const Oscillator& oscillator, const Instant& now) {
  const PhasePoint response = response_at(oscillator, now.sine, now.cosine);
  return {now.x - response.x, now.v - response.v};
}

double transient_bound(const Oscillator& oscillator, const PhasePoint& transient) {
  const double energy = norm(transient.x, transient.v);
  if (!rotates(oscillator)) return energy;
  const double rotating = std::abs(rotation(oscillator, transient));
  return rotating < energy ? rotating : energy;
}

double decay_over(const Oscillator& oscillator, double time) {
  const double h = oscillator.damping;
  return std::exp(-time * (h <= 1 ? h : 1 / (h + std::sqrt((h - 1) * (h + 1)))));
}

double reach_through_impacts(const Oscillator& oscillator, const Instant& now, double duration) {
  const double push = oscillator.forcing == 0 ? 0.0 : std::abs(oscillator.forcing) * duration;
  const double bound = (norm(now.x, now.v) + push) * (1 + rounding);
  return bound >= 0 ? bound : std::numeric_limits<double>::infinity();
}

double reach_of(const Oscillator& oscillator, const Instant& now, double duration, double enough) {
  const auto response = steady_response(oscillator.damping, oscillator.forcing, oscillator.frequency);
  const PhasePoint transient = transient_of(oscillator, now);
  double bound = std::numeric_limits<double>::infinity();
  const auto improve = [&](double other) {
    if (other * (1 + rounding) < bound) bound = other * (1 + rounding);  // a NaN is no improvement
  };
  improve(response.amplitude + transient_bound(oscillator, transient) + rounding * response.amplitude);
  improve(reach_through_impacts(oscillator, now, duration));
  if (bound < enough || !rotates(oscillator) || !(response.amplitude > 0)) return bound;
  const Complex theta(now.cosine, now.sine), R = Complex(response.in_phase, response.quadrature) * theta;
  const double h = oscillator.damping, detuning = (oscillator.frequency - 1) + h * h / (1 + root_of(oscillator));
  if (std::abs(detuning) > 1e-10) improve(beat_bound(R, rotation(oscillator, transient), h, -detuning));
  return bound;
}

}  // namespace clatter
