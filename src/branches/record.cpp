#include "branches/record.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "branches/measures/measures.hpp"

namespace clatter::branches {
namespace {

bool meet(const std::vector<attractors::SectionState>& one, const std::vector<attractors::SectionState>& other,
          double within) {
  return std::ranges::any_of(one, [&](const attractors::SectionState& a) {
    return std::ranges::any_of(other, [&](const attractors::SectionState& b) {
      const attractors::SectionState off = difference(a, b);
      return std::hypot(std::hypot(off.x, off.v), std::hypot(off.z, off.w)) <= within;
    });
  });
}

/// Whether two motions of scenes that differ by rounding are one, which may begin some forcing periods later, or mirror
/// images of each other, which have the same numbers: they have a state in common when the phase of the force is 0, or
/// another one, where no impact is near.
bool is_same_motion(const BranchPoint& one, const BranchPoint& other, double within) {
  const bool has_images = is_symmetric(one.scene);
  return std::ranges::any_of(std::array{0.0, 2.0}, [&](double phase) {
    const std::vector<attractors::SectionState> states = states_at_phase(other.scene, other.orbit, phase);
    return meet(states_at_phase(one.scene, one.orbit, phase), states, within) ||
           (has_images && meet(states_at_phase(one.scene, one.orbit.mirror_image(), phase), states, within));
  });
}

}  // namespace

std::optional<Birth> birth_at(SpecialKind kind) {
  switch (kind) {
    case SpecialKind::symmetry_breaking:
      return Birth::symmetry;
    case SpecialKind::flip:
      return Birth::flip;
    case SpecialKind::graze:
      return Birth::graze;
    default:
      return std::nullopt;
  }
}

void Record::begin(double speed_unit) {
  branch_ = found_.ends.empty() ? 0 : found_.ends.back().branch + 1;
  first_point_ = found_.points.size(), first_special_ = specials();
  speed_unit_ = speed_unit;
}

BranchPoint Record::point(const OrbitEquations& equations, const CurvePoint& at) const {
  BranchPoint out{branch_, at.arclength, equations.scene_at(at.at), equations.orbit_at(at.at), false, {}, {}};
  const auto grazing = equations.grazing();  // the multipliers are those without the impact that has no speed
  const bool is_nothing = grazing && out.orbit.changes_nothing(*grazing);
  if (is_nothing && out.orbit.events[*grazing].kind == Event::Kind::separation && equations.grazes_outside())
    out.orbit.events[*grazing].before = 0;
  const Multipliers of = multipliers(out.scene, is_nothing ? out.orbit.without(*grazing) : out.orbit);
  out.stable = of.stable, out.multiplier_re = of.re, out.multiplier_im = of.im;
  return out;
}

std::size_t Record::number_of(SpecialKind kind, const BranchPoint& at) const {
  const auto known = std::ranges::find_if(found_.special, [&](const SpecialPoint& special) {
    if (special.kind != kind) return false;
    for (const auto& [parameter, unit] : axes_)
      if (std::abs(value_of(special.at.scene, parameter) - value_of(at.scene, parameter)) > 1e-8 * unit) return false;
    return is_same_motion(special.at, at, 1e-5 * speed_unit_);
  });
  return static_cast<std::size_t>(known - found_.special.begin());
}

Record::Noted Record::note(SpecialKind kind, BranchPoint at, const Condition& condition) {
  const std::size_t number = number_of(kind, at);
  const bool is_new = number == specials();
  at.branch = branch_;
  if (is_new) found_.special.push_back({kind, std::move(at), {}, condition});
  meet(number, branch_);
  return {number, is_new};
}

bool Record::grazes_at(std::size_t special) const {
  const SpecialPoint& at = found_.special[special];
  const Parameter parameter = axes_[0].parameter;
  const double near = 1e-12 * axes_[0].unit;
  return std::ranges::any_of(found_.special, [&](const SpecialPoint& other) {
    return other.kind == SpecialKind::graze && std::ranges::count(other.branches, at.branches.front()) > 0 &&
           std::abs(value_of(other.at.scene, parameter) - value_of(at.at.scene, parameter)) <= near;
  });
}

bool Record::is_met_by(std::size_t special, const Orbit& orbit) const {
  const std::vector<std::size_t>& meeting = found_.special[special].branches;
  const std::string word = orbit.word(), image = orbit.mirror_image().word();
  return std::ranges::any_of(found_.points, [&](const BranchPoint& point) {
    const bool meets = std::ranges::find(meeting, point.branch) != meeting.end();
    if (!meets || point.orbit.half_turns != orbit.half_turns) return false;
    const std::string its = point.orbit.word();
    return its == word || its == image;
  });
}

void Record::meet(std::size_t special, std::size_t branch) {
  std::vector<std::size_t>& meeting = found_.special[special].branches;
  if (std::ranges::find(meeting, branch) == meeting.end()) meeting.push_back(branch);
}

void Record::end(const BranchPoint& last, std::string reason, bool failed) {
  found_.ends.push_back({branch_, last.scene, std::move(reason), failed, axes_.size() > 1});
}

double Record::way_to(const BranchPoint& last) const {
  const auto first = std::ranges::find(found_.points, branch_, &BranchPoint::branch);
  return value_of(last.scene, axes_[0].parameter) - value_of(first->scene, axes_[0].parameter);
}

bool Record::is_of_cascade(const BranchPoint& last, double within) const {
  const double way = way_to(last);
  return last.orbit.size() >= 8 && way != 0 && std::abs(way) <= within * axes_[0].unit;
}

std::optional<std::size_t> Record::branch_of(const std::string& word, double value) const {
  for (std::size_t i = 0; i + 1 < found_.points.size(); ++i) {
    const BranchPoint &one = found_.points[i], &other = found_.points[i + 1];
    if (one.branch != other.branch || one.orbit.word() != word || other.orbit.word() != word) continue;
    const double a = value_of(one.scene, axes_[0].parameter), b = value_of(other.scene, axes_[0].parameter);
    if (value >= std::min(a, b) && value <= std::max(a, b)) return one.branch;
  }
  return std::nullopt;
}

Branches Record::take() {
  for (SpecialPoint& special : found_.special) {
    const std::optional<Birth> birth = birth_at(special.kind);
    special.left_out = special.left_out && birth && special.branches.size() < 2;
    if (special.left_out) ++found_.left_out[static_cast<std::size_t>(*birth)];
  }
  return std::move(found_);
}

void Record::turn_round() {
  kept_for_start_ = 0;
  std::reverse(found_.points.begin() + static_cast<std::ptrdiff_t>(first_point_), found_.points.end());
  for (std::size_t i = first_point_; i < found_.points.size(); ++i) found_.points[i].arclength *= -1;
  for (std::size_t i = first_special_; i < specials(); ++i) found_.special[i].at.arclength *= -1;
}

}  // namespace clatter::branches
