#pragma once

#include "motion/relative_arc.hpp"

namespace clatter::observables {

/// The flight of a loose mass between two impacts as the ground sees it: y, a parabola, with the bounds that an arc
/// has.
template <Effects E>
class LooseArc {
 public:
  using Number = double;

  explicit LooseArc(const motion::RelativeArc<double, E>& arc) : arc_(arc), place_(arc.place()) {}

  [[nodiscard]] motion::Motion<double> start() const { return at(0.0); }
  [[nodiscard]] motion::Motion<double> at(double s) const {
    const double way = (arc_.velocity(0.0) + arc_.load() * s / 2) * s;
    const auto [sine, cosine] = arc_.main().phase_after(s);
    return {way, place_ + way, arc_.velocity(s), arc_.load(), sine, cosine};
  }

  /// As those of an arc: `jerk`, `rate` and `sixth_bound`.
  [[nodiscard]] const LooseArc& constants() const { return *this; }
  [[nodiscard]] static double jerk(const motion::Motion<double>&) { return 0.0; }
  [[nodiscard]] friend double sixth_bound(const LooseArc&, const motion::Motion<double>&, double, int) { return 0.0; }
  static constexpr double rate = 0.0;

 private:
  const motion::RelativeArc<double, E>& arc_;
  double place_;  ///< y at the start
};

}  // namespace clatter::observables
