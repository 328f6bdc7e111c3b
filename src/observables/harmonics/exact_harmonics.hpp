#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "motion/arc.hpp"
#include "motion/event.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/relative_arc.hpp"
#include "observables/energy/quadrature.hpp"
#include "observables/harmonics/panel.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/shaking.hpp"

namespace clatter::observables {

/// Harmonics integrated over the arcs themselves, without samples and so without aliasing.
///
/// With w = k Omega, integrating eq. 3 by parts over an arc gives its part of the integral of x e^{-iw tau},
/// Z X = int (f sin theta + load) e^{-iw tau} - [(x' + (iw + 2h) x) e^{-iw tau}],  Z = k - w^2 + 2ihw; eq. 38
/// is their sum. If Z is small, at a resonance, the right-hand side cancels, and Gauss-Legendre quadrature takes its
/// place, exact to rounding; so it does for arcs by polynomials, which fulfil eq. 3 only to their error.
class ExactHarmonics {
 public:
  using Complex = std::complex<double>;

  /// Harmonics 0 ... K of the base frequency, over the observed time.
  ExactHarmonics(std::size_t highest, double base_frequency) : base_(base_frequency), x_(highest + 1) {}

  template <motion::Polynomial A>
  void arc(const A& arc, double begin, double length) {
    if (begins(begin)) first_x_ = arc.start().x;
    const double rate = arc.constants().rate;
    if (length * (rate + base_ * static_cast<double>(x_.size() - 1)) < 1) return short_arc(arc, begin, length);
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      x_[k] += length * (rate + w) < 1 ? quadrature<10>(arc, w, begin, length) : quadrature<20>(arc, w, begin, length);
    }
  }
  template <Effects E>
  void arc(const motion::Arc<double, E>& arc, double begin, double length) {
    const motion::Motion<double>& first = arc.start();
    const motion::Motion<double> last = arc.at(length);
    ++evaluations_;
    if (begins(begin)) first_x_ = first.x;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k), h = arc.constants().h;
      const Complex z = impedance(h, w, arc.constants().k);
      if (resonates(z) || arc.constants().is_in_pieces() || arc.constants().has_orders()) {
        x_[k] += quadrature<20>(arc, w, begin, length);
        continue;
      }
      const Complex slope(2 * h, w);
      const Complex ends =
          (last.v + slope * last.x) * turn(w * (begin + length)) - (first.v + slope * first.x) * turn(w * begin);
      x_[k] += (force(arc, w, length) * turn(w * begin) - ends) / z;
    }
  }
  /// Of the place of a loose mass in its housing: from its values, which are right to their own rounding, whatever the
  /// ways of the two masses are.
  template <Effects E>
  void arc(const motion::RelativeArc<double, E>& arc, double begin, double length) {
    if (begins(begin)) first_x_ = arc.start().x;
    evaluations_ += 20 * for_each_panel(length, pace_of(arc.constants()), 4, [&](double middle, double half) {
                      Panel here(middle, half, [&](double s) { return arc.at(s).x; });
                      for (std::size_t k = 0; k < x_.size(); ++k) {
                        const double w = base_ * static_cast<double>(k);
                        x_[k] += here.integral(w) * turn(w * (begin + middle));
                      }
                    });
  }
  /// Beside the flights, times at rest; a mass on which a loose one presses moves along an arc.
  void event(const motion::Event& event) {
    if (!event.lasts() || event.has_arc) return;
    if (begins(event.time)) first_x_ = event.place;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      x_[k] += event.place * turn(w * event.time) * wave(-w, event.length);
    }
  }

  /// All flights of whole forcing periods at once, without rest: the terms at the ends of arcs cancel but for the jumps
  /// of the velocity, whose sums with e^{-iw tau}, w = k nu, are given, shape [harmonic]. Nowhere may Z be small.
  void flights(const Oscillator& o, double phase, const PhasePoint& first, const PhasePoint& last, double total,
               std::span<const Complex> jumps) {
    first_x_ = first.x;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      const Complex slope(2 * o.damping, w), growth = (last.v - first.v) + slope * (last.x - first.x);
      Complex force = k == 0 ? o.load * total : 0.0;
      if (k == 1) force = o.forcing * total / 2 * Complex(std::sin(phase), -std::cos(phase));
      x_[k] = (force + jumps[k] - growth) / impedance(o.damping, w, o.stiffness);
    }
  }
  /// A time `total` of the steady response to the force, whole periods of it from displacement x on, base frequency nu.
  void response(const Oscillator& o, double phase, double x, double total) {
    const auto [in_phase, quadrature, amplitude] = steady_response(o);
    first_x_ = x;
    x_[0] = equilibrium_of(o) * total;
    if (x_.size() > 1) x_[1] = total / 2 * Complex(quadrature, -in_phase) * std::polar(1.0, phase);
  }
  /// Z of harmonic w.
  [[nodiscard]] static Complex impedance(double h, double w, double stiffness) {
    return {stiffness - w * w, 2 * h * w};
  }
  /// Whether Z is so small that quadrature has to take the place of a division by it.
  [[nodiscard]] static bool resonates(const Complex& z) { return std::norm(z) < 1.0 / 64; }

  /// Ends the observed time, of length `total`, at displacement x.
  void finish(double x, double total) {
    v_.resize(x_.size());
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      x_[k] /= total;
      v_[k] = Complex(0, w) * x_[k] + (x * turn(w * total) - first_x_) / total;
    }
  }
  /// Adds the harmonics of a frame's motion over the observed time, once that has ended.
  void add(const FrameMotion& frame, double total) {
    const double nu = frame.frequency();
    const SineCosine<double> first = frame.at(0.0);  // b sin = (rising + falling)/2, each turning one way
    const Complex rising(frame.displacement(first), -frame.velocity(first) / nu), falling = std::conj(rising);
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      const Complex up = rising * wave(nu - w, total) / (2 * total),
                    down = falling * wave(-nu - w, total) / (2 * total);
      x_[k] += up + down, v_[k] += Complex(0, nu) * (up - down);
    }
  }
  [[nodiscard]] const std::vector<Complex>& displacement() const { return x_; }
  [[nodiscard]] const std::vector<Complex>& velocity() const { return v_; }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  /// Whether what is seen at an instant begins the observed time. Where an impact falls on that, the first arc begins
  /// after the impact, later by rounding.
  [[nodiscard]] bool begins(double time) const { return !(time > 0.0) || std::isnan(first_x_); }
  [[nodiscard]] static Complex turn(double angle) { return {std::cos(angle), -std::sin(angle)}; }

  /// Integral of e^{i w s} from 0 to `length`, without cancellation.
  [[nodiscard]] static Complex wave(double w, double length) {
    const double half = w * length / 2;
    return length * (half == 0.0 ? 1.0 : std::sin(half) / half) * Complex(std::cos(half), std::sin(half));
  }

  /// Integral of the force times e^{-i w s} over an arc.
  template <Effects E>
  [[nodiscard]] static Complex force(const motion::Arc<double, E>& arc, double w, double length) {
    const auto& constants = arc.constants();
    Complex sum = constants.load * wave(-w, length);
    if constexpr (E.forcing != Forcing::none) {
      const Complex phase(arc.start().cosine, arc.start().sine);
      const Complex difference =
          phase * wave(constants.nu - w, length) - std::conj(phase) * wave(-constants.nu - w, length);
      sum += constants.f * difference / Complex(0, 2);
    }
    return sum;
  }

  template <class A>
  [[nodiscard]] static double displacement_of(const A& arc, double s) {
    if constexpr (motion::Polynomial<A>)
      return arc.displacement(s);  // no phase, no acceleration
    else
      return arc.at(s).x;
  }
  /// Adds an arc in which no harmonic turns by more than a radian: all of them at the same ten points.
  template <motion::Polynomial A>
  void short_arc(const A& arc, double begin, double length) {
    std::array<double, 10> times, weighted;
    std::size_t points = 0;
    over_panel<10>(length / 2, length / 2, [&](double s, double weight) {
      times[points] = begin + s, weighted[points++] = weight * arc.displacement(s);
    });
    evaluations_ += static_cast<double>(points * x_.size());  // a term counts as one
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const double w = base_ * static_cast<double>(k);
      Complex sum = 0;
      for (std::size_t i = 0; i < points; ++i) sum += weighted[i] * turn(w * times[i]);
      x_[k] += sum;
    }
  }
  /// Integral of x e^{-i w tau} over an arc by panels in which nothing turns by more than a few radians.
  template <unsigned points, class A>
  [[nodiscard]] Complex quadrature(const A& arc, double w, double begin, double length) {
    Complex sum = 0;
    evaluations_ += over_panels<points>(length, pace_of(arc.constants()).with(w), 4, [&](double s, double weight) {
      sum += weight * displacement_of(arc, s) * turn(w * (begin + s));
    });
    return sum;
  }

  double base_;
  double first_x_ = std::numeric_limits<double>::quiet_NaN();
  double evaluations_ = 0.0;
  std::vector<Complex> x_, v_;
};

}  // namespace clatter::observables
