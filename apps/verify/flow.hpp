#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "linear.hpp"
#include "scene.hpp"

namespace verify {

/// The linear oscillator of one phase of the motion: free, or in contact with a soft stop (eq. 51). With duals all that
/// it gives are derivatives by the parameter, too.
template <class Number>
class BasicFlow {
 public:
  using Scene = BasicScene<Number>;
  using Vector = BasicVector<Number>;
  using Matrix = BasicMatrix<Number>;

  BasicFlow(const Number& h, const Number& k, const Number& load, const Scene& scene);

  [[nodiscard]] static BasicFlow free(const Scene& scene) { return {scene.h, scene.k, scene.load, scene}; }
  [[nodiscard]] static BasicFlow in_contact(const Scene& scene, const BasicStop<Number>& stop) {
    return {scene.h + stop.h_s, scene.k + stop.kappa, scene.load + stop.kappa * stop.position, scene};
  }

  /// Displacement and its derivatives at an instant.
  struct Instant {
    Number x, v, a, j, d4;  ///< d4: the fourth derivative
  };
  /// The solution through a state, as a function of the time s after it.
  class Flight {
   public:
    Flight(const BasicFlow& flow, const Number& time, const Number& x, const Number& v);

    [[nodiscard]] Instant at(const Number& s) const;
    /// The derivative of (x, v) at s by (x, v) at 0.
    [[nodiscard]] Matrix derivative(const Number& s) const;
    /// The fifth and the sixth derivative of the displacement at s, from the others.
    [[nodiscard]] std::pair<Number, Number> further(const Number& s, const Instant& there) const;

   private:
    /// The particular solution, x and v, and the force with its next two derivatives by the time.
    struct Driven {
      Vector y;
      std::array<Number, 3> force;
    };
    [[nodiscard]] Driven driven(const Number& s) const;

    const BasicFlow& flow_;
    Number theta_;  ///< phase at s = 0
    Vector free_;   ///< (x, v) less the particular solution at s = 0
  };

  /// The steady response to a force of order 1, the only periodic motion without an event if it has one: centre +
  /// amplitude sin(theta - lag).
  struct Response {
    Number centre, amplitude;
    Number in_phase, quadrature;  ///< centre + in_phase sin(theta) + quadrature cos(theta)
  };
  /// Nothing if there is none or many, or the force has other orders.
  [[nodiscard]] std::optional<Response> response() const;
  /// The derivative of (x, v) after a time by (x, v).
  [[nodiscard]] Matrix propagator(const Number& s) const;

  [[nodiscard]] const Number& damping() const { return h_; }
  [[nodiscard]] const Number& stiffness() const { return k_; }
  [[nodiscard]] const Number& load() const { return load_; }
  /// Greatest rate at which motion changes, for the choice of a step.
  [[nodiscard]] double rate() const { return rate_; }

 private:
  /// e^(-h s) cos(lambda s) and e^(-h s) sin(lambda s)/lambda, lambda^2 = k - h^2, also if that is negative or near 0.
  [[nodiscard]] Vector rotation(const Number& s) const;

  /// The response to an order of the force.
  struct Part {
    BasicOrder<Number> force;
    Number nu;              ///< its frequency
    bool resonant = false;  ///< h = 0 and k = nu^2: there is no steady response
    Number sine, cosine;    ///< P and Q of that (eqs. 6 and 44)

    /// x and v a time s after the phase that a flight begins with.
    [[nodiscard]] Vector at(const Number& s, const Number& sine_then, const Number& cosine_then) const;
  };
  [[nodiscard]] Part part_of(const BasicOrder<Number>& order) const;
  /// x and v that the load alone gives a mass after a time.
  [[nodiscard]] Vector loaded(const Number& s) const;

  Number h_, k_, nu_, load_, phase_;
  std::vector<Part> parts_;
  Number lambda_squared_, lambda_;  ///< k - h^2, and the root of its amount if its sign is known
  int sign_ = 0;                    ///< of k - h^2; 0: not known, or 0
  double rate_ = 1.0;
};

extern template class BasicFlow<Ball>;
extern template class BasicFlow<Dual>;

using Flow = BasicFlow<Ball>;

}  // namespace verify
