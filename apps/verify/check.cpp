#include "check.hpp"

#include <algorithm>

#include "claims.hpp"
#include "deadline.hpp"
#include "eigenvalues.hpp"
#include "order.hpp"

namespace verify {
namespace {

/// Motion without an event swings about where the forces balance. In a scene that is its own mirror image this is the
/// centre, if no stop acts, and sin(theta + pi) = -sin(theta); within a stop it never crosses over to the other one.
void check_symmetry_of(const Certificate& certificate, const Scene& scene, const Response& found, Report& report) {
  if (!certificate.symmetric) return;
  if (!mirror_centre(scene)) return report.add(Verdict::undecided, "symmetric: the scene isn't, to its last digit");
  if (*certificate.symmetric != found.within_stop) return;
  report.add(Verdict::refuted,
             found.within_stop ? "symmetric: claimed true, found false" : "symmetric: claimed false, found true");
}

void check_response(const Certificate& certificate, const Scene& scene, const Response& found, Report& report) {
  if (certificate.periods != 1)
    report.add(Verdict::refuted, "periods: claimed " + std::to_string(certificate.periods) + ", found 1");
  report.compare("start, x", found.start.x, certificate.start_x);
  report.compare("start, v", found.start.y, certificate.start_v);
  if (certificate.x_min) report.compare("x_min", found.x_min, *certificate.x_min);
  if (certificate.x_max) report.compare("x_max", found.x_max, *certificate.x_max);
  check_multipliers(certificate, eigenvalues(found.derivative), report);
  check_word(certificate, Cycle({}, scene.period()), scene, found.start.x, report);
  check_symmetry_of(certificate, scene, found, report);
}

void check_periodic(const Certificate& certificate, Report& report) {
  const Scene scene = certificate.scene_in_balls();
  if (const auto response = steady_response(certificate, scene))
    return check_response(certificate, scene, *response, report);
  const Orbit orbit = claimed_orbit(certificate, scene);
  compare_events(certificate, orbit.events, report);
  if (!certificate.released) {
    report.compare("start, x", orbit.x(), certificate.start_x);
    report.compare("start, v", orbit.v(), certificate.start_v);
  }
  if (orbit.in_flight) {
    report.compare("start, z", orbit.in_flight->first[2], certificate.start_z);
    report.compare("start, w", orbit.in_flight->first[3], certificate.start_w);
  }
  compare_extrema(certificate, *orbit.motion, orbit.events, scene, report);
  check_multipliers(certificate, orbit.multipliers(), report);
  const Cycle cycle(orbit.events, length_of(scene, certificate.periods), certificate.pressed.has_value());
  check_word(certificate, cycle, scene, orbit.x(), report);
  check_smallest_period(certificate, scene, orbit, cycle, report);
  check_symmetry(certificate, scene, orbit, cycle, report);
}

void check_transient(const Certificate& certificate, Report& report) {
  const Scene scene = certificate.scene_in_balls();
  Motion motion(scene, certificate.start_in_balls(), Four::zero());
  const Ball length = certificate.end->time.ball() - motion.start_time();  // of motion that a stop releases from there
  if (length.is_negative()) throw Refuted("end: claimed before the stop releases the mass");
  if (!length.is_positive()) throw Undecided("whether the motion ends before the stop releases the mass");
  Course course(certificate, motion, certificate.end->time.ball());
  try {
    course.run();
  } catch (...) {
    compare_events(certificate, course.events(), report);  // what was found before stands
    throw;
  }
  compare_events(certificate, course.events(), report);
  compare_extrema(certificate, motion, course.events(), scene, report);
  const Four end = motion.state();
  report.compare("end, x", end[0], certificate.end->x);
  report.compare("end, v", end[1], certificate.end->v);
  if (!scene.loose) return;
  report.compare("end, z", end[2], certificate.end->z);
  report.compare("end, w", end[3], certificate.end->w);
}

Finding found_in(const Certificate& certificate, slong precision) {
  const Precision present(precision);
  Report report;
  try {
    require_possible_order(certificate);
    if (certificate.special)
      check_special(certificate, report);
    else if (certificate.periodic)
      check_periodic(certificate, report);
    else
      check_transient(certificate, report);
  } catch (const Refuted& refuted) {
    report.add(Verdict::refuted, refuted.what());
  } catch (const Undecided& undecided) {
    report.add(Verdict::undecided, undecided.what());
  } catch (const OutOfTime& over) {
    report.add(Verdict::undecided, over.what());
  }
  Finding finding = report.finding();
  finding.bits = precision;
  return finding;
}

}  // namespace

Finding check(const Certificate& certificate) {
  Finding finding;
  const bool chatters =
      std::ranges::any_of(certificate.events, [](const ClaimedEvent& event) { return event.kind == Kind::chatter; });
  for (slong precision = chatters ? 128 : 64; precision <= 1024; precision *= 2) {  // its last flights are minute
    finding = found_in(certificate, precision);
    if (finding.verdict != Verdict::undecided || deadline.is_over()) break;
  }
  return finding;
}

}  // namespace verify
