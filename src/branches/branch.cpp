#include "branches/branch.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <numbers>

#include "branches/measures.hpp"
#include "branches/resting.hpp"
#include "branches/start.hpp"
#include "branches/touch.hpp"

namespace clatter::branches {
namespace {

constexpr std::array<std::string_view, 11> special_names{"fold",
                                                         "flip",
                                                         "symmetry breaking",
                                                         "graze",
                                                         "chatter limit",
                                                         "release tangency",
                                                         "maximum impact_speed",
                                                         "maximum impact_power",
                                                         "maximum harmonic",
                                                         "resonant graze",
                                                         "cusp"};

constexpr std::string_view closed_curve = "closed";

/// A branch that waits to be followed.
struct Waiting {
  Scene scene;
  Orbit orbit;
  std::optional<Vector> direction{};     ///< along which it begins; nothing: both ways
  std::optional<std::size_t> special{};  ///< that it comes from
  std::int64_t generation = 0;
  int heading = 0;                       ///< of motion that rests: up or down the parameter; 0: both ways
  std::optional<std::size_t> cascade{};  ///< the branch that came near it through ever more grazes
};

/// Whether a scene stays symmetric if a parameter changes.
bool keeps_symmetry(sweep::Parameter parameter) {
  using enum sweep::Parameter;
  return parameter != load && parameter != stop_lower && parameter != stop_upper && parameter != R_lower &&
         parameter != R_upper;
}

/// Throws StartError if the scene doesn't lie on the branch that is asked for.
void require_start_in_range(const Scene& scene, const BranchSettings& settings) {
  const Stops& stops = scene.stops;
  const std::string name(sweep::key_of(settings.along));
  if (settings.along == sweep::Parameter::xs && stops.lower != -stops.upper)
    throw StartError("branch.along = xs moves both stops, which aren't symmetric; follow stop_lower or stop_upper");
  if (settings.along == sweep::Parameter::R && stops.restitution_lower != stops.restitution_upper)
    throw StartError("branch.along = R changes both stops, whose R differ; follow R_lower or R_upper");
  const double at = value_of(scene, settings.along);
  if (!(at >= settings.range[0] && at <= settings.range[1]))
    throw StartError("the start lies outside branch.range; give scene." + name + " a value within it");
}

/// Everything about following one branch after the other.
class Follower {
 public:
  Follower(const point::Problem& problem, const BranchSettings& settings)
      : problem_(problem),
        settings_(settings),
        width_(settings.range[1] - settings.range[0]),
        symmetric_(is_symmetric(problem) && keeps_symmetry(settings.along) &&
                   (!settings.across || keeps_symmetry(*settings.across))) {}

  Branches run() {
    require_start_in_range(problem_, settings_);
    waiting_.push_back({problem_, start_orbit(problem_, settings_.period, symmetric_)});
    while (!waiting_.empty()) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      follow(next);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] OrbitEquations equations_for(const Orbit& orbit, std::vector<Condition> conditions = {}) const {
    return {problem_, orbit, {{settings_.along, width_}}, speed_unit_, std::move(conditions)};
  }
  [[nodiscard]] double parameter(const Scene& scene) const { return value_of(scene, settings_.along); }
  [[nodiscard]] bool in_range(double value) const { return value >= settings_.range[0] && value <= settings_.range[1]; }
  [[nodiscard]] WalkLimits limits() const { return {settings_.tolerance, settings_.largest_step}; }

  BranchPoint point_of(const OrbitEquations& equations, const CurvePoint& point) const {
    BranchPoint out{branch_, point.arclength, equations.scene_at(point.at), equations.orbit_at(point.at), false, {},
                    {}};
    const Multipliers of = multipliers(out.scene, out.orbit);
    out.stable = of.stable, out.multiplier_re = of.re, out.multiplier_im = of.im;
    return out;
  }

  void follow(const Waiting& from) {
    branch_ = result_.ends.empty() ? 0 : result_.ends.back().branch + 1;
    if (speed_unit_ == 0) speed_unit_ = impact_speed(from.orbit);
    if (speed_unit_ == 0) speed_unit_ = std::max(1e-3, std::abs(problem_.oscillator.forcing));
    generation_ = from.generation;
    if (from.orbit.rests()) return follow_resting(from);
    const OrbitEquations equations = equations_for(from.orbit);
    CurvePoint start{equations.unknowns_of(from.scene, from.orbit), {}, 0.0};
    Vector axis(equations.unknowns(), 0.0);
    axis.back() = 1;
    if (from.special) {
      const auto first = first_step(equations, start, from.direction);
      if (!first) return;
      result_.special[*from.special].branches.push_back(branch_);
      start.tangent = *first;
      add(point_of(equations, start));
      walk(equations, start, from.special);
      return;
    }
    const auto at = corrected(equations, start.at, axis, settings_.tolerance);
    const auto along = at ? tangent(equations, *at, axis) : std::nullopt;
    if (!along)
      throw StartError(
          "Newton's method does not converge from the motion at the start; move it away from a special point");
    start.at = *at, start.tangent = *along;
    if (violation(equations, start.at))
      throw StartError(
          "Newton's method leads from the start to no motion between the stops; set x0 and v0 nearer to the motion "
          "that is meant");
    CurvePoint back = start;
    for (double& x : back.tangent) x = -x;
    walk(equations, back, {});
    const bool closed = result_.ends.back().reason == closed_curve;
    turn_round(0, 0);
    add(point_of(equations, start));
    if (!closed) walk(equations, start, {});
  }

  /// The way back is walked first; its points are brought into the order of the whole branch.
  void turn_round(std::size_t first_point, std::size_t first_special) {
    std::reverse(result_.points.begin() + static_cast<std::ptrdiff_t>(first_point), result_.points.end());
    for (std::size_t i = first_point; i < result_.points.size(); ++i) result_.points[i].arclength *= -1;
    for (std::size_t i = first_special; i < result_.special.size(); ++i) result_.special[i].at.arclength *= -1;
  }

  /// The direction from a special point into a branch that begins there, in which it is motion between the stops.
  [[nodiscard]] std::optional<Vector> first_step(const OrbitEquations& equations, const CurvePoint& start,
                                                 const std::optional<Vector>& direction) const {
    std::vector<Vector> tried;
    if (direction) {
      tried = {*direction};
    } else {
      Vector axis(equations.unknowns(), 1.0);
      const auto along = tangent(equations, start.at, axis);
      if (!along) return std::nullopt;
      tried = {*along, sum(*along, -2.0, *along)};
    }
    for (const double s : {1e-5, 1e-4, 1e-3, 1e-2})
      for (const Vector& tangent_there : tried) {
        const auto at = corrected(equations, sum(start.at, s, tangent_there), tangent_there, settings_.tolerance);
        if (at && !violation(equations, *at)) return tangent_there;
      }
    return std::nullopt;
  }

  void add(const BranchPoint& point) { result_.points.push_back(point); }

  [[nodiscard]] bool budget_is_spent() const {
    return result_.points.size() >= static_cast<std::size_t>(settings_.max_points);
  }

  void end(const BranchPoint& last, std::string reason, bool failed = false) {
    result_.ends.push_back({branch_, parameter(last.scene), std::move(reason), failed});
  }

  void walk(const OrbitEquations& equations, const CurvePoint& start, std::optional<std::size_t> from) {
    Walk walk(equations, start, limits());
    BranchPoint last = point_of(equations, start);
    for (;;) {
      if (budget_is_spent()) return end(last, "branch.max_points is spent", true);
      const auto next = walk.next();
      if (!next) return end(last, "no step leads on", true);
      const double step = next->arclength - walk.here().arclength;
      if (!in_range(parameter(equations.scene_at(next->at)))) return end_of_range(equations, walk, step);
      if (violation(equations, next->at)) return end_in_graze(equations, walk, step);
      const bool born = special_between(equations, walk, step, from);
      if (born) return end(last, "born");
      if (!from && walk.passes(start, *next)) {
        CurvePoint closing = start;
        closing.arclength = next->arclength;
        last = point_of(equations, closing);
        return add(last), end(last, std::string(closed_curve));
      }
      walk.move_to(*next);
      last = point_of(equations, *next);
      add(last);
      from.reset();
    }
  }

  void end_of_range(const OrbitEquations& equations, const Walk& walk, double step) {
    for (const double bound : settings_.range) {
      auto zero = walk.zero([&](const CurvePoint& p) { return p.at.back() * width_ - bound; }, step);
      if (!zero) continue;
      zero->at.back() = bound / width_;  // R = 0 less a rounding would be no impact
      const double length = zero->arclength - walk.here().arclength;
      if (violation(equations, zero->at)) return end_in_graze(equations, walk, length);
      special_between(equations, walk, length, {});
      const BranchPoint last = point_of(equations, *zero);
      add(last);
      return end(last, "range");
    }
    end(point_of(equations, walk.here()), "no step leads on", true);
  }

  /// Special points within a step. Returns true if the branch is born in one of them, which ends it.
  bool special_between(const OrbitEquations& equations, const Walk& walk, double step,
                       const std::optional<std::size_t>& from) {
    struct Found {
      SpecialKind kind;
      CurvePoint point;
    };
    std::vector<Found> found;
    const auto look = [&](SpecialKind kind, const TestFunction& test, bool only_down) {
      const auto there = walk.after(step);
      if (!there) return;
      const double a = test(walk.here()), b = test(*there);
      if ((a < 0) == (b < 0) || (only_down && a < 0)) return;
      if (const auto zero = walk.zero(test, step)) found.push_back({kind, *zero});
    };
    if (!from)
      look(
          SpecialKind::fold, [](const CurvePoint& p) { return p.tangent.back(); }, false);
    const bool has_impacts = equations.shape().size() > 0;
    if (has_impacts) {
      const SpecialKind kind = equations.shape().mirrored ? SpecialKind::symmetry_breaking : SpecialKind::flip;
      look(
          kind,
          [&](const CurvePoint& p) {
            return impact_map(equations.scene_at(p.at), equations.orbit_at(p.at)).distance_to(-1);
          },
          false);
      const auto look_for_maximum = [&](SpecialKind of, Along (*measure)(const Moving&)) {
        look(
            of, [&, measure](const CurvePoint& p) { return measure(moving(equations, p.at, p.tangent)).slope[0]; },
            true);
      };
      look_for_maximum(SpecialKind::impact_speed, impact_speed);
      if (problem_.observe.energy) look_for_maximum(SpecialKind::impact_power, impact_power);
      if (problem_.observe.harmonics > 0) look_for_maximum(SpecialKind::harmonic, harmonic);
    }
    std::ranges::sort(found, {}, [](const Found& f) { return f.point.arclength; });
    for (Found& f : found) {
      if (f.kind == SpecialKind::fold) {
        const Orbit orbit = equations.orbit_at(f.point.at);
        const Orbit half = orbit.half_if_same(1e-3, symmetric_);
        if (half.size() < orbit.size() && note_birth(equations, f.point, half)) return true;
      }
      note(equations, f.kind, f.point);
    }
    return false;
  }

  /// A branch of half the symmetry, or twice the period, of another one ends on it. Returns false if there is no such
  /// branch at its fold.
  bool note_birth(const OrbitEquations& equations, const CurvePoint& point, const Orbit& half) {
    const OrbitEquations there = equations_for(half, {{Condition::Kind::multiplier, -1}});
    const auto exact = solution(there, there.unknowns_of(equations.scene_at(point.at), half), settings_.tolerance);
    if (!exact || std::abs(exact->back() - point.at.back()) > 1e-6) return false;
    const SpecialKind kind = half.mirrored ? SpecialKind::symmetry_breaking : SpecialKind::flip;
    const std::size_t special = add_special(kind, point_of(there, {*exact, {}, point.arclength}));
    if (generation_ < settings_.generations && result_.special[special].branches.size() == 1)
      waiting_.push_back({there.scene_at(*exact), there.orbit_at(*exact), {}, special, generation_ + 1});
    return true;
  }

  /// The special point of that kind near another, known already or new; it belongs to this branch.
  std::size_t add_special(SpecialKind kind, BranchPoint at) {
    at.branch = branch_;
    for (std::size_t i = 0; i < result_.special.size(); ++i) {
      SpecialPoint& known = result_.special[i];
      const PhasePoint a = state_at_phase_zero(at.scene, at.orbit),
                       b = state_at_phase_zero(known.at.scene, known.at.orbit);
      if (known.kind == kind && std::abs(parameter(known.at.scene) - parameter(at.scene)) <= 1e-8 * width_ &&
          std::hypot(a.x - b.x, a.v - b.v) <= 1e-5 * speed_unit_) {
        meet(known, branch_);
        return i;
      }
    }
    result_.special.push_back({kind, std::move(at), {branch_}});
    return result_.special.size() - 1;
  }

  static void meet(SpecialPoint& special, std::size_t branch) {
    if (std::ranges::find(special.branches, branch) == special.branches.end()) special.branches.push_back(branch);
  }

  /// A special point on the branch; what is born there waits.
  void note(const OrbitEquations& equations, SpecialKind kind, const CurvePoint& point) {
    CurvePoint exact = point;
    if (kind == SpecialKind::fold || kind == SpecialKind::flip || kind == SpecialKind::symmetry_breaking) {
      const int multiplier = kind == SpecialKind::fold ? 1 : -1;
      const OrbitEquations there = equations_for(equations.shape(), {{Condition::Kind::multiplier, multiplier}});
      if (const auto at = solution(there, point.at, settings_.tolerance)) exact.at = *at;
    }
    const BranchPoint at = point_of(equations, exact);
    const std::size_t before = result_.special.size(), special = add_special(kind, at);
    const bool is_new = result_.special.size() > before;
    if (!is_new || generation_ >= settings_.generations) return;
    if (kind == SpecialKind::flip || kind == SpecialKind::symmetry_breaking) wait_for_daughter(at, special);
  }

  /// What is born at a flip or a loss of symmetry begins along the eigenvector of multiplier -1.
  void wait_for_daughter(const BranchPoint& at, std::size_t special) {
    const Orbit daughter = at.orbit.mirrored ? at.orbit.whole() : at.orbit.repeated(2);
    const ImpactMap map = impact_map(at.scene, at.orbit);
    const auto& m = map.numerator;
    const double c = map.denominator;
    std::array<double, 2> vector{-m[0][1], m[0][0] + c};  // of (M + 1) v = 0, by the larger row
    if (std::hypot(m[1][0], m[1][1] + c) > std::hypot(m[0][1], m[0][0] + c)) vector = {m[1][1] + c, -m[1][0]};
    const auto changes = spread(at.scene, daughter, vector);
    Vector direction;
    for (const auto& [phase, before] : changes) direction.push_back(phase), direction.push_back(before / speed_unit_);
    direction.push_back(0.0);
    const double length = std::sqrt(product(direction, direction));
    for (double& x : direction) x /= length;
    waiting_.push_back({at.scene, daughter, direction, special, generation_ + 1});
  }

  /// The branch ends within a step, at a graze.
  void end_in_graze(const OrbitEquations& equations, const Walk& walk, double step) {
    const std::optional<Touch> touch = touch_within(equations, walk, step);
    if (!touch) return end(point_of(equations, walk.here()), "no step leads on", true);
    special_between(equations, walk, touch->last_good.arclength - walk.here().arclength, {});
    const OrbitEquations there = equations_for(touch->orbit, {{Condition::Kind::graze, 1, touch->impact}});
    const Vector guess = there.unknowns_of(equations.scene_at(touch->beyond.at), touch->orbit);
    const auto exact = solution(there, guess, settings_.tolerance);
    BranchPoint last = point_of(equations, touch->last_good);
    if (!exact || std::abs(exact->back() - guess.back()) > 10 * step)
      return add(last), end(last, "a contact that no graze explains", true);
    const Orbit with = there.orbit_at(*exact), without = with.without(touch->impact);
    last.scene = there.scene_at(*exact), last.orbit = touch->appears ? without : with;
    add(last);
    if (ends_in_chatter(last, with.impacts[touch->impact].side)) return end(last, "chatter limit");
    const std::size_t before = result_.special.size();
    BranchPoint at = last;
    at.orbit = with;
    const std::size_t special = add_special(SpecialKind::graze, at);
    end(last, "graze");
    if (result_.special.size() == before) return;
    Orbit beyond = touch->appears ? with : without;
    if (beyond.size() == 0) beyond = Orbit{}.half_if_same(0.0, symmetric_);
    waiting_.push_back({at.scene, beyond, {}, special, generation_});
  }

  /// Motion that rests is a function of the parameter: the run from its release. It is walked along the parameter.
  void follow_resting(const Waiting& from) {
    const Side stop = from.orbit.impacts.back().side;
    const double start = parameter(from.scene);
    if (from.special) result_.special[*from.special].branches.push_back(branch_);
    if (from.heading != 0) {
      add(resting_point(start, start, from.orbit));
      return walk_resting(stop, start, from.orbit, from.heading);
    }
    const std::size_t first_point = result_.points.size(), first_special = result_.special.size();
    walk_resting(stop, start, from.orbit, -1);
    turn_round(first_point, first_special);
    add(resting_point(start, start, from.orbit));
    walk_resting(stop, start, from.orbit, 1);
    if (!from.cascade) return;
    for (std::size_t i = first_special; i < result_.special.size(); ++i)
      if (result_.special[i].kind == SpecialKind::chatter_limit) return meet(result_.special[i], *from.cascade);
  }

  [[nodiscard]] std::optional<Orbit> resting_at(double value, Side stop, const Orbit& like) const {
    point::Problem problem = problem_;
    static_cast<Scene&>(problem) = changed(problem_, settings_.along, value);
    return resting_orbit(problem, stop, like.half_turns / 2);
  }

  [[nodiscard]] BranchPoint resting_point(double value, double start, const Orbit& orbit) const {
    return {branch_,
            std::abs(value - start) / width_,
            changed(problem_, settings_.along, value),
            half_of_resting(orbit, symmetric_),
            true,
            {},
            {}};
  }

  void walk_resting(Side stop, double start, Orbit orbit, int heading) {
    const double bound = settings_.range[heading > 0 ? 1 : 0];
    // short steps, as all that happens within one unseen is that an impact comes and goes
    const double step = heading * settings_.largest_step / 4 * width_;
    double here = start;
    while (here != bound) {
      if (budget_is_spent()) return end(resting_point(here, start, orbit), "branch.max_points is spent", true);
      const double next = heading * (bound - here) < heading * step ? bound : here + step;
      const std::optional<Orbit> there = resting_at(next, stop, orbit);
      if (!there || letters_of(*there) != letters_of(orbit)) {
        const auto [last, beyond] = change_between(here, next, stop, orbit);
        const std::optional<Orbit> good = resting_at(last, stop, orbit), other = resting_at(beyond, stop, orbit);
        maxima_between(here, last, stop, start, orbit);
        if (!other || is_new_contact(*good, *other))
          return end_resting(stop, start, last, *good, beyond, other, heading);
        orbit = *other, here = beyond;  // an impact passed another in speed
      } else {
        maxima_between(here, next, stop, start, orbit);
        orbit = *there, here = next;
      }
      add(resting_point(here, start, orbit));
    }
    end(resting_point(here, start, orbit), "range");
  }

  /// Neighbours, as good as, between which the letters of the motion change: the last value with those of `orbit`, and
  /// the next one.
  [[nodiscard]] std::pair<double, double> change_between(double good, double bad, Side stop, const Orbit& orbit) const {
    const std::string letters = letters_of(orbit);
    for (;;) {
      const double middle = good + (bad - good) / 2;
      if (middle == good || middle == bad) return {good, bad};
      const std::optional<Orbit> there = resting_at(middle, stop, orbit);
      (there && letters_of(*there) == letters ? good : bad) = middle;
    }
  }

  /// Whether of two neighbouring motions one has a rest, or an impact without speed, that the other hasn't.
  [[nodiscard]] bool is_new_contact(const Orbit& one, const Orbit& other) const {
    return rests_of(one) != rests_of(other) ||
           std::min(slowest_letter(one), slowest_letter(other)) < 1e-4 * speed_unit_;
  }
  static std::ptrdiff_t rests_of(const Orbit& orbit) {
    return std::ranges::count_if(orbit.impacts, [](const OrbitImpact& impact) { return impact.rest > 0; });
  }

  void end_resting(Side stop, double start, double last, const Orbit& good, double beyond,
                   const std::optional<Orbit>& other, int heading) {
    BranchPoint at = resting_point(last, start, good);
    const std::optional<double> tangency = release_tangency(at.scene, stop, settings_.along);
    SpecialKind kind = SpecialKind::chatter_limit;
    // nearby, flights are too short to be told from rest
    if (tangency && std::abs(*tangency - last) <= 1e-9 * (std::abs(last) + width_))
      kind = SpecialKind::release_tangency, at.scene = changed(problem_, settings_.along, *tangency);
    else if (other && rests_of(*other) == rests_of(good))
      kind = SpecialKind::graze;
    add(at);
    if (kind == SpecialKind::graze && ends_in_chatter(at, stop)) return end(at, "chatter limit");
    const std::size_t before = result_.special.size(), special = add_special(kind, at);
    end(at, std::string(name_of(kind)));
    if (kind == SpecialKind::graze && result_.special.size() > before)
      waiting_.push_back({changed(problem_, settings_.along, beyond), *other, {}, special, generation_, heading, {}});
  }

  /// Largest speeds and losses of motion that rests, between two values of the parameter.
  void maxima_between(double here, double next, Side stop, double start, const Orbit& like) {
    const auto look = [&](SpecialKind kind, Along (*measure)(const Moving&)) {
      const auto slope = [&](double value) {
        const std::optional<Orbit> orbit = resting_at(value, stop, like);
        return orbit ? measure(moving_from_release(changed(problem_, settings_.along, value), *orbit, settings_.along))
                           .slope[0]
                     : 0.0;
      };
      const double low = std::min(here, next), high = std::max(here, next), first = slope(low), last = slope(high);
      if (!(first > 0 && last < 0)) return;
      std::uintmax_t most = 60;
      const auto [a, b] = boost::math::tools::toms748_solve(
          slope, low, high, first, last, [](double x, double y) { return std::abs(x - y) <= 4e-16 * std::abs(x); },
          most);
      const double value = a + (b - a) / 2;
      if (const auto orbit = resting_at(value, stop, like)) add_special(kind, resting_point(value, start, *orbit));
    };
    look(SpecialKind::impact_speed, impact_speed);
    if (problem_.observe.energy) look(SpecialKind::impact_power, impact_power);
  }

  /// A branch that was born at a graze not long ago ends in another one: they accumulate where a chatter ends in rest
  /// just at its release. The motion that rests begins not far beyond.
  [[nodiscard]] bool ends_in_chatter(const BranchPoint& last, Side stop) {
    const auto first = std::ranges::find(result_.points, branch_, &BranchPoint::branch);
    const double distance = parameter(last.scene) - parameter(first->scene);
    if (last.orbit.size() < 8 || distance == 0 || std::abs(distance) > 1e-5 * width_) return false;
    for (double ahead = distance; std::abs(ahead) < 0.01 * width_; ahead *= 2) {
      const double value = parameter(last.scene) + ahead;
      if (!in_range(value)) return false;
      const Orbit whole = last.orbit.whole();
      const auto orbit = resting_at(value, stop, whole);
      if (orbit && rests_of(*orbit) > rests_of(whole)) {
        waiting_.push_back({changed(problem_, settings_.along, value), *orbit, {}, {}, generation_, 0, branch_});
        return true;
      }
    }
    return false;
  }

  point::Problem problem_;
  BranchSettings settings_;
  double width_;
  bool symmetric_;  ///< all scenes of the branch
  double speed_unit_ = 0.0;
  std::size_t branch_ = 0;
  std::int64_t generation_ = 0;
  std::deque<Waiting> waiting_;
  Branches result_;
};

}  // namespace

std::string_view name_of(SpecialKind kind) { return special_names[static_cast<std::size_t>(kind)]; }

Branches follow_branches(const point::Problem& problem, const BranchSettings& settings) {
  return Follower(problem, settings).run();
}

}  // namespace clatter::branches
