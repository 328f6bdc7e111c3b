#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "hard/machine.hpp"
#include "hard/machine_series.hpp"

namespace clatter::hard::machine {

/// The motion of a stop by itself: b sin(nu tau + phase) about its place.
struct StopMotion {
  Quad amplitude = 0, frequency = 1, phase = 0;  ///< b, 0: it stands; nu

  [[nodiscard]] bool moves() const { return amplitude != 0; }
  [[nodiscard]] Quad place(Quad time) const { return wave(amplitude, 0, time, 0)[0]; }
  [[nodiscard]] Quad speed(Quad time) const { return wave(0, frequency * amplitude, time, 0)[0]; }
  /// The Taylor series of the place over a step, by parts of it.
  [[nodiscard]] Series series(Quad time, Quad step) const { return wave(amplitude, 0, time, step); }
  /// That of the force of inertia, damper and spring on a mass, 1, whose place counts from the stop.
  [[nodiscard]] Series push(Quad damping, Quad stiffness, Quad time, Quad step) const {
    return wave((frequency * frequency - stiffness) * amplitude, -2 * damping * frequency * amplitude, time, step);
  }
  /// The largest of these three, together.
  [[nodiscard]] Quad push_size(Quad damping, Quad stiffness) const {
    return size_of(amplitude) * (frequency * frequency + 2 * damping * frequency + size_of(stiffness));
  }

 private:
  /// Of a sine and a cosine with these factors.
  [[nodiscard]] Series wave(Quad of_sine, Quad of_cosine, Quad time, Quad step) const {
    Series sum{};
    if (!moves()) return sum;
    const Quad angle = frequency * time + phase, sine = sinq(angle), cosine = cosq(angle);
    const std::array<Quad, 4> derivatives{sine, cosine, -sine, -cosine};
    Quad factor = 1;  // (nu step)^n / n!
    for (std::size_t n = 0; n < terms && factor != 0; ++n) {
      sum[n] = factor * (of_sine * derivatives[n % 4] + of_cosine * derivatives[(n + 1) % 4]);
      factor *= frequency * step / number(n + 1);
    }
    return sum;
  }
};

/// How a stop or a wall throws back.
struct Rebound {
  Quad R;
  Law law;

  /// The share of a speed that an impact leaves.
  [[nodiscard]] Quad share(Quad speed) const {
    if (speed < law.below) return 0;
    if (!law.knots.empty()) return share_by_knots(speed);
    if (law.exponent == 0) return R;
    const Quad p = law.exponent;
    return std::max(1 - (1 - R) * powq(speed / law.reference, p), p / (1 + p));
  }
  [[nodiscard]] Quad share_by_knots(Quad speed) const {
    const Law::Knot* slower = nullptr;
    for (const Law::Knot& knot : law.knots) {
      const Quad above = Quad(knot.speed) * Quad(law.unit) - speed;
      if (above >= 0 && slower == nullptr) return knot.R;
      if (above >= 0) {
        const Quad below = speed - Quad(slower->speed) * Quad(law.unit);
        return (slower->R * above + knot.R * below) / (above + below);
      }
      slower = &knot;
    }
    return slower->R;
  }
};
/// A stop or a wall.
struct Contact {
  bool exists, is_soft;
  Quad place;
  Rebound rebound;
  Quad kappa, damper;
  StopMotion motion{};
};
[[nodiscard]] inline Contact contact(double place, Rebound rebound, double kappa, double zeta, Quad mass = 1,
                                     StopMotion motion = {}) {
  const bool is_soft = std::isfinite(kappa);
  return {std::isfinite(place),
          is_soft,
          place,
          std::move(rebound),
          is_soft ? kappa : 0,
          is_soft ? 2 * Quad(zeta) * sqrtq(kappa * mass) : 0,
          motion};
}

}  // namespace clatter::hard::machine
