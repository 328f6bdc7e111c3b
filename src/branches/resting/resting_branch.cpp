#include "branches/resting/resting_branch.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/resting/resting.hpp"

namespace clatter::branches {
namespace {

std::ptrdiff_t rests_of(const Orbit& orbit) {
  return std::ranges::count_if(orbit.impacts, [](const OrbitImpact& impact) { return impact.rest > 0; });
}

std::ptrdiff_t renewals_of(const Orbit& orbit) {
  return std::ranges::count(orbit.impacts, EventKind::renewal, &OrbitImpact::event);
}

double shortest_rest(const Orbit& orbit) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const OrbitImpact& impact : orbit.impacts)
    if (impact.rest > 0) shortest = std::min(shortest, impact.rest);
  return shortest;
}

}  // namespace

RestingBranch::RestingBranch(const StartProblem& problem, const BranchSettings& settings, bool symmetric,
                             double speed_unit, Record& record, std::deque<Waiting>& waiting)
    : problem_(problem),
      settings_(settings),
      symmetric_(symmetric),
      width_(settings.range[1] - settings.range[0]),
      speed_unit_(speed_unit),
      record_(record),
      waiting_(waiting) {}

void RestingBranch::follow(const Waiting& from) {
  stop_ = from.orbit.impacts.back().side, start_ = value_of(from.scene, settings_.along);
  generation_ = from.generation, cascade_side_ = from.cascade_side;
  if (from.cascade)
    if (const auto known = record_.branch_of(from.orbit.word(), start_)) return join(*known, from);
  if (from.special) record_.meet(*from.special, record_.branch());
  if (from.heading != 0) {
    record_.add(point(start_, from.orbit));
    return walk(from.orbit, from.heading);
  }
  record_.walk_back();
  walk(from.orbit, -1);
  record_.turn_round();
  record_.add(point(start_, from.orbit));
  if (!record_.is_full()) walk(from.orbit, 1);
  if (from.cascade) join(record_.branch(), from);
}

/// A cascade that came near a branch ends in that of its chatter limits which is nearest.
void RestingBranch::join(std::size_t branch, const Waiting& cascade) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  const std::vector<SpecialPoint>& special = record_.found().special;
  for (std::size_t i = 0; i < special.size(); ++i) {
    if (special[i].kind != SpecialKind::chatter_limit || !std::ranges::count(special[i].branches, branch)) continue;
    const double distance =
        std::abs(value_of(special[i].at.scene, settings_.along) - value_of(cascade.scene, settings_.along));
    if (distance < least) least = distance, nearest = i;
  }
  if (nearest) record_.meet(*nearest, *cascade.cascade);
}

std::optional<Orbit> RestingBranch::orbit(double value, Side stop, const Orbit& like) const {
  return resting_orbit(with_scene(problem_, scene(value)), stop, like.half_turns / 2);
}

BranchPoint RestingBranch::point(double value, const Orbit& orbit) const {
  const double arclength = std::abs(value - start_) / width_;
  return {record_.branch(), arclength, scene(value), half_of_resting(orbit, symmetric_), true, {}, {}};
}

void RestingBranch::walk(Orbit here_orbit, int heading) {
  const double bound = settings_.range[heading > 0 ? 1 : 0];
  // short steps, as all that happens within one unseen is that an impact comes and goes
  const double step = heading * settings_.largest_step / 4 * width_;
  double here = start_;
  while (here != bound) {
    if (record_.is_full()) return record_.fail(point(here, here_orbit), max_points_spent);
    const double next = heading * (bound - here) < heading * step ? bound : here + step;
    const std::optional<Orbit> there = orbit(next, stop_, here_orbit);
    if (!there || letters_of(*there) != letters_of(here_orbit)) {
      const auto [last, beyond] = change_between(here, next, here_orbit);
      const std::optional<Orbit> good = orbit(last, stop_, here_orbit), other = orbit(beyond, stop_, here_orbit);
      note_maxima(here, last, here_orbit);
      if (!other || is_new_contact(*good, *other)) return end(last, *good, beyond, other, heading);
      here_orbit = *other, here = beyond;  // an impact passed another in speed
    } else {
      note_maxima(here, next, here_orbit);
      here_orbit = *there, here = next;
    }
    record_.add(point(here, here_orbit));
  }
  record_.end(point(here, here_orbit), "range");
}

/// Neighbours, as good as, between which the letters of the motion change: the last value with those of `like`, and the
/// next one.
std::pair<double, double> RestingBranch::change_between(double good, double bad, const Orbit& like) const {
  const std::string letters = letters_of(like);
  for (;;) {
    const double middle = good + (bad - good) / 2;
    if (middle == good || middle == bad) return {good, bad};
    const std::optional<Orbit> there = orbit(middle, stop_, like);
    (there && letters_of(*there) == letters ? good : bad) = middle;
  }
}

/// Whether of two neighbouring motions one has a rest, or an impact without speed, or an interrupted contact, that the
/// other hasn't.
bool RestingBranch::is_new_contact(const Orbit& one, const Orbit& other) const {
  return rests_of(one) != rests_of(other) || renewals_of(one) != renewals_of(other) ||
         std::min(slowest_letter(one), slowest_letter(other)) < 1e-4 * speed_unit_;
}

void RestingBranch::end(double last, const Orbit& good, double beyond, const std::optional<Orbit>& other, int heading) {
  BranchPoint at = point(last, good);
  SpecialKind kind = SpecialKind::chatter_limit;
  // nearby, flights are too short to be told from rest
  if (const auto tangency = release_tangency(at.scene, stop_, settings_.along, 1e-9 * (std::abs(last) + width_)))
    kind = SpecialKind::release_tangency, at.scene = scene(*tangency);
  else if (other && rests_of(*other) == rests_of(good))
    kind = SpecialKind::graze;
  record_.add(at);
  if (kind == SpecialKind::chatter_limit && std::min(shortest_rest(good), other ? shortest_rest(*other) : 1) > 1e-3)
    return record_.fail(at, "its impacts change at no special point; begin beyond");
  if (kind == SpecialKind::graze && waits_beyond(at, stop_, generation_)) return record_.end(at, "chatter limit");
  const auto [special, is_new] = record_.note(kind, at);
  record_.end(at, std::string(name_of(kind)));
  if (!is_new) return no_longer_waits(waiting_, special, good);  // this is the branch that waits there
  if (kind == SpecialKind::graze) waiting_.push_back({scene(beyond), *other, {}, special, generation_, heading});
  if (kind == SpecialKind::chatter_limit && heading != cascade_side_)
    go_on_beyond(special, last, good, beyond, other, heading);
}

/// Where a rest begins or vanishes, there may be another one in each period. On the side of fewer rests, grazes
/// accumulate near the limit: the branch is followed from a little further on.
void RestingBranch::go_on_beyond(std::size_t limit, double last, const Orbit& good, double beyond,
                                 const std::optional<Orbit>& other, int heading) {
  if (other && rests_of(*other) > rests_of(good))
    return waiting_.push_back({scene(beyond), *other, {}, limit, generation_, heading});
  if (numbers_of<double>(scene(last)).restitution(stop_) == 0) wait_without_rest(limit, last, good, heading);
  const double value = last + heading * 1e-5 * width_;
  if (value < settings_.range[0] || value > settings_.range[1]) return;
  for (const Side stop : {Side::lower, Side::upper})
    if (const auto resting = orbit(value, stop, good))
      return waiting_.push_back({scene(value), *resting, {}, limit, generation_});
}

/// Without restitution, a rest that vanishes leaves its landing as an impact; if it was the only one, or so are all of
/// them, motion without rest begins.
void RestingBranch::wait_without_rest(std::size_t limit, double last, const Orbit& good, int heading) {
  Orbit landings = good;
  std::erase_if(landings.impacts, [](const OrbitImpact& impact) { return impact.rest > 0 && impact.rest < 1e-3; });
  if (landings.rests()) return;
  waiting_.push_back({scene(last), landings.half_if_same(1e-6, symmetric_), {}, limit, generation_, heading});
}

/// Largest speeds and losses between two values of the parameter.
void RestingBranch::note_maxima(double here, double next, const Orbit& like) {
  const auto look = [&](SpecialKind kind, Along (*measure)(const Moving&)) {
    const auto slope = [&](double value) {
      const std::optional<Orbit> there = orbit(value, stop_, like);
      return there ? measure(moving_from_release(scene(value), *there, settings_.along)).slope[0] : 0.0;
    };
    const double low = std::min(here, next), high = std::max(here, next), first = slope(low), last = slope(high);
    if (!(first > 0 && last < 0)) return;
    std::uintmax_t most = 60;
    const auto bracket = boost::math::tools::toms748_solve(
        slope, low, high, first, last, [](double x, double y) { return std::abs(x - y) <= 4e-16 * std::abs(x); }, most);
    const double value = bracket.first + (bracket.second - bracket.first) / 2;
    if (const auto there = orbit(value, stop_, like)) record_.note(kind, point(value, *there));
  };
  look(SpecialKind::impact_speed, impact_speed);
  if (problem_.observe.energy) look(SpecialKind::impact_power, impact_power);
}

bool RestingBranch::waits_beyond(const BranchPoint& last, Side stop, std::int64_t generation) {
  if (!record_.is_of_cascade(last)) return false;
  if (has_loose_mass(problem_.loose)) return true;  // beyond the limit a wall presses it, which isn't followed
  const double distance = record_.way_to(last);
  const auto resting = resting_ahead(last, stop, distance);
  if (resting)
    waiting_.push_back(
        {scene(resting->first), resting->second, {}, {}, generation, 0, record_.branch(), distance > 0 ? -1 : 1});
  return resting.has_value();
}

void RestingBranch::wait_beyond(const BranchPoint& last, Side stop, double ahead, std::size_t special,
                                std::int64_t generation) {
  if (const auto resting = resting_ahead(last, stop, ahead))
    waiting_.push_back({scene(resting->first), resting->second, {}, special, generation, ahead > 0 ? 1 : -1});
}

std::optional<std::pair<double, Orbit>> RestingBranch::resting_ahead(const BranchPoint& last, Side stop,
                                                                     double ahead) const {
  const Orbit whole = last.orbit.whole();
  const double end = value_of(last.scene, settings_.along);
  for (; ahead != 0 && std::abs(ahead) < 0.01 * width_; ahead *= 2) {
    const double value = end + ahead;
    if (value < settings_.range[0] || value > settings_.range[1]) return std::nullopt;
    auto resting = orbit(value, stop, whole);
    if (resting && rests_of(*resting) > rests_of(whole)) return std::pair(value, std::move(*resting));
  }
  return std::nullopt;
}

}  // namespace clatter::branches
