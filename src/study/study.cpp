#include "study/study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <optional>
#include <span>

#include "study/comparison.hpp"

namespace clatter {
namespace {

constexpr std::size_t highest_harmonic = 3;
constexpr double agreement_room = 1e-8;  ///< forcing periods by which double and 50 digits may differ: half the digits

using Complexes = std::vector<std::complex<double>>;

double period_of(const Scene& scene) { return 2 * pi<double>() / counting_frequency(scene.oscillator); }

/// Complex amplitudes of the harmonics of a result, in the form of a course's.
Complexes complex_amplitudes(const Spectrum& spectrum) {
  Complexes harmonics;
  for (std::size_t k = 0; k < spectrum.amplitude.size(); ++k)
    harmonics.push_back(k == 0 ? spectrum.amplitude[0] : std::polar(spectrum.amplitude[k] / 2, spectrum.phase[k]));
  return harmonics;
}

/// Largest error of the harmonics from the first on, over the largest of them; NaN where one has no value.
double harmonics_error(const Complexes& harmonics, const Complexes& reference) {
  double error = 0.0, largest = 0.0;
  for (std::size_t k = 1; k < reference.size(); ++k) {
    const double off = k < harmonics.size() ? std::abs(harmonics[k] - reference[k]) : no_value;
    if (std::isnan(off)) return no_value;
    error = std::max(error, off), largest = std::max(largest, std::abs(reference[k]));
  }
  return largest > 0 ? error / largest : error;
}

/// Error of the ends of a range, over its larger end.
double range_error(double low, double high, const Extrema::Range& reference) {
  const double size = std::max(std::abs(reference.low), std::abs(reference.high));
  const double error = std::max(std::abs(low - reference.low), std::abs(high - reference.high));
  return size > 0 ? error / size : error;
}

std::vector<Event> events_of(const PointResult& result) {
  std::vector<Event> events;
  for (const Impact& impact : result.log) events.push_back(event_of(impact));
  for (const Rest& rest : result.rests) events.push_back(event_of(rest));
  std::ranges::stable_sort(events, {}, &Event::time);  // an impact before the rest that it begins
  return events;
}

/// A trial's scenes: what its errors are taken from, and the same without what costs time beside it.
struct Prepared {
  Trial trial;
  Scene observed, silent;
  const Course* reference = nullptr;  ///< null: nothing to compare with
  double reference_period =
      no_value;  ///< steady trials: contacts are compared with a motion of as many forcing periods
};

/// Wall times of a trial.
class Stopwatch {
 public:
  /// Runs a scene often enough to be measured; a slow one is measured in the first rounds only.
  void measure(const Scene& scene, Workshop& workshop, int round) {
    if ((round > 0 && seconds_ > 5) || (round > 2 && seconds_ > 1)) return;
    const auto begin = std::chrono::steady_clock::now();
    double periods = 0;
    for (int i = 0; i < batch_; ++i) periods += run_point(scene, workshop).periods;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    seconds_ = seconds / batch_;
    if (round >= 0) ns_per_period_.push_back(1e9 * seconds / periods);
    batch_ = static_cast<int>(std::clamp(shortest / seconds_, 1.0, 1e6));
  }
  [[nodiscard]] double median() { return quantile(0.5); }
  [[nodiscard]] double spread() { return ns_per_period_.size() > 1 ? quantile(0.75) - quantile(0.25) : no_value; }

 private:
  static constexpr double shortest = 2e-3;  // seconds

  [[nodiscard]] double quantile(double share) {
    if (ns_per_period_.empty()) return no_value;
    std::ranges::sort(ns_per_period_);
    const double place = share * static_cast<double>(ns_per_period_.size() - 1);
    const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, ns_per_period_.size() - 1);
    return std::lerp(ns_per_period_[below], ns_per_period_[above], place - std::floor(place));
  }

  int batch_ = 1;
  double seconds_ = 0.0;
  std::vector<double> ns_per_period_;
};

/// What a thread needs for a scene's harmonics.
class Bench {
 public:
  explicit Bench(const Observe& observe) {
    if (observe.harmonics == 0 || observe.harmonics_method != HarmonicsMethod::fft) return;
    transform_.emplace(static_cast<std::size_t>(observe.harmonics_samples));
    workshop_ = {&*transform_, transform_->workspace()};
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  [[nodiscard]] Workshop& workshop() { return workshop_; }

 private:
  std::optional<FourierTransform> transform_;
  Workshop workshop_;
};

/// The study of one scene.
class Study {
 public:
  Study(const Scene& scene, const StudyOptions& options) : scene_(scene), options_(options) {
    scene_.integration.method = Method::exact, scene_.integration.all_effects = false;
    scene_.observe = {};
  }

  PointStudy run(const std::vector<Trial>& trials) {
    if (!stopped()) find_references();
    std::vector<Prepared> prepared;
    for (const Trial& trial : trials) prepared.push_back(prepare(trial));
    for (const Prepared& trial : prepared) result_.rows.push_back(row_of(trial));
    measure(prepared);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool stopped() const { return options_.stopped && options_.stopped(); }
  void step() const {
    if (options_.progress) options_.progress();
  }
  [[nodiscard]] CourseObservables observables() const {
    return {highest_harmonic, counting_frequency(scene_.oscillator)};
  }

  /// Motion from the start in 50 digits as far as a double follows it, and the steady motion.
  void find_references() {
    const double period = period_of(scene_);
    const bool steady = scene_.time.mode == Mode::steady;
    const double duration = steady ? static_cast<double>(scene_.time.window) * period : scene_.time.duration;
    result_.asked = duration / period;
    const Course in_double = course_of(scene_, duration);
    from_start_ = reference_of(scene_, duration, observables());
    const bool failed = in_double.outcome != Outcome::completed || from_start_->outcome != Outcome::completed;
    Agreement agreement = agreement_of(in_double, *from_start_, agreement_room * period);
    const double periods = failed ? 0 : std::floor(agreement.until / period);
    result_.horizon = !failed && agreement.until == duration ? result_.asked : periods;
    if (result_.horizon < result_.asked) {
      const double end = periods * period;
      from_start_ = reference_of(scene_, end, observables());
      std::erase_if(agreement.events, [&](const Event& event) { return event.time > end; });
      for (Event& event : agreement.events) event.length = std::min(event.length, end - event.time);
    }
    from_start_->events = std::move(agreement.events);
    if (!(result_.horizon > 0)) from_start_.reset();
    count_events();
    if (steady && scene_.oscillator.forcing != 0) find_steady_motion();
  }

  void count_events() {
    if (!from_start_) return;
    for (const Event& event : with_rests_joined(from_start_->events)) {
      if (event.kind == Event::Kind::impact) ++result_.impacts;
      if (event.kind == Event::Kind::rest) ++result_.rests;
    }
  }

  void find_steady_motion() {
    Scene scene = scene_;
    scene.observe.period = true;
    Workshop workshop;
    const PointResult result = run_point(scene, workshop);
    const bool moves = result.status == Status::periodic && result.found_by != FoundBy::standstill;
    const double periods = result.observed_turns;
    if (!moves) return;
    on_period_ = scene_;
    on_period_->start = result.end;
    on_period_->time.mode = Mode::transient, on_period_->time.duration = periods * period_of(scene_);
    periodic_ = periodic_reference(*on_period_, periods, observables());
    if (periodic_) result_.steady_periods = periods;
  }

  [[nodiscard]] Prepared prepare(const Trial& trial) const {
    Prepared prepared{trial, scene_, scene_};
    switch (trial.studied) {
      case Studied::exact:
      case Studied::dopri5:
      case Studied::moreau:
        prepare_method(prepared);
        break;
      case Studied::harmonics_exact:
      case Studied::harmonics_fft:
        prepare_harmonics(prepared);
        break;
      case Studied::steady:
      case Studied::steady_repetition:
        prepare_steady(prepared);
        break;
    }
    return prepared;
  }

  [[nodiscard]] Observe everything() const {
    Observe observe;
    observe.extrema = observe.impact_log = observe.rest_log = true;
    observe.harmonics = highest_harmonic, observe.harmonics_method = HarmonicsMethod::exact;
    observe.base_frequency = observables().base_frequency;
    return observe;
  }

  void prepare_method(Prepared& prepared) const {
    Scene& scene = prepared.silent;
    Integration& integration = scene.integration;
    scene.time.mode = Mode::transient, scene.time.duration = result_.horizon * period_of(scene_);
    if (prepared.trial.studied == Studied::dopri5)
      integration.method = Method::dopri5, integration.tolerance = prepared.trial.setting;
    if (prepared.trial.studied == Studied::moreau)
      integration.method = Method::moreau, integration.step = prepared.trial.setting;
    prepared.observed = scene;
    prepared.observed.observe = everything();
    if (from_start_) prepared.reference = &*from_start_;
  }

  void prepare_harmonics(Prepared& prepared) const {
    Scene& scene = prepared.silent;
    if (periodic_) scene = *on_period_;
    if (!periodic_) scene.time.mode = Mode::transient, scene.time.duration = result_.horizon * period_of(scene_);
    scene.observe.harmonics = highest_harmonic, scene.observe.base_frequency = observables().base_frequency;
    scene.observe.harmonics_method = HarmonicsMethod::exact;
    if (prepared.trial.studied == Studied::harmonics_fft)
      scene.observe.harmonics_method = HarmonicsMethod::fft,
      scene.observe.harmonics_samples = static_cast<std::int64_t>(prepared.trial.setting);
    prepared.observed = scene;
    if (periodic_)
      prepared.reference = &*periodic_;
    else if (from_start_)
      prepared.reference = &*from_start_;
  }

  void prepare_steady(Prepared& prepared) const {
    Scene& scene = prepared.silent;
    scene.time.tolerance = prepared.trial.setting;
    scene.integration.shortcuts = prepared.trial.studied == Studied::steady;
    prepared.observed = scene;
    prepared.observed.observe = everything();
    if (!periodic_) return;
    prepared.reference = &*periodic_, prepared.reference_period = result_.steady_periods;
  }

  [[nodiscard]] Row row_of(const Prepared& prepared) const {
    Row row{.trial = prepared.trial};
    const bool empty = prepared.silent.time.mode == Mode::transient && !(prepared.silent.time.duration > 0);
    if (stopped() || empty) return row;
    Bench bench(prepared.observed.observe);
    const PointResult result = run_point(prepared.observed, bench.workshop());
    row.status = result.status;
    row.impacts = result.impacts, row.simulated_periods = result.periods, row.evaluations = result.evaluations;
    if (prepared.reference != nullptr && !failed(result.status)) compare_with(prepared, result, row);
    step();
    return row;
  }

  void compare_with(const Prepared& prepared, const PointResult& result, Row& row) const {
    const Course& reference = *prepared.reference;
    row.harmonics = harmonics_error(complex_amplitudes(result.x_spectrum), reference.harmonics);
    row.v_harmonics = harmonics_error(complex_amplitudes(result.v_spectrum), reference.v_harmonics);
    if (!prepared.observed.observe.extrema) return;
    row.extrema = std::max(range_error(result.x_min, result.x_max, reference.x_range),
                           range_error(result.v_min, result.v_max, reference.v_range));
    if (prepared.reference_period > 0 && result.observed_turns != prepared.reference_period) return;
    const double period = period_of(scene_);
    const ContactErrors errors = compare(events_of(result), reference.events, period / 2);
    row.contact_time = errors.time / period, row.contact_speed = errors.speed, row.rest = errors.rest / period;
    row.missed = static_cast<double>(errors.missed), row.doubled = static_cast<double>(errors.doubled);
    row.rests_missed = static_cast<double>(errors.rests_missed);
  }

  /// All trials in turn, so that what disturbs the machine disturbs them alike.
  void measure(const std::vector<Prepared>& prepared) {
    std::vector<Stopwatch> stopwatches(prepared.size());
    for (int round = -1; round < options_.rounds; ++round) {  // the first one warms up
      for (std::size_t i = 0; i < prepared.size(); ++i) {
        if (stopped()) return;
        if (std::isnan(result_.rows[i].simulated_periods)) continue;
        Bench bench(prepared[i].silent.observe);
        stopwatches[i].measure(prepared[i].silent, bench.workshop(), round);
        if (round >= 0) step();
      }
    }
    for (std::size_t i = 0; i < prepared.size(); ++i)
      result_.rows[i].ns_per_period = stopwatches[i].median(), result_.rows[i].ns_spread = stopwatches[i].spread();
  }

  Scene scene_;
  const StudyOptions& options_;
  PointStudy result_{};
  std::optional<Course> from_start_;  ///< over the horizon
  std::optional<Course> periodic_;    ///< one period of the steady motion
  std::optional<Scene> on_period_;    ///< that starts on it, for one period
};

}  // namespace

std::size_t steps_of(std::size_t rows, const StudyOptions& options) {
  return rows * static_cast<std::size_t>(options.rounds + 1);
}

PointStudy study(const Scene& scene, const std::vector<Trial>& trials, const StudyOptions& options) {
  return Study(scene, options).run(trials);
}

}  // namespace clatter
