#include "plan/memory_need.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "point/point.hpp"
#include "results/shard_file.hpp"
#include "storage/scratch.hpp"
#include "sweep/attractor_table.hpp"
#include "sweep/chains.hpp"
#include "sweep/joined.hpp"
#include "sweep/output_variables.hpp"

namespace clatter::plan {
namespace {

constexpr double kibi = 1024;
constexpr double program = 11.5 * kibi * kibi;  ///< the program and its libraries, with a sweep of a few points
constexpr double thread = 64 * kibi;            ///< stack and heap of a thread
constexpr double value_bytes = sizeof(double);

constexpr double text_in_file = 64;  ///< of a short text: a reference, a header, letters
constexpr double pointer = sizeof(void*);
constexpr double kept_text = 24;  ///< of a short text: length, letters
constexpr double logged_head = sizeof(std::uint64_t);
constexpr double logged_impact = sizeof(observables::LoggedImpact);
constexpr double files_resident = storage::Scratch::most_resident + storage::Scratch::between_checks;

/// While a file is written: pages that aren't yet full, values that are made and those that are written meanwhile,
/// blocks of texts, and what deflates values.
constexpr double of_pages = kibi * kibi, of_values = 2 * results::made_at_once, of_texts = 32 * kibi * kibi,
                 of_deflating = 2.5 * kibi * kibi;

/// Sizes of everything that a run holds value by value, and of its files, in bytes.
struct Parts {
  double points = 0.0, chains = 0.0;
  double axes = 0.0;         ///< values of the sweep's axes
  double coordinates = 0.0;  ///< all of the file
  double results = 0.0;      ///< in the file, all but the log
  double packed = 0.0;       ///< in the journal, all but the log
  double columns = 0.0;      ///< results in the scratch space, those of texts and logs being pointers
  double kept = 0.0;         ///< texts and logs there
  double numbered = 0.0;     ///< in memory, to number the motions by
  double motions = 0.0;      ///< those of the ensembles, which are held twice while they are numbered
  double numbers = 0.0;      ///< of the points' motions, and the shares of the ensembles
  double texts = 0.0;        ///< in the file
  double impacts = 0.0;      ///< number of impacts in the log
  double logged = 0.0;       ///< an impact in the file
  double counts = 0.0;       ///< in the file, the numbers of impacts of each point

  [[nodiscard]] double logged_in_file() const { return impacts * logged + counts; }
  [[nodiscard]] double output() const { return coordinates + results + logged_in_file(); }

  /// Results in files of the scratch space, as `storage::Scratch` decides it.
  [[nodiscard]] double in_files() const {
    const double most = storage::Scratch::most_in_memory;
    return columns > most ? columns + kept : std::max(0.0, columns + kept - most);
  }
  [[nodiscard]] double in_memory() const {
    return columns + kept - in_files() + std::min(in_files(), files_resident) + numbered;
  }
  [[nodiscard]] double writing(int level) const {
    return std::min(output(), of_pages) + std::min(texts, of_texts) + (level > 0 ? of_deflating : 0.0);
  }
};

void add_coordinates(const sweep::Sweep& sweep, bool is_shard, Parts& parts) {
  for (const sweep::Dimension& dimension : sweep.dimensions) {
    parts.axes += value_bytes * static_cast<double>(length(dimension)) * static_cast<double>(dimension.size());
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
  constexpr double few = 4, of_share = 3 * value_bytes;
  const double ensembles = std::min(parts.points, static_cast<double>(sweep::ensembles_of(sweep)));
  const double motions = std::min(parts.points, few * ensembles);
  parts.motions = attractors::bytes_of_motion * motions + sizeof(std::uint32_t) * ensembles;
  const double shares = (value_bytes + std::min(few, parts.points / ensembles) * of_share) * ensembles;
  parts.numbers = sizeof(std::int32_t) * parts.points + shares;
  parts.results += parts.numbers;
}

Parts parts_of(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard, double impacts) {
  const sweep::Share share(sweep, shard);
  Parts parts{.points = static_cast<double>(share.points()), .chains = static_cast<double>(share.count())};
  add_coordinates(sweep, shard.has_value(), parts);
  const observables::Observe& observe = sweep.problem.observe;
  const double always =
      (sizeof(std::uint8_t) + sizeof(std::int64_t) + value_bytes) * parts.points;  // status, impacts, periods
  parts.results = parts.packed = parts.columns = always;
  for (const sweep::OutputVariable& output : sweep::outputs_of(sweep.problem)) {
    const double bytes = static_cast<double>(output.width()) * value_bytes * parts.points;
    const double in_file = output.text ? text_in_file * parts.points : bytes;
    parts.packed += output.text ? kept_text * parts.points : bytes;
    if (!output.intermediate || shard) parts.results += in_file;
    if (output.text) parts.texts += in_file, parts.kept += kept_text * parts.points;
    (observe.attractor && output.intermediate ? parts.numbered : parts.columns) +=
        output.text ? pointer * parts.points : bytes;
  }
  if (observe.attractor) add_numbering(sweep, parts);
  if (!observe.impact_log) return parts;
  parts.impacts = impacts, parts.counts = sizeof(std::int64_t) * parts.points;
  parts.logged =
      static_cast<double>(observables::log_columns(is_shaken(sweep)).size()) * value_bytes + sizeof(std::int8_t);
  parts.columns += pointer * parts.points;
  parts.kept += logged_head * parts.points + logged_impact * impacts;
  return parts;
}

/// The part of the log in what is held in memory.
double log_in_memory(const Parts& parts) {
  const double log = logged_impact * parts.impacts, all = parts.columns + parts.kept;
  return all > 0 ? log * parts.in_memory() / all : 0.0;
}

/// A chain that is packed to be saved.
double saving_bytes(const sweep::Sweep& sweep, const Parts& parts) {
  return sweep.follow && parts.chains > 0 ? (parts.packed + logged_impact * parts.impacts) / parts.chains : 0.0;
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
  const double bits = 2 * parts.chains / 8;  // of the chains' states
  const double working =
      std::max(value_bytes * observables::All::values_held(sweep.problem.observe, threads), saving_bytes(sweep, parts));
  const double numbering = parts.motions + std::max(parts.motions, parts.numbers);
  const double writing = parts.numbers + parts.writing(1) + std::min(parts.output(), of_values);
  return {
      .output = parts.output(),
      .memory = before_bytes(parts, threads) + bits + parts.in_memory() +
                std::max({working, sweep.problem.observe.attractor ? numbering : 0.0, writing}),
      .log = sweep.problem.observe.impact_log ? log_in_memory(parts) : 0.0,
      .in_files = parts.in_files(),
      .journal = parts.packed + logged_impact * parts.impacts,
      .logged = parts.impacts * parts.logged,
      .merging = merge_bytes(sweep, shard ? shard->of : 1, shard ? impacts * static_cast<double>(shard->of) : impacts)};
}

double merge_bytes(const sweep::Sweep& sweep, std::size_t shards, double impacts, int level) {
  const Parts parts = parts_of(sweep, std::nullopt, impacts);
  double of_point = value_bytes;  // of the variable that has most
  for (const sweep::OutputVariable& output : sweep::outputs_of(sweep.problem))
    of_point = std::max(of_point, output.text ? text_in_file : static_cast<double>(output.width()) * value_bytes);
  constexpr double of_open_file = 0.64 * kibi * kibi;
  const double open = of_open_file * static_cast<double>(std::min(shards, results::most_open_shards));
  const double most = std::max<double>(sweep::joined_at_once, of_point);
  constexpr double blocks = 3.3;  // one is read, one gathered, one being written, and gaps lie between
  const double block = blocks * std::min(most, of_point * parts.points),
               log = (1 + 1 / static_cast<double>(shards)) * std::min(most, value_bytes * impacts);
  const double numbering = parts.numbered + parts.motions + std::max(parts.motions, parts.numbers);
  return before_bytes(parts, 0) + open + std::max(numbering, parts.numbers + block + log + parts.writing(level));
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
