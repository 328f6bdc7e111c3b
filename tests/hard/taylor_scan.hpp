#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/oscillator.hpp"

namespace clatter::hard {

/// Computes an arc by Taylor steps of eq. 3 in long double, scanning each step's polynomial: shares no formula with the
/// program, and proves nothing, but examines every step.
class TaylorScan {
 public:
  using Real = long double;

  /// Motion at an instant, the displacement counted from an anchor.
  struct PhaseState {
    Real offset, v, sine, cosine;
  };

  /// The end of a flight, and its extreme offsets.
  struct Flight {
    PhaseState end;
    Real lowest, highest;  ///< of the offset, or of the offset plus a time times the velocity
  };

  TaylorScan(const Oscillator& oscillator, double anchor) : TaylorScan(oscillator, anchor, 0, 0) {}

  /// Of motion in contact with a soft stop of stiffness kappa and damping ratio zeta, anchored on it (eq. 51).
  TaylorScan(const Oscillator& oscillator, double anchor, double kappa, double zeta)
      : TaylorScan(oscillator.damping + zeta * std::sqrt(static_cast<Real>(kappa)), oscillator.forcing,
                   oscillator.frequency, static_cast<Real>(oscillator.stiffness) + kappa,
                   static_cast<Real>(oscillator.load) - static_cast<Real>(oscillator.stiffness) * anchor) {}

  /// From h, f, nu, k and the constant force at the anchor.
  TaylorScan(Real h, Real f, Real nu, Real k, Real pull)
      : h_(h),
        f_(f),
        nu_(nu),
        k_(k),
        pull_(pull),
        rate_(std::max({std::sqrt(std::abs(k_)), 2 * h_, f_ == 0 ? Real(0) : nu_, Real(0.01)})) {}

  /// The fastest that the motion changes.
  [[nodiscard]] Real rate() const { return rate_; }

  /// The extremes are those of the offset plus a time q times the velocity.
  [[nodiscard]] Flight fly(const PhaseState& start, double length, Real q = 0) const {
    Flight flight{start, start.offset + q * start.v, start.offset + q * start.v};
    const auto steps = static_cast<long>(std::ceil(length * rate_));  // 1/24! is far below rounding
    if (steps == 0) return flight;
    const Real step = static_cast<Real>(length) / static_cast<Real>(steps);
    const int looks = std::max(4, static_cast<int>(std::ceil(16 * step * rate_)));
    const Real sine = std::sin(nu_ * step), cosine = std::cos(nu_ * step);
    for (long i = 0; i < steps; ++i) {
      const PhaseState& m = flight.end;
      const Series c = series(m, step);
      look(q == 0 ? c : with_velocity(c, q / step), looks, flight);
      const Jet last = jet(c, 1);
      flight.end = {last[0], last[1] / step, m.sine * cosine + m.cosine * sine, m.cosine * cosine - m.sine * sine};
    }
    return flight;
  }

 private:
  static constexpr std::size_t order = 24;
  using Series = std::array<Real, order + 1>;  ///< offset over a step, by powers of its part that has passed
  using Jet = std::array<Real, 4>;             ///< value and first three derivatives

  /// The series by the recurrence of eq. 3, together with that of the force.
  [[nodiscard]] Series series(const PhaseState& m, Real d) const {
    static const std::array<Real, order> inverse = [] {
      std::array<Real, order> table{};
      for (std::size_t k = 0; k + 1 < order; ++k) table[k] = 1 / static_cast<Real>((k + 1) * (k + 2));
      return table;
    }();
    const Real square = d * d, friction = 2 * h_ * d, turn = nu_ * d;
    Series c{m.offset, m.v * d};
    Real force = f_ * square, drive = m.sine, next = m.cosine;
    for (std::size_t k = 0; k + 2 <= order; ++k) {
      const auto n = static_cast<Real>(k + 1);
      c[k + 2] = (force * drive - friction * n * c[k + 1] - square * (k_ * c[k] - (k == 0 ? pull_ : 0))) * inverse[k];
      force *= turn / n;
      const Real after = -drive;
      drive = next, next = after;
    }
    return c;
  }

  /// The series of the offset plus q times its derivative.
  [[nodiscard]] static Series with_velocity(Series c, Real q) {
    for (std::size_t k = 0; k < order; ++k) c[k] += q * static_cast<Real>(k + 1) * c[k + 1];
    return c;
  }

  [[nodiscard]] static Jet jet(const Series& c, Real u) {
    Real y = c[order], v = 0, a = 0, j = 0;
    for (std::size_t k = order; k-- > 0;) j = j * u + a, a = a * u + v, v = v * u + y, y = y * u + c[k];
    return {y, v, 2 * a, 6 * j};
  }

  /// The zero of a derivative that changes sign between two points, by Newton's iteration within a bracket.
  template <std::size_t derivative>
  [[nodiscard]] static Real turn(const Series& c, Real low, Real high) {
    const bool rises = jet(c, high)[derivative] > 0;
    Real u = (low + high) / 2;
    for (int i = 0; i < 60; ++i) {
      const Jet y = jet(c, u);
      ((y[derivative] > 0) == rises ? high : low) = u;
      Real next = u - y[derivative] / y[derivative + 1];
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (std::abs(next - u) < Real(1e-12)) return next;
      u = next;
    }
    return u;
  }

  static void include(Real offset, Flight& flight) {
    flight.lowest = std::min(flight.lowest, offset), flight.highest = std::max(flight.highest, offset);
  }

  /// Examines points of a step, its turning points, and pairs of turning points between two of these points: in between
  /// the extremum of the velocity has the other sign.
  static void look(const Series& c, int looks, Flight& flight) {
    Jet left = jet(c, 0);
    for (int i = 1; i <= looks; ++i) {
      const Real from = static_cast<Real>(i - 1) / static_cast<Real>(looks),
                 to = static_cast<Real>(i) / static_cast<Real>(looks);
      const Jet right = jet(c, to);
      include(right[0], flight);
      if (left[1] * right[1] < 0) {
        include(jet(c, turn<1>(c, from, to))[0], flight);
      } else if (left[2] * right[2] < 0) {
        const Real middle = turn<2>(c, from, to);
        if (jet(c, middle)[1] * left[1] < 0) {
          include(jet(c, turn<1>(c, from, middle))[0], flight);
          include(jet(c, turn<1>(c, middle, to))[0], flight);
        }
      }
      left = right;
    }
  }

  Real h_, f_, nu_, k_;
  Real pull_;  ///< of the load and the spring, at the anchor
  Real rate_;  ///< the fastest that the motion changes
};

}  // namespace clatter::hard
