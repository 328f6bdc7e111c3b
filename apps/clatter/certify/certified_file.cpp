#include "certify/certified_file.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "certificates/certificate_text.hpp"
#include "certify/reproduced.hpp"
#include "outputs/output_summary.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "sweep/mirror_images.hpp"
#include "sweep/result_dataset.hpp"
#include "sweep/run.hpp"
#include "tables/csv_table.hpp"
#include "terminal/command_line.hpp"

namespace clatter::app {
namespace {

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

std::vector<std::string> names_of(const std::vector<results::NamedLength>& dimensions) {
  std::vector<std::string> names;
  for (const results::NamedLength& dimension : dimensions) names.push_back(dimension.name);
  return names;
}

double number_of_values(const results::FileSummary::Entry& entry) {
  double values = 1.0;
  for (const results::NamedLength& dimension : entry.dimensions) values *= static_cast<double>(dimension.length);
  return values;
}

/// Whether a point's result depends on which others are run: motions are numbered from one to the next, and one of two
/// mirror images is the other's.
bool depends_on_others(const sweep::Sweep& sweep) {
  return sweep.problem.observe.attractor || sweep::MirrorImages(sweep).exist();
}

}  // namespace

CertifiedFile::CertifiedFile(const std::string& path, const std::vector<Condition>& where)
    : path_(path), summary_(outputs::read_summary(path)) {
  const CsvTable table(summary_, path, {.only = {"status"}, .where = where});
  sweep_ = outputs::config_of_output(summary_, path).sweep;
  require_exact(sweep_, path);
  const results::Dataset status = results::read_variables(path, table.variables());
  points_ = table.points(status);
  if (points_of(dimensions_of_points(summary_, path)) != size(sweep_))
    storage::refuse_reading(path, "is damaged: its points aren't those of its configuration",
                            "run its configuration again");
  for (const auto& [name, value] : summary_.attributes) {
    if (name != sweep::instruction_set_attribute) continue;
    if (const auto arch = lanes::instruction_set_of_bits(value))
      arch_ = *arch;
    else
      lacking_ = value;
  }
}

CertifiedFile::Anew CertifiedFile::run(const sweep::Sweep& sweep, int threads) const {
  std::vector<certificates::KnownResult> known(size(sweep));
  const auto see = [&](std::size_t point, const point::PointResult& result) {
    known[point] = certificates::KnownResult(problem_at(sweep, point), result);
  };
  sweep::RunResult result = sweep::run(sweep, {.threads = threads, .arch = arch_, .see = see});
  const auto status = std::ranges::find(result.dataset.variables, "status", &results::Variable::name);
  std::vector<std::string> dimensions = status->dimensions;
  return {PointRows(std::move(result.dataset), std::move(dimensions), known.size()), std::move(known)};
}

/// The results of some points in the file that a run has, too. To open a file takes longer than to read a few results,
/// but all of a large one at once would take its memory.
PointRows CertifiedFile::stored(const std::vector<std::size_t>& points) const {
  constexpr double most_at_once = 1e6;  // values
  std::vector<std::vector<std::string>> groups;
  double in_group = 0.0;
  for (const results::Variable& variable : sweep::description(sweep_).variables) {
    const results::FileSummary::Entry* const entry = find_variable(summary_, variable.name);
    if (entry == nullptr) continue;
    const double values = number_of_values(*entry);
    if (groups.empty() || in_group + values > most_at_once) groups.emplace_back(), in_group = 0.0;
    groups.back().push_back(variable.name), in_group += values;
  }
  const auto read = [this](const std::vector<std::string>& some) { return results::read_variables(path_, some); };
  return PointRows::chosen(groups, names_of(dimensions_of_points(summary_, path_)), size(sweep_), points, read);
}

certificates::Tally CertifiedFile::certify(const std::vector<std::size_t>& points,
                                           const std::function<void(std::string_view line)>& take) const {
  const PointRows file = stored(points);
  const auto whole = depends_on_others(sweep_) ? std::optional(run(sweep_, 0)) : std::nullopt;
  certificates::Tally tally;
  point::ThreadScratch scratch;
  const auto certify_point = [&](const point::Problem& problem, std::size_t chosen, const Anew& anew, std::size_t ran) {
    certificates::CertifiedPoint found = certificates::certified(problem, anew.known[ran], scratch);
    const std::string_view only = found.certificate ? "" : "status";  // of other results nothing is claimed
    if (found.differs.empty())
      found.differs = difference(anew.rows, ran, file, chosen, found.certificate, only).value_or("");
    tally.add(found);
    if (found.certificate && found.differs.empty())
      take(certificates::certificate_text(*found.certificate, place_of(sweep_, points[chosen])));
  };
  const sweep::Chains chains(sweep_);
  for (std::size_t chain = 0; chain < chains.count; ++chain) {
    std::vector<std::optional<std::size_t>> chosen(chains.length);  // which of `points`, by the place in the chain
    std::size_t length = 0;                                         // up to the last of them
    for (std::size_t i = 0; i < chains.length; ++i) {
      const auto found = std::ranges::lower_bound(points, chains.point(chain, i));
      if (found == points.end() || *found != chains.point(chain, i)) continue;
      chosen[i] = static_cast<std::size_t>(found - points.begin()), length = i + 1;
    }
    if (length == 0) continue;
    const sweep::Sweep alone = chain_alone(sweep_, chains, chain);
    const sweep::Chains chain_of_alone(alone);
    const auto of_chain = whole ? std::nullopt : std::optional(run(alone, 1));
    const Anew& anew = whole ? *whole : *of_chain;
    std::optional<point::End> end;
    Units units_of_end{};
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t ran = whole ? chains.point(chain, i) : chain_of_alone.point(0, i);
      point::Problem problem = problem_at(sweep_, chains.point(chain, i));
      if (sweep_.follow) sweep::start_from(problem, end, units_of_end);
      if (chosen[i]) certify_point(problem, *chosen[i], anew, ran);
      const certificates::KnownResult& known = anew.known[ran];
      end = failed(known.status) ? std::nullopt : std::optional(sweep::end_for_next(problem, known.end));
      units_of_end = problem.units;
    }
  }
  return tally;
}

}  // namespace clatter::app
