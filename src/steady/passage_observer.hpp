#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "motion/tangent_map.hpp"
#include "steady/map_orbit.hpp"
#include "stepping/integration.hpp"

namespace clatter::steady {

/// Records, for the search of a periodic motion, which stops are hit, rested on, touched and left between sections, and
/// where the mass sticks or turns back, in their order, and if asked for the derivative of the motion.
class PassageObserver {
 public:
  explicit PassageObserver(const Stops& stops)
      : stops_(stops),
        log_lower_(2 * std::log(stops.restitution_lower)),
        log_upper_(2 * std::log(stops.restitution_upper)),
        tangent_(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (differentiates_) [[unlikely]]
      tangent_.arc(arc, begin, length);
    if constexpr (A::effects.stiffness)
      if (const auto& stop = arc.constants().stop; stop.side != Side::none) {
        if (passage_.itinerary == 0) passage_.itinerary = itinerary_in_contact(stop.side);
        passage_.log_area -= 2 * stop.damping * length;
      }
  }
  void rest(const motion::Rest& rest) {
    add(rest.is_stick() ? 13 : rest.side == Side::upper ? 4 : 3);
    if (rest.held) passage_.rested_on = rest.side;
    see(rest.position, 0.0);
    passage_.log_area = -std::numeric_limits<double>::infinity();
    if (differentiates_) tangent_.rest(rest);
  }
  void impact(const motion::Impact& impact) {
    const bool upper = impact.side == Side::upper;
    add(upper ? 2 : 1);
    passage_.log_area += upper ? log_upper_ : log_lower_;
    see(impact.position, impact.before);
    if (differentiates_) tangent_.impact(impact);
  }

  /// Of a loose mass: areas are volumes of four numbers, of which a press takes two.
  void strike(const motion::Strike& strike) {
    add(strike.side == Side::upper ? 2 : 1);
    passage_.log_area += 2 * std::log(std::abs(strike.after / strike.before));
    see(strike.place, strike.v_before);
    passage_.loose_size = std::max({passage_.loose_size, std::abs(strike.wall), std::abs(strike.before)});
  }
  void press(const motion::Press& press) {
    add(press.side == Side::upper ? 4 : 3);
    passage_.log_area = -std::numeric_limits<double>::infinity();
  }

  void reversal(const motion::Reversal& reversal) {
    add(14);
    passage_.log_area += std::log(reversal.after / reversal.before);
    see(reversal.position, 0.0);
    if (differentiates_) tangent_.reversal(reversal);
  }

  void touch(const motion::Touch& touch) {
    add((touch.from_outside ? 5 : 7) + (touch.side == Side::upper));
    see(touch.position, touch.velocity);
    if (differentiates_) tangent_.touch(touch);
  }
  void separate(const motion::Separation& separation) { add(separation.side == Side::upper ? 10 : 9); }

  /// The contact of a period which begins in contact with a soft stop, as long as that goes on.
  [[nodiscard]] static constexpr std::uint64_t itinerary_in_contact(Side side) {
    return with(0, side == Side::upper ? 12 : 11);
  }

  void begin_section() { passage_ = {}; }
  /// Begins to compute the derivative anew, from here.
  void differentiate() { differentiates_ = true, tangent_ = motion::TangentMap<double>(stops_); }

  /// Makes the derivative that from here on, within an event, too.
  void begin_derivative_anew() { tangent_.begin_anew(); }

  [[nodiscard]] const Passage& passage() const { return passage_; }  ///< since the section
  [[nodiscard]] motion::Jacobian<double> derivative() const { return tangent_.map(); }

 private:
  [[nodiscard]] static constexpr std::uint64_t with(std::uint64_t itinerary, std::uint64_t event) {
    return (itinerary + event) * 0x9e3779b97f4a7c15u;
  }
  void see(double x, double v) { passage_.size = std::max({passage_.size, std::abs(x), std::abs(v)}); }
  void add(std::uint64_t event) { passage_.itinerary = with(passage_.itinerary, event); }

  Stops stops_;
  double log_lower_, log_upper_;  ///< logarithm of R^2, the factor by which an impact shrinks areas
  motion::TangentMap<double> tangent_;
  Passage passage_;
  bool differentiates_ = false;
};

/// The motion over n periods from a state; nothing if it fails. `advance(state)` runs it to the next section and shows
/// it to `watch`.
template <class Advance>
[[nodiscard]] std::optional<MapOrbit> orbit_from(motion::State<double> state, std::size_t periods,
                                                 PassageObserver& watch, Advance&& advance) {
  MapOrbit orbit{.periods = periods};
  orbit.states[0] = state, orbit.derivatives[0] = {1, 0, 0, 1};
  watch.differentiate();
  for (std::size_t i = 1; i <= periods; ++i) {
    watch.begin_section();
    if (advance(state) != stepping::Outcome::completed) return std::nullopt;
    orbit.states[i] = state, orbit.derivatives[i] = watch.derivative();
    orbit.passages[i - 1] = watch.passage();
  }
  return orbit;
}

}  // namespace clatter::steady
