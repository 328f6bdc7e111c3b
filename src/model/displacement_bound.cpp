#include "model/displacement_bound.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "math/number.hpp"
#include "model/response.hpp"

namespace clatter {
inline namespace model {
namespace {

using Complex = std::complex<double>;

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

/// lambda = (1 - h^2)^(1/2) of light damping.
double root_of(const Oscillator& oscillator) { return std::sqrt((1 - oscillator.damping) * (1 + oscillator.damping)); }

bool rotates(const Oscillator& oscillator) { return oscillator.damping > 0 && oscillator.damping < 1; }

/// B of the transient Im(B e^{(-h + i lambda) t}), the T of eq. 19.
Complex rotation(const Oscillator& oscillator, const PhasePoint& transient) {
  return {(transient.v + oscillator.damping * transient.x) / root_of(oscillator), transient.x};
}

/// Bound of |R + B e^{(-h + i delta) t}| for all t >= 0 (eq. 19). In each part of the first turn the second term is at
/// most as long as at the beginning of the part; the modulus is convex in that length, so no more than with this length
/// or without the term; later turns repeat the angles with shorter lengths. `slack` bounds the relative error of delta
/// and the error of the angles. Infinite as soon as it exceeds `most`.
double beat_bound(const Complex& R, const Complex& B, double h, double delta, double most) {
  constexpr int parts = 48;
  constexpr double slack = 1e-4;
  const double scale = std::abs(R) + std::abs(B);  // divided out, so that squares neither overflow nor vanish
  const double steady = std::abs(R) / scale, whole = std::abs(B) / scale, part = 2 * std::acos(-1.0) / parts;
  const double decay = std::exp(-h * part / (std::abs(delta) * (1 + slack)));
  const Complex turn = std::polar(1.0, part), begin = std::polar(1.0, std::arg(B) - std::arg(R));
  Complex from = delta > 0 ? begin : std::conj(begin);
  double square = steady * steady, length = whole;
  const double most_square = (most / scale) * (most / scale);
  for (int i = 0; i < parts; ++i) {
    const Complex to = from * turn;
    const bool aligned = from.real() > 0 && from.imag() <= slack && to.imag() >= -slack;
    const double cosine = aligned ? 1.0 : std::max(from.real(), to.real()) + slack;
    square = std::max(square, steady * steady + length * length + 2 * steady * length * cosine);
    if (square > most_square) return std::numeric_limits<double>::infinity();
    from = to, length *= decay;
  }
  return (std::sqrt(square) + rounding) * scale;
}

/// From the load's equilibrium to the nearer stop.
double gap_of(const Oscillator& oscillator, const Stops& stops) {
  return std::min(oscillator.load - stops.lower, stops.upper - oscillator.load);
}

}  // namespace

PhasePoint response_at(const Oscillator& oscillator, double sine, double cosine) {
  const double nu = oscillator.frequency;
  const auto [P, Q, amplitude] = steady_response(oscillator.damping, oscillator.forcing, nu);
  if (amplitude == 0) return {0, 0};
  return {P * sine + Q * cosine, nu * (P * cosine - Q * sine)};
}

PhasePoint transient_of(const Oscillator& oscillator, const PhaseState& now) {
  const PhasePoint response = response_at(oscillator, now.sine, now.cosine);
  return {now.x - response.x, now.v - response.v};
}

double transient_bound(const Oscillator& oscillator, const PhasePoint& transient, double after) {
  const double h = oscillator.damping, energy = norm(transient.x, transient.v);
  if (h == 0) return energy;
  if (rotates(oscillator)) return std::min(energy, std::abs(rotation(oscillator, transient)) * std::exp(-h * after));
  // e^{-slow t} [x + (v + slow x) (1 - e^{-2 lambda t})/(2 lambda)], the last factor being at most t
  const double root = std::sqrt((h - 1) * (h + 1)), slow = 1 / (h + root), decay = std::exp(-slow * after);
  const double longest = std::max(after, 1 / slow);  // the t >= after at which t e^{-slow t} is greatest
  const double creep = std::min(longest * std::exp(-slow * longest), decay / (2 * root));
  return std::min(energy, decay * std::abs(transient.x) + std::abs(transient.v + slow * transient.x) * creep);
}

double fading_time(const Oscillator& oscillator, const PhasePoint& transient, double most) {
  const double h = oscillator.damping;
  if (norm(transient.x, transient.v) <= most) return 0;
  if (h == 0) return std::numeric_limits<double>::infinity();
  if (rotates(oscillator)) return std::max(0.0, std::log(std::abs(rotation(oscillator, transient)) / most) / h);
  // for t >= 1/slow the bound is e^{-slow t} (|x| + |v + slow x| min(t, 1/(2 lambda))): solved for the exponent's t
  const double root = std::sqrt((h - 1) * (h + 1)), slow = 1 / (h + root);
  const double begin = std::abs(transient.x), creep = std::abs(transient.v + slow * transient.x);
  double time = 1 / slow;
  for (int i = 0; i < 8; ++i)
    time = std::max(1.0, std::log((begin + creep * std::min(time, 1 / (2 * root))) / most)) / slow;
  return time;
}

double displacement_bound_through_impacts(const Oscillator& oscillator, const PhaseState& now, double duration) {
  const double push = oscillator.forcing == 0 ? 0.0 : std::abs(oscillator.forcing) * duration;
  const double bound = (norm(now.x, now.v) + push) * (1 + rounding);
  return bound >= 0 && oscillator.damping >= 0 ? bound : std::numeric_limits<double>::infinity();
}

double displacement_bound(const Oscillator& oscillator, const PhaseState& now, double duration, double enough) {
  const auto response = steady_response(oscillator.damping, oscillator.forcing, oscillator.frequency);
  const PhasePoint transient = transient_of(oscillator, now);
  double bound = std::numeric_limits<double>::infinity();
  if (!(oscillator.damping >= 0)) return bound;
  const auto improve = [&](double other) {
    if (other * (1 + rounding) < bound) bound = other * (1 + rounding);  // a NaN is no improvement
  };
  improve(response.amplitude + transient_bound(oscillator, transient) + rounding * response.amplitude);
  improve(displacement_bound_through_impacts(oscillator, now, duration));
  if (bound < enough || !rotates(oscillator) || !(response.amplitude > 0)) return bound;
  const Complex theta(now.cosine, now.sine), R = Complex(response.in_phase, response.quadrature) * theta;
  const double h = oscillator.damping, detuning = (oscillator.frequency - 1) + h * h / (1 + root_of(oscillator));
  const double most = enough > 0 ? enough : std::numeric_limits<double>::infinity();
  if (std::abs(detuning) > 1e-10) improve(beat_bound(R, rotation(oscillator, transient), h, -detuning, most));
  return bound;
}

bool response_meets(const Oscillator& oscillator, const Stops& stops) {
  const auto response = steady_response(oscillator.damping, oscillator.forcing, oscillator.frequency);
  return !(response.amplitude < gap_of(oscillator, stops));
}

bool out_of_reach(const Oscillator& oscillator, const PhaseState& now, const Stops& stops) {
  if (response_meets(oscillator, stops)) return false;  // cheap to check first
  const double gap = gap_of(oscillator, stops);
  return displacement_bound(oscillator, now, std::numeric_limits<double>::infinity(), gap) < gap;
}

}  // namespace model
}  // namespace clatter
