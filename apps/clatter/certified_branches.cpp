#include "certified_branches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "branches/curve.hpp"
#include "branches/measures/measures.hpp"
#include "certificates/certified_branch.hpp"
#include "certificates/sample.hpp"
#include "command_line.hpp"
#include "outputs/output_summary.hpp"
#include "storage/input_file.hpp"

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
    const auto grazing = std::ranges::find(point.orbit.impacts, 0.0, &branches::OrbitImpact::before);
    if (special.kind == branches::SpecialKind::graze && grazing != point.orbit.impacts.end())
      special.condition = {.kind = branches::Condition::Kind::graze,
                           .impact = static_cast<std::size_t>(grazing - point.orbit.impacts.begin())};
    specials.push_back(special);
  }
  return specials;
}

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
  const std::string name(settings_.along.key());
  results_ = results::read_variables(path, {name, "x", "v", "special_" + name, "special_x", "special_v"});
  try {
    found_ =
        settings_.across ? branches::follow_curves(*start_, settings_) : branches::follow_branches(*start_, settings_);
  } catch (const branches::StartError& error) {
    storage::refuse_reading(path, std::string("can't be followed anew: ") + error.what(),
                            "follow its configuration again");
  }
}

bool CertifiedBranches::is_reproduced(const std::string& prefix, std::size_t number,
                                      const branches::BranchPoint& point) const {
  constexpr double same = 1e-9;
  const PhasePoint state = branches::state_at_phase_zero(point.scene, point.orbit);
  const double velocity = factor_of(start_->units, Quantity::velocity);
  const double parameter = value_of(point.scene, settings_.along);
  const double size = std::abs(velocity * state.v) + std::abs(state.x) + std::abs(parameter);
  for (const auto& [name, value] : {std::pair<std::string, double>{settings_.along.key(), parameter},
                                    {"x", factor_of(start_->units, Quantity::length) * state.x},
                                    {"v", velocity * state.v}}) {
    const auto* const told = results::values_of<double>(results_, prefix + name);
    if (told == nullptr || number >= told->size() || !(std::abs((*told)[number] - value) <= same * size)) return false;
  }
  return true;
}

bool CertifiedBranches::is_graze(const branches::BranchPoint& point) const {
  const double value = value_of(point.scene, settings_.along);
  return std::ranges::any_of(found_.special, [&](const branches::SpecialPoint& special) {
    return special.kind == branches::SpecialKind::graze &&
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
  const auto add = [&](const certificates::CertifiedPoint& found, bool is_reproduced, std::size_t number,
                       const branches::BranchPoint& at) {
    if (!is_reproduced) return tally.add_not_reproduced();
    tally.add(found);
    if (found.certificate) take(certificates::certificate_text(*found.certificate, place_of(number, at)));
  };
  const auto curve = settings_.across ? specials_of(found_, settings_) : std::vector<branches::SpecialPoint>{};
  for (const std::size_t i : chosen(found_.points.size(), sample)) {
    const branches::BranchPoint& point = found_.points[i];
    if (!settings_.across && is_graze(point))
      add({.status = steady::Status::grazing, .without = certificates::Without::graze}, true, i, point);
    else if (settings_.across)
      add(certificates::certified(curve[i], settings_.along, *start_), is_reproduced("", i, point), i, point);
    else {
      const certificates::CertifiedPoint found = certificates::certified(point, *start_);
      const bool returns = found.without != certificates::Without::rounding || !must_return(point);
      add(found, returns && is_reproduced("", i, point), i, point);
    }
  }
  for (const std::size_t i : chosen(found_.special.size(), sample)) {
    const branches::SpecialPoint& special = found_.special[i];
    add(certificates::certified(special, settings_.along, *start_), is_reproduced("special_", i, special.at), i,
        special.at);
  }
  return tally;
}

}  // namespace clatter::app
