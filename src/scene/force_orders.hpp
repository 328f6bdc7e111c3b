#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "math/number.hpp"

namespace clatter {
inline namespace scene {

/// The part a sin(j theta) + b cos(j theta) of a force, of order j.
template <class Number>
struct ForceOrder {
  Number in_phase{};    ///< a
  Number quadrature{};  ///< b

  friend bool operator==(const ForceOrder&, const ForceOrder&) = default;
};

/// The orders 1 ... 8 of a force s(theta), whose sum of sizes is 1.
template <class Number>
struct ForceOrders {
  static constexpr std::size_t most = 8;  ///< the highest order

  std::array<ForceOrder<Number>, most> of{};  ///< [order - 1]

  /// Calls `see(j, value, slope)` for j = 1 up to the highest: the part of order j, and its derivative by j theta.
  template <class See>
  void each(const SineCosine<Number>& theta, See&& see) const {
    SineCosine<Number> turned{Number(0), Number(1)};  // by j theta
    for (std::size_t j = 1, last = highest(); j <= last; ++j) {
      turned = {turned.sine * theta.cosine + turned.cosine * theta.sine,
                turned.cosine * theta.cosine - turned.sine * theta.sine};
      const auto& [a, b] = of[j - 1];
      see(static_cast<int>(j), Number(a * turned.sine + b * turned.cosine),
          Number(a * turned.cosine - b * turned.sine));
    }
  }
  /// s and its first derivatives by theta.
  [[nodiscard, gnu::noinline]] std::array<Number, 5> derivatives(const SineCosine<Number>& theta) const {
    std::array<Number, 5> s{};
    each(theta, [&s](int j, const Number& value, const Number& slope) {
      s[0] += value, s[1] += j * slope, s[2] -= j * j * value, s[3] -= j * j * j * slope, s[4] += j * j * j * j * value;
    });
    return s;
  }
  /// Bound of the derivative of an order by theta.
  [[nodiscard]] Number most_of(int derivative) const {
    Number sum(0);
    for (std::size_t j = 1; j <= most; ++j) {
      Number part = size(j);
      for (int i = 0; i < derivative; ++i) part *= static_cast<double>(j);
      sum += part;
    }
    return sum;
  }
  /// (a^2 + b^2)^(1/2) of an order.
  [[nodiscard]] Number size(std::size_t order) const { return norm(of[order - 1].in_phase, of[order - 1].quadrature); }
  [[nodiscard]] bool is_zero(std::size_t order) const {
    return is_always_zero(of[order - 1].in_phase) && is_always_zero(of[order - 1].quadrature);
  }
  /// ds/dtheta.
  [[nodiscard]] ForceOrders derivative() const {
    ForceOrders by_theta;
    for (std::size_t i = 0; i < most; ++i) {
      const auto j = static_cast<double>(i + 1);
      by_theta.of[i] = {-j * of[i].quadrature, j * of[i].in_phase};
    }
    return by_theta;
  }
  /// Whether there is none.
  [[nodiscard]] bool is_zero() const { return highest() == 1 && is_zero(1); }
  /// The highest order that isn't 0; 1 if none is.
  [[nodiscard]] std::size_t highest() const {
    std::size_t order = most;
    while (order > 1 && is_zero(order)) --order;
    return order;
  }

  friend bool operator==(const ForceOrders&, const ForceOrders&) = default;
};

namespace detail {

/// The search for the phase at which a sum of orders rises through a value, in turns, within which its derivatives are
/// bounded: a part of the turn is halved until it has no root, or one.
template <class Number>
class RisingPhase {
 public:
  RisingPhase(const ForceOrders<Number>& orders, const Number& sign, const Number& value)
      : orders_(orders),
        sign_(sign),
        value_(value),
        steepest_(2 * pi<Number>() * orders.most_of(1)),
        sharpest_(4 * pi<Number>() * pi<Number>() * orders.most_of(2)) {}

  /// The first one after `begin` up to `end`.
  [[nodiscard]] std::optional<Number> first(const Number& begin, const Number& end) const {
    using std::abs;
    const Number middle = (begin + end) / 2, half = (end - begin) / 2;
    const auto [height, slope] = at(middle);
    if (abs(height) > steepest_ * half) return std::nullopt;
    if (abs(slope) > sharpest_ * half || half < Number(1e-9)) {  // monotonous, or it only touches the value
      if (!(slope > 0) || !(at(begin).height < 0) || at(end).height < 0) return std::nullopt;
      return root(begin, end);
    }
    if (const auto found = first(begin, middle)) return found;
    return first(middle, end);
  }

 private:
  struct Height {
    Number height, slope;
  };
  [[nodiscard]] Height at(const Number& turns) const {
    const auto s = orders_.derivatives(sine_cosine_of_turns(turns));
    return {sign_ * s[0] - value_, sign_ * 2 * pi<Number>() * s[1]};
  }
  /// By Newton's method, with halves where a step leads out of the part.
  [[nodiscard]] Number root(Number below, Number above) const {
    using std::abs;
    Number here = (below + above) / 2;
    for (int i = 0; i < 400; ++i) {
      const auto [height, slope] = at(here);
      (height < 0 ? below : above) = here;
      Number next = here - height / slope;
      if (!(next > below && next < above)) next = (below + above) / 2;
      if (abs(next - here) <= epsilon<Number>()) return next;
      here = next;
    }
    return here;
  }

  const ForceOrders<Number>& orders_;
  Number sign_, value_, steepest_, sharpest_;
};

}  // namespace detail

/// Phase in turns, 0 ... 1, at which f s of some orders passes a value next, on its way up or down, after the phase
/// `from`; nothing if it never does, or only touches it.
template <class Number>
[[nodiscard]] std::optional<Number> phase_of_orders(const ForceOrders<Number>& orders, const Number& f,
                                                    const Number& needed, bool rises, const Number& from) {
  const Number sign((f > 0) == rises ? 1 : -1);
  const Number begin = part_of_turn(from);
  const auto turns =
      detail::RisingPhase<Number>(orders, sign, Number(sign * needed / f)).first(begin, Number(begin + 1));
  return turns ? std::optional<Number>(part_of_turn(*turns)) : std::nullopt;
}

/// Phases, rad, -pi ... pi, at which the sum of some orders, times a sign, has a maximum.
[[nodiscard]] std::vector<double> crests_of(const ForceOrders<double>& orders, double sign);

/// The one at which the sum, times the sign, is greatest; one that it has.
[[nodiscard]] double crest_of(const ForceOrders<double>& orders, double sign);

}  // namespace scene
}  // namespace clatter
