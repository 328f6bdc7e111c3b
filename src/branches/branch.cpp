#include "branches/branch.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

#include "branches/halt_end.hpp"
#include "branches/resting_branch.hpp"
#include "branches/simultaneous_end.hpp"
#include "branches/start/start.hpp"
#include "branches/walk/halves.hpp"
#include "branches/walk/rebound_threshold.hpp"
#include "branches/walk/special_points.hpp"
#include "branches/walk/violation.hpp"

namespace clatter::branches {
namespace {

constexpr std::string_view closed_curve = "closed", no_step_off = "no step leads off its special point";

/// Everything about following one branch after the other.
class Follower {
 public:
  Follower(const StartProblem& problem, const BranchSettings& settings)
      : problem_(damped_by(problem, settings.along)),
        settings_(settings),
        width_(settings.range[1] - settings.range[0]),
        symmetric_(is_symmetric(problem) && keeps_symmetry(problem_, settings.along) &&
                   (!settings.across || keeps_symmetry(problem_, *settings.across))),
        record_({{settings.along, width_}}, settings.max_points) {}

  Branches run() {
    require_start_in_range(problem_, settings_.along, settings_.range, "along");
    waiting_.push_back({problem_, start_orbit(problem_, settings_.period, symmetric_)});
    while (!waiting_.empty() && !record_.is_full()) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      const bool is_born_soft = next.direction && next.orbit.meets_soft_stop();
      if (!is_born_soft || !record_.grazes_at(*next.special)) follow(next);
    }
    if (!waiting_.empty() && record_.found().ends.back().reason != max_points_spent)
      record_.fail(record_.found().points.back(), max_points_spent);
    for (const Waiting& one : waiting_)
      if (one.special) record_.leave_out(*one.special);
    return record_.take();
  }

 private:
  [[nodiscard]] OrbitEquations equations_for(const Orbit& orbit, std::vector<Condition> conditions = {}) const {
    return {problem_, orbit, {{settings_.along, width_}}, speed_unit_, std::move(conditions)};
  }
  [[nodiscard]] Equations any_equations() const { return std::bind_front(&Follower::equations_for, this); }
  [[nodiscard]] RestingBranch resting() { return {problem_, settings_, symmetric_, speed_unit_, record_, waiting_}; }
  [[nodiscard]] double parameter(const FollowedScene& scene) const { return value_of(scene, settings_.along); }
  /// How far, over the width of the range, the exact end of a branch may lie from that which bisection found.
  [[nodiscard]] double near(double step) const { return std::max(step / 10, 1e-3 * settings_.largest_step); }
  [[nodiscard]] bool in_range(double value) const { return value >= settings_.range[0] && value <= settings_.range[1]; }

  void follow(const Waiting& from) {
    speed_unit_ = speed_scale(from.scene, from.orbit);
    record_.begin(speed_unit_);
    generation_ = from.generation, turns_at_.clear();
    if (from.orbit.rests()) return resting().follow(from);
    if (from.begins_across()) turns_at_.push_back(parameter(from.scene) / width_);
    if (from.opens) return follow_opened(from);
    const OrbitEquations equations = equations_for(from.orbit);
    CurvePoint start{equations.unknowns_of(from.scene, from.orbit), {}, 0.0};
    if (from.special && !from.passes) {
      const auto first = first_step(equations, start, from, settings_.tolerance);
      if (!first) return record_.fail(record_.point(equations, start), no_step_off);
      if (is_left_out(from, *first)) return record_.leave_out(*from.special);
      record_.meet(*from.special, record_.branch());
      start.tangent = *first;
      record_.add(record_.point(equations, start));
      return walk(equations, start, from.special);
    }
    if (!from.special) return walk_both_ways(equations, start_near(equations, start.at, settings_.tolerance));
    // the motion that another branch was born on
    const auto begun = point_near(equations, start.at, settings_.tolerance);
    if (!begun || violation(equations, begun->at)) return record_.fail(record_.point(equations, start), no_step_off);
    record_.meet(*from.special, record_.branch());
    walk_both_ways(equations, *begun);
  }

  void walk_both_ways(const OrbitEquations& equations, const CurvePoint& start) {
    CurvePoint back = start;
    for (double& x : back.tangent) x = -x;
    record_.walk_back();
    walk(equations, back, {});
    const bool closed = record_.found().ends.back().reason == closed_curve;
    record_.turn_round();
    record_.add(record_.point(equations, start));
    if (!closed && !record_.is_full()) walk(equations, start, {});
  }

  /// A branch with one contact with a soft stop, or interruption of one, or slip to a stick, more than its origin.
  void follow_opened(const Waiting& from) {
    const auto begun = opened(any_equations(), from.scene, from.orbit, *from.opens, settings_.tolerance);
    const OrbitEquations equations = equations_for(begun ? begun->orbit : from.orbit);
    if (!begun)
      return record_.fail(record_.point(equations, {equations.unknowns_of(from.scene, from.orbit), {}, 0.0}),
                          no_step_off);
    if (is_left_out(from, begun->tangent)) return record_.leave_out(*from.special);
    const CurvePoint start{begun->at, begun->tangent, 0.0};
    record_.meet(*from.special, record_.branch());
    record_.add(record_.point(equations, start));
    walk(equations, start, from.special);
  }

  /// Whether a branch that begins in a direction is born in a graze, on the side from which another one came, and such
  /// births aren't followed.
  [[nodiscard]] bool is_left_out(const Waiting& from, const Vector& direction) const {
    return from.came * direction.back() < 0 && !settings_.follows(Birth::graze);
  }
  /// Leaves out what is born at a flip or a loss of symmetry, unless it is followed. Returns whether it does.
  bool leaves_out(SpecialKind kind, std::size_t special) {
    if (generation_ < settings_.generations && settings_.follows(birth_at(kind).value())) return false;
    return record_.leave_out(special), true;
  }

  void walk(const OrbitEquations& equations, const CurvePoint& start, std::optional<std::size_t> from,
            std::optional<double> largest_step = {}) {
    Walk walk(equations, start, {settings_.tolerance, largest_step.value_or(settings_.largest_step)});
    BranchPoint last = record_.point(equations, start);
    if (leaves_range(start, settings_)) return record_.end(last, "range");
    for (;;) {
      if (record_.is_full()) return record_.fail(last, max_points_spent);
      const auto next = walk.next();
      if (!next) return end_without_step(equations, last, walk.here());
      const double step = next->arclength - walk.here().arclength;
      if (!in_range(parameter(equations.scene_at(next->at)))) return end_of_range(equations, walk, step, from);
      if (violation(equations, next->at)) return end_in_graze(equations, walk, step, from);
      const bool born = special_between(equations, walk, step, from);
      if (born) return record_.end(last, "born");
      if (!from && walk.passes(start, *next)) {
        CurvePoint closing = start;
        closing.arclength = next->arclength;
        last = record_.point(equations, closing);
        return record_.add(last), record_.end(last, std::string(closed_curve));
      }
      walk.move_to(*next);
      last = record_.point(equations, *next);
      record_.add(last);
      from.reset();
    }
  }

  void end_of_range(const OrbitEquations& equations, const Walk& walk, double step,
                    const std::optional<std::size_t>& from) {
    for (const double bound : settings_.range) {
      auto zero = walk.zero([&](const CurvePoint& p) { return p.at.back() * width_ - bound; }, step);
      if (!zero) continue;
      zero->at.back() = bound / width_;  // R = 0 less a rounding would be no impact
      const double length = zero->arclength - walk.here().arclength;
      if (violation(equations, zero->at)) return end_in_graze(equations, walk, length, from);
      if (special_between(equations, walk, length, from)) return record_.end(record_.point(equations, *zero), "born");
      const BranchPoint last = record_.point(equations, *zero);
      return record_.add(last), record_.end(last, "range");
    }
    record_.fail(record_.point(equations, walk.here()), no_step);
  }

  /// Special points within a step, which may end in a graze. Returns whether the branch is born in one, and ends.
  bool special_between(const OrbitEquations& equations, const Walk& walk, double step,
                       const std::optional<std::size_t>& from, bool grazes = false) {
    std::vector<FoundPoint> found = special_points_within(
        equations, walk, step, {from.has_value(), from && !turns_at_.empty(), grazes}, problem_.observe);
    const auto met = from ? std::nullopt : halves_met(equations, walk, step, symmetric_);
    const bool born = met && note_birth(equations, *met, step);
    if (born) turns_at_.push_back(met->point.at.back());  // and so do all measures: that is no fold, and no maximum
    std::erase_if(found, [&](const FoundPoint& f) {
      if (birth_at(f.kind) || f.kind == SpecialKind::neimark_sacker) return false;
      const auto is_near = [&](double turn) { return std::abs(f.point.at.back() - turn) <= beside_singular; };
      if (std::ranges::any_of(turns_at_, is_near)) return true;
      if (slip_vanishes_beside(any_equations(), equations, f.point, symmetric_, settings_.tolerance)) return true;
      if (f.kind != SpecialKind::fold) return false;
      return born || (!from && is_turn_of_birth(equations, walk, 2 * step, symmetric_));
    });
    const double end = born ? met->point.arclength - 1e-2 * step : walk.here().arclength + step;
    for (const FoundPoint& f : found)
      if (f.point.arclength <= end) note(equations, f.kind, f.point);
    return born;
  }

  /// A branch of half the symmetry, or twice the period, of another one ends on it; false if its halves meet elsewhere.
  bool note_birth(const OrbitEquations& equations, const MetHalves& met, double step) {
    const OrbitEquations there = equations_for(met.half, {{Condition::Kind::multiplier, -1}});
    const Vector guess = there.unknowns_of(equations.scene_at(met.point.at), met.half);
    const auto exact = solution(there, guess, settings_.tolerance);
    if (!exact || !(largest(sum(*exact, -1.0, guess)) <= step)) return false;
    const SpecialKind kind = met.half.mirrored ? SpecialKind::symmetry_breaking : SpecialKind::flip;
    const Record::Noted noted = record_.note(kind, record_.point(there, {*exact, {}, met.point.arclength}));
    if (noted.is_new && !leaves_out(kind, noted.number)) {
      waiting_.push_back({there.scene_at(*exact), there.orbit_at(*exact), {}, noted.number, generation_ + 1});
      waiting_.back().passes = true;
    }
    // what waits there to be born is this branch, or has the same numbers
    std::erase_if(waiting_, [&](const Waiting& one) { return one.special == noted.number && one.direction; });
    return true;
  }

  /// A special point on the branch; what is born there waits.
  void note(const OrbitEquations& equations, SpecialKind kind, const CurvePoint& point) {
    CurvePoint exact = point;
    // motion that meets no stop may lose a symmetry which the scene doesn't have
    const bool of_free_motion = kind == SpecialKind::symmetry_breaking && !equations.shape().mirrored;
    const bool gives_birth = (kind == SpecialKind::flip || kind == SpecialKind::symmetry_breaking) && !of_free_motion;
    if (kind == SpecialKind::fold || gives_birth) {
      const int multiplier = kind == SpecialKind::fold ? 1 : -1;
      const OrbitEquations there = equations_for(equations.shape(), {{Condition::Kind::multiplier, multiplier}});
      if (const auto at = solution(there, point.at, settings_.tolerance)) exact.at = *at;
    }
    const BranchPoint at = record_.point(equations, exact);
    const auto noted = record_.note(kind, at);
    if (of_free_motion) return record_.leave_out(noted.number);
    if (!noted.is_new)  // a branch that passes where another one was born, and waits there, is that one
      std::erase_if(waiting_, [&](const Waiting& one) { return one.special == noted.number && one.passes; });
    else if (gives_birth && !leaves_out(kind, noted.number))
      waiting_.push_back(daughter_at(at, noted.number, generation_ + 1));
  }

  /// The branch ends within a step, at a graze. If Newton's method doesn't find that from here, shorter steps go on.
  void end_in_graze(const OrbitEquations& equations, const Walk& walk, double step,
                    const std::optional<std::size_t>& from) {
    std::optional<Narrowed> between = narrowed(equations, walk, step);
    if (!between) return end_without_step(equations, record_.point(equations, walk.here()), walk.here());
    if (const auto kind = between->violated.kind;
        kind == Violation::Kind::at_once || kind == Violation::Kind::no_rebound)
      return end_at_once(equations, walk, *between, from);
    const auto end = nearest_end(any_equations(), equations, *between, symmetric_,
                                 std::max(step, 1e-2 * settings_.largest_step), settings_.tolerance);
    double length = between->last_good.arclength - walk.here().arclength;
    if (end && end->change)  // where a slip vanishes, derivatives have no digits
      length *= 1 - 1e-4, turns_at_.push_back(parameter(end->exact.scene) / width_);
    if (special_between(equations, walk, length, from, !end || !end->change))
      return record_.end(record_.point(equations, between->last_good), "born");
    if (ends_in_halt(equations, between->last_good, end)) return;
    if (end) between->violated = end->graze;
    const Touch touch = touch_of(equations, *between);
    if (resting().ends_in_rest(any_equations(), equations, touch, near(step), generation_)) return;
    std::optional<ExactGraze> exact = end ? std::optional(end->exact) : std::nullopt;
    const bool rubs = has_friction(equations.scene_at(touch.beyond.at).friction);
    if (!exact && !rubs)
      exact = exact_graze(any_equations(), equations.scene_at(touch.beyond.at), touch.graze(), 1e-3 * speed_unit_,
                          symmetric_, near(step), settings_.tolerance);
    if (exact && exact->joins) return end_on(*exact, equations.shape());
    BranchPoint last = record_.point(equations, touch.last_good);
    if (!exact && step > 1e-6 * settings_.largest_step) return this->walk(equations, touch.last_good, {}, step / 8);
    if (!exact) return record_.add(last), record_.fail(last, rubs ? no_halt_change : no_graze);
    const Orbit with = exact->orbit,
                without = touch.halts ? halting_at_stop(exact->scene, with, touch.event) : with.without(touch.event);
    last.scene = exact->scene, last.orbit = touch.appears ? without : with;
    record_.add(last);
    if (!rubs && resting().waits_beyond(last, with.events[touch.event].side, generation_))
      return record_.end(last, "chatter limit");
    BranchPoint at = last;
    at.orbit = with;
    const auto [special, is_new] = record_.note(SpecialKind::graze, at, touch.graze().condition);
    record_.end(last, "graze");
    const int heading = touch.last_good.tangent.back() < 0 ? -1 : 1;
    const bool may_gain = !touch.turns && !touch.appears && !touch.halts && settings_.follows(Birth::graze);
    if (!is_new && may_gain) wait_for_sooner(waiting_, record_, at, touch.event, symmetric_, special, generation_);
    if (!is_new) return no_longer_waits(waiting_, special, last.orbit);       // this is the branch that waits there
    if (touch.appears && impact_without_rebound(exact->scene, with)) return;  // the one that appears is too slow
    if (touch.halts && jumps_to_stick(exact->scene, without, touch.event)) return;
    if (touch.turns)
      waiting_.push_back({at.scene, turned(with, touch.event), {}, special, generation_});
    else if (touch.appears)
      waiting_.push_back(with_contact({at.scene, with, {}, special, generation_}, touch.event, heading));
    else
      wait_without(waiting_, {at.scene, without, {}, special, generation_}, symmetric_, heading);
    if (auto each = may_gain ? with_each(at, touch.event, symmetric_, special, generation_) : std::nullopt)
      waiting_.push_back(*std::move(each));
  }

  /// The branch ends within a step, as two events fall together, one of each mass: which of them comes first changes
  /// the motion beyond. Or as an impact is about to be the first one without a rebound.
  void end_at_once(const OrbitEquations& equations, const Walk& walk, const Narrowed& between,
                   const std::optional<std::size_t>& from) {
    const bool born = special_between(equations, walk, between.last_good.arclength - walk.here().arclength, from);
    if (born) return record_.end(record_.point(equations, between.last_good), "born");
    if (between.violated.kind == Violation::Kind::no_rebound) {
      const BranchPoint last = record_.point(equations, point_at_threshold(equations, walk, between));
      record_.add(last), record_.note(SpecialKind::rebound_threshold, last);
      return record_.end(last, std::string(name_of(SpecialKind::rebound_threshold)));
    }
    end_at_once(record_.point(equations, point_at_once(equations, walk, between).value_or(between.last_good)));
  }
  void end_at_once(const BranchPoint& last) {
    branches::end_at_once(any_equations(), last, symmetric_, settings_.tolerance, record_, waiting_, generation_);
  }

  /// No step leads on: under dry friction, as a slip vanishes; or as two events are about to change places.
  void end_without_step(const OrbitEquations& equations, const BranchPoint& last, const CurvePoint& here) {
    const Narrowed at{here, here, {}};
    const auto end =
        nearest_end(any_equations(), equations, at, symmetric_, settings_.largest_step, settings_.tolerance);
    if (ends_in_halt(equations, here, end)) return;
    has_events_at_once(last.orbit) ? end_at_once(last) : record_.fail(last, no_step);
  }
  /// Ends a branch after a good point as friction begins to hold the mass somewhere, or no longer does, if it does.
  bool ends_in_halt(const OrbitEquations& equations, const CurvePoint& last, const std::optional<FrictionEnd>& end) {
    if (!end || !end->change) return false;
    return end_in_change(*end, record_.point(equations, last), record_, waiting_, generation_), true;
  }

  /// The branch ends on a motion that repeats sooner, or is symmetric, as that grazes soft stops, whose dampers change
  /// its multipliers at once. A free motion that is symmetric between unlike stops touches both at once, too: then the
  /// motion with these contacts is the branch that ends.
  void end_on(const ExactGraze& exact, const Orbit& ends) {
    const Condition condition{Condition::Kind::graze, 1, exact.event};
    const OrbitEquations equations = equations_for(exact.orbit, {condition});
    const BranchPoint at = record_.point(equations, {equations.unknowns_of(exact.scene, exact.orbit), {}, 0.0});
    record_.add(at);
    const auto [special, is_new] = record_.note(SpecialKind::graze, at, condition);
    record_.end(at, "graze");
    if (!is_new) return;
    if (exact.orbit.half_turns != ends.half_turns) {
      if (!settings_.follows(Birth::graze)) return record_.leave_out(special);
      waiting_.push_back(with_contact({at.scene, at.orbit, {}, special, generation_}, exact.event));
    }
    wait_without(waiting_, {at.scene, at.orbit.without(exact.event), {}, special, generation_}, symmetric_);
  }

  StartProblem problem_;
  BranchSettings settings_;
  double width_;
  bool symmetric_;  ///< all scenes of the branch
  double speed_unit_ = 0.0;
  std::int64_t generation_ = 0;
  std::vector<double> turns_at_{};  ///< parameters at which the branch begins or ends, and turns
  std::deque<Waiting> waiting_;
  Record record_;
};

}  // namespace

Branches follow_branches(const StartProblem& problem, const BranchSettings& settings) {
  Branches found = Follower(problem, settings).run();
  found.letters = {.sticks = problem.observe.word && problem.observe.word_sticks, .walls = tells_walls(problem)};
  return found;
}

}  // namespace clatter::branches
