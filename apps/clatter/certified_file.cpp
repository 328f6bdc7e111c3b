#include "certified_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "certificates/certificate_text.hpp"
#include "command_line.hpp"
#include "csv_table.hpp"
#include "outputs/output_summary.hpp"
#include "results/dataset_file.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "sweep/chains.hpp"

namespace clatter::app {
namespace {

bool has(const results::FileSummary& summary, std::string_view name) {
  return std::ranges::find(summary.variables, name, &results::FileSummary::Entry::name) != summary.variables.end();
}

/// The values of the axes of a point, in the user's units, and its machine.
certificates::CertifiedPlace place_of(const sweep::Sweep& sweep, std::size_t point) {
  certificates::CertifiedPlace place{.number = point};
  if (sweep.problem.is_si) place.machine = sweep.problem;
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    place.at.emplace_back(axis.parameter.key(), value);
    if (place.machine) set(*place.machine, axis.parameter, value);
  });
  if (sweep.direction == sweep::Direction::both) place.direction = point < size_one_way(sweep) ? "up" : "down";
  return place;
}

void require_exact(const sweep::Sweep& sweep, const std::string& path) {
  if (sweep.problem.integration.method == stepping::Method::exact) return;
  throw UsageError(storage::quoted_name(path) +
                   " isn't of the exact method, whose results alone are certified; run its configuration with --set "
                   "integrator.method=exact");
}

}  // namespace

CertifiedFile::CertifiedFile(const std::string& path, const std::vector<Place>& where) {
  const results::FileSummary summary = outputs::read_summary(path);
  TableChoice choice{.only = {"status"}, .where = where};
  for (const char* const compared : {"period_ratio", "impact_word"})
    if (has(summary, compared)) choice.only.emplace_back(compared);
  const CsvTable table(summary, path, choice);
  sweep_ = outputs::config_of_output(summary, path).sweep;
  require_exact(sweep_, path);
  results_ = results::read_variables(path, table.variables());
  points_ = table.points(results_);
  const auto* const status = results::values_of<std::uint8_t>(results_, "status");
  if (status == nullptr || status->size() != size(sweep_))
    storage::refuse_reading(path, "is damaged: its points aren't those of its configuration",
                            "run its configuration again");
}

/// Whether a point has the status, the period and the word of the file. A certificate looks for grazes, a run does only
/// if derivatives are asked for.
bool CertifiedFile::is_reproduced(std::size_t point, const certificates::CertifiedPoint& found) const {
  using steady::Status;
  const observables::Observe& observe = sweep_.problem.observe;
  const bool tells_grazes = observe.stability || !observe.sensitivity.empty();
  const auto told = static_cast<Status>((*results::values_of<std::uint8_t>(results_, "status"))[point]);
  const bool is_untold = found.status == Status::grazing && told == Status::periodic && !tells_grazes;
  if (told != found.status && !is_untold) return false;
  const auto* const periods = results::values_of<double>(results_, "period_ratio");
  if (periods != nullptr && (*periods)[point] > 0 && (*periods)[point] != found.periods) return false;
  const auto* const words = results::values_of<std::string>(results_, "impact_word");
  return words == nullptr || observe.word_sticks || (*words)[point].empty() || (*words)[point] == found.word;
}

certificates::Tally CertifiedFile::certify(const std::vector<std::size_t>& points,
                                           const std::function<void(std::string_view line)>& take) const {
  std::vector<bool> is_chosen(size(sweep_), false);
  for (const std::size_t point : points) is_chosen[point] = true;
  certificates::Tally tally;
  point::ThreadScratch scratch;
  const sweep::Chains chains(sweep_);
  for (std::size_t chain = 0; chain < chains.count; ++chain) {
    std::size_t length = chains.length;  // up to the last point that is chosen
    while (length > 0 && !is_chosen[chains.point(chain, length - 1)]) --length;
    std::optional<point::End> end;
    Units units_of_end{};
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t index = chains.point(chain, i);
      point::Problem problem = problem_at(sweep_, index);
      if (sweep_.follow) sweep::start_from(problem, end, units_of_end);
      const certificates::CertifiedPoint found = certificates::certified(problem, scratch);
      end = failed(found.status) ? std::nullopt : std::optional(sweep::end_for_next(problem, found.end));
      units_of_end = problem.units;
      if (!is_chosen[index]) continue;
      if (!is_reproduced(index, found)) {
        tally.add_not_reproduced();
        continue;
      }
      tally.add(found);
      if (found.certificate) take(certificates::certificate_text(*found.certificate, place_of(sweep_, index)));
    }
  }
  return tally;
}

}  // namespace clatter::app
