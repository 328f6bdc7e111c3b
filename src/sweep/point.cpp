#include "sweep/point.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "integrators/settle.hpp"
#include "observables/extrema.hpp"
#include "observables/samples.hpp"
#include "observables/stability.hpp"

namespace clatter {
namespace {

/// The observers that a scene asks for; each is called once an arc, and costs nothing where it is absent.
class Observers {
 public:
  Observers(const Scene& scene, double total, double base_frequency) {
    const Observe& observe = scene.observe;
    if (observe.extrema) extrema.emplace();
    if (observe.impacts || observe.period) impacts.emplace();
    if (observe.impact_log) log.emplace();
    if (observe.trajectory > 0) {
      const auto count = static_cast<std::size_t>(observe.trajectory);
      trajectory.emplace(count, total / static_cast<double>(count - 1), AtImpact::after, scene.stops);
    }
    if (observe.stability) stability.emplace(scene.stops);
    if (observe.harmonics == 0) return;
    if (observe.harmonics_method == HarmonicsMethod::exact) {
      exact_harmonics.emplace(static_cast<std::size_t>(observe.harmonics), base_frequency);
    } else {
      const auto count = static_cast<std::size_t>(observe.harmonics_samples);
      samples.emplace(count, total / static_cast<double>(count), AtImpact::mean, scene.stops);
    }
  }

  template <Effects E>
  void arc(const Arc<double, E>& arc, double begin, double length) {
    each([&](auto& observer) { observer.arc(arc, begin, length); });
  }
  void rest(const Rest& rest) {
    each([&](auto& observer) { observer.rest(rest); });
  }
  void impact(const Impact& impact) {
    if (!(impact.time > 0.0)) return;  // the observed time begins after t0: an impact there belongs to what was before
    each([&](auto& observer) { observer.impact(impact); });
  }
  void finish(double x, double v, double total, bool periodic, bool autonomous) {
    if (stability && periodic) stability->finish_period(total, autonomous);
    if (stability && !periodic) stability->finish_window(total);
    if (trajectory) trajectory->finish(x, v, total, periodic);
    if (samples) samples->finish(x, v, total, periodic);
    if (exact_harmonics) exact_harmonics->finish(x, total);
  }

  /// Of arcs, by all observers together.
  [[nodiscard]] double evaluations() const {
    const auto of = [](const auto& observer) { return observer ? observer->evaluations() : 0.0; };
    return of(extrema) + of(trajectory) + of(samples) + of(exact_harmonics) + of(stability);
  }

  std::optional<Extrema> extrema;
  std::optional<Impacts> impacts;
  std::optional<ImpactLog> log;
  std::optional<Samples> trajectory, samples;
  std::optional<ExactHarmonics> exact_harmonics;
  std::optional<Stability> stability;

 private:
  template <class Function>
  void each(Function&& function) {
    if (extrema) function(*extrema);
    if (impacts) function(*impacts);
    if (log) function(*log);
    if (trajectory) function(*trajectory);
    if (samples) function(*samples);
    if (exact_harmonics) function(*exact_harmonics);
    if (stability) function(*stability);
  }
};

/// Harmonics k of the base frequency from samples of an observed time in which it turns `turns` times. NaN from half
/// the sampling rate on; all, the constant part too, where the base frequency itself is beyond it.
Spectrum sampled_spectrum(const std::vector<double>& samples, double turns, std::size_t highest, Workshop& workshop) {
  const auto all = workshop.transform->transform(samples, *workshop.workspace);
  const double nan = no_value;
  std::vector<std::complex<double>> harmonics(highest + 1, {nan, nan});
  for (std::size_t k = 0; k <= highest; ++k) {
    const double index = std::round(turns * static_cast<double>(k)), needed = std::max(index, turns);
    if (2 * needed < static_cast<double>(samples.size())) harmonics[k] = all[static_cast<std::size_t>(index)];
  }
  return Spectrum::of(harmonics);
}

/// One scene on its way to a result.
template <Effects E>
class Point {
 public:
  Point(const Task& task, Workshop& workshop)
      : scene_(task.scene),
        workshop_(workshop),
        integrator_(task.scene, stops_in_reach(task.scene.stops, task.effects)) {}

  PointResult run() {
    State<double> state;
    state.x = scene_.start.displacement, state.v = scene_.start.velocity;
    observed_ = settle(integrator_, state, scene_);
    result_.status = observed_.status;
    result_.found_by = observed_.found_by;
    result_.periods = observed_.settled;
    if (!failed(observed_.status)) observe();
    result_.impacts = integrator_.impacts();
    result_.evaluations += integrator_.evaluations();
    return std::move(result_);
  }

 private:
  void observe() {
    const bool forced = scene_.oscillator.forcing != 0;
    const double total = observed_.turns * integrator_.period();
    // the base frequency turns once in a transient and in a period of unforced motion, else with the force
    const bool once = observed_.status == Status::transient || (!forced && observed_.status == Status::periodic);
    const double base_turns = once ? 1.0 : observed_.turns;
    result_.base_frequency = once || !forced ? 2 * pi<double>() * base_turns / total : scene_.oscillator.frequency;
    Observers observers(scene_, total, result_.base_frequency);
    State<double> state = observed_.from;
    const Outcome outcome = run_for(integrator_, state, observed_.turns, observers);
    result_.periods = observed_.settled + observed_.turns;
    result_.evaluations = observers.evaluations();
    if (outcome != Outcome::completed) {
      result_.status = status_of(outcome);
      result_.base_frequency = no_value;
      return;
    }
    result_.end = {state.x, state.v, scene_.start.phase};
    if (state.turns > 0)
      result_.end.phase = std::fmod(scene_.start.phase + 2 * pi<double>() * state.turns, 2 * pi<double>());
    observers.finish(state.x, state.v, total, observed_.status == Status::periodic,
                     !forced && observed_.found_by != FoundBy::standstill);
    collect(observers, total, base_turns);
    if (observers.impacts) collect_impacts(*observers.impacts, total, once ? 1.0 : observed_.turns);
  }

  void collect(Observers& observers, double total, double base_turns) {
    if (observers.extrema) {
      const auto x = observers.extrema->displacement(scene_.stops), v = observers.extrema->velocity();
      result_.x_min = x.low, result_.x_max = x.high, result_.v_min = v.low, result_.v_max = v.high;
    }
    if (observers.stability) {
      const std::complex<double> multipliers[2] = {observers.stability->first(), observers.stability->second()};
      for (std::size_t i = 0; i < 2; ++i)
        result_.multiplier_re[i] = multipliers[i].real(), result_.multiplier_im[i] = multipliers[i].imag();
      result_.lyapunov = observers.stability->lyapunov();
    }
    if (observers.log) result_.log = std::move(observers.log->impacts());
    if (observers.trajectory) {
      result_.tau = observers.trajectory->times(total);
      result_.x = std::move(observers.trajectory->displacement()),
      result_.v = std::move(observers.trajectory->velocity());
    }
    if (observers.exact_harmonics) {
      result_.x_spectrum = Spectrum::of(observers.exact_harmonics->displacement());
      result_.v_spectrum = Spectrum::of(observers.exact_harmonics->velocity());
    }
    if (observers.samples) {
      const auto highest = static_cast<std::size_t>(scene_.observe.harmonics);
      result_.x_spectrum = sampled_spectrum(observers.samples->displacement(), base_turns, highest, workshop_);
      result_.v_spectrum = sampled_spectrum(observers.samples->velocity(), base_turns, highest, workshop_);
    }
  }

  void collect_impacts(const Impacts& impacts, double total, double periods) {
    bool rests_throughout = false;
    for (std::size_t i = 0; i < impacts.stops().size(); ++i) {
      const Impacts::OfStop& stop = impacts.stops()[i];
      result_.impacts_per_period[i] = stop.count / periods;
      result_.v_before[i] = stop.before, result_.v_after[i] = stop.after;
      result_.rest_fraction[i] = std::min(1.0, stop.rest_time / total);
      rests_throughout = rests_throughout || stop.rest_time >= total * (1 - 1e-14);
    }
    const Stops& stops = scene_.stops;
    if (stops.lower == -stops.upper) result_.velocity_ratio = impacts.first_speed() / stops.upper;
    if (observed_.status == Status::aperiodic) result_.period_ratio = 0.0;
    if (observed_.status != Status::periodic || observed_.found_by == FoundBy::standstill || rests_throughout) return;
    result_.period = total;
    const bool forced = scene_.oscillator.forcing != 0;
    if (forced) result_.period_ratio = observed_.turns;
    if (!forced) result_.eigenfrequency = 2 * pi<double>() / total;
  }

  const Scene& scene_;
  Workshop& workshop_;
  Exact<double, E> integrator_;
  Observed observed_{};
  PointResult result_{};
};

}  // namespace

Effects effects_of(const Scene& scene) {
  return scene.all_effects ? all_effects(scene.oscillator.damping) : required_effects(scene);
}

void run_batch(std::span<const Task> tasks, Workshop& workshop,
               const std::function<void(const Task&, PointResult&&)>& take) {
  if (tasks.empty()) return;
  with_effects(tasks.front().effects, [&]<Effects kernel>() {
    for (const Task& task : tasks) take(task, Point<kernel>(task, workshop).run());
  });
}

PointResult run_point(const Scene& scene, Workshop& workshop) {
  PointResult result;
  const Task task{0, scene, effects_of(scene)};
  run_batch({&task, 1}, workshop, [&](const Task&, PointResult&& of_point) { result = std::move(of_point); });
  return result;
}

double seconds_per_evaluation(const Effects& effects) {
  return with_effects(effects, []<Effects kernel>() {
    Scene scene;
    scene.oscillator.damping = kernel.damping == Damping::none ? 0.0 : kernel.damping == Damping::light ? 0.04 : 2.0;
    scene.oscillator.forcing = kernel.forcing == Forcing::none ? 0.0 : 1.0;
    scene.oscillator.frequency = kernel.forcing == Forcing::secular ? 1.03 : 1.3;
    scene.start.velocity = 1.0;
    if (kernel.stops()) scene.stops = {-0.5, 0.5, 0.7, 0.7};
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 3; ++repetition) {
      Exact<double, kernel> integrator(scene);
      State<double> state;
      state.v = scene.start.velocity;
      NoObserver nobody;
      const auto begin = Clock::now();
      (void)run_for(integrator, state, 50.0, nobody);
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      least = std::min(least, seconds / std::max(1.0, integrator.evaluations()));
    }
    return least;
  });
}

}  // namespace clatter
