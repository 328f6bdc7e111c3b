#pragma once

#include "model/oscillator.hpp"
#include "model/stops.hpp"

namespace clatter::inline model {

/// An instant of a motion, seen from the load's equilibrium.
struct PhaseState {
  double x, v;          ///< displacement minus the load, velocity
  double sine, cosine;  ///< of the forcing phase
};

/// Displacement and velocity, or their differences.
struct PhasePoint {
  double x, v;
};

/// The steady forced response at a forcing phase, from the load's equilibrium; 0 without forcing, infinite or NaN where
/// there is none (h = 0, nu = 1).
[[nodiscard]] PhasePoint response_at(const Oscillator& oscillator, double sine, double cosine);

/// What is left of the transient at an instant: the motion minus its steady forced response.
[[nodiscard]] PhasePoint transient_of(const Oscillator& oscillator, const PhaseState& now);

/// Bound of the transient's displacement from a time `after` on, while no stop interferes: of its decaying rotation for
/// 0 < h < 1, of its decays for h >= 1, of its energy norm, which never grows.
[[nodiscard]] double transient_bound(const Oscillator& oscillator, const PhasePoint& transient, double after = 0.0);

/// The time after which `transient_bound` is no larger than `most`; infinite where it never is.
[[nodiscard]] double fading_time(const Oscillator& oscillator, const PhasePoint& transient, double most);

/// Bound of |x - load| from an instant on for a time `duration` (inf: for all time), while no stop interferes; infinite
/// where nothing bounds the motion. Rounding is allowed for. A bound below `enough` isn't made any sharper.
///
/// Of three bounds the least: response plus transient; the energy norm, which the force raises by at most |f| in a unit
/// of time; and for 0 < h < 1 the envelope of their beats: x - load is the imaginary part of
/// e^{i nu t} [R + B e^{(-h + i(lambda - nu)) t}], whose modulus is at most |R| or what it is in the first turn of the
/// second term around the first.
[[nodiscard]] double displacement_bound(const Oscillator& oscillator, const PhaseState& now, double duration,
                                        double enough);

/// Bound of |x - load| for a time `duration` that holds through impacts too: they take energy, and the force raises the
/// energy norm by at most |f| in a unit of time. Infinite where nothing bounds the motion.
[[nodiscard]] double displacement_bound_through_impacts(const Oscillator& oscillator, const PhaseState& now,
                                                        double duration);

/// Whether no stop can be met from an instant on, for all time.
[[nodiscard]] bool out_of_reach(const Oscillator& oscillator, const PhaseState& now, const Stops& stops);

}  // namespace clatter::inline model
