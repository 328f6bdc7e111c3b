#include "branches/resting_branch.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "branches/measures/measures.hpp"
#include "branches/start/resting.hpp"
#include "branches/walk/rebound_threshold.hpp"

namespace clatter::branches {
namespace {

constexpr double of_threshold = 1e-6;  ///< share of the speed, to which the halving of a step brings an impact

std::ptrdiff_t rests_of(const Orbit& orbit) {
  return std::ranges::count_if(orbit.events, [](const OrbitEvent& event) { return event.rest > 0; });
}

std::ptrdiff_t renewals_of(const Orbit& orbit) {
  return std::ranges::count(orbit.events, Event::Kind::renewal, &OrbitEvent::kind);
}

/// An event that is a letter of its own, or the beginning of a rest, which moves as the last impact of its chatter.
struct Joint {
  Along phase, before;
  double rest;  ///< its length, rad; 0: an impact
};
std::vector<Joint> joints_of(const Orbit& orbit, const Moving& moving) {
  std::vector<Joint> joints;
  auto next = moving.events.begin();
  const std::vector<bool> is_letter = are_letters(orbit);
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& event = orbit.events[i];
    if (event.rest == 0) {
      if (is_letter[i]) joints.push_back({next->phase, next->coordinate, 0});
      ++next;
    } else if (next != moving.events.begin() && std::prev(next)->rests) {
      joints.push_back({event.phase, 0, event.rest});
      joints.back().phase.slope = std::prev(next)->phase.slope;
    }
  }
  return joints;
}

/// Whether a rest doesn't vanish between two values of the parameter. Its length does so as a square root, as the force
/// that presses the mass as the chatter ends does, too: by the tangents of the square.
bool lasts(const Joint& one, const Joint& other, double ahead) {
  const double release = (other.phase.value + other.rest - one.phase.value - one.rest) / ahead;  // nearly its slope
  const double a = one.rest * one.rest, a_slope = 2 * one.rest * (release - one.phase.slope[0]);
  const double b = other.rest * other.rest, b_slope = 2 * other.rest * (release - other.phase.slope[0]);
  if (!(a_slope * ahead < 0 && b_slope * ahead > 0)) return true;
  return a + a_slope * (b - a - b_slope * ahead) / (a_slope - b_slope) > 0;
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
  stop_ = from.orbit.events.back().side, start_ = value_of(from.scene, settings_.along);
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
    const auto [last, good, beyond] = stretch(here, here_orbit, next);
    note_maxima(here, last, here_orbit);
    here_orbit = good, here = last;
    if (beyond) {
      const std::optional<Orbit> other = orbit(*beyond, stop_, here_orbit);
      const bool jumps = is_at_threshold(scene(last), good, of_threshold) ||
                         (other && is_at_threshold(scene(*beyond), *other, of_threshold));
      if (!other || jumps || is_new_contact(good, *other)) return end(last, good, *beyond, other, heading);
      here_orbit = *other, here = *beyond;  // an impact passed another in speed
    }
    record_.add(point(here, here_orbit));
  }
  record_.end(point(here, here_orbit), "range");
}

std::optional<RestingBranch::Sample> RestingBranch::sample(double value, const Orbit& like) const {
  const std::optional<Orbit> there = orbit(value, stop_, like);
  if (!there || letters_of(*there) != letters_of(like)) return std::nullopt;
  return Sample{value, *there, moving_from_release(scene(value), *there, settings_.along)};
}

/// Whether the tangents at two points of a branch lead from one to the other.
bool RestingBranch::are_joined(const Sample& one, const Sample& other) const {
  constexpr double rough = 0.1;  // rad, of the unit of speeds, and of a rest
  const double ahead = other.value - one.value;
  const auto is_smooth = [&](const Along& from, const Along& to, double unit) {
    return !(std::abs(to.value - from.value - ahead * (from.slope[0] + to.slope[0]) / 2) > rough * unit);
  };
  return std::ranges::equal(
      joints_of(one.orbit, one.moving), joints_of(other.orbit, other.moving), [&](const Joint& from, const Joint& to) {
        if (from.rest > 0)
          return is_smooth(from.phase, to.phase, std::min(from.rest, to.rest)) && lasts(from, to, ahead);
        return is_smooth(from.phase, to.phase, 1) && is_smooth(from.before, to.before, speed_unit_);
      });
}

/// Goes on to a value of the parameter, or to where the letters of the motion change: halving finds neighbours, as good
/// as. Beyond a gap the letters may be the same again, but the tangents don't lead there.
RestingBranch::Stretch RestingBranch::stretch(double here, const Orbit& from, double to) const {
  struct Goal {
    double value;
    std::optional<Sample> alike;
  };
  const auto goal = [&](double value) { return Goal{value, sample(value, from)}; };
  Sample good{here, from, moving_from_release(scene(here), from, settings_.along)};
  std::vector<Goal> goals{goal(to)};
  while (!goals.empty()) {
    const Goal& next = goals.back();
    const double middle = good.value + (next.value - good.value) / 2;
    const bool are_neighbours = middle == good.value || middle == next.value;
    if (next.alike && (are_neighbours || are_joined(good, *next.alike)))
      good = *next.alike, goals.pop_back();
    else if (are_neighbours)
      return {good.value, good.orbit, next.value};
    else
      goals.push_back(goal(middle));
  }
  return {good.value, good.orbit, {}};
}

/// Whether a rest is about to vanish, as a square root: it is short, or would have vanished, but for rounding.
bool RestingBranch::has_rest_beside_limit(double value, const Orbit& orbit) const {
  constexpr double is_short = 1e-3, beside = 1e-9;  // rad; of the range
  const Moving moving = moving_from_release(scene(value), orbit, settings_.along);
  return std::ranges::any_of(joints_of(orbit, moving), [&](const Joint& joint) {
    return joint.rest > 0 &&
           (joint.rest < is_short || joint.rest < 2 * beside * width_ * std::abs(joint.phase.slope[0]));
  });
}

/// Whether of two neighbouring motions one has a rest, or an impact without speed, or an interrupted contact, that the
/// other hasn't.
bool RestingBranch::is_new_contact(const Orbit& one, const Orbit& other) const {
  return rests_of(one) != rests_of(other) || renewals_of(one) != renewals_of(other) ||
         std::min(slowest_letter(one), slowest_letter(other)) < 1e-4 * speed_unit_;
}

void RestingBranch::end(double last, const Orbit& good, double beyond, const std::optional<Orbit>& other, int heading) {
  BranchPoint at = point(last, good);
  if (is_at_threshold(at.scene, good, of_threshold) ||
      (other && is_at_threshold(scene(beyond), *other, of_threshold))) {
    record_.add(at), record_.note(SpecialKind::rebound_threshold, at);
    return record_.end(at, std::string(name_of(SpecialKind::rebound_threshold)));
  }
  SpecialKind kind = SpecialKind::chatter_limit;
  // nearby, flights are too short to be told from rest
  const double release = good.events.back().phase + good.events.back().rest;
  if (const auto tangency =
          release_tangency(at.scene, stop_, release, settings_.along, 1e-9 * (std::abs(last) + width_)))
    kind = SpecialKind::release_tangency, at.scene = scene(*tangency);
  else if (other && rests_of(*other) == rests_of(good))
    kind = SpecialKind::graze;
  record_.add(at);
  if (kind == SpecialKind::chatter_limit && !has_rest_beside_limit(last, good) &&
      !(other && has_rest_beside_limit(beyond, *other)))
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
  if (numbers_of<double>(scene(last)).law(stop_).share_at_rest() == 0) wait_without_rest(limit, last, good, heading);
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
  std::erase_if(landings.events, [](const OrbitEvent& event) { return event.rest > 0 && event.rest < 1e-3; });
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
  if (has_loose_mass(problem_.loose)) return true;  // beyond the limit something holds a mass, which isn't followed
  const double distance = record_.way_to(last);
  const auto resting = resting_ahead(last, stop, distance);
  if (resting)
    waiting_.push_back(
        {scene(resting->first), resting->second, {}, {}, generation, 0, record_.branch(), distance > 0 ? -1 : 1});
  return resting.has_value();
}

bool RestingBranch::ends_in_rest(const Equations& builder, const OrbitEquations& walked, const Touch& touch,
                                 double within, std::int64_t generation) {
  if (!touch.appears || touch.halts || touch.event == 0) return false;
  const std::size_t event = touch.event - 1;
  const OrbitEvent &turn = touch.orbit.events[touch.event], &begins = touch.orbit.events[event];
  const bool at_once = turn.side == begins.side && turn.phase - begins.phase < 1e-2;
  if (!at_once || begins.kind != Event::Kind::impact || turn.is_of_wall()) return false;
  const SceneNumbers<double> p = numbers_of<double>(walked.scene_at(touch.beyond.at));
  if (p.law(begins.side).share_at_rest() != 0) return false;
  const OrbitEquations there = builder(walked.shape(), {{Condition::Kind::release, 1, event}});
  const auto exact = solution(there, touch.beyond.at, settings_.tolerance);
  if (!exact || std::abs(exact->back() - touch.beyond.at.back()) > within) return false;
  const BranchPoint last = record_.point(there, {*exact, {}, touch.last_good.arclength});
  record_.add(last);
  const auto [special, is_new] = record_.note(SpecialKind::chatter_limit, last);
  record_.end(last, "chatter limit");
  if (!is_new)
    no_longer_waits(waiting_, special, last.orbit);  // this is the branch that waits there
  else
    wait_beyond(last, begins.side, (touch.beyond.at.back() - exact->back()) * width_, special, generation);
  return true;
}

void RestingBranch::wait_beyond(const BranchPoint& last, Side stop, double ahead, std::size_t special,
                                std::int64_t generation) {
  if (has_loose_mass(problem_.loose)) return;  // a main mass at rest isn't followed
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
