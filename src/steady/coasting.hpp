#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/displacement_bound.hpp"
#include "scene/response.hpp"
#include "steady/observed_time.hpp"
#include "stepping/exact.hpp"

namespace clatter::steady {

inline constexpr double longest_settling = 0x1p52;  ///< the most forcing periods that double counts exactly

/// Forced motion that no stop interrupts any more: the transient fades, and the steady response is left.
template <Effects E>
class Coasting {
 public:
  Coasting(const stepping::Exact<double, E>& integrator, const Scene& scene, double tolerance)
      : integrator_(integrator),
        scene_(scene),
        tolerance_(tolerance),
        is_possible_(scene.oscillator.damping != 0 && scene.oscillator.shape.is_sine() && !integrator.is_rough() &&
                     !(E.stops() && response_meets(scene.oscillator, innermost(integrator.stops())))) {}

  /// The steady response, if no stop is in reach from a state at a section on and damping removes the rest of the
  /// transient, however long that may take: after `settled` forcing periods of the motion, of which, with those of
  /// attempts, `simulated` were run.
  [[nodiscard]] std::optional<ObservedTime> from(const motion::State<double>& state, double settled,
                                                 double simulated) const {
    if (!is_possible_) return std::nullopt;
    const Oscillator& o = scene_.oscillator;
    const auto [sine, cosine] = integrator_.phase(motion::State<double>{});
    const double middle = equilibrium_of(o);
    const PhaseState now{state.x - middle, state.v, sine, cosine};
    if (E.stops() && !out_of_reach(o, now, innermost(integrator_.stops()))) return std::nullopt;
    const PhasePoint response = response_at(o, sine, cosine), left{now.x - response.x, now.v - response.v};
    const double x = middle + response.x;
    double size = std::max(std::abs(x), std::abs(response.v));
    if (size == 0)  // without a force, between stops that move by themselves
      for (const double stop : {scene_.stops.lower, scene_.stops.upper})
        if (std::isfinite(stop)) size = std::max(size, std::abs(stop));
    const double most = tolerance_ * size;
    const double periods = fading_time(o, left, most) / integrator_.period();
    if (!(periods < longest_settling)) return std::nullopt;
    motion::State<double> steady = state;
    steady.x = x, steady.v = response.v, steady.from_stop = Side::none;
    return ObservedTime{Status::periodic, steady, 1.0, simulated, FoundBy::closed_form, settled + periods};
  }

 private:
  const stepping::Exact<double, E>& integrator_;
  const Scene& scene_;
  double tolerance_;
  bool is_possible_;  ///< the transient may die out without a contact
};

}  // namespace clatter::steady
