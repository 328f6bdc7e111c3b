#include "sweep/attractor_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <utility>

#include "sweep/binomial_share.hpp"
#include "sweep/dataset_axes.hpp"
#include "sweep/parallel.hpp"
#include "sweep/share.hpp"

namespace clatter::sweep {
namespace {

bool is_of_start(const Dimension& dimension) {
  return std::ranges::all_of(dimension, [](const Axis& axis) { return axis.parameter.role() == Role::start; });
}

attractors::Grid grid_of(const Sweep& sweep) {
  std::vector<attractors::Grid::Dimension> dimensions;
  if (sweep.direction == Direction::both) dimensions.push_back({2, true});
  for (const Dimension& dimension : sweep.dimensions) dimensions.push_back({length(dimension), is_of_start(dimension)});
  return attractors::Grid(std::move(dimensions));
}

bool varies_phase(const Sweep& sweep) {
  return std::ranges::any_of(sweep.dimensions, [](const Dimension& dimension) {
    return std::ranges::find(dimension, Parameter("phase"), &Axis::parameter) != dimension.end();
  });
}

/// `parallel_for` with work that may throw: the first exception comes out of it.
void for_each(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::mutex mutex;
  std::exception_ptr failure;
  parallel_for(count, threads, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

/// Shares of starts and their 95 % intervals, each computed once.
class Shares {
 public:
  explicit Shares(std::size_t starts) : starts_(starts) {}

  /// The share of `points` starts.
  const BinomialShare& of(std::size_t points) {
    const auto [found, is_new] = known_.try_emplace(points);
    if (is_new) found->second = binomial_share(points, starts_);
    return found->second;
  }

 private:
  std::size_t starts_;
  std::map<std::size_t, BinomialShare> known_;
};

/// Points by ensemble and motion.
std::vector<std::size_t> counts_of(const attractors::Grid& grid, const attractors::Numbering& numbering) {
  const std::size_t motions = numbering.motions.size();
  std::vector<std::size_t> counts(grid.ensembles() * motions, 0);
  for (std::size_t ensemble = 0; ensemble < grid.ensembles(); ++ensemble)
    for (std::size_t start = 0; start < grid.starts(); ++start) {
      const std::int32_t number = numbering.number[grid.point(ensemble, start)];
      if (number != attractors::undecided) ++counts[ensemble * motions + static_cast<std::size_t>(number)];
    }
  return counts;
}

/// The dimensions of the sweep that aren't those of the start.
std::vector<std::string> parameter_names(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const Dimension& dimension : sweep.dimensions)
    if (!is_of_start(dimension)) names.emplace_back(name_of(dimension));
  return names;
}

void add_counts(const Sweep& sweep, const attractors::Grid& grid, const attractors::Numbering& numbering,
                results::Dataset& dataset) {
  const std::size_t motions = numbering.motions.size();
  std::vector<std::int64_t> motion_count(grid.ensembles(), 0);
  std::vector<std::int32_t> seen(motions, -1);  // [motion]: the ensemble whose points had it last
  for (std::size_t ensemble = 0; ensemble < grid.ensembles(); ++ensemble)
    for (std::size_t start = 0; start < grid.starts(); ++start) {
      const std::int32_t number = numbering.number[grid.point(ensemble, start)];
      if (number == attractors::undecided) continue;
      const auto here = static_cast<std::int32_t>(ensemble);
      motion_count[ensemble] += std::exchange(seen[static_cast<std::size_t>(number)], here) == here ? 0 : 1;
    }
  std::vector<std::string> along = parameter_names(sweep);
  dataset.variables.push_back({"motion_count", along, std::move(motion_count), "motions that the starts end in", "1"});
  if (motions > grid.starts() || motions == 0) return;  // they would take more room than the points
  const std::vector<std::size_t> counts = counts_of(grid, numbering);
  std::vector<double> shares(counts.size()), low(counts.size()), high(counts.size());
  Shares of_starts(grid.starts());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const BinomialShare& share = of_starts.of(counts[i]);
    shares[i] = share.share, low[i] = share.low, high[i] = share.high;
  }
  along.emplace_back("motion");
  dataset.variables.push_back({"motion_share", along, std::move(shares), "share of the starts that end in it", "1"});
  dataset.variables.push_back(
      {"motion_share_low", along, std::move(low), "lower end of the 95 % interval of the share", "1"});
  dataset.variables.push_back(
      {"motion_share_high", along, std::move(high), "upper end of the 95 % interval of the share", "1"});
}

/// The state of a motion at forcing phase 0, at its example, in the frame and the units of the user.
attractors::SectionState example_state(const Sweep& sweep, const attractors::NumberedMotion& motion) {
  point::Problem problem = problem_at(sweep, motion.example % size_one_way(sweep));
  problem.start.phase = problem.shaking.lead;
  attractors::SectionState state = motion.state;
  if (const auto frame = observed_frame(problem)) {
    const SineCosine<double> at = frame->at(0.0);
    state.x += frame->displacement(at), state.v += frame->velocity(at);
  }
  if (problem.units == Units{}) return state;
  const double rate = factor_of(problem.units, Quantity::velocity);
  state.v *= rate, state.w *= rate;
  return state;
}

}  // namespace

std::optional<attractors::Numbering> numbering_by(
    const Sweep& sweep, const std::optional<results::Shard>& shard, int threads,
    const std::function<std::span<const double>(std::string_view output)>& numbers_of) {
  if (!sweep.problem.observe.attractor) return std::nullopt;
  const bool loose = sweep.problem.observe.loose_attractor, follows = sweep.problem.observe.followed_attractor;
  const std::span<const double> none,
      x = numbers_of("attractor_x"), v = numbers_of("attractor_v"), periods = numbers_of("attractor_periods"),
      z = loose ? numbers_of("attractor_z") : none, w = loose ? numbers_of("attractor_w") : none,
      phase = follows ? numbers_of("attractor_phase") : none;
  const Share share(sweep, shard);
  return attractors::number_motions(
      {.grid = grid_of(sweep),
       .has_phases = varies_phase(sweep),
       .problem = [&](std::size_t point) { return problem_at(sweep, point % size_one_way(sweep)); },
       .index = [&](std::size_t point) -> std::optional<std::size_t> {
         const std::size_t index = share.points_before(point);
         return index < share.points() && share.point_at(index) == point ? std::optional(index) : std::nullopt;
       },
       .count = share.points(),
       .ending =
           [&](std::size_t i) {
             return attractors::Ending{{x[i], v[i], loose ? z[i] : 0.0, loose ? w[i] : 0.0},
                                       periods[i],
                                       follows ? std::optional(phase[i]) : std::nullopt};
           },
       .for_each = [threads](std::size_t count,
                             const std::function<void(std::size_t)>& work) { for_each(count, threads, work); }});
}

std::size_t ensembles_of(const Sweep& sweep) { return grid_of(sweep).ensembles(); }

void add_attractors(const Sweep& sweep, bool is_shard, const std::vector<std::string>& along,
                    attractors::Numbering numbering, results::Dataset& dataset) {
  const std::vector<attractors::NumberedMotion>& motions = numbering.motions;
  dataset.dimensions.push_back({"motion", motions.size()});
  const auto add = [&]<class T>(const char* name, const char* long_name, T value_of,
                                Quantity quantity = Quantity::number) {
    std::vector<decltype(value_of(motions.front()))> values;
    values.reserve(motions.size());
    for (const attractors::NumberedMotion& motion : motions) values.push_back(value_of(motion));
    dataset.variables.push_back(
        {name, {"motion"}, std::move(values), long_name, std::string(unit_of(quantity, sweep.problem.is_si))});
  };
  using Motion = attractors::NumberedMotion;
  std::size_t number = 0;
  add("motion", "number of the motion, by its first point",
      [&](const Motion&) { return static_cast<std::int64_t>(number++); });
  add("motion_period_ratio", "period in forcing periods, 0: it doesn't repeat",
      [](const Motion& m) { return static_cast<std::int64_t>(m.periods); });
  add("motion_word", "impacts of one period in order, L: lower stop, U: upper stop, *: until at rest",
      [](const Motion& m) { return m.word; });
  dataset.variables.back().missing_if = "no stop is hit, or it has no period";
  add("motion_regime", "impacts on the stop with more of them / forcing periods",
      [](const Motion& m) { return m.regime; });
  dataset.variables.back().missing_if = "it has no period, or there is no force";
  number = 0;
  add("motion_symmetric", "1: half a period later the motion is its mirror image", [&](const Motion& m) {
    const bool is_own_mirror = m.mirror == static_cast<std::int32_t>(number++);
    return m.has_mirror ? (is_own_mirror ? 1.0 : 0.0) : observables::no_value;
  });
  dataset.variables.back().missing_if = "the scene isn't symmetric";
  add("motion_mirror", "number of its mirror image, -1: no start ends in it", [](const Motion& m) { return m.mirror; });
  add("motion_points", "points that end in it", [](const Motion& m) { return static_cast<std::int64_t>(m.points); });
  add(
      "motion_x", "displacement at forcing phase 0, at the parameters of the example",
      [&](const Motion& m) { return example_state(sweep, m).x; }, Quantity::length);
  name_frame(sweep, observables::FrameOf::observed, dataset.variables.back());
  add(
      "motion_v", "velocity at forcing phase 0, at the parameters of the example",
      [&](const Motion& m) { return example_state(sweep, m).v; }, Quantity::velocity);
  name_frame(sweep, observables::FrameOf::observed, dataset.variables.back());
  if (sweep.problem.observe.loose_attractor) {
    add(
        "motion_z", "place of the loose mass in the housing at forcing phase 0, at the parameters of the example",
        [&](const Motion& m) { return example_state(sweep, m).z; }, Quantity::length);
    add(
        "motion_w", "velocity of the loose mass over the housing at forcing phase 0, at those parameters",
        [&](const Motion& m) { return example_state(sweep, m).w; }, Quantity::velocity);
  }
  add("motion_example", "index of the first point that ends in it, row-major over the sweep",
      [](const Motion& m) { return static_cast<std::int64_t>(m.example); });
  if (!is_shard) add_counts(sweep, grid_of(sweep), numbering, dataset);
  dataset.variables.push_back({"attractor", along, std::move(numbering.number),
                               "number of the motion that the point ends in, -1: undecided or failed", "1"});
  name_observable("attractor", dataset.variables.back());
}

}  // namespace clatter::sweep
