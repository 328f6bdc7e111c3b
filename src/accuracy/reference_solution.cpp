#include "accuracy/reference_solution.hpp"

#include <algorithm>
#include <cmath>

#include "accuracy/comparison.hpp"
#include "motion/walls.hpp"
#include "point/exact_motion.hpp"
#include "point/point.hpp"
#include "stepping/run.hpp"

namespace clatter::accuracy {
namespace {

constexpr double steady_tolerance = 1e-12;
/// Forcing periods by which double and 50 digits may differ: half the digits.
constexpr double agreement_tolerance = 1e-8;

/// Finds the motion from the start in 50 digits, for as long as a run in double agrees.
void find_motion_from_start(const point::Problem& scene, double duration, const std::function<bool()>& stopped,
                            ReferenceSolution& found) {
  const double period = period_of(scene.oscillator);
  const RunRecord in_double = record_of(scene, duration);
  RunRecord exact = reference_of(scene, duration, observables_over(scene, duration), stopped);
  const stepping::Outcome outcome =
      in_double.outcome != stepping::Outcome::completed ? in_double.outcome : exact.outcome;
  found.not_run = outcome != stepping::Outcome::completed ? steady::status_of(outcome) : steady::Status::transient;
  if (outcome != stepping::Outcome::completed) return;
  Agreement agreement = agreement_of(in_double, exact, agreement_tolerance * period);
  const bool throughout = agreement.until == duration;
  found.horizon = throughout ? found.asked : std::floor(agreement.until / period);
  if (!(found.horizon > 0)) return;
  if (!throughout) {
    const double end = found.horizon * period;
    exact = reference_of(scene, end, observables_over(scene, end), stopped);
    std::erase_if(agreement.events, [&](const Event& event) { return event.time > end; });
    for (Event& event : agreement.events) event.length = std::min(event.length, end - event.time);
  }
  exact.events = std::move(agreement.events);
  found.from_start = std::move(exact);
}

/// Whether a periodic motion in 50 digits is the one found in double, not another one nearby.
bool same_motion(const RunRecord& exact, const Start& in_double) {
  const double size = std::max(std::abs(exact.x), std::abs(exact.v));
  return std::max(std::abs(exact.x - in_double.displacement), std::abs(exact.v - in_double.velocity)) <= 1e-6 * size;
}

/// Starts a loose mass at a place between its walls, to rounding.
void put_loose_mass(point::Problem& scene, double z, double w) {
  scene.loose.place = std::clamp(z, scene.loose.lower, scene.loose.upper), scene.loose.velocity = w;
}

/// Starts both masses of a scene on its steady motion, whose result tells of the main mass alone.
void start_on_steady_motion(point::Problem& scene) {
  const steady::ObservedTime found = point::ExactMotion::of(scene)->find_steady();
  const auto [z, w] = motion::place_in_housing(found.from, scene.loose);
  scene.start.displacement = found.from.x, scene.start.velocity = found.from.v;
  put_loose_mass(scene, z, w);
}

/// Finds the steady motion with a tolerance of at most `steady_tolerance`: a loose one may find another motion.
void find_steady_motion(point::Problem scene, const std::function<bool()>& stopped, ReferenceSolution& found) {
  scene.time.tolerance = std::min(scene.time.tolerance, steady_tolerance);
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  if (result.status != steady::Status::periodic || result.found_by == steady::FoundBy::standstill) return;
  const double periods = result.observed_turns, duration = periods * period_of(scene.oscillator);
  point::Problem on_period = scene;
  if (has_loose_mass(scene.loose))
    start_on_steady_motion(on_period);
  else
    on_period.start = result.end;
  on_period.time.mode = steady::Mode::transient, on_period.time.duration = duration;
  found.periodic = periodic_reference(on_period, periods, observables_over(scene, duration), stopped);
  if (found.periodic && !same_motion(*found.periodic, on_period.start)) found.periodic.reset();
  if (!found.periodic) return;
  on_period.start.displacement = found.periodic->x, on_period.start.velocity = found.periodic->v;
  if (has_loose_mass(scene.loose)) put_loose_mass(on_period, found.periodic->z, found.periodic->w);
  found.on_period = on_period, found.steady_periods = periods;
}

}  // namespace

double ReferenceSolution::count(Event::Kind kind) const {
  if (!from_start) return 0.0;
  return static_cast<double>(std::ranges::count(with_rests_joined(from_start->events), kind, &Event::kind));
}

RecordObservables observables_over(const point::Problem& scene, double duration) {
  const double turns = duration / period_of(scene.oscillator), whole = std::max(1.0, std::round(turns));
  if (std::abs(turns - whole) < 1e-9 * whole) return {highest_harmonic, counting_frequency(scene.oscillator)};
  return {highest_harmonic, 2 * pi<double>() * whole / duration};
}

ReferenceSolution reference_solution_of(const point::Problem& scene, const std::function<bool()>& stopped) {
  ReferenceSolution found;
  const bool steady = scene.time.mode == steady::Mode::steady;
  const double duration =
      steady ? static_cast<double>(scene.time.window) * period_of(scene.oscillator) : scene.time.duration;
  found.asked = duration / period_of(scene.oscillator);
  find_motion_from_start(scene, duration, stopped, found);
  if (steady && scene.oscillator.forcing != 0) find_steady_motion(scene, stopped, found);
  return found;
}

}  // namespace clatter::accuracy
