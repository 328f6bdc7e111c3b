#include "plan/plan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "lanes/run_in_lanes.hpp"
#include "plan/available_memory.hpp"
#include "plan/costliest_point.hpp"
#include "plan/survey.hpp"
#include "point/point.hpp"
#include "sweep/chains.hpp"
#include "sweep/mirror_images.hpp"

namespace clatter::plan {
namespace {

/// Measured wall time of a unit of work.
double seconds_of_work(point::Problem scene, const Effects& effects) {
  if (scene.integration.method == stepping::Method::exact) return point::seconds_per_evaluation(effects);
  if (!std::isfinite(scene.start.displacement)) scene.start = {};
  sweep::start_from(scene, std::nullopt, {});
  point::ThreadScratch scratch;
  return seconds_per_period(scene, scratch);
}

/// Seconds that lanes take for a forcing period, measured on motion with an impact or two in a forcing period: chaotic
/// with a spring, from wall to wall without one, which takes lanes of their own, as soft stops do.
double seconds_of_lane_work(const point::Problem& example, const Effects& effects, lanes::InstructionSet arch) {
  constexpr double nu = 0.827759, gap = 2.19231, periods = 200;
  point::Problem scene;
  scene.oscillator = {.damping = 0.1, .forcing = -1.0, .frequency = nu};
  scene.stops = {-gap, gap, 0.7, 0.7};
  if (!(example.oscillator.stiffness > 0)) scene.oscillator.stiffness = 0, scene.stops = {-1, 1, 0.7, 0.7};
  if (effects.soft) {
    scene.stops.stiffness_lower = scene.stops.stiffness_upper = 100;
    scene.stops.damping_lower = scene.stops.damping_upper = 0.1;
  }
  scene.time = {.mode = example.time.mode, .max_periods = static_cast<std::int64_t>(periods), .window = 1};
  scene.time.duration = periods * period_of(scene.oscillator);
  const point::WorkItem item{0, 0, scene, effects_of(scene)};
  constexpr std::size_t times = 4 * lanes::lanes_per_block;
  point::ThreadScratch scratch;
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 3; ++repetition) {
    const auto begin = std::chrono::steady_clock::now();
    const double simulated = lanes::run_in_lanes(item, times, arch, scratch).periods * times;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    least = std::min(least, passed.count() / simulated);
  }
  return least / work_of_period(scene, item.effects);
}

/// Wall time of a group's work on one thread.
Bounds seconds_of(const Collected& group, const point::Problem& example, lanes::InstructionSet arch) {
  Bounds seconds;
  if (group.work.most > 0) seconds += group.work * seconds_of_work(example, group.effects);
  if (group.lane_work.most > 0) seconds += group.lane_work * seconds_of_lane_work(example, group.effects, arch);
  return seconds;
}

/// Warns of a stop that some points have but none meets.
void warn_of_stop(const sweep::Sweep& sweep, const StopSeen& stop, const std::string& name, Plan& plan) {
  if (stop.met || stop.closest.ratio < 0) return;
  const auto reasons = reasons_of(planned_problem(sweep, stop.closest.point));
  const std::string& why = std::ranges::find(reasons, name, &Reason::effect)->why;
  const std::string reached =
      plan.sampled_points ? " is reached at none of the " + std::to_string(*plan.sampled_points) + " points examined"
                          : " is never reached at any point";
  plan.warnings.push_back("the " + name + reached + ", at the closest " + why +
                          "; if impacts are meant, move it nearer or raise f, x0 or v0");
}

void warn(const sweep::Sweep& sweep, const Survey& survey, Plan& plan) {
  warn_of_stop(sweep, survey.lower, "lower stop", plan);
  warn_of_stop(sweep, survey.upper, "upper stop", plan);
  if (survey.lasting)
    plan.warnings.emplace_back(
        "without damping and loss at impacts a transient never fades: forced points run for all of max_periods unless "
        "they start on a periodic motion; for a given time write mode = transient");
  if (const auto warning = warning_of_costliest_point(sweep, plan.shard)) plan.warnings.push_back(*warning);
}

}  // namespace

std::string effect_set_name(const Effects& effects) {
  const Effects& set = compiled_effects[effect_set_of(effects)];
  std::string name = set.stiffness && !set.loose     ? "any spring"
                     : set.damping == Damping::none  ? "no damping"
                     : set.damping == Damping::light ? "light damping"
                                                     : "heavy damping";
  if (set.forcing != Forcing::none) name += set.forcing == Forcing::regular ? ", forcing" : ", resonant forcing";
  if (set.loose) return name + (set.stops() ? ", loose mass beside stops and friction" : ", loose mass");
  name += set.stops() ? ", impacts" : ", no stops";
  if (set.friction) name += effects.own_motion ? ", stops that move" : ", friction";
  return name;
}

Plan plan_of(const sweep::Sweep& sweep, const sweep::RunOptions& options, const MemoryNeed& need,
             const std::optional<results::Shard>& shard) {
  const sweep::Share share(sweep, shard);
  Survey survey = survey_of(sweep, share, options);
  std::ranges::sort(survey.groups, cheaper, &Collected::effects);
  Plan plan;
  plan.shard = shard;
  plan.points = share.points(), plan.chains = share.count();
  if (survey.examined < plan.points) plan.sampled_points = survey.examined;
  plan.observed = observables::All::descriptions(sweep.problem.observe);
  for (const Collected& group : survey.groups) {
    const point::Problem example = planned_problem(sweep, group.example.point);
    plan.groups.push_back({.effects = group.effects,
                           .points = group.points,
                           .example = group.example.point,
                           .reasons = reasons_of(example),
                           .periods = group.periods,
                           .seconds = seconds_of(group, example, options.arch)});
  }
  if (!shard) plan.mirror_images = sweep::MirrorImages(sweep).count();
  const double run =
      1 - static_cast<double>(plan.mirror_images) / static_cast<double>(std::max<std::size_t>(1, plan.points));
  for (Group& group : plan.groups) group.periods = group.periods * run, group.seconds = group.seconds * run;
  plan.need = need;
  plan.available_memory = memory_limit(options.threads, need.in_files).besides(need.in_files);
  warn(sweep, survey, plan);
  return plan;
}

}  // namespace clatter::plan
