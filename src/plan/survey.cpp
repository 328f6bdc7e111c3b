#include "plan/survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "lanes/run_in_lanes.hpp"
#include "motion/contact.hpp"
#include "plan/sample.hpp"
#include "point/point.hpp"
#include "scene/displacement_bound.hpp"
#include "steady/repeat.hpp"
#include "sweep/chains.hpp"
#include "sweep/parallel.hpp"

namespace clatter::plan {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Whether motion without stops reaches its final form: the steady response, free vibration, or standstill in time.
bool comes_to_its_end(const point::Problem& scene, double time) {
  const Oscillator& o = scene.oscillator;
  if (is_driven(o)) return o.damping > 0 && o.shape.is_sine();
  const double x = scene.start.displacement - equilibrium_of(o), v = scene.start.velocity;
  const double scale = std::max({std::abs(scene.start.displacement), std::abs(v), std::abs(equilibrium_of(o))});
  return o.damping == 0 || fading_time(o, {x, v}, scene.time.tolerance * scale) <= time;
}

/// Forcing periods of a point. If nothing is proved, at best one to settle and one observed; at worst all of
/// max_periods, those of the attempts to find the periodic motion, and the window. General methods make no such
/// attempt, nor is one made under friction, which proves nothing but that a mass stays where it is, nor with a loose
/// mass.
Bounds periods_of(const point::Problem& scene, const Effects& effects) {
  const steady::TimeSettings& time = scene.time;
  const Oscillator& o = scene.oscillator;
  const double longest = static_cast<double>(time.max_periods), period = period_of(o);
  if (time.mode == steady::Mode::transient) return {time.duration / period, time.duration / period};
  if (never_moves(scene)) return {1, 1};
  if (effects.friction || effects.loose) return {2, longest + static_cast<double>(time.window)};
  if (scene.integration.all_effects) {
    const double least = static_cast<double>(steady::last_look(o, time.max_periods));
    return {std::max(1.0, least) + 1, longest + static_cast<double>(time.window)};
  }
  if (scene.integration.method != stepping::Method::exact) return {2, longest + static_cast<double>(time.window)};
  if (!effects.stops() && comes_to_its_end(scene, longest * period)) return {1, 1};
  if (!is_driven(o) && o.damping == 0 && !effects.dissipation) return {0, 1};
  return {2, longest * 1.25 + std::min(64.0, longest) + static_cast<double>(time.window)};
}

/// The largest displacement over the gap of a stop that isn't met: 1 if it would touch; negative if there is no stop.
double closeness(const Requirements& needs, double gap) {
  return gap < unbounded ? (needs.effects.stops() ? needs.reach : needs.free_reach) / gap : -1;
}

/// The points of a run that are examined. Those that begin a chain are sampled apart from the others: their start is
/// known, so their work differs.
class ExaminedPoints {
 public:
  explicit ExaminedPoints(const sweep::Share& share)
      : share_(share),
        firsts_(share.count(),
                share.length() == 1 || share.points() <= most_examined ? most_examined : most_examined / 2),
        others_(share.points() - share.count(), most_examined - firsts_.size()) {}

  [[nodiscard]] std::size_t size() const { return firsts_.size() + others_.size(); }

  /// The i-th point: its number in the sweep, and how many points it stands for.
  [[nodiscard]] Sample::Draw operator[](std::size_t i) const {
    if (i < firsts_.size()) return {share_.point(firsts_[i].number, 0), firsts_[i].weight};
    const auto [number, weight] = others_[i - firsts_.size()];
    return {share_.point(number % share_.count(), 1 + number / share_.count()), weight};
  }

 private:
  sweep::Share share_;
  Sample firsts_, others_;
};

void examine(const sweep::Sweep& sweep, const Sample::Draw& draw, bool lanes_run, Survey& survey) {
  const point::Problem scene = planned_problem(sweep, draw.number);
  const Requirements needs = requirements_of(scene, duration_of(scene.time));
  const bool required = scene.integration.method == stepping::Method::exact && !scene.integration.all_effects;
  const Effects effects = required ? needs.effects : effects_of(scene);
  const Bounds periods = periods_of(scene, effects) * static_cast<double>(draw.weight);
  const Closest to_lower{needs.effects.lower ? 0 : closeness(needs, needs.lower_gap), draw.number},
      to_upper{needs.effects.upper ? 0 : closeness(needs, needs.upper_gap), draw.number};
  Closest example = to_lower;
  example.add(to_upper);
  const Bounds work = periods * work_of_period(scene, effects);
  const bool in_lanes = lanes_run && lanes::accepts({0, 0, scene, effects});
  survey.add({effects, draw.weight, example, periods, in_lanes ? Bounds{} : work, in_lanes ? work : Bounds{}});
  survey.lower.add({needs.effects.lower, to_lower}), survey.upper.add({needs.effects.upper, to_upper});
  const Stops walls = walls_of(scene.loose);
  const bool strikes_take = takes_energy(walls, Side::lower) || takes_energy(walls, Side::upper);
  survey.lasting = survey.lasting || (scene.time.mode == steady::Mode::steady && is_driven(scene.oscillator) &&
                                      scene.oscillator.damping == 0 && !needs.effects.dissipation &&
                                      !needs.effects.friction && !(needs.effects.loose && strikes_take));
}

/// Examines points on several threads, in blocks that are the same for every number of threads, and so are the sums.
class Surveyor {
 public:
  Surveyor(const sweep::Sweep& sweep, const sweep::Share& share, lanes::InstructionSet arch)
      : sweep_(sweep), points_(share), lanes_run_(runs_in_lanes(sweep, arch)) {}

  Survey run(int threads) {
    sweep::parallel_for(blocks, threads, [this](std::size_t block) { work(block); });
    Survey sum;
    sum.examined = points_.size();
    for (const Survey& of_block : surveys_) sum.add(of_block);
    return sum;
  }

 private:
  static constexpr std::size_t blocks = 256;

  void work(std::size_t block) {
    for (std::size_t i = block * points_.size() / blocks; i < (block + 1) * points_.size() / blocks; ++i)
      examine(sweep_, points_[i], lanes_run_, surveys_[block]);
  }

  const sweep::Sweep& sweep_;
  ExaminedPoints points_;
  bool lanes_run_;
  std::vector<Survey> surveys_ = std::vector<Survey>(blocks);
};

}  // namespace

double work_of_period(const point::Problem& scene, const Effects& effects) {
  if (scene.integration.method != stepping::Method::exact) return 1;
  const double step = motion::usual_step(natural_frequency(scene.oscillator), counting_frequency(scene.oscillator));
  return effects.stops() || effects.loose ? std::ceil(period_of(scene.oscillator) / step) + 4 : 1;
}

point::Problem planned_problem(const sweep::Sweep& sweep, std::size_t point) {
  point::Problem problem = problem_at(sweep, point);
  if (sweep::Chains(sweep).begins(point)) {
    sweep::start_from(problem, std::nullopt, {});
  } else {
    problem.start = {point::no_value, point::no_value, point::no_value};
  }
  return problem;
}

Survey survey_of(const sweep::Sweep& sweep, const sweep::Share& share, const sweep::RunOptions& options) {
  return Surveyor(sweep, share, options.arch).run(options.threads);
}

}  // namespace clatter::plan
