#pragma once

#include <cmath>

#include "certificates/certified_point.hpp"
#include "observables/contacts/impact_word.hpp"

namespace clatter::certificates {

/// The claims of a motion that begins at a time with the start of its problem, whose phase is then that of time 0.
template <class Motion, class Bounds>
Certificate claims_of(const point::Problem& problem, const Motion& motion, const Bounds& bounds,
                      const point::PointResult& result) {
  Certificate certificate{.scene = problem};
  auto& events = certificate.events;
  for (const auto& event : motion.events) {
    events.push_back(bounds.claimed(event, events.empty() ? nullptr : &events.back()));
    if (const std::size_t n = events.size(); n > 1 && bounds.is_cut(events[n - 2], events[n - 1]))
      events[n - 2].then = events[n - 1].time;
  }
  certificate.x_min = bounds.claimed_extremum(result.x_min), certificate.x_max = bounds.claimed_extremum(result.x_max);
  return certificate;
}

/// Drops a certificate whose errors are so large that it says nothing.
template <class Bounds>
void keep_if_known(CertifiedPoint& point, const Bounds& bounds) {
  point.without = bounds.tell(*point.certificate) ? Without::none : Without::rounding;
  if (point.without != Without::none) point.certificate.reset();
}

/// Certifies a transient, with its claims and its end.
template <class Bounds, class Motion>
void certify_run(const point::Problem& problem, Motion motion, const point::PointResult& result,
                 CertifiedPoint& point) {
  motion.duration = problem.time.duration;
  const Bounds bounds(problem, motion, result, 0.0, false);
  point.certificate = claims_of(problem, motion, bounds, result);
  point.certificate->end = bounds.claimed_end(motion);
  keep_if_known(point, bounds);
}

/// What is claimed of a period besides its multipliers.
inline ClaimedPeriod period_of_result(const point::PointResult& result) {
  ClaimedPeriod period{.periods = static_cast<std::size_t>(std::llround(result.observed_turns))};
  if (result.impact_word.size() <= observables::ImpactWord::longest) period.word = result.impact_word;
  if (!std::isnan(result.symmetric)) period.symmetric = result.symmetric == 1.0;
  return period;
}

/// Certifies a period that begins at a time after a section, whose phase is `section_phase`, with the start of its
/// problem; `add(certificate, bounds)` adds the multipliers and what holds the mass.
template <class Bounds, class Motion, class Add>
void certify_period(const point::Problem& at_start, double time, const Motion& motion, double section_phase,
                    const point::PointResult& result, CertifiedPoint& point, Add&& add) {
  const Bounds bounds(at_start, motion, result, time, true);
  if (!bounds.know_the_start()) {
    point.without = Without::family;
    return;
  }
  Certificate& certificate = point.certificate.emplace(claims_of(at_start, motion, bounds, result));
  certificate.scene.start.phase = section_phase, certificate.time = time;
  certificate.x_error = certificate.v_error = bounds.of_start();
  certificate.period = period_of_result(result);
  add(certificate, bounds);
  keep_if_known(point, bounds);
}

}  // namespace clatter::certificates
