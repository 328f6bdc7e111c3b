#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "dynamics/oscillator.hpp"
#include "dynamics/stops.hpp"

namespace clatter {

/// Where the motion begins, at tau = 0.
struct Start {
  double displacement = 0.0;  ///< x0, between the stops
  double velocity = 0.0;      ///< v0
  double phase = 0.0;         ///< forcing phase at tau = 0, rad
};

enum class Mode : std::uint8_t { steady, transient };

/// How long a scene is run and when its motion counts as repeated. "Periods" are forcing periods, 2 pi / nu; without
/// forcing, 2 pi.
struct TimePlan {
  Mode mode = Mode::steady;
  std::int64_t max_periods = 5000;  ///< periods after which settling is given up, >= 1
  std::int64_t window = 64;         ///< periods observed of a motion that does not repeat, >= 1
  double duration = 0.0;            ///< transient: observed time in tau, > 0
  double tolerance = 1e-12;         ///< distance of the states at a repeat, relative to the larger of |x| and |v|
  double max_impacts = 1e8;         ///< impacts after which a point is given up (event_budget)
};

enum class HarmonicsMethod : std::uint8_t { fft, exact };

/// What is computed and stored; nothing else is.
struct Observe {
  bool extrema = false;
  std::int64_t harmonics = 0;  ///< highest harmonic K, 0: none observed
  HarmonicsMethod harmonics_method = HarmonicsMethod::fft;
  std::int64_t harmonics_samples = 4096;  ///< FFT samples over the observed time
  double base_frequency = 0.0;            ///< of harmonics; 0: the force's, without forcing the motion's own
  bool impacts = false;
  bool impact_log = false;
  bool full_log = false;        ///< with the impact log: every rest and completed chatter, and an impact at t0 itself
  std::int64_t trajectory = 0;  ///< samples over the observed time, both ends included; 0: none
  bool period = false;
  bool stability = false;
};

enum class Method : std::uint8_t { exact, dopri5, moreau };

/// In the order of Method.
inline constexpr std::array<std::string_view, 3> method_names{"exact", "dopri5", "moreau"};

/// How arcs, impacts and rests are computed.
struct Integration {
  Method method = Method::exact;
  double tolerance = 1e-10;  ///< dopri5: error of a step, relative to the motion
  double step = 1e-3;        ///< moreau: in forcing periods
  double theta = 0.5;        ///< moreau: share of a step's end in its mean, 0 ... 1
  bool shortcuts = true;     ///< exact: settle by closed forms and Newton's method where they hold
  bool all_effects = false;  ///< simulate every effect and take no shortcut, to compare with
};

/// One point of a sweep: everything its motion and its results depend on.
struct Scene {
  Oscillator oscillator;
  Stops stops;
  Start start;
  TimePlan time;
  Observe observe;
  Integration integration;
};

/// What became of a point; from `event_budget` on it has failed.
enum class Status : std::uint8_t {
  periodic = 0,
  aperiodic = 1,
  transient = 2,
  grazing = 3,  ///< periodic, but touches a stop within rounding: its stability doesn't exist
  event_budget = 16,
  not_finite = 17,
  unresolved = 18
};

/// Every status and its name.
inline constexpr std::array<std::pair<Status, std::string_view>, 7> status_names{
    {{Status::periodic, "periodic"},
     {Status::aperiodic, "aperiodic"},
     {Status::transient, "transient"},
     {Status::grazing, "grazing"},
     {Status::event_budget, "event_budget"},
     {Status::not_finite, "not_finite"},
     {Status::unresolved, "unresolved"}}};

[[nodiscard]] constexpr bool failed(Status status) { return status >= Status::event_budget; }

}  // namespace clatter
