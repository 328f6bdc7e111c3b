#pragma once

#include <optional>
#include <vector>

#include "dual.hpp"

namespace verify {

/// What an impact makes of a velocity v: (factor + per_speed |v| + taken (|v|/reference)^exponent) v.
struct Rebound {
  Dual factor{1};
  Ball per_speed{0};
  Ball taken{0}, exponent{0}, reference{1};

  template <class Number>
  [[nodiscard]] Number after(const Number& v) const {
    return share_of(v) * v;
  }
  /// That less the velocity before.
  [[nodiscard]] Ball change(const Ball& v) const { return (share_of(v) - Ball(1)) * v; }
  /// Its derivative by v.
  [[nodiscard]] Ball slope(const Ball& v) const {
    if (per_speed.is_zero() && taken.is_zero()) return factor.value;
    return Rebound{Dual(factor.value), per_speed, taken, exponent, reference}.after(Dual(v, Ball(1))).slope;
  }
  /// Whether it leaves no speed.
  [[nodiscard]] bool is_none() const { return factor.value.is_zero() && per_speed.is_zero() && taken.is_zero(); }

 private:
  [[nodiscard]] const Dual& factor_in(const Dual&) const { return factor; }
  [[nodiscard]] const Ball& factor_in(const Ball&) const { return factor.value; }
  template <class Number>
  [[nodiscard]] Number share_of(const Number& v) const {
    Number share = factor_in(v);
    if (!per_speed.is_zero()) share = share + Number(per_speed) * abs(v);
    if (!taken.is_zero()) share = share + Number(taken) * exp(Number(exponent) * log(abs(v) / Number(reference)));
    return share;
  }
};

/// Restitution R that depends on the speed v of an impact: 1 - (1 - R) (v/V)^p down to p/(1 + p), or straight lines
/// between knots and constant beyond them. Below a speed nothing rebounds.
struct Law {
  struct Knot {
    Ball speed, R;
  };
  Ball R{1};
  std::optional<Ball> exponent{};  ///< p, 0 < p < 1, with R < 1; none: R is the same at each speed
  Ball reference{1};               ///< V
  Ball below{0};
  std::vector<Knot> knots{};  ///< in place of R

  /// What an impact does at a velocity, or at all of a ball's. Throws Undecided if one formula doesn't hold for all of
  /// them: a knot, or a speed at which the law changes, may be among them.
  [[nodiscard]] Rebound at(const Ball& v) const;
  /// Whether the slowest impacts leave no speed, so that there is no endless chatter.
  [[nodiscard]] bool stops_the_slowest() const;
  /// All R of the speeds from 0 to one, 0 excluded. Throws Undecided if the slowest impacts leave no speed.
  [[nodiscard]] Ball shares_up_to(const Ball& speed) const;
  /// R of all these speeds, if it is one number.
  [[nodiscard]] std::optional<Ball> only_share_up_to(const Ball& speed) const;
  /// Whether R tends to 1 with the speed, by the power.
  [[nodiscard]] bool is_power() const { return exponent.has_value(); }
  /// (1 - R) (v/V)^p of a speed.
  [[nodiscard]] Ball taken_at(const Ball& speed) const;
  /// The sum w + w' + w'' + ... of the speeds of endless rebounds by the power, if a flight from one at u comes back
  /// with u (1 - change u) ... u (1 + change u). Throws Undecided if that isn't proved.
  [[nodiscard]] Ball sum_of_rebounds(const Ball& w, const Ball& change) const;

  /// Whether two are the same, exactly.
  [[nodiscard]] bool is_like(const Law& other) const;

 private:
  [[nodiscard]] Rebound on_knots(const Ball& speed) const;
  [[nodiscard]] Rebound by_power(const Ball& speed) const;
};

/// Whether two laws that there may be are the same, exactly.
[[nodiscard]] inline bool are_alike(const std::optional<Law>& one, const std::optional<Law>& other) {
  return one && other ? one->is_like(*other) : one.has_value() == other.has_value();
}

}  // namespace verify
