#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "branches/equations/followed_scene.hpp"
#include "branches/equations/orbit.hpp"
#include "branches/equations/push_of_orders.hpp"

namespace clatter::branches {

/// A mass at x' = 0, at a place that counts from `SceneNumbers::middle`, when the forcing phase is this, in rad;
/// perhaps beyond the position of a soft stop.
template <class Number>
struct Standing {
  Number place, phase;
  Side held_by = Side::none;
};
[[nodiscard]] inline Standing<double> standing_at(const OrbitEvent& halt) {
  return {halt.place, halt.phase, halt.held_by()};
}

/// When dry friction lets a mass go that it holds, at given parameters, to which it refers.
template <class Number>
class Releases {
 public:
  Releases(const SceneNumbers<Number>& parameters, const LeadingForce<Number>& force)
      : p_(parameters), f_(force.amplitude), lead_(force.lead) {
    const auto push = [&](Side side) { return PushOfOrders<Number>(f_, p_.oscillator.shape.orders, side); };
    if (p_.oscillator.shape.has_orders()) pushes_.emplace(std::pair(push(Side::lower), push(Side::upper)));
  }

  /// The forcing phase, rad, from which on so strong a push rises beyond the static level (the guide's formula), less
  /// that at which the mass halts: negative if that is later, up to the push's crest. Infinite: it never or always is
  /// beyond. A crest that is the level to rounding is the release.
  [[nodiscard]] Number hold(const Standing<Number>& at, Side side) const {
    using std::atan, std::sqrt;
    if (pushes_) return push_of_orders(side).hold(at.phase, level_to(at, side));
    const Number sine = push_at_release(at, side);
    if (is_at_crest(sine)) return hold_to_crest(at, side);
    if (sine >= 1 || sine <= -1) return (sine > 0 ? 1 : -1) * std::numeric_limits<double>::infinity();
    return atan(sine / sqrt((1 - sine) * (1 + sine))) - of_push(at.phase, side);
  }
  /// The forcing phase, rad, from that at which the mass halts on to the crest of the push, under several orders of it
  /// to the one that is most nearly as high as the level.
  [[nodiscard]] Number hold_to_crest(const Standing<Number>& at, Side side) const {
    if (pushes_) return push_of_orders(side).hold_to_crest(at.phase, level_to(at, side));
    return std::numbers::pi / 2 - of_push(at.phase, side);
  }
  /// `hold`, which beyond the crest goes on as it comes there: as far behind it as a push as much weaker is before it.
  /// That is no motion, but a step towards the crest passes through there: a release a way before it has a place by the
  /// square of that, so no line from there leads to the crest. Under several orders a later crest may release the mass
  /// as well, if that is before a flight from there has an end, a phase `end` after the halt.
  [[nodiscard]] Number hold_and_beyond(const Standing<Number>& at, Side side, const Number& end) const {
    using std::atan, std::sqrt;
    if (pushes_) {
      const Number held = hold(at, side);
      return held < end ? held : push_of_orders(side).hold_beyond_crest(at.phase, level_to(at, side));
    }
    const Number push = push_at_release(at, side);
    if (!(push > 1) || is_at_crest(push)) return hold(at, side);
    return hold_to_crest(at, side) + atan(sqrt((push - 1) * (push + 1)));
  }

 private:
  [[nodiscard]] const PushOfOrders<Number>& push_of_orders(Side side) const {
    return side == Side::lower ? pushes_->first : pushes_->second;
  }
  /// The push to a side at which a mass at a place is released.
  [[nodiscard]] Number level_to(const Standing<Number>& at, Side side) const {
    const Number force = p_.standing_force(Number(p_.middle() + at.place), at.held_by);
    return p_.friction.static_level - sign_of(side) * force;
  }
  /// That over the push at its crest.
  [[nodiscard]] Number push_at_release(const Standing<Number>& at, Side side) const {
    using std::abs;
    return level_to(at, side) / abs(f_);
  }
  [[nodiscard]] static bool is_at_crest(const Number& push) {
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    return push >= 1 && push <= 1 + rounding;
  }
  /// The phase of the push to a side from zero on its way up, between the crests: -3 pi/2 ... pi/2.
  [[nodiscard]] Number of_push(const Number& phase, Side side) const {
    constexpr double turn = 2 * std::numbers::pi, quarter = turn / 4;
    const Number of = phase + lead_ + (sign_of(side) * f_ < 0 ? std::numbers::pi : 0.0);
    return of - turn * std::round((static_cast<double>(of) + quarter) / turn);
  }

  const SceneNumbers<Number>& p_;
  Number f_, lead_;
  std::optional<std::pair<PushOfOrders<Number>, PushOfOrders<Number>>> pushes_{};  ///< of several orders, to both sides
};

}  // namespace clatter::branches
