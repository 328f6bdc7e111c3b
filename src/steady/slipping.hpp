#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scene/displacement_bound.hpp"
#include "scene/response.hpp"
#include "steady/contraction.hpp"
#include "steady/stroboscopic_map.hpp"

namespace clatter::steady {

/// Forced motion under dry friction that no stop interrupts any more. Friction of one level takes energy from the
/// difference of any two such motions, and so does damping: if one of them is periodic, and moves, all settle to it.
template <Effects E>
class Slipping {
 public:
  Slipping(StroboscopicMap<E>& map, const stepping::Exact<double, E>& integrator, const Scene& scene, double tolerance)
      : map_(map),
        integrator_(integrator),
        scene_(scene),
        tolerance_(tolerance),
        may_exist_(integrator.is_rough() && scene.friction.kinetic == scene.friction.static_level &&
                   scene.oscillator.damping > 0 && scene.oscillator.stiffness > 0 &&
                   !response_meets(scene.oscillator, integrator.stops())) {}

  /// The periodic motion that the motion from a state at a section is proved to settle to; nothing if a stop may be in
  /// reach, or Newton's method doesn't find it from the response without friction.
  [[nodiscard]] std::optional<MapOrbit> from(const motion::State<double>& state) {
    if (!may_exist_) return std::nullopt;
    if (!orbit_) orbit_ = periodic(state);
    may_exist_ = orbit_.has_value();
    if (!may_exist_ || !keeps_clear(state)) return std::nullopt;
    const double rounds =
        std::log(between(state, orbit_->states[0]).size() / (tolerance_ * size_of(orbit_->states[0]))) /
        -std::log(spectral_radius(orbit_->derivative()));
    orbit_->settling = std::max(0.0, rounds);
    return orbit_;
  }

 private:
  /// How far a motion reaches, whose velocity is 0 where it turns back or sticks.
  struct Reach {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool meets = false, moves = false;

    template <class A>
    void arc(const A&, double, double length) {
      moves = moves || length > 0;
    }
    void event(const motion::Event& event) {
      using Kind = motion::Event::Kind;
      meets = meets || (event.kind != Kind::reversal && event.kind != Kind::stick);
      low = std::min(low, event.place), high = std::max(high, event.place);
    }
  };

  [[nodiscard]] static double size_of(const motion::State<double>& state) {
    return std::max(std::abs(state.x), std::abs(state.v));
  }

  /// From the steady response without friction.
  [[nodiscard]] std::optional<MapOrbit> periodic(const motion::State<double>& at_section) {
    constexpr int most_iterations = 8;
    const auto [sine, cosine] = integrator_.phase(motion::State<double>{});
    const PhasePoint response = response_at(scene_.oscillator, sine, cosine);
    motion::State<double> start;
    start.x = equilibrium_of(scene_.oscillator) + response.x, start.v = response.v, start.periods = at_section.periods;
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      reach_ = {};
      const std::optional<MapOrbit> orbit = map_.follow(start, 1, reach_);
      if (!orbit || reach_.meets) return std::nullopt;
      const double gap = orbit->gap().size();
      const bool is_found = before <= tolerance_ * size_of(start);  // and is a step closer than that
      if (is_found) return reach_.moves && spectral_radius(orbit->derivative()) < 1 ? orbit : std::nullopt;
      if (!(gap < before)) return std::nullopt;
      before = gap;
      const motion::Perturbation step = newton_step(orbit->derivative(), orbit->gap());
      start.x += step.x, start.v += step.v;
    }
    return std::nullopt;
  }

  /// Whether the energy norm of the difference, which never grows, leaves no stop in reach.
  [[nodiscard]] bool keeps_clear(const motion::State<double>& state) const {
    const motion::State<double>& start = orbit_->states[0];
    const double rate = natural_frequency(scene_.oscillator),
                 off = std::hypot(state.x - start.x, (state.v - start.v) / rate);
    const double most = off * (1 + 1e-9) + 64 * epsilon<double>() * std::max(-reach_.low, reach_.high);
    return state.within == Side::none && reach_.low - most > integrator_.stops().lower &&
           reach_.high + most < integrator_.stops().upper;
  }

  StroboscopicMap<E>& map_;
  const stepping::Exact<double, E>& integrator_;
  const Scene& scene_;
  double tolerance_;
  bool may_exist_;
  Reach reach_{};
  std::optional<MapOrbit> orbit_{};
};

/// In place of it without friction.
struct NoSlipping {
  template <class... Arguments>
  explicit NoSlipping(const Arguments&...) {}
};

}  // namespace clatter::steady
