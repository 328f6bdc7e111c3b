#pragma once

#include "math/number.hpp"
#include "scene/oscillator.hpp"
#include "scene/scene.hpp"

namespace clatter {
inline namespace scene {

/// An instant of a motion, relative to the load's equilibrium.
struct PhaseState {
  double x, v;          ///< displacement minus the load, velocity
  double sine, cosine;  ///< of the forcing phase
};

/// Displacement and velocity, or their differences.
struct PhasePoint {
  double x, v;
};

/// The steady forced response at a forcing phase (eq. 5), from the load's equilibrium; 0 without forcing, infinite or
/// NaN if there is none (h = 0, nu = 1).
[[nodiscard]] PhasePoint response_at(const Oscillator& oscillator, double sine, double cosine);

/// The transient at an instant: the motion minus its steady forced response.
[[nodiscard]] PhasePoint transient_of(const Oscillator& oscillator, const PhaseState& now);

/// Bound of the transient's displacement from a time `after` on, while no stop interferes: by its decaying rotation for
/// 0 < h < 1, by its decays for h >= 1, by its energy norm, which never grows.
[[nodiscard]] double transient_bound(const Oscillator& oscillator, const PhasePoint& transient, double after = 0.0);

/// The time after which `transient_bound` is no larger than `most`; infinite if it never is.
[[nodiscard]] double fading_time(const Oscillator& oscillator, const PhasePoint& transient, double most);

/// Bound of the distance from the equilibrium from an instant on for a time `duration` (inf: for all time), while no
/// stop interferes; infinite if nothing bounds the motion. Rounding is allowed for. A bound below `enough` isn't made
/// any sharper, nor, unless `enough` is 0, one that can't get below it.
///
/// The least of three bounds: response plus transient (eq. 16); the energy norm, which the force raises by at most |f|
/// in a unit of time (eq. 18); and for 0 < h < 1 the envelope of the beats of response and transient (eq. 19), which is
/// greatest in the first turn of the second term around the first, or |R|.
[[nodiscard]] double displacement_bound(const Oscillator& oscillator, const PhaseState& now, double duration,
                                        double enough);

/// Bound of the part of a displacement that friction makes, while no stop interferes: it is a force of at most mu in
/// either direction (eq. 62). Infinite if nothing bounds it.
[[nodiscard]] double friction_bound(const Oscillator& oscillator, const Friction& friction);

/// Bound of the distance from the equilibrium for a time `duration` that holds through impacts too, since they take
/// energy, as does friction (eq. 18); infinite if nothing bounds the motion.
[[nodiscard]] double displacement_bound_through_impacts(const Oscillator& oscillator, const PhaseState& now,
                                                        double duration);

/// Whether the steady forced response alone meets a stop.
[[nodiscard]] bool response_meets(const Oscillator& oscillator, const Stops& stops);

/// Whether undamped motion without stops is at resonance to rounding: then it grows for ever.
[[nodiscard]] bool grows_at_resonance(const Scene& scene);

/// Whether motion from displacement x and velocity v at a forcing phase is proved to leave every bound: at resonance,
/// or without a spring that holds the mass (k <= 0) in a direction in which there is no stop, and never to meet the
/// other one (eq. 49).
[[nodiscard]] bool escapes(const Scene& scene, double x, double v, const SineCosine<double>& phase);

/// Whether dry friction holds a mass at x, away from rigid stops, for all time once its velocity is 0.
[[nodiscard]] bool sticks_for_good(const Scene& scene, double x);

/// Whether dry friction holds a mass for all time where it starts.
[[nodiscard]] bool never_moves(const Scene& scene);

/// Whether no stop can be met from an instant on, for all time.
[[nodiscard]] bool out_of_reach(const Oscillator& oscillator, const PhaseState& now, const Stops& stops);

}  // namespace scene
}  // namespace clatter
