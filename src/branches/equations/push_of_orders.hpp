#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "math/number.hpp"
#include "scene/force_orders.hpp"
#include "scene/stops.hpp"

namespace clatter::branches {

/// The push of a force of several orders to a side, by its phase, rad: dry friction lets a mass go where that rises
/// through a level. Instants are found on numbers without derivatives, and these by steps of Newton's method from
/// there.
template <class Number>
class PushOfOrders {
 public:
  PushOfOrders(const Number& f, const ForceOrders<Number>& orders, Side side)
      : size_(sign_of(side) * f), orders_(orders) {
    ForceOrders<double> values;
    for (std::size_t i = 0; i < values.of.size(); ++i)
      values.of[i] = {static_cast<double>(orders.of[i].in_phase), static_cast<double>(orders.of[i].quadrature)};
    const double sign = size_ < 0 ? -1 : 1;
    for (const double phase : crests_of(values, sign)) turns_.push_back({phase, true});
    for (const double phase : crests_of(values, -sign)) turns_.push_back({phase, false});
    std::ranges::sort(turns_, {}, &Turn::phase);
  }

  /// The push at a phase, and its first two derivatives by that.
  [[nodiscard]] std::array<Number, 3> at(const Number& phase) const {
    using std::cos, std::sin;
    const auto s = orders_.derivatives({sin(phase), cos(phase)});
    return {size_ * s[0], size_ * s[1], size_ * s[2]};
  }

  /// For how long, from a phase on, the push stays below a level, rad; negative if it has risen through that before,
  /// with no crest in between. Infinite: it never or always is beyond.
  [[nodiscard]] Number hold(const Number& phase, const Number& level) const {
    const auto from = static_cast<double>(phase), needed = static_cast<double>(level);
    const double crest = next(from, true), lacks = needed - height(crest);
    if (lacks >= 0 && lacks <= rounding * std::abs(static_cast<double>(size_))) return refined_crest(crest) - phase;
    const std::optional<double> rise = lacks < 0 ? last_rise(crest, needed) : next_rise(crest, needed);
    if (!rise) return (lacks < 0 ? -1 : 1) * std::numeric_limits<double>::infinity();
    Number there(*rise);
    for (int i = 0; i < steps; ++i) {
      const auto [push, slope, bend] = at(there);
      there -= (push - level) / slope;
    }
    return there - phase;
  }
  /// From a phase on to the crest within a turn that is most nearly as high as a level, rad.
  [[nodiscard]] Number hold_to_crest(const Number& phase, const Number& level) const {
    return refined_crest(crest_at(static_cast<double>(phase), static_cast<double>(level))) - phase;
  }
  /// The same where the level is beyond that crest: so much later than the crest as a push that was stronger by as much
  /// would rise through it sooner.
  [[nodiscard]] Number hold_beyond_crest(const Number& phase, const Number& level) const {
    using std::sqrt;
    const Number crest = refined_crest(crest_at(static_cast<double>(phase), static_cast<double>(level)));
    const auto [push, slope, bend] = at(crest);
    return crest - phase + (push < level ? Number(sqrt(2 * (push - level) / bend)) : Number(0));
  }
  /// The height of the crest within a turn from a phase on that is most nearly as high as a level.
  [[nodiscard]] Number crest_height(double phase, double level) const { return at(Number(crest_at(phase, level)))[0]; }
  /// The phase near another one of the highest crest.
  [[nodiscard]] double highest_crest_near(double phase) const {
    double highest = next(phase, true);
    for (const Turn& turn : turns_)
      if (turn.is_crest && height(turn.phase) > height(highest)) highest = turn.phase;
    return highest + whole * std::round((phase - highest) / whole);
  }
  /// The phase nearest to another one at which the push falls through a level that it has on both sides of.
  [[nodiscard]] double fall_near(double phase, double level) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (double crest = next(phase - whole, true); crest < phase + whole; crest = next(crest + apart, true)) {
      const double trough = next(crest, false);
      if (!(height(crest) > level && height(trough) < level)) continue;
      const double fall = crossing(crest, trough, level);
      if (std::abs(fall - phase) < std::abs(nearest - phase)) nearest = fall;
    }
    return nearest;
  }

 private:
  static constexpr double whole = 2 * std::numbers::pi, apart = 1e-9;
  static constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  static constexpr int steps = 3;  ///< of Newton's method, which each double the derivatives that are right
  struct Turn {
    double phase;
    bool is_crest;
  };

  [[nodiscard]] double height(double phase) const { return static_cast<double>(at(Number(phase))[0]); }
  /// The first crest, or trough, from a phase on.
  [[nodiscard]] double next(double from, bool is_crest) const {
    double first = std::numeric_limits<double>::infinity();
    for (const Turn& turn : turns_)
      if (turn.is_crest == is_crest)
        first = std::min(first, turn.phase + whole * std::ceil((from - turn.phase) / whole));
    return first;
  }
  [[nodiscard]] double crest_at(double from, double level) const {
    double best = next(from + apart, true);
    for (double crest = best; crest <= from + apart + whole; crest = next(crest + apart, true))
      if (std::abs(height(crest) - level) < std::abs(height(best) - level)) best = crest;
    return best;
  }
  /// The last rise through a level before a crest beyond it, within a turn.
  [[nodiscard]] std::optional<double> last_rise(double crest, double level) const {
    for (double end = crest; end > crest - whole + apart; end = before(before(end, false), true))
      if (const double trough = before(end, false); height(trough) < level) return crossing(trough, end, level);
    return std::nullopt;
  }
  /// The first rise through a level after a crest below it, within a turn.
  [[nodiscard]] std::optional<double> next_rise(double after, double level) const {
    for (double crest = next(after + apart, true); crest <= after + apart + whole; crest = next(crest + apart, true))
      if (height(crest) > level) return crossing(before(crest, false), crest, level);
    return std::nullopt;
  }
  /// The last crest, or trough, before a phase.
  [[nodiscard]] double before(double phase, bool is_crest) const {
    double last = -std::numeric_limits<double>::infinity();
    for (const Turn& turn : turns_)
      if (turn.is_crest == is_crest)
        last = std::max(last, turn.phase + whole * std::floor((phase - apart - turn.phase) / whole));
    return last;
  }
  /// Where the push passes a level between two turns, on whose sides of it they are.
  [[nodiscard]] double crossing(double low, double high, double level) const {
    const bool rises = height(high) > level;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      ((height(middle) < level) == rises ? low : high) = middle;
    }
    return (low + high) / 2;
  }
  [[nodiscard]] Number refined_crest(double phase) const {
    Number crest(phase);
    for (int i = 0; i < steps; ++i) {
      const auto [push, slope, bend] = at(crest);
      crest -= slope / bend;
    }
    return crest;
  }

  Number size_;
  ForceOrders<Number> orders_;
  std::vector<Turn> turns_;  ///< of one period, in their order
};

}  // namespace clatter::branches
