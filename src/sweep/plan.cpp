#include "sweep/plan.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "dynamics/contact.hpp"
#include "dynamics/reach.hpp"
#include "sweep/branches.hpp"
#include "sweep/dearest_point.hpp"
#include "sweep/fork_join.hpp"
#include "sweep/memory_limits.hpp"
#include "sweep/point.hpp"

namespace clatter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point as the plan sees it; along a followed branch nobody knows where it starts.
Scene planned_scene(const Sweep& sweep, const Branches& branches, std::size_t point) {
  Scene scene = scene_at(sweep, point);
  if (branches.begins(point)) {
    start_from(scene, std::nullopt);
  } else {
    scene.start = {no_value, no_value, no_value};
  }
  return scene;
}

/// Whether motion without stops comes to its end: the steady response, free vibration, or standstill within a time.
bool comes_to_its_end(const Scene& scene, double time) {
  const Oscillator& o = scene.oscillator;
  if (o.forcing != 0) return o.damping > 0;
  const double x = scene.start.displacement - o.load, v = scene.start.velocity;
  const double scale = std::max({std::abs(scene.start.displacement), std::abs(v), std::abs(o.load)});
  return o.damping == 0 || fading_time(o, {x, v}, scene.time.tolerance * scale) <= time;
}

/// Forcing periods of a point. Where nothing is proved: at best a single one is settled and one observed, at worst all
/// of max_periods, what attempts to find the periodic motion may take, and the window.
Estimate periods_of(const Scene& scene, const Effects& effects) {
  const TimePlan& time = scene.time;
  const Oscillator& o = scene.oscillator;
  const double longest = static_cast<double>(time.max_periods), period = period_of(o);
  if (time.mode == Mode::transient) return {time.duration / period, time.duration / period};
  if (scene.integration.all_effects) {
    const double slow = o.damping > 0 ? std::min(longest / 2, 3 * std::log(4.0) / (o.damping * period)) : 0.0;
    return {std::max(1.0, longest - 192 - slow) + 1, longest + static_cast<double>(time.window)};
  }
  if (scene.integration.method != Method::exact) return {2, longest + static_cast<double>(time.window)};
  if (!effects.stops() && comes_to_its_end(scene, longest * period)) return {1, 1};
  if (o.forcing == 0 && o.damping == 0 && !effects.dissipation) return {0, 1};
  return {2, longest * 1.25 + std::min(64.0, longest) + static_cast<double>(time.window)};
}

/// Evaluations of arcs in a forcing period, from the length of the steps that are proved free of contact; two impacts a
/// period, each worth two. The work of general methods counts in forcing periods.
double work_of_period(const Scene& scene, const Effects& effects) {
  if (scene.integration.method != Method::exact) return 1;
  const double step = longest_step(counting_frequency(scene.oscillator));
  return effects.stops() ? std::ceil(period_of(scene.oscillator) / step) + 4 : 1;
}

/// How near motion comes to a stop that it doesn't meet: 1 where it would touch. Negative where there is none.
double closeness(const Requirements& needs, double gap) {
  return gap < infinity ? (needs.effects.stops() ? needs.reach : needs.free_reach) / gap : -1;
}

/// The point that is closest to something, the first of equal ones.
struct Closest {
  double ratio = -1;
  std::size_t point = 0;

  void add(const Closest& other) {
    if (other.ratio > ratio || (other.ratio == ratio && other.point < point)) *this = other;
  }
};

/// A stop over all points.
struct StopSeen {
  bool met = false;  ///< by any of them
  Closest closest;   ///< among those that don't meet it

  void add(const StopSeen& other) { met = met || other.met, closest.add(other.closest); }
};

/// A group while it is collected.
struct Collected {
  Effects effects;
  std::size_t points = 0;
  Closest example;
  Estimate periods, work;

  void add(const Collected& other) {
    points += other.points;
    periods += other.periods, work += other.work;
    example.add(other.example);
  }
};

/// What points have to do, whatever their order and division.
struct Survey {
  std::vector<Collected> groups;
  StopSeen lower, upper;
  bool lasting = false;  ///< a transient never fades

  void add(const Collected& part) {
    const auto same = std::ranges::find(groups, part.effects, &Collected::effects);
    if (same == groups.end()) {
      groups.push_back(part);
    } else {
      same->add(part);
    }
  }
  void add(const Survey& other) {
    for (const Collected& group : other.groups) add(group);
    lower.add(other.lower), upper.add(other.upper), lasting = lasting || other.lasting;
  }
};

/// Wall time of a unit of work, by a measurement.
double seconds_of_work(Scene scene, const Effects& effects) {
  if (scene.integration.method == Method::exact) return seconds_per_evaluation(effects);
  if (!std::isfinite(scene.start.displacement)) scene.start = {};
  start_from(scene, std::nullopt);
  Workshop workshop;
  return seconds_per_period(scene, workshop);
}

void look_at(const Sweep& sweep, const Branches& branches, std::size_t point, Survey& survey) {
  const Scene scene = planned_scene(sweep, branches, point);
  const Requirements needs = requirements_of(scene);
  const bool required = scene.integration.method == Method::exact && !scene.integration.all_effects;
  const Effects effects = required ? needs.effects : effects_of(scene);
  const Estimate periods = periods_of(scene, effects);
  const double work = work_of_period(scene, effects);
  const Closest to_lower{needs.effects.lower ? 0 : closeness(needs, needs.lower_gap), point},
      to_upper{needs.effects.upper ? 0 : closeness(needs, needs.upper_gap), point};
  Closest example = to_lower;
  example.add(to_upper);
  survey.add({effects, 1, example, periods, {periods.least * work, periods.most * work}});
  survey.lower.add({needs.effects.lower, to_lower}), survey.upper.add({needs.effects.upper, to_upper});
  survey.lasting = survey.lasting || (scene.time.mode == Mode::steady && scene.oscillator.forcing != 0 &&
                                      scene.oscillator.damping == 0 && !needs.effects.dissipation);
}

/// Looks at all points on several threads; the same survey for every number of them but for the rounding of estimates.
class Surveyor {
 public:
  Surveyor(const Sweep& sweep, int threads)
      : sweep_(sweep), branches_(sweep), points_(size(sweep)), surveys_(static_cast<std::size_t>(threads)) {}

  CLATTER_PARALLEL_REGION Survey run() {
    fork_join_.fork();
#pragma omp parallel for schedule(static) num_threads(threads())
    for (std::size_t point = 0; point < points_; ++point) work(point, static_cast<std::size_t>(omp_get_thread_num()));
    fork_join_.join();
    Survey sum;
    for (const Survey& of_thread : surveys_) sum.add(of_thread);
    std::ranges::sort(sum.groups, cheaper, &Collected::effects);
    return sum;
  }

 private:
  [[nodiscard]] int threads() const { return static_cast<int>(surveys_.size()); }

  void work(std::size_t point, std::size_t thread) {
    const ForkJoin::Member member(fork_join_);
    look_at(sweep_, branches_, point, surveys_[thread]);
  }

  const Sweep& sweep_;
  Branches branches_;
  std::size_t points_;
  std::vector<Survey> surveys_;  ///< [thread]
  ForkJoin fork_join_;
};

std::vector<std::string> observed_of(const Observe& observe) {
  std::vector<std::string> names;
  if (observe.extrema) names.emplace_back("extrema");
  if (observe.harmonics > 0) {
    const bool fft = observe.harmonics_method == HarmonicsMethod::fft;
    names.push_back("harmonics 0 ... " + std::to_string(observe.harmonics) +
                    (fft ? " by FFT of " + std::to_string(observe.harmonics_samples) + " samples" : " from the arcs"));
  }
  if (observe.impacts) names.emplace_back("impacts");
  if (observe.impact_log) names.emplace_back("impact log");
  if (observe.trajectory > 0) names.push_back("trajectory of " + std::to_string(observe.trajectory) + " samples");
  if (observe.period) names.emplace_back("period");
  if (observe.stability) names.emplace_back("stability");
  return names;
}

/// A stop that is there at some point, but never met by any.
void warn_of_stop(const Sweep& sweep, const StopSeen& stop, const std::string& name, Plan& plan) {
  if (stop.met || stop.closest.ratio < 0) return;
  const auto reasons = reasons_of(planned_scene(sweep, Branches(sweep), stop.closest.point));
  const std::string& why = std::ranges::find(reasons, name, &Reason::effect)->why;
  plan.warnings.push_back("the " + name + " is never reached at any point, at the closest " + why +
                          "; if impacts are meant, move it nearer or raise f, x0 or v0");
}

void warn(const Sweep& sweep, const Survey& survey, Plan& plan) {
  warn_of_stop(sweep, survey.lower, "lower stop", plan);
  warn_of_stop(sweep, survey.upper, "upper stop", plan);
  if (plan.need.memory > plan.machine_bytes)
    plan.warnings.emplace_back(
        "a run takes more memory than there is: clatter run will refuse; sweep fewer points, or observe less");
  if (survey.lasting)
    plan.warnings.emplace_back(
        "without damping and loss at impacts a transient never fades: forced points run for all of max_periods unless "
        "they start on a periodic motion; for a given time write mode = transient");
  if (const auto warning = warning_of_dearest_point(sweep)) plan.warnings.push_back(*warning);
}

}  // namespace

bool cheaper(const Effects& one, const Effects& other) {
  const auto key = [](const Effects& e) {
    return std::tuple(kernel_of(e), e.damping, e.forcing, e.load, e.lower, e.upper, e.dissipation, e.rest);
  };
  return key(one) < key(other);
}

std::string kernel_name(const Effects& effects) {
  const Effects& kernel = compiled_effects[kernel_of(effects)];
  std::string name = kernel.damping == Damping::none    ? "no damping"
                     : kernel.damping == Damping::light ? "light damping"
                                                        : "heavy damping";
  if (kernel.forcing != Forcing::none) name += kernel.forcing == Forcing::regular ? ", forcing" : ", resonant forcing";
  name += kernel.stops() ? ", impacts" : ", no stops";
  if (kernel.rest) name += ", chatter and rest";
  return name;
}

Plan plan_of(const Sweep& sweep, int threads) {
  const Survey survey = Surveyor(sweep, threads).run();
  Plan plan;
  plan.points = size(sweep);
  plan.observed = observed_of(sweep.scene.observe);
  const Branches branches(sweep);
  plan.branches = branches.count;
  for (const Collected& group : survey.groups) {
    const double seconds = seconds_of_work(planned_scene(sweep, branches, group.example.point), group.effects);
    plan.groups.push_back({.effects = group.effects,
                           .points = group.points,
                           .example = group.example.point,
                           .reasons = reasons_of(planned_scene(sweep, branches, group.example.point)),
                           .periods = group.periods,
                           .seconds = {group.work.least * seconds, group.work.most * seconds}});
  }
  plan.need = memory_need(sweep, std::nullopt, threads);
  plan.machine_bytes = memory_limit(threads).bytes;
  warn(sweep, survey, plan);
  return plan;
}

}  // namespace clatter
