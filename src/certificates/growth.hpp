#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace clatter::certificates {

/// How a motion of so many numbers stretches errors: of the state at its start, and of the rounding that each flight
/// adds on the way. An error that enters late is stretched by what is left of the motion, though what is before it may
/// have contracted.
template <std::size_t count>
class Growth {
 public:
  using Map = std::array<double, count * count>;  ///< by rows
  using Sizes = std::array<double, count>;

  /// A flight and the event before it, with their derivative; it adds rounding of so many units.
  void pass(const Map& step, double rounding) {
    const Map before = derivative_, spread = spread_;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        at(derivative_, i, j) = along(step, i, before, j);
        at(spread_, i, j) = carried(step, i, j, spread);
      }
    for (std::size_t i = 0; i < count; ++i) {
      before_[i] = std::sqrt(std::max(0.0, at(spread_, i, i)));
      at(spread_, i, i) += rounding * rounding;
    }
  }

  /// The sum of the moduli of a row.
  [[nodiscard]] static double row_norm(const Map& map, std::size_t i) {
    double sum = 0;
    for (std::size_t j = 0; j < count; ++j) sum += std::abs(at(map, i, j));
    return sum;
  }
  [[nodiscard]] static double norm(const Map& map) {
    double most = row_norm(map, 0);
    for (std::size_t i = 1; i < count; ++i) most = std::max(most, row_norm(map, i));
    return most;
  }

  [[nodiscard]] const Map& derivative() const { return derivative_; }  ///< from the start
  /// The rounding of earlier flights as it has grown, in each number: the root of the sum of squares.
  [[nodiscard]] const Sizes& rounding() const { return before_; }

 private:
  template <class M>
  [[nodiscard]] static auto& at(M& map, std::size_t i, std::size_t j) {
    return map[i * count + j];
  }
  [[nodiscard]] static Map identity() {
    Map map{};
    for (std::size_t i = 0; i < count; ++i) at(map, i, i) = 1;
    return map;
  }
  [[nodiscard]] static double along(const Map& step, std::size_t i, const Map& before, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += at(step, i, k) * at(before, k, j);
    return sum;
  }
  /// An entry of step spread step^T, spread being symmetric.
  [[nodiscard]] static double carried(const Map& step, std::size_t i, std::size_t j, const Map& spread) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      sum += at(step, i, k) * at(step, j, k) * at(spread, k, k);
      for (std::size_t l = k + 1; l < count; ++l)
        sum += (at(step, i, k) * at(step, j, l) + at(step, i, l) * at(step, j, k)) * at(spread, k, l);
    }
    return sum;
  }

  Map derivative_ = identity(), spread_{};  ///< the latter a covariance
  Sizes before_{};
};

}  // namespace clatter::certificates
