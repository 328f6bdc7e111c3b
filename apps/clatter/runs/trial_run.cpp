#include "runs/trial_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "plan/costliest_point.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double enough = 0.2;           ///< seconds for the last trial
constexpr double most = 1;               ///< seconds after which a trial of costly points ends
constexpr double enough_points = 2000;   ///< of the last trial, unless they are costly
constexpr double room = 64 << 20;        ///< bytes that a trial may take
constexpr double of_program = 12 << 20;  ///< bytes that the program takes
constexpr double of_a_process = 0.005;   ///< seconds to begin and to end

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Ends a trial from within.
struct TimeIsUp {};

/// So many values of an axis, the middles of equal parts.
sweep::Axis thinned(const sweep::Axis& axis, std::size_t kept) {
  const std::size_t length = axis.values.size();
  sweep::Axis some{axis.parameter, {}};
  for (std::size_t i = 0; i < kept; ++i) some.values.push_back(axis.values[(2 * i + 1) * length / (2 * kept)]);
  return some;
}

/// How many values of each dimension make about so many points, the same share of each.
std::vector<std::size_t> kept_values(const std::vector<sweep::Dimension>& dimensions, double points) {
  std::vector<std::size_t> shortest_first(dimensions.size()), kept(dimensions.size());
  std::iota(shortest_first.begin(), shortest_first.end(), std::size_t{0});
  std::ranges::sort(shortest_first, {}, [&](std::size_t i) { return length(dimensions[i]); });
  std::size_t others = dimensions.size();
  for (const std::size_t i : shortest_first) {
    const double share = std::floor(std::pow(points, 1.0 / static_cast<double>(others--)) + 1e-9);
    kept[i] = static_cast<std::size_t>(std::clamp(share, 1.0, static_cast<double>(length(dimensions[i]))));
    points = std::max(1.0, points / static_cast<double>(kept[i]));
  }
  return kept;
}

/// A sweep over about so many points of another one.
sweep::Sweep thinned(const sweep::Sweep& sweep, double points) {
  sweep::Sweep some{sweep.problem, {}, sweep.follow, sweep.direction};
  const std::vector<std::size_t> kept = kept_values(sweep.dimensions, points);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    sweep::Dimension& dimension = some.dimensions.emplace_back();
    for (const sweep::Axis& axis : sweep.dimensions[i]) dimension.push_back(thinned(axis, kept[i]));
  }
  return some;
}

/// Points of a trial, and the seconds that they took.
struct Trial {
  double points = 0, seconds = 0;
};

/// Runs a sweep as `clatter run` does, but for the disk, no longer than a trial lasts.
Trial run(const sweep::Sweep& sweep, const config::Config& config, sweep::RunOptions options) {
  const Clock::time_point begin = Clock::now();
  double finished = 0;
  options.progress = [&](double done, std::size_t) {
    finished = done;
    if (seconds_since(begin) > most) throw TimeIsUp();
  };
  try {
    sweep::SweepRun run(sweep);
    run.run(options);
    std::vector<std::byte> journal;
    run.save([&](std::span<const std::byte> results) { journal.assign(results.begin(), results.end()); });
    static_cast<void>(results::file_image(run.result().dataset, config));
    return {static_cast<double>(size(sweep)), seconds_since(begin)};
  } catch (const TimeIsUp&) {
    return {finished, seconds_since(begin)};
  }
}

}  // namespace

std::optional<double> foretold_seconds(const config::Config& config, const sweep::RunOptions& options,
                                       const std::optional<results::Shard>& shard, const plan::MemoryNeed& need) {
  const auto all = static_cast<double>(sweep::Share(config.sweep, shard).points());
  const double fit = std::floor(room * all / std::max(need.output, need.memory - of_program));
  if (!(fit >= 1) || plan::warning_of_costliest_point(config.sweep, shard)) return std::nullopt;
  Trial last;
  const auto is_short = [&] {  // of fewer points, one that takes long may be most of the time
    return last.seconds < enough || (last.points < enough_points && last.seconds < most / 2);
  };
  for (double points = std::min(256.0, fit); is_short(); points *= std::clamp(most / last.seconds, 2.0, 8.0)) {
    const bool is_last = points >= std::min(all, fit);
    last = run(thinned(config.sweep, std::min({points, all, fit})), config, options);
    if (is_last) break;
  }
  if (!(last.points > 0)) return std::nullopt;
  return of_a_process + last.seconds * std::max(1.0, all / last.points);
}

}  // namespace clatter::app
