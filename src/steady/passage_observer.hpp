#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include "motion/housed_arc.hpp"
#include "motion/loose_tangent.hpp"
#include "motion/tangent_map.hpp"
#include "steady/map_orbit.hpp"
#include "stepping/integration.hpp"
#include "stepping/integrator.hpp"

namespace clatter::steady {

/// Records, for the search of a periodic motion, which stops are hit, rested on, touched and left between sections, and
/// where the mass sticks or turns back, in their order, and if asked for the derivative of the motion.
template <class Tangent>
class BasicPassageObserver {
 public:
  explicit BasicPassageObserver(const Stops& stops) requires std::is_same_v<Tangent, motion::TangentMap<double>>
      : BasicPassageObserver(stops, Tangent(stops)) {}
  /// `tangent` is a derivative that hasn't begun.
  BasicPassageObserver(const Stops& stops, const Tangent& tangent)
      : stops_(stops),
        log_lower_(2 * std::log(stops.restitution_lower.R)),
        log_upper_(2 * std::log(stops.restitution_upper.R)),
        anew_(tangent),
        tangent_(tangent) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (differentiates_) [[unlikely]]
      tangent_.arc(arc, begin, length);
    if constexpr (motion::Housed<A>) see_hold(arc.loose), see_soft_wall(arc.loose, length);
    if constexpr (A::effects.stiffness)
      if (const auto& stop = arc.constants().stop; stop.side != Side::none) {
        if (passage_.itinerary == 0) passage_.itinerary = itinerary_in_contact(stop.side);
        passage_.log_area -= 2 * stop.damping * length;
      }
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind == Kind::hold) {
      if (event.side == Side::none)
        stick_in_housing(event);
      else
        passage_.meets_wall = true;
      return;
    }
    passage_.itinerary = with(passage_.itinerary, mark_of(event));
    if (event.lasts() || event.kind == Kind::press)
      passage_.log_area = -std::numeric_limits<double>::infinity();
    else
      passage_.log_area += log_of_area(event);
    if (event.lasts() && event.held) passage_.rested_on = event.side;
    if (event.kind == Kind::strike || event.is_of_soft_wall()) {
      passage_.meets_wall = true;
      see(event.main.place, event.main.before);
      passage_.loose_size = std::max({passage_.loose_size, std::abs(event.place), std::abs(event.before)});
    } else if (event.kind != Kind::separation && event.kind != Kind::press) {
      see(event.place, event.velocity());
    }
    if (differentiates_) tangent_.event(event);
  }

  /// The contact of a period which begins in contact with a soft stop, as long as that goes on.
  [[nodiscard]] static constexpr std::uint64_t itinerary_in_contact(Side side) {
    return with(0, in_contact + (side == Side::upper));
  }

  void begin_section() { passage_ = {}, slide_.reset(); }
  /// Begins to compute the derivative anew, from here.
  void differentiate() { differentiates_ = true, tangent_ = anew_; }
  void stop_differentiating() { differentiates_ = false; }

  /// Makes the derivative that from here on, within an event, too.
  void begin_derivative_anew() { tangent_.begin_anew(); }

  [[nodiscard]] const Passage& passage() const { return passage_; }  ///< since the section
  [[nodiscard]] auto derivative() const { return tangent_.map(); }

 private:
  /// The mark of an event in an itinerary, > 0.
  [[nodiscard]] static constexpr std::uint64_t mark_of(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    const std::uint64_t upper = event.side == Side::upper;
    switch (event.kind) {
      case Kind::impact:
        return 1 + upper;
      case Kind::rest:
      case Kind::chatter:
        return 3 + upper;
      case Kind::touch:
        return 5 + upper;
      case Kind::renewal:
        return 7 + upper;
      case Kind::separation:
        return 9 + upper;
      case Kind::stick:
        return 13;
      case Kind::reversal:
        return 14;
      case Kind::strike:
        return 15 + upper;
      case Kind::press:
      case Kind::hold:
        return 17 + upper;
      case Kind::wall_touch:
        return 21 + upper;
      case Kind::wall_renewal:
        return 23 + upper;
      case Kind::wall_separation:
        return 25 + upper;
    }
    return 0;
  }
  static constexpr std::uint64_t in_contact = 11;  ///< with a soft stop, the lower one
  static constexpr std::uint64_t held_in_housing = 19, slides = 20;
  static constexpr std::uint64_t in_soft_wall = 27;  ///< the lower one

  /// The logarithm of the factor by which an event at an instant changes areas; of a loose mass they are volumes of
  /// four numbers, of which a press takes two.
  [[nodiscard]] double log_of_area(const motion::Event& event) const {
    using Kind = motion::Event::Kind;
    if (event.kind == Kind::impact) {
      const Restitution<double>& law = law_of(stops_, event.side);
      if (law.is_constant()) return event.side == Side::upper ? log_upper_ : log_lower_;
      return std::log(law.share(event.before) * -law.derivative(event.before));
    }
    if (event.kind == Kind::strike) return log_of_strike(event);
    return event.kind == Kind::reversal ? std::log(event.a_after / event.a_before) : 0.0;
  }
  [[nodiscard]] double log_of_strike(const motion::Event& strike) const {
    const double share = std::abs(strike.after / strike.before);
    if constexpr (std::is_same_v<Tangent, motion::LooseTangent>) {
      const Restitution<double>& law = anew_.law(strike.side);
      if (!law.is_constant()) return std::log(share * -law.derivative(strike.before));
    }
    return 2 * std::log(share);
  }
  [[nodiscard]] static constexpr std::uint64_t with(std::uint64_t itinerary, std::uint64_t mark) {
    return (itinerary + mark) * 0x9e3779b97f4a7c15u;
  }
  /// Friction holds a loose mass in its housing, which takes z'.
  void stick_in_housing(const motion::Event& hold) {
    passage_.log_area = -std::numeric_limits<double>::infinity();
    passage_.loose_size = std::max(passage_.loose_size, std::abs(hold.place));
  }
  /// Friction in the housing begins to hold the loose mass, turns it, or lets it go: y'' is another one from here on.
  template <class L>
  void see_hold(const L& loose) {
    if (motion::wall_of(loose) != Side::none) return;
    double load = std::numeric_limits<double>::infinity();
    if constexpr (requires { loose.load(); }) load = loose.load();
    if (slide_ && *slide_ != load)
      passage_.itinerary = with(passage_.itinerary, std::isinf(load) ? held_in_housing : slides);
    slide_ = load;
  }
  /// The contact with a soft wall of a period that begins in it, and what its damper takes of a volume.
  template <class L>
  void see_soft_wall(const L& loose, double length) {
    if constexpr (requires { loose.coupling(); }) {
      const auto& coupling = loose.coupling();
      passage_.meets_wall = true;
      if (!coupling.pushes) return;
      if (passage_.itinerary == 0) passage_.itinerary = with(0, in_soft_wall + (coupling.wall.side == Side::upper));
      passage_.log_area -= 2 * coupling.wall.damping * (1 + coupling.ratio) / coupling.ratio * length;
    }
  }
  void see(double x, double v) { passage_.size = std::max({passage_.size, std::abs(x), std::abs(v)}); }

  Stops stops_;
  double log_lower_, log_upper_;  ///< logarithm of R^2, by which an impact shrinks areas if R is constant
  Tangent anew_, tangent_;
  Passage passage_;
  bool differentiates_ = false;
  std::optional<double> slide_{};  ///< y'' of the loose mass in the flight or slide before, infinite if it was held
};

using PassageObserver = BasicPassageObserver<motion::TangentMap<double>>;

using HousingObserver = BasicPassageObserver<motion::LooseTangent>;

/// That of the motion that an integrator computes, with a loose mass or without.
template <stepping::Integrator I>
[[nodiscard]] auto passage_observer(const I& integrator, const Scene& scene) {
  if constexpr (I::effects.loose)
    return HousingObserver(integrator.stops(), motion::LooseTangent(scene));
  else
    return PassageObserver(integrator.stops());
}

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
