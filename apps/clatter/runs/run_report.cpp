#include "runs/run_report.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "plan/plan.hpp"
#include "steady/status.hpp"
#include "storage/utf8.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

/// The work of lanes, if any ran.
std::string lanes_text(const sweep::LaneWork& work) {
  if (work.proved == 0) return "";
  return "; lanes: steps proved " + formatted("%.6g", work.proved) + ", contacts refined " +
         formatted("%.6g", work.refined);
}

std::string host() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// The work of each group of points, and of all together.
std::string work_text(const std::vector<sweep::WorkStats>& work) {
  std::string text;
  double impacts = 0, periods = 0, evaluations = 0;
  for (std::size_t group = 0; group < work.size(); ++group) {
    const sweep::WorkStats& part = work[group];
    text += (group == 0 ? "groups           " : "                 ") +
            counted(static_cast<double>(part.points), "point") + " with " + plan::effect_set_name(part.effects) +
            "; forcing periods " + formatted("%.6g", part.periods) + ", impacts " + formatted("%.0f", part.impacts) +
            ", evaluations " + formatted("%.0f", part.evaluations);
    std::string found;
    for (std::size_t i = 0; i < part.found_by.size(); ++i)
      if (part.found_by[i] > 0)
        found += (found.empty() ? "; settled: " : ", ") + std::string(steady::found_by_names[i]) + ' ' +
                 std::to_string(part.found_by[i]);
    text += found + '\n';
    impacts += part.impacts, periods += part.periods, evaluations += part.evaluations;
  }
  return text + "impacts          " + formatted("%.0f", impacts) + "\nforcing periods  " + formatted("%.6g", periods) +
         "\nevaluations      " + formatted("%.0f", evaluations) + '\n';
}

std::string example_text(const sweep::Sweep& sweep, std::size_t point) {
  const std::string coordinates = coordinates_text(sweep, point);
  return ", e.g. point " + std::to_string(point) + (coordinates.empty() ? "" : " at " + coordinates);
}

}  // namespace

std::string summary_of_points(const sweep::RunResult& result, const sweep::Sweep& sweep,
                              const std::optional<results::Shard>& shard) {
  return counted(static_cast<double>(result.points), "point") + ", " + failures_text(result.statuses, sweep, shard);
}

std::string details(const sweep::RunResult& result, const std::string& command, const std::string& began) {
  return work_text(result.work) + "threads          " + std::to_string(result.threads) + "\ninstruction set  " +
         std::string(name_of(result.arch)) + lanes_text(result.lanes) + "\nhost             " + host() +
         "\ncommand line     " + storage::printable(command) + "\nbegan            " + began + "\nended            " +
         now() + '\n';
}

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm fields{};
  gmtime_r(&seconds, &fields);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &fields);
  return text.data();
}

std::string command_line() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::string words{std::istreambuf_iterator<char>(stream), {}};
  if (!words.empty()) words.pop_back();  // each word ends with NUL
  for (char& character : words) {
    if (character == '\0') character = ' ';
  }
  return words;
}

std::string failures_text(const sweep::StatusTally& statuses, const sweep::Sweep& sweep,
                          const std::optional<results::Shard>& shard) {
  const sweep::Share share(sweep, shard);
  std::string text;
  for (const auto& [status, name, meaning] : steady::status_names) {
    const sweep::StatusTally::Entry& points = statuses.of(status);
    if (!steady::failed(status) || points.points == 0) continue;
    (text += text.empty() ? " (" : "; ") += std::string(name) + ": " + std::to_string(points.points);
    text += example_text(sweep, share.point_at(points.first));
  }
  const std::size_t failures = statuses.failed();
  return std::to_string(failures) + " failed" + text + (failures > 0 ? ")" : "");
}

}  // namespace clatter::app
