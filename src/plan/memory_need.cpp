#include "plan/memory_need.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "point/point.hpp"
#include "sweep/attractor_table.hpp"
#include "sweep/chains.hpp"
#include "sweep/result_store.hpp"

namespace clatter::plan {
namespace {

constexpr double kibi = 1024;
constexpr double program = 11.5 * kibi * kibi;  ///< the program and its libraries, with a sweep of a few points
constexpr double thread = 64 * kibi;            ///< stack and heap of a thread
constexpr double value = sizeof(double);

constexpr double short_text = 2 * sizeof(std::string);  ///< most are short; in the file a reference, a header, letters
constexpr double heap = 2 * sizeof(void*);              ///< overhead of a block
constexpr double held_impact = sizeof(observables::LoggedImpact);
constexpr double lone_block = 128 * kibi;  ///< size from which on a block is returned to the system by itself

/// Sizes of everything that is held value by value, in bytes.
struct Parts {
  double points = 0.0, chains = 0.0;
  double axes = 0.0;          ///< coordinates that are axes of the sweep, which holds them too
  double coordinates = 0.0;   ///< all of the file
  double results = 0.0;       ///< all but the log
  double intermediate = 0.0;  ///< results that aren't in the file, and what numbering the motions takes
  double motions = 0.0;       ///< those of the ensembles, which are held twice while they are numbered
  double shares = 0.0;        ///< results of the ensembles, which aren't there yet meanwhile
  double largest = 0.0;       ///< largest variable of the file
  double impacts = 0.0;       ///< number of impacts in the log
  double counts = 0.0;        ///< the numbers of impacts of each point
  double logged = 0.0;        ///< an impact in the file

  [[nodiscard]] double logged_in_file() const { return impacts * logged + counts; }
  /// All results before the file is built, without the log.
  [[nodiscard]] double collected() const { return results + intermediate + std::max(0.0, motions - shares); }
};

void add_coordinates(const sweep::Sweep& sweep, bool is_shard, Parts& parts) {
  for (const sweep::Dimension& dimension : sweep.dimensions) {
    const double axis = value * static_cast<double>(length(dimension));
    parts.axes += axis * static_cast<double>(dimension.size());
    parts.largest = std::max(parts.largest, axis);
  }
  parts.coordinates = parts.axes;
  if (sweep.direction == sweep::Direction::both) parts.coordinates += 2 * sizeof(std::int8_t);
  if (is_shard) parts.coordinates += sizeof(std::int64_t) * parts.points;  // index in the sweep
  for (const observables::Coordinate& coordinate : observables::All::coordinates(sweep.problem.observe)) {
    const auto bytes = [&]<class T>(const T& values) -> double {
      if constexpr (std::is_same_v<T, std::monostate>)
        return 0.0;
      else
        return static_cast<double>(values.size() * sizeof values[0]);
    };
    parts.coordinates += std::visit(bytes, coordinate.values);
  }
}

/// The numbers of the points, and the motions of each ensemble, of which most have few.
void add_numbering(const sweep::Sweep& sweep, Parts& parts) {
  constexpr double few = 4, of_share = 3 * value;
  const double ensembles = std::min(parts.points, static_cast<double>(sweep::ensembles_of(sweep)));
  const double motions = std::min(parts.points, few * ensembles);
  parts.motions = attractors::bytes_of_motion * motions;
  parts.shares = (value + std::min(few, parts.points / ensembles) * of_share) * ensembles;
  parts.results += sizeof(std::int32_t) * parts.points + parts.shares;
  parts.intermediate += parts.motions + sizeof(std::uint32_t) * ensembles;
}

Parts parts_of(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, double impacts) {
  const sweep::Share share(sweep, shard);
  Parts parts{.points = static_cast<double>(share.points()), .chains = static_cast<double>(share.count())};
  add_coordinates(sweep, shard.has_value(), parts);
  parts.results = (sizeof(std::uint8_t) + sizeof(std::int64_t) + value) * parts.points;  // status, impacts, periods
  parts.largest = std::max(parts.largest, value * parts.points);
  for (const sweep::OutputVariable& output : sweep::outputs_of(sweep.problem)) {
    const double bytes = (output.text ? short_text : static_cast<double>(output.width()) * value) * parts.points;
    if (output.intermediate && !shard) {
      parts.intermediate += bytes;
      continue;
    }
    parts.results += bytes, parts.largest = std::max(parts.largest, bytes);
  }
  if (sweep.problem.observe.attractor) add_numbering(sweep, parts);
  if (!sweep.problem.observe.impact_log) return parts;
  parts.impacts = impacts, parts.counts = sizeof(std::int64_t) * parts.points;
  parts.logged = static_cast<double>(observables::log_columns(is_shaken(sweep)).size()) * value + sizeof(std::int8_t);
  parts.largest = std::max(parts.largest, value * impacts);
  return parts;
}

/// The log while points are computed, one vector for each.
double held_log_bytes(const sweep::Sweep& sweep, const Parts& parts) {
  if (!sweep.problem.observe.impact_log) return 0.0;
  return (sizeof(std::vector<observables::LoggedImpact>) + heap) * parts.points + held_impact * parts.impacts;
}

/// The log while its columns are made. Blocks of long logs are returned to the system one after the other meanwhile.
double log_bytes(const sweep::Sweep& sweep, const Parts& parts) {
  const double held = held_log_bytes(sweep, parts), columns = parts.logged_in_file();
  const bool alone = held_impact * parts.impacts >= lone_block * parts.points;
  return alone ? std::max(held, columns) : held + columns;
}

/// A chain that is packed to be saved.
double saving_bytes(const sweep::Sweep& sweep, const Parts& parts, double log) {
  return sweep.follow && parts.chains > 0 ? (parts.results + log) / parts.chains : 0.0;
}

/// While the file is built: coordinates and results are in one place or the other, the largest variable in both.
double building_bytes(const Parts& parts) {
  return parts.coordinates + parts.results + parts.logged_in_file() + parts.largest;
}

double before_bytes(const Parts& parts, int threads) { return program + thread * threads + parts.axes; }

/// The extent of the runs for the estimate: some milliseconds, by general methods a good part of a second.
struct Trial {
  std::size_t points = 32;
  double impacts = 16384;         ///< of a point
  double periods = 64;            ///< of a transient
  std::int64_t to_settle = 2048;  ///< periods until motion counts as aperiodic
  std::int64_t window = 16;       ///< periods of aperiodic motion
};

Trial trial_of(const stepping::Integration& integration) {
  if (integration.method == stepping::Method::exact) return {};
  return {.points = 4, .periods = 4, .to_settle = 16, .window = 4};
}

/// Impacts in the time of a transient, extrapolated from its first periods.
double impacts_of_transient(point::Problem scene, const Trial& trial) {
  steady::TimeSettings& time = scene.time;
  const double budget = time.max_impacts, whole = time.duration, period = period_of(scene.oscillator);
  time.max_impacts = std::min(budget, trial.impacts), time.duration = std::min(whole, trial.periods * period);
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  const double simulated = std::min(result.periods * period, time.duration);
  const double impacts = failed(result.status) ? result.impacts : static_cast<double>(result.log.size());
  return simulated > 0 ? std::min(budget, impacts * whole / simulated) : impacts;
}

/// Impacts in a period of the motion that the point settles to; in the window if it doesn't settle.
double impacts_of_steady_motion(point::Problem scene, const Trial& trial) {
  steady::TimeSettings& time = scene.time;
  const auto window = static_cast<double>(time.window);
  time.max_impacts = std::min(time.max_impacts, trial.impacts);
  time.max_periods = std::min(time.max_periods, trial.to_settle), time.window = std::min(time.window, trial.window);
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  const auto impacts = static_cast<double>(result.log.size());
  return lacks_period(result.status) ? impacts * window / static_cast<double>(time.window) : impacts;
}

}  // namespace

MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, int threads) {
  const double impacts = sweep.problem.observe.impact_log ? expected_impacts(sweep, shard) : 0.0;
  return memory_need(sweep, shard, threads, impacts);
}

MemoryNeed memory_need(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, int threads,
                       double impacts) {
  const Parts parts = parts_of(sweep, shard, impacts);
  const double log = log_bytes(sweep, parts),
               held = parts.results + parts.intermediate + parts.chains;  // a byte tells a chain's state
  const double working = threads * value * observables::All::values_held(sweep.problem.observe);
  const double running = held + log + std::max(working, saving_bytes(sweep, parts, log));
  const double collecting = parts.coordinates + parts.collected() + parts.chains + log;
  const double building = parts.chains + building_bytes(parts);
  return {.output = parts.coordinates + parts.results + parts.logged_in_file(),
          .memory = before_bytes(parts, threads) + std::max({running, collecting, building}),
          .log = log};
}

double merge_bytes(const sweep::Sweep& sweep, std::span<const ShardSize> shards) {
  double impacts = 0.0, largest = 0.0;
  for (const ShardSize& size : shards) {
    const Parts shard = parts_of(sweep, size.shard, static_cast<double>(size.impacts));
    impacts += static_cast<double>(size.impacts);
    largest = std::max(largest, shard.coordinates + shard.results + shard.logged_in_file());
  }
  const Parts parts = parts_of(sweep, std::nullopt, impacts);
  const double log = log_bytes(sweep, parts),
               reading = parts.results + parts.intermediate + held_log_bytes(sweep, parts) + largest;
  return before_bytes(parts, 0) +
         std::max({reading, parts.coordinates + parts.collected() + log, building_bytes(parts)});
}

double expected_impacts(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard) {
  const Trial trial = trial_of(sweep.problem.integration);
  const sweep::Share share(sweep, shard);
  const std::size_t points = share.points(), examined = std::min(points, trial.points);
  double impacts = 0;
  for (std::size_t i = 0; i < examined; ++i) {
    const std::size_t local_index = (2 * i + 1) * points / (2 * examined);  // the middles of equal parts
    point::Problem scene = problem_at(sweep, share.point(local_index / share.length(), local_index % share.length()));
    sweep::start_from(scene, std::nullopt, {});
    scene.observe = {}, scene.observe.impact_log = true, scene.integration.all_effects = false;
    impacts += scene.time.mode == steady::Mode::transient ? impacts_of_transient(scene, trial)
                                                          : impacts_of_steady_motion(scene, trial);
  }
  return examined == 0 ? 0.0 : impacts * static_cast<double>(points) / static_cast<double>(examined);
}

}  // namespace clatter::plan
