#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "observables/extremes/range.hpp"
#include "point/problem.hpp"
#include "stepping/integration.hpp"

namespace clatter::accuracy {

using motion::Event;

/// The events of a run, as recorders keep them, as they are compared: contacts with soft stops as impacts, and no
/// separations.
[[nodiscard]] std::vector<Event> as_compared(const std::vector<Event>& events);

/// Joins the parts into which stroboscopic sections cut a rest or a chatter: then there is one for each time on a stop.
[[nodiscard]] std::vector<Event> with_rests_joined(const std::vector<Event>& events);

/// Takes the slow impacts that end a chatter of a loose mass on a wall, up to a millionth of the fastest, for a summed
/// end: methods take as many of them as their digits can tell.
[[nodiscard]] std::vector<Event> with_slow_impacts_summed(const std::vector<Event>& events);

/// Whether a chatter consists of such events: impacts and, under friction, the turns between them.
[[nodiscard]] constexpr bool is_of_chatter(const Event& event) {
  return event.kind == Event::Kind::impact || event.kind == Event::Kind::reversal;
}

/// A run of a scene, rounded to doubles from its number type.
struct RunRecord {
  stepping::Outcome outcome = stepping::Outcome::unresolved;
  std::vector<Event> events{};
  double duration = 0.0;
  double x = 0.0, v = 0.0;                  ///< at the end
  double z = 0.0, w = 0.0;                  ///< of a loose mass in its housing, at the end
  double impacts = 0.0;                     ///< number of impacts
  double evaluations = 0.0;                 ///< of arcs
  observables::Range x_range{}, v_range{};  ///< if observables are asked for
  std::vector<std::complex<double>> harmonics{},
      v_harmonics{};  ///< of x and x', shape [harmonic], as Spectrum takes them
};

/// The observables of a run record, besides its events.
struct RecordObservables {
  std::size_t harmonics = 0;  ///< highest
  double base_frequency = 1.0;
};

/// The run of a scene from its start for a time in tau, in double, without observables.
[[nodiscard]] RunRecord record_of(const point::Problem& scene, double duration);

/// The run of a scene in 50 digits, by the source that runs it in double: the reference. It completes a chatter only
/// long after a double would have done so. Observables are taken from its arcs, each rounded to double at its start: an
/// error of a few roundings, which doesn't grow. The outcome is `unresolved` if `stopped`, which is called at every
/// section, ends it.
[[nodiscard]] RunRecord reference_of(const point::Problem& scene, double duration,
                                     const std::optional<RecordObservables>& observables = std::nullopt,
                                     const std::function<bool()>& stopped = {});

/// The periodic motion of so many forcing periods, a whole number, near the scene's start, by Newton's method in 50
/// digits; nothing if that doesn't converge to 30 digits, or `stopped` ends it.
[[nodiscard]] std::optional<RunRecord> periodic_reference(const point::Problem& scene, double periods,
                                                          const RecordObservables& observables,
                                                          const std::function<bool()>& stopped = {});

}  // namespace clatter::accuracy
