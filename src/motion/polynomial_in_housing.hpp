#pragma once

#include <cstddef>
#include <tuple>

#include "motion/polynomial_arc.hpp"
#include "motion/relative_arc.hpp"

namespace clatter::motion {

/// Motion of a loose mass in its housing, z = y - x, over one step of a general method: polynomials of z and z' beside
/// those of the main mass. Observers take it in place of a RelativeArc.
template <Effects E>
class PolynomialInHousing {
 public:
  using Number = double;
  static constexpr Effects effects = E;

  /// `offset` of z from the place `origin`, and z', over the step of `main`; `load` is y''.
  PolynomialInHousing(const PolynomialArc<E>& main, double origin, double load, const Bernstein<double>& offset,
                      const Bernstein<double>& velocity)
      : main_(main), origin_(origin), load_(load), offset_(offset), velocity_(velocity) {}

  /// Beside a step of the main mass: the parabola of the loose one less the way of that.
  [[nodiscard]] static PolynomialInHousing beside(const PolynomialArc<E>& main, const RelativeStart<double>& from,
                                                  double load) {
    constexpr auto degree = static_cast<double>(std::tuple_size_v<Bernstein<double>> - 1);
    const double way = from.v * main.length(), bend = load * main.length() * main.length() / 2;
    Bernstein<double> offset, velocity;
    for (std::size_t i = 0; i < offset.size(); ++i) {
      const auto at = static_cast<double>(i);
      const double share = at / degree, square = at * (at - 1) / (degree * (degree - 1));
      offset[i] = from.offset + ((way * share + bend * square) - (main.offset()[i] - main.offset()[0]));
      velocity[i] = from.w + (load * main.length() * share - (main.velocity()[i] - main.velocity()[0]));
    }
    return {main, from.origin, load, offset, velocity};
  }

  [[nodiscard]] const ArcConstants<double, E>& constants() const { return main_.constants(); }
  [[nodiscard]] const PolynomialArc<E>& main() const { return main_; }  ///< of the main mass
  [[nodiscard]] Motion<double> start() const { return at(0.0); }
  [[nodiscard]] double anchor() const { return origin_; }                    ///< the place that `offset` counts from
  [[nodiscard]] double length() const { return main_.length(); }             ///< of the step, in tau
  [[nodiscard]] double load() const { return load_; }                        ///< y''
  [[nodiscard]] const Bernstein<double>& offset() const { return offset_; }  ///< over the step
  [[nodiscard]] const Bernstein<double>& velocity() const { return velocity_; }  ///< over the step

  /// Motion of z a time s after the start, 0 <= s <= length.
  [[nodiscard]] Motion<double> at(double s) const {
    const double u = share(s);
    Motion<double> m = main_.at(s);
    m.offset = value_at(offset_, u), m.x = origin_ + m.offset, m.v = value_at(velocity_, u), m.a = load_ - m.a;
    return m;
  }
  /// z alone.
  [[nodiscard]] double displacement(double s) const { return origin_ + value_at(offset_, share(s)); }
  /// y' a time s after the start.
  [[nodiscard]] double velocity(double s) const {
    const double u = share(s);
    return value_at(velocity_, u) + value_at(main_.velocity(), u);
  }
  /// y from the place `origin` in a housing that stands at the anchor of the main mass.
  [[nodiscard]] Bernstein<double> way() const {
    Bernstein<double> sum = offset_;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += main_.offset()[i];
    return sum;
  }

 private:
  [[nodiscard]] double share(double s) const { return length() > 0 ? s / length() : 0.0; }

  PolynomialArc<E> main_;
  double origin_, load_;
  Bernstein<double> offset_, velocity_;
};

}  // namespace clatter::motion
