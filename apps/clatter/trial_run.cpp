#include "trial_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "plan/costliest_point.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double enough = 0.2;          ///< seconds for the last trial
constexpr double most = 1;              ///< seconds after which a trial of costly points ends
constexpr double enough_points = 2000;  ///< of the last trial, unless they are costly
constexpr double of_a_process = 0.005;  ///< seconds to begin and to end

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Ends a trial from within.
struct TimeIsUp {};

/// So many values of an axis, the middles of equal parts.
void thin(sweep::Axis& axis, std::size_t kept) {
  const std::size_t length = axis.values.size();
  std::vector<double> values;
  for (std::size_t i = 0; i < kept; ++i) values.push_back(axis.values[(2 * i + 1) * length / (2 * kept)]);
  axis.values = std::move(values);
}

/// A sweep over about so many points of another one, the same share of each dimension.
sweep::Sweep thinned(sweep::Sweep sweep, double points) {
  double left = points;
  std::size_t dimensions = sweep.dimensions.size();
  std::vector<sweep::Dimension*> shortest_first;
  for (sweep::Dimension& dimension : sweep.dimensions) shortest_first.push_back(&dimension);
  std::ranges::sort(shortest_first, {}, [](const sweep::Dimension* dimension) { return length(*dimension); });
  for (sweep::Dimension* const dimension : shortest_first) {
    const double share = std::ceil(std::pow(left, 1.0 / static_cast<double>(dimensions--)));
    const auto kept = static_cast<std::size_t>(std::clamp(share, 1.0, static_cast<double>(length(*dimension))));
    for (sweep::Axis& axis : *dimension) thin(axis, kept);
    left = std::max(1.0, left / static_cast<double>(kept));
  }
  return sweep;
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
    const results::FileImage image = results::file_image(run.result().dataset, config);
    journal.assign(image.bytes.begin(), image.bytes.end());
    return {static_cast<double>(size(sweep)), seconds_since(begin)};
  } catch (const TimeIsUp&) {
    return {finished, seconds_since(begin)};
  }
}

}  // namespace

std::optional<double> foretold_seconds(const config::Config& config, const sweep::RunOptions& options,
                                       const std::optional<sweep::Shard>& shard) {
  if (plan::warning_of_costliest_point(config.sweep, shard)) return std::nullopt;
  const double all = static_cast<double>(sweep::Share(config.sweep, shard).points());
  Trial last;
  const auto is_short = [&] {  // of fewer points, one that takes long may be most of the time
    return last.seconds < enough || (last.points < enough_points && last.seconds < most / 2);
  };
  for (double points = 256; is_short(); points *= std::clamp(most / last.seconds, 2.0, 8.0)) {
    const bool is_whole = !shard && points >= all;
    const sweep::Sweep some = is_whole ? config.sweep : thinned(config.sweep, points);
    last = run(some, config, options);
    if (last.points >= all || size(some) == size(config.sweep)) break;
  }
  if (!(last.points > 0)) return std::nullopt;
  return of_a_process + last.seconds * std::max(1.0, all / last.points);
}

}  // namespace clatter::app
