#include "accuracy/accuracy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <optional>

#include "accuracy/comparison.hpp"
#include "accuracy/forecast.hpp"
#include "accuracy/reference_solution.hpp"
#include "accuracy/timing.hpp"
#include "lanes/run_in_lanes.hpp"

namespace clatter::accuracy {
namespace {

using Complexes = std::vector<std::complex<double>>;

/// Complex amplitudes of the harmonics of a result, in the form of those in a RunRecord.
Complexes complex_amplitudes(const observables::Spectrum& spectrum) {
  Complexes harmonics;
  for (std::size_t k = 0; k < spectrum.amplitude.size(); ++k)
    harmonics.push_back(k == 0 ? spectrum.amplitude[0] : std::polar(spectrum.amplitude[k] / 2, spectrum.phase[k]));
  return harmonics;
}

/// Largest error of the harmonics from the first on, over the largest of them, or over the motion's size if they are no
/// larger than its rounding; NaN if one has no value.
double harmonics_error(const Complexes& harmonics, const Complexes& reference, double size) {
  double error = 0.0, largest = 0.0;
  for (std::size_t k = 1; k < reference.size(); ++k) {
    const double off = k < harmonics.size() ? std::abs(harmonics[k] - reference[k]) : point::no_value;
    if (std::isnan(off)) return point::no_value;
    error = std::max(error, off), largest = std::max(largest, std::abs(reference[k]));
  }
  const double scale = largest > 1e-12 * size ? largest : size;
  return scale > 0 ? error / scale : error;
}

double size_of(const observables::Range& range) { return std::max(std::abs(range.low), std::abs(range.high)); }

/// Error of the ends of a range, over its larger end.
double range_error(double low, double high, const observables::Range& reference) {
  const double size = size_of(reference);
  const double error = std::max(std::abs(low - reference.low), std::abs(high - reference.high));
  return size > 0 ? error / size : error;
}

/// The events of a run; `is_in_housing`: of a loose mass.
std::vector<Event> events_of(const point::PointResult& result, bool is_in_housing) {
  std::vector<Event> events;
  for (const observables::LoggedImpact& impact : result.log)
    events.push_back({.side = impact.stop > 0 ? Side::upper : Side::lower,
                      .time = impact.time,
                      .before = impact.before,
                      .after = impact.after,
                      .of_wall = std::abs(impact.stop) == 2});
  events.insert(events.end(), result.rests.begin(), result.rests.end());
  std::ranges::stable_sort(events, {}, &Event::time);  // an impact before the rest that it begins
  return is_in_housing ? with_slow_impacts_summed(events) : events;
}

/// A trial ready to run: the scene observed for its errors, the same without observables for its time, and the
/// reference.
struct Prepared {
  Trial trial;
  point::Problem observed, silent;
  const RunRecord* reference = nullptr;  ///< null: nothing to compare with
  double reference_period = 0.0;  ///< steady trials: contacts are compared with a motion of as many forcing periods
};

/// Harmonics alone, of the frequency that suits a duration.
observables::Observe harmonics_over(const point::Problem& scene, double duration) {
  observables::Observe observe;
  observe.harmonics = highest_harmonic, observe.harmonics_method = observables::HarmonicsMethod::exact;
  observe.base_frequency = observables_over(scene, duration).base_frequency;
  if (has_loose_mass(scene.loose)) observe.frame = Frame::absolute;  // in which it is computed
  return observe;
}
observables::Observe everything_over(const point::Problem& scene, double duration) {
  observables::Observe observe = harmonics_over(scene, duration);
  observe.extrema = observe.impact_log = observe.full_log = true;
  observe.wall_log = has_loose_mass(scene.loose);
  return observe;
}

/// The part of the observables that lanes can observe: they count impacts, keep no log, and sum only the harmonics of
/// the force.
observables::Observe in_lanes(observables::Observe observe, const point::Problem& scene) {
  observe.impact_log = observe.full_log = false, observe.impacts = true;
  if (observe.base_frequency != scene.oscillator.frequency) observe.harmonics = 0;
  return observe;
}

const RunRecord* pointer_to(const std::optional<RunRecord>& record) { return record ? &*record : nullptr; }

/// A scene that runs over the horizon.
point::Problem over_horizon(point::Problem scene, const ReferenceSolution& references) {
  scene.time.mode = steady::Mode::transient, scene.time.duration = references.horizon * period_of(scene.oscillator);
  return scene;
}

Prepared prepare_method(const Trial& trial, const point::Problem& scene, const ReferenceSolution& references) {
  Prepared prepared{trial, scene, over_horizon(scene, references), pointer_to(references.from_start)};
  stepping::Integration& integration = prepared.silent.integration;
  if (trial.method == TestedMethod::dopri5)
    integration.method = stepping::Method::dopri5, integration.tolerance = trial.setting;
  if (trial.method == TestedMethod::moreau)
    integration.method = stepping::Method::moreau, integration.step = trial.setting;
  prepared.observed = prepared.silent;
  prepared.observed.observe = everything_over(scene, prepared.silent.time.duration);
  return prepared;
}

Prepared prepare_harmonics(const Trial& trial, const point::Problem& scene, const ReferenceSolution& references) {
  const bool steady = references.periodic.has_value();
  Prepared prepared{trial, scene, steady ? *references.on_period : over_horizon(scene, references),
                    pointer_to(steady ? references.periodic : references.from_start)};
  observables::Observe& observe = prepared.silent.observe = harmonics_over(scene, prepared.silent.time.duration);
  if (trial.method == TestedMethod::harmonics_fft)
    observe.harmonics_method = observables::HarmonicsMethod::fft,
    observe.harmonics_samples = std::llround(trial.setting);
  prepared.observed = prepared.silent;
  return prepared;
}

Prepared prepare_steady(const Trial& trial, const point::Problem& scene, const ReferenceSolution& references) {
  Prepared prepared{trial, scene, scene, pointer_to(references.periodic), references.steady_periods};
  prepared.silent.time.tolerance = trial.setting;
  prepared.silent.integration.shortcuts = trial.method == TestedMethod::steady;
  prepared.observed = prepared.silent;
  prepared.observed.observe = everything_over(scene, period_of(scene.oscillator));
  return prepared;
}

Prepared prepare(const Trial& trial, const point::Problem& scene, const ReferenceSolution& references) {
  Prepared prepared = trial.method <= TestedMethod::moreau          ? prepare_method(trial, scene, references)
                      : trial.method <= TestedMethod::harmonics_fft ? prepare_harmonics(trial, scene, references)
                                                                    : prepare_steady(trial, scene, references);
  observables::Observe& observe = prepared.observed.observe;
  if (trial.arch != lanes::InstructionSet::scalar) observe = in_lanes(observe, scene);
  return prepared;
}

point::WorkItem item_of(const point::Problem& scene) { return {0, 0, scene, effects_of(scene)}; }

/// Runs a trial once; in lanes, too, once is enough, as each lane of a full block gives the same. Nothing if lanes
/// leave it to the scalar loop.
std::optional<point::PointResult> result_of(const Prepared& prepared, point::ThreadScratch& scratch) {
  const lanes::InstructionSet arch = prepared.trial.arch;
  if (arch == lanes::InstructionSet::scalar) return run_point(prepared.observed, scratch);
  const point::WorkItem item = item_of(prepared.observed);
  if (!lanes::accepts(item)) return std::nullopt;
  point::PointResult result = run_in_lanes(item, 1, arch, scratch);
  return result.in_lanes || failed(result.status) ? std::optional(std::move(result)) : std::nullopt;
}

/// Runs a trial without observables so many times, in lanes so many full blocks; returns the forcing periods of all.
double run_silently(const Prepared& prepared, point::ThreadScratch& scratch, int times) {
  if (const lanes::InstructionSet arch = prepared.trial.arch; arch != lanes::InstructionSet::scalar) {
    const std::size_t points = lanes::lanes_per_block * static_cast<std::size_t>(times);
    return static_cast<double>(points) * run_in_lanes(item_of(prepared.silent), points, arch, scratch).periods;
  }
  double periods = 0;
  for (int i = 0; i < times; ++i) periods += run_point(prepared.silent, scratch).periods;
  return periods;
}

/// The accuracy run of one scene.
class AccuracyRun {
 public:
  AccuracyRun(const point::Problem& scene, const std::vector<Trial>& trials, const AccuracyOptions& options)
      : scene_(scene), trials_(trials), options_(options), forecast_(trials, options.rounds) {
    scene_.integration.method = stepping::Method::exact, scene_.integration.all_effects = false;
    scene_.observe = {};
  }

  PointAccuracy run() {
    if (!stopped()) references_ = reference_solution_of(scene_, options_.stopped);
    std::vector<Prepared> prepared;
    for (const Trial& trial : trials_) prepared.push_back(prepare(trial, scene_, references_));
    PointAccuracy found{.asked = references_.asked,
                        .horizon = references_.horizon,
                        .impacts = references_.count(Event::Kind::impact),
                        .rests = references_.count(Event::Kind::rest) + references_.count(Event::Kind::stick),
                        .steady_periods = references_.periodic ? references_.steady_periods : point::no_value,
                        .rows = {}};
    for (const Prepared& trial : prepared) found.rows.push_back(row_of(trial, found.rows.size()));
    measure(prepared, found.rows);
    return found;
  }

 private:
  [[nodiscard]] bool stopped() const { return options_.stopped && options_.stopped(); }
  void step() const {
    if (options_.progress) options_.progress(forecast_.seconds_left());
  }

  [[nodiscard]] WorkPrecision row_of(const Prepared& prepared, std::size_t number) {
    WorkPrecision row{.trial = prepared.trial, .status = references_.not_run};
    const bool empty = prepared.silent.time.mode == steady::Mode::transient && !(prepared.silent.time.duration > 0);
    if (stopped()) return row;
    const auto begin = std::chrono::steady_clock::now();
    if (!empty) {
      point::ThreadScratch scratch{observables::Harmonics::scratch_for(prepared.observed.observe)};
      if (const std::optional<point::PointResult> result = result_of(prepared, scratch)) take(prepared, *result, row);
    }
    forecast_.ran(number, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    step();
    return row;
  }

  void take(const Prepared& prepared, const point::PointResult& result, WorkPrecision& row) const {
    row.status = result.status;
    row.impacts = result.impacts, row.simulated_periods = result.periods, row.observed_periods = result.observed_turns;
    row.evaluations = result.evaluations;
    if (prepared.reference != nullptr && !failed(result.status)) compare_with(prepared, result, row);
  }

  void compare_with(const Prepared& prepared, const point::PointResult& result, WorkPrecision& row) const {
    const RunRecord& reference = *prepared.reference;
    if (prepared.reference_period > 0 && row.observed_periods != prepared.reference_period) return;  // another motion
    const double size = std::max(size_of(reference.x_range), size_of(reference.v_range));
    row.harmonics = harmonics_error(complex_amplitudes(result.x_spectrum), reference.harmonics, size);
    row.v_harmonics = harmonics_error(complex_amplitudes(result.v_spectrum), reference.v_harmonics, size);
    if (!prepared.observed.observe.extrema) return;
    row.extrema = std::max(range_error(result.x_min, result.x_max, reference.x_range),
                           range_error(result.v_min, result.v_max, reference.v_range));
    if (result.in_lanes) return compare_counts(result, reference, row);
    const double period = period_of(scene_.oscillator);
    const ContactErrors errors = compare(events_of(result, has_loose_mass(scene_.loose)), reference.events, period / 2);
    if (errors.paired > 0) row.contact_time = errors.time / period, row.contact_speed = errors.speed;
    if (errors.rests_paired > 0) row.rest = errors.rest / period;
    row.missed = static_cast<double>(errors.missed), row.extra = static_cast<double>(errors.extra);
    row.rests_missed = static_cast<double>(errors.rests_missed);
  }

  /// Compares the number of impacts on each stop, as lanes only count them.
  static void compare_counts(const point::PointResult& result, const RunRecord& reference, WorkPrecision& row) {
    row.missed = row.extra = 0.0;
    const double periods = result.status == steady::Status::transient ? 1.0 : result.observed_turns;
    for (const Side side : {Side::lower, Side::upper}) {
      const auto counts = [&](const Event& event) {  // an impact at the start belongs to the time before
        return event.kind == Event::Kind::impact && event.side == side && event.time > 0;
      };
      const double more = std::round(result.impacts_per_period[index_of(side)] * periods) -
                          static_cast<double>(std::ranges::count_if(reference.events, counts));
      row.missed += std::max(0.0, -more), row.extra += std::max(0.0, more);
    }
  }

  /// Measures all trials in turn, so that other load on the machine disturbs them alike.
  void measure(const std::vector<Prepared>& prepared, std::vector<WorkPrecision>& rows) {
    std::vector<Timing> timings(prepared.size());
    for (int round = -1; round < options_.rounds; ++round) {  // the first one warms up
      for (std::size_t i = 0; i < prepared.size(); ++i) {
        if (stopped()) return;
        const WorkPrecision& row = rows[i];
        if (row.simulated_periods > 0 && !failed(row.status)) {
          point::ThreadScratch scratch{observables::Harmonics::scratch_for(prepared[i].silent.observe)};
          const auto run = [&](int times) { return run_silently(prepared[i], scratch, times); };
          timings[i].measure(run, round);
        }
        forecast_.measured(i, round, timings[i].seconds());
        if (round >= 0) step();
      }
    }
    for (std::size_t i = 0; i < prepared.size(); ++i)
      rows[i].ns_per_period = timings[i].median(), rows[i].ns_spread = timings[i].spread();
  }

  point::Problem scene_;
  const std::vector<Trial>& trials_;
  const AccuracyOptions& options_;
  Forecast forecast_;
  ReferenceSolution references_{};
};

}  // namespace

std::size_t steps_of(std::size_t rows, const AccuracyOptions& options) {
  return rows * static_cast<std::size_t>(options.rounds + 1);
}

PointAccuracy measure_accuracy(const point::Problem& scene, const std::vector<Trial>& trials,
                               const AccuracyOptions& options) {
  return AccuracyRun(scene, trials, options).run();
}

}  // namespace clatter::accuracy
