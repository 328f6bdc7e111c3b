#pragma once

#include <optional>

#include "scene.hpp"

namespace verify {

/// A 2 x 2 matrix, by rows.
struct Matrix {
  Ball a, b, c, d;

  friend Matrix operator*(const Matrix& p, const Matrix& q) {
    return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
  }
  [[nodiscard]] Ball determinant() const { return a * d - b * c; }
  [[nodiscard]] Matrix inverse() const {
    const Ball e = determinant();
    return {d / e, -b / e, -c / e, a / e};
  }
  [[nodiscard]] Matrix middle() const { return {a.middle(), b.middle(), c.middle(), d.middle()}; }
};

struct Vector {
  Ball x, y;

  friend Vector operator+(const Vector& p, const Vector& q) { return {p.x + q.x, p.y + q.y}; }
  friend Vector operator-(const Vector& p, const Vector& q) { return {p.x - q.x, p.y - q.y}; }
  friend Vector operator-(const Vector& p) { return {-p.x, -p.y}; }
  friend Vector operator*(const Matrix& m, const Vector& p) { return {m.a * p.x + m.b * p.y, m.c * p.x + m.d * p.y}; }
  [[nodiscard]] Vector middle() const { return {x.middle(), y.middle()}; }
};

/// The linear oscillator of one phase of the motion: free, or in contact with a soft stop (eq. 51).
class Flow {
 public:
  Flow(const Ball& h, const Ball& k, const Ball& load, const Scene& scene);

  [[nodiscard]] static Flow free(const Scene& scene) { return {scene.h, scene.k, scene.load, scene}; }
  [[nodiscard]] static Flow in_contact(const Scene& scene, const Stop& stop) {
    return {scene.h + stop.h_s, scene.k + stop.kappa, scene.load + stop.kappa * stop.position, scene};
  }

  /// Displacement and its derivatives at an instant.
  struct Instant {
    Ball x, v, a, j, d4;  ///< d4: the fourth derivative
  };
  /// The solution through a state, as a function of the time s after it.
  class Flight {
   public:
    Flight(const Flow& flow, const Ball& time, const Ball& x, const Ball& v);

    [[nodiscard]] Instant at(const Ball& s) const;
    /// The derivative of (x, v) at s by (x, v) at 0.
    [[nodiscard]] Matrix derivative(const Ball& s) const;

   private:
    /// The particular solution: x and v at s, from sine and cosine of the phase.
    [[nodiscard]] Vector particular(const Ball& s, const Ball& sine, const Ball& cosine) const;

    const Flow& flow_;
    Ball theta_;   ///< phase at s = 0
    Vector free_;  ///< (x, v) less the particular solution at s = 0
  };

  /// The steady response, the only periodic motion without an event if it has one: centre + amplitude sin(theta - lag).
  struct Response {
    Ball centre, amplitude;
    Ball in_phase, quadrature;  ///< centre + in_phase sin(theta) + quadrature cos(theta)
  };
  /// Nothing if there is none or many.
  [[nodiscard]] std::optional<Response> response() const;
  /// The derivative of (x, v) after a time by (x, v).
  [[nodiscard]] Matrix propagator(const Ball& s) const;

  /// Greatest rate at which motion changes, for the choice of a step.
  [[nodiscard]] double rate() const { return rate_; }

 private:
  /// e^(-h s) cos(lambda s) and e^(-h s) sin(lambda s)/lambda, lambda^2 = k - h^2, also if that is negative or near 0.
  [[nodiscard]] Vector rotation(const Ball& s) const;

  Ball h_, k_, f_, nu_, load_, phase_;
  Ball lambda_squared_, lambda_;  ///< k - h^2, and the root of its amount if its sign is known
  int sign_ = 0;                  ///< of k - h^2; 0: not known, or 0
  bool resonant_ = false;         ///< h = 0 and k = nu^2: there is no steady response
  Ball sine_part_, cosine_part_;  ///< P and Q of the steady response (eqs. 6 and 44)
  double rate_ = 1.0;
};

}  // namespace verify
