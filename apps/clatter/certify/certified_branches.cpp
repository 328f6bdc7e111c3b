#include "certify/certified_branches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "branches/branch_dataset.hpp"
#include "branches/curve.hpp"
#include "branches/measures/measures.hpp"
#include "certificates/certified_branch.hpp"
#include "certificates/sample.hpp"
#include "certify/reproduced.hpp"
#include "outputs/output_summary.hpp"
#include "storage/input_file.hpp"
#include "tables/file_points.hpp"
#include "terminal/command_line.hpp"

namespace clatter::app {
namespace {

std::vector<std::size_t> chosen(std::size_t count, const std::optional<std::size_t>& sample) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return sample ? certificates::spread(all, *sample) : all;
}

/// The points of a curve are special points of its kind, each with the same graze.
std::vector<branches::SpecialPoint> specials_of(const branches::Branches& found,
                                                const branches::BranchSettings& settings) {
  std::vector<branches::SpecialPoint> specials;
  for (const branches::BranchPoint& point : found.points) {
    branches::SpecialPoint special{branches::SpecialKind::graze, point, {point.branch}, {}};
    for (const auto kind : {branches::SpecialKind::fold, branches::SpecialKind::flip,
                            branches::SpecialKind::symmetry_breaking, branches::SpecialKind::graze})
      if (name_of(kind) == settings.curve) special.kind = kind;
    const auto grazing = std::ranges::find(point.orbit.events, 0.0, &branches::OrbitEvent::before);
    if (special.kind == branches::SpecialKind::graze && grazing != point.orbit.events.end())
      special.condition = {.kind = branches::Condition::Kind::graze,
                           .event = static_cast<std::size_t>(grazing - point.orbit.events.begin())};
    specials.push_back(special);
  }
  return specials;
}

/// The length of a dimension in a file, 0 if it has none of this name.
std::size_t length_of(const results::FileSummary& summary, std::string_view dimension) {
  for (const auto& entry : summary.variables)
    for (const results::NamedLength& own : entry.dimensions)
      if (own.name == dimension) return own.length;
  return 0;
}

/// A branch ends at one of these, whose own claim says it.
constexpr std::array claimed_as_special{branches::SpecialKind::graze};
/// The motions of both sides meet at these, but have different multipliers, and different words if a rest begins.
constexpr std::array of_two_sides{branches::SpecialKind::chatter_limit, branches::SpecialKind::crossing_sliding,
                                  branches::SpecialKind::grazing_sliding, branches::SpecialKind::switching_sliding};
void drop_one_side(certificates::ClaimedPeriod& period) { period.multipliers.reset(), period.word.reset(); }

/// Whether a run from the start of an orbit comes back to it, since it doesn't stretch rounding much: if it doesn't,
/// the orbit is no motion.
bool must_return(const branches::BranchPoint& point) {
  return std::hypot(point.multiplier_re[0], point.multiplier_im[0]) < 1e4;
}

}  // namespace

CertifiedBranches::CertifiedBranches(const std::string& path) {
  const results::FileSummary summary = outputs::read_summary(path);
  const config::Config config = outputs::config_of_output(summary, path);
  if (!config.branch)
    storage::refuse_reading(path, "has no [branch] in its configuration", "follow its configuration again");
  sweep_ = config.sweep, settings_ = *config.branch, start_.emplace(sweep_.problem);
  try {
    found_ =
        settings_.across ? branches::follow_curves(*start_, settings_) : branches::follow_branches(*start_, settings_);
  } catch (const branches::StartError& error) {
    storage::refuse_reading(path, std::string("can't be followed anew: ") + error.what(),
                            "follow its configuration again");
  }
  compare_with(path, summary);
}

/// The rows of points, and those of special points.
void CertifiedBranches::compare_with(const std::string& path, const results::FileSummary& summary) {
  results::Dataset dataset = branches::branch_dataset(found_, settings_, start_->units, has_loose_mass(start_->loose));
  std::vector<std::string> names;
  for (const results::Variable& variable : dataset.variables)
    if (find_variable(summary, variable.name) != nullptr) names.push_back(variable.name);
  const results::Dataset stored = results::read_variables(path, names);
  const auto rows = [&](std::string_view dimension, std::size_t followed) {
    const std::size_t length = length_of(summary, dimension);
    const std::vector<std::string> along{std::string(dimension)};
    return Compared{PointRows(dataset, along, followed), PointRows(stored, along, length)};
  };
  points_ = rows(branch_points, found_.points.size());
  special_ = rows(special_points, found_.special.size());
}

bool CertifiedBranches::is_at(const branches::BranchPoint& point, std::span<const branches::SpecialKind> kinds) const {
  const double value = value_of(point.scene, settings_.along);
  return std::ranges::any_of(found_.special, [&](const branches::SpecialPoint& special) {
    return std::ranges::count(kinds, special.kind) > 0 &&
           std::abs(value_of(special.at.scene, settings_.along) - value) <= 1e-12 * std::abs(value) &&
           std::ranges::count(special.branches, point.branch) > 0;
  });
}

certificates::CertifiedPlace CertifiedBranches::place_of(std::size_t number, const branches::BranchPoint& point) const {
  certificates::CertifiedPlace place{.number = number, .branch = point.branch};
  if (sweep_.problem.is_si) place.machine = point.scene.given;
  const auto add = [&](Parameter parameter) {
    place.at.emplace_back(parameter.key(), value_of(point.scene, parameter));
  };
  add(settings_.along);
  if (settings_.across) add(*settings_.across);
  return place;
}

certificates::Tally CertifiedBranches::certify(const std::optional<std::size_t>& sample,
                                               const std::function<void(std::string_view line)>& take) const {
  certificates::Tally tally;
  const auto add = [&](certificates::CertifiedPoint found, const Compared& compared, std::size_t number,
                       const branches::BranchPoint& at) {
    const auto differing = difference(compared.followed, number, compared.stored, number, found.certificate);
    if (differing) found.differs = *differing;
    tally.add(found);
    if (found.certificate && found.differs.empty())
      take(certificates::certificate_text(*found.certificate, place_of(number, at)));
  };
  const auto curve = settings_.across ? specials_of(found_, settings_) : std::vector<branches::SpecialPoint>{};
  for (const std::size_t i : chosen(found_.points.size(), sample)) {
    const branches::BranchPoint& point = found_.points[i];
    if (!settings_.across && is_at(point, claimed_as_special))
      add({.status = steady::Status::grazing, .without = certificates::Without::graze}, *points_, i, point);
    else if (settings_.across)
      add(certificates::certified(curve[i], settings_.along, *start_), *points_, i, point);
    else {
      certificates::CertifiedPoint found = certificates::certified(point, *start_);
      if (found.without == certificates::Without::rounding && must_return(point)) found.differs = "x";
      if (found.certificate && is_at(point, of_two_sides)) drop_one_side(*found.certificate->period);
      add(std::move(found), *points_, i, point);
    }
  }
  for (const std::size_t i : chosen(found_.special.size(), sample)) {
    const branches::SpecialPoint& special = found_.special[i];
    add(certificates::certified(special, settings_.along, *start_), *special_, i, special.at);
  }
  return tally;
}

}  // namespace clatter::app
