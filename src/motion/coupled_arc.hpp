#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "math/bernstein.hpp"
#include "motion/arc_constants.hpp"
#include "motion/linear_maps.hpp"
#include "motion/relative_arc.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::motion {

/// Constants of any oscillator, also of a mass that something holds: no force moves that.
template <class Number>
using AnyConstants =
    ArcConstants<Number, Effects{.damping = Damping::heavy, .forcing = Forcing::regular, .stiffness = true}>;

/// An oscillator's constants as those of any.
template <class Number, Effects E>
[[nodiscard]] AnyConstants<Number> as_any(const ArcConstants<Number, E>& of) {
  auto any = AnyConstants<Number>::of(of.h, of.f, of.nu, of.load, of.k, of.shape);
  any.stop = of.stop, any.friction = of.friction, any.carried = of.carried, any.rubbing = of.rubbing;
  any.origin = of.origin, any.balance = of.balance, any.equilibrium = of.equilibrium, any.period = of.period;
  return any;
}

/// The terms y^(k) d^k / k! of a Taylor series over a step d in which nothing turns by more than a radian: 1/20! and
/// 1/48! are below rounding.
template <class Number>
using Powers = std::array<Number, std::numeric_limits<Number>::digits <= 64 ? 20 : 48>;

/// A polynomial at u, by powers of it; `from` 1 leaves out the first term.
template <class Number, std::size_t size>
[[nodiscard]] Number value_of(const std::array<Number, size>& p, const Number& u, std::size_t from = 0) {
  Number sum(0);
  for (std::size_t k = size; k-- > from;) sum = sum * u + p[k];
  return from == 0 ? sum : Number(sum * u);
}
template <class Number, std::size_t size>
[[nodiscard]] std::array<Number, size> derivative_of(const std::array<Number, size>& p) {
  std::array<Number, size> q{};
  for (std::size_t k = 1; k < size; ++k) q[k - 1] = static_cast<double>(k) * p[k];
  return q;
}

/// A soft wall of the housing beside an arc of the main mass: x'' = ... + q and y'' = load - q/eps, with the push
/// q = kappa (z - wall) + c z' while the wall pushes (eq. 85).
template <class Number>
struct Coupling {
  SoftStop<Number> wall{};
  Number ratio{};        ///< eps
  bool pushes = false;   ///< else the wall relaxes, and both masses move by themselves
  bool is_held = false;  ///< something holds the main mass

  /// q, by z less the place of the wall, and z'.
  [[nodiscard]] Number push(const Number& offset, const Number& w) const {
    return pushes ? Number(wall.stiffness * offset + 2 * wall.damping * w) : Number(0);
  }
  /// A bound of all frequencies and decay rates of both masses: of a root of r^2 = b r + a, whose coefficients bound
  /// those of their equations.
  template <class Constants>
  [[nodiscard]] Number rate(const Constants& c) const {
    using std::abs, std::max, std::sqrt;
    const Number inverse = (1 + ratio) / ratio, kappa = pushes ? wall.stiffness : Number(0),
                 damper = pushes ? Number(2 * wall.damping) : Number(0);
    const Number b = 2 * c.h + damper * inverse, a = abs(c.k) + kappa * inverse;
    return max(c.nu, Number((b + sqrt(b * b + 4 * a)) / 2));
  }
  /// Completes the series of both masses over a step d, whose first three terms are known.
  template <class Constants>
  void complete(const Constants& c, const Number& d, const SineCosine<Number>& phase, Powers<Number>& x,
                Powers<Number>& z) const {
    const Number kappa = pushes ? Number(wall.stiffness * d * d) : Number(0),
                 damper = pushes ? Number(2 * wall.damping * d) : Number(0), stiffness = c.k * d * d,
                 damping = 2 * c.h * d;
    with_force_terms<std::tuple_size_v<Powers<Number>>>(c, Number(c.f * d * d), phase, d, [&](auto&& force) {
      for (std::size_t k = 1; k + 2 < x.size(); ++k) {
        const double more = static_cast<double>(k + 1), both = static_cast<double>((k + 1) * (k + 2));
        const Number pushed = kappa * z[k] + damper * (more * z[k + 1]);
        const Number pulled = -stiffness * x[k] - damping * (more * x[k + 1]) + force(k) + pushed;
        x[k + 2] = is_held ? Number(0) : Number(pulled / both);
        z[k + 2] = -pushed / ratio / both - x[k + 2];
      }
    });
  }
};

/// The course of a displacement over a step, by powers of the part of the step: how far it moves, and its velocity, a
/// polynomial of its own by general methods. The first terms are those of the start.
template <class Number>
struct Course {
  Powers<Number> way{}, velocity{};

  /// Of a Taylor series over a step d.
  [[nodiscard]] static Course of(const Powers<Number>& series, const Number& v, const Number& d) {
    Course course{series, derivative_of(series)};
    for (Number& term : course.velocity) term = d > 0 ? Number(term / d) : Number(0);
    course.way[0] = Number(0), course.velocity[0] = v;
    return course;
  }
};

/// Motion of the main mass while a soft wall of the housing pushes, or relaxes, over a step in which it is a polynomial
/// to the accuracy of the method. Observers take it in place of an Arc.
template <class N>
class CoupledArc {
 public:
  using Number = N;
  using Series = Powers<Number>;
  static constexpr Effects effects = AnyConstants<Number>::effects;

  CoupledArc(const AnyConstants<Number>& constants, const Motion<Number>& start, const Number& anchor,
             const Number& length, const Course<Number>& course)
      : constants_(constants), start_(start), anchor_(anchor), length_(length), course_(course) {}

  [[nodiscard]] const AnyConstants<Number>& constants() const { return constants_; }
  [[nodiscard]] const Motion<Number>& start() const { return start_; }
  [[nodiscard]] const Number& anchor() const { return anchor_; }  ///< the position that `offset` counts from
  [[nodiscard]] const Number& length() const { return length_; }  ///< of the step, in tau
  [[nodiscard]] const Course<Number>& course() const { return course_; }

  /// Motion a time s after the start, 0 <= s <= length.
  [[nodiscard]] Motion<Number> at(const Number& s) const {
    using std::abs;
    const Number u = share_of(s, length_), way = value_of(course_.way, u, 1), offset = start_.offset + way;
    const bool rises = abs(anchor_) + abs(offset) < abs(start_.x) + abs(way);
    const auto [sine, cosine] = phase_after(s);
    return {offset,
            rises ? Number(anchor_ + offset) : Number(start_.x + way),
            value_of(course_.velocity, u),
            length_ > 0 ? Number(value_of(derivative_of(course_.velocity), u) / length_) : start_.a,
            sine,
            cosine};
  }
  /// Displacement alone.
  [[nodiscard]] Number displacement(const Number& s) const { return at(s).x; }
  /// The forcing phase a time s after the start.
  [[nodiscard]] SineCosine<Number> phase_after(const Number& s) const {
    return constants_.phase_after({start_.sine, start_.cosine}, s);
  }
  /// Offset and velocity over the step.
  [[nodiscard]] Series offset() const { return from_powers(offset_powers()); }
  [[nodiscard]] Series velocity() const { return from_powers(course_.velocity); }
  /// The first by powers of the part of the step.
  [[nodiscard]] Series offset_powers() const {
    Series p = course_.way;
    p[0] = start_.offset;
    return p;
  }

  [[nodiscard]] static Number share_of(const Number& s, const Number& length) {
    return length > 0 ? Number(s / length) : Number(0);
  }

 private:
  AnyConstants<Number> constants_;
  Motion<Number> start_;
  Number anchor_, length_;
  Course<Number> course_;
};

/// Motion of a loose mass in its housing, z = y - x, meanwhile. Observers take it in place of a RelativeArc.
template <class N>
class CoupledInHousing {
 public:
  using Number = N;
  using Series = Powers<Number>;
  static constexpr Effects effects = CoupledArc<Number>::effects;

  CoupledInHousing(const CoupledArc<Number>& main, const Coupling<Number>& coupling, const RelativeStart<Number>& from,
                   const Number& load, const Course<Number>& course)
      : main_(main), coupling_(coupling), from_(from), load_(load), course_(course) {}

  [[nodiscard]] const AnyConstants<Number>& constants() const { return main_.constants(); }
  [[nodiscard]] const CoupledArc<Number>& main() const { return main_; }  ///< of the main mass
  [[nodiscard]] const Coupling<Number>& coupling() const { return coupling_; }
  [[nodiscard]] Motion<Number> start() const { return at(Number(0)); }
  [[nodiscard]] const Number& anchor() const { return from_.origin; }    ///< the place of the wall
  [[nodiscard]] const Number& length() const { return main_.length(); }  ///< of the step, in tau
  [[nodiscard]] const Number& load() const { return load_; }             ///< y'' without the push of the wall

  /// Motion of z a time s after the start, 0 <= s <= length.
  [[nodiscard]] Motion<Number> at(const Number& s) const {
    const Number u = CoupledArc<Number>::share_of(s, length());
    Motion<Number> m = main_.at(s);
    m.offset = from_.offset + value_of(course_.way, u, 1), m.x = from_.origin + m.offset;
    m.v = value_of(course_.velocity, u);
    m.a = load_ - coupling_.push(m.offset, m.v) / coupling_.ratio - m.a;
    return m;
  }
  /// z alone.
  [[nodiscard]] Number displacement(const Number& s) const { return at(s).x; }
  /// y' a time s after the start.
  [[nodiscard]] Number velocity(const Number& s) const { return at(s).v + main_.at(s).v; }
  /// z less the place of the wall, and z', over the step.
  [[nodiscard]] Series offset() const { return from_powers(offset_powers()); }
  [[nodiscard]] Series velocity() const { return from_powers(course_.velocity); }
  /// y from the place of the wall in a housing that stands at the anchor of the main mass.
  [[nodiscard]] Series way() const {
    Series sum = offset_powers();
    const Series main = main_.offset_powers();
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += main[k];
    return from_powers(sum);
  }
  /// The same by powers of the part of the step.
  [[nodiscard]] Series offset_powers() const {
    Series p = course_.way;
    p[0] = from_.offset;
    return p;
  }
  [[nodiscard]] const Series& velocity_powers() const { return course_.velocity; }
  /// The push q of the wall over the step.
  [[nodiscard]] Series push_powers() const {
    Series q = offset_powers();
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = coupling_.push(q[k], course_.velocity[k]);
    return q;
  }

 private:
  CoupledArc<Number> main_;
  Coupling<Number> coupling_;
  RelativeStart<Number> from_;
  Number load_;
  Course<Number> course_;
};

/// The motion of both masses from an instant on, over `horizon` or a shorter step: of the main mass along an arc that
/// begins with `start`, without the push of the wall, and of the loose one by itself with y'' = load.
template <class Number, Effects E>
[[nodiscard]] CoupledInHousing<Number> coupled(const ArcConstants<Number, E>& constants,
                                               const Coupling<Number>& coupling, Motion<Number> start,
                                               const Number& anchor, const RelativeStart<Number>& from,
                                               const Number& load, const Number& horizon) {
  using std::min;
  const AnyConstants<Number> any = as_any(constants);
  const Number push = coupling.push(from.offset, from.w), length = min(horizon, Number(1 / coupling.rate(any)));
  if (!coupling.is_held) start.a += push;
  const Number a = (load - push / coupling.ratio) - start.a;
  Powers<Number> x{}, z{};
  x[1] = start.v * length, x[2] = start.a * length * length / 2;
  z[1] = from.w * length, z[2] = a * length * length / 2;
  coupling.complete(any, length, {start.sine, start.cosine}, x, z);
  return {CoupledArc<Number>(any, start, anchor, length, Course<Number>::of(x, start.v, length)), coupling, from, load,
          Course<Number>::of(z, from.w, length)};
}

/// The derivative of x, x', y and y' a time s after the start of a step of both masses by those at its start.
[[nodiscard]] inline LooseJacobian flow_of(const CoupledInHousing<double>& arc, double s) {
  LooseJacobian map{};
  AnyConstants<double> free = arc.constants();
  free.f = 0;
  const Coupling<double>& coupling = arc.coupling();
  for (std::size_t column = 0; column < 4; ++column) {
    const double x0 = column == 0, v0 = column == 1, z0 = (column == 2) - x0, w0 = (column == 3) - v0;
    const double push = coupling.push(z0, w0), a = -free.k * x0 - 2 * free.h * v0 + push;
    Powers<double> x{}, z{};
    x[0] = x0, x[1] = v0 * s, x[2] = a * s * s / 2;
    z[0] = z0, z[1] = w0 * s, z[2] = (-push / coupling.ratio - a) * s * s / 2;
    if (coupling.is_held) x[1] = x[2] = 0, z[2] = -push / coupling.ratio * s * s / 2;
    coupling.complete(free, s, {0.0, 1.0}, x, z);
    const double at_end = value_of(x, 1.0), relative = value_of(z, 1.0), over = s > 0 ? s : 1.0;
    const double v = s > 0 ? value_of(derivative_of(x), 1.0) / over : v0,
                 w = s > 0 ? value_of(derivative_of(z), 1.0) / over : w0;
    map[0][column] = at_end, map[1][column] = v, map[2][column] = at_end + relative, map[3][column] = v + w;
  }
  return map;
}

}  // namespace clatter::motion
