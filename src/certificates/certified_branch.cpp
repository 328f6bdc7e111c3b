#include "certificates/certified_branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "branches/measures/measures.hpp"
#include "branches/measures/moving.hpp"
#include "branches/walk/rebound_threshold.hpp"
#include "sweep/sweep.hpp"

namespace clatter::certificates {
namespace {

using branches::BranchPoint;
using branches::FollowedScene;
using branches::Orbit;
using branches::OrbitEvent;
using branches::SpecialKind;
using branches::SpecialPoint;
using branches::StartProblem;
using point::Problem;

/// The problem of a state at a phase of the shaking, in the frame of what is shaken.
Problem problem_from(const StartProblem& start, const FollowedScene& scene, const attractors::SectionState& state,
                     double phase) {
  Problem problem = branches::with_scene(start, scene);
  problem.start = {state.x, state.v, phase};
  if (has_loose_mass(scene.loose)) problem.loose.place = state.z, problem.loose.velocity = state.w;
  sweep::enter_shaken_frame(problem);
  return problem;
}

/// The event that a graze claims to be none.
std::optional<std::size_t> grazing(const SpecialPoint& special) {
  using enum branches::Condition::Kind;
  if (special.condition.kind != graze && special.condition.kind != force) return std::nullopt;
  const std::size_t i = special.condition.event;
  return i < special.at.orbit.size() && special.at.orbit.changes_nothing(i) ? std::optional(i) : std::nullopt;
}

/// Where a special point's motion begins: within its longest flight, clear of stops and of the graze.
struct Begin {
  double phase = 0.0;
  PhasePoint state;
  std::size_t flight = 0;  ///< that begins with this event
};
Begin begin_of(const FollowedScene& scene, const Orbit& orbit, std::optional<double> graze) {
  if (orbit.size() == 0 && !graze) return {0.0, branches::state_at(scene, orbit, 0, 0.0)};
  Begin longest;
  double length = 0.0;
  const std::size_t flights = std::max<std::size_t>(orbit.size(), 1);
  for (std::size_t i = 0; i < flights; ++i) {
    double from = orbit.size() > 0 ? orbit.event(i).phase : *graze;
    const double to = orbit.size() > 0 ? orbit.event(i + 1).phase : from + orbit.advance();
    if (orbit.size() > 0 && orbit.pressed_after(i) != Side::none) continue;
    const auto consider = [&](double begin, double end) {
      if (end - begin <= length) return;
      length = end - begin, longest.phase = (begin + end) / 2, longest.flight = i;
      longest.state = branches::state_at(scene, orbit, i, longest.phase);
    };
    for (const double turn : {-orbit.advance(), 0.0, orbit.advance()})
      if (graze && *graze + turn > from && *graze + turn < to) consider(from, *graze + turn), from = *graze + turn;
    consider(from, to);
  }
  return longest;
}

/// How far an event may be off.
struct EventError {
  double phase = 0.0, velocity = 0.0;
};

/// How an error of the state at the start spreads over the events of a period.
std::vector<EventError> errors_after(const FollowedScene& scene, const Orbit& orbit, const Begin& begin,
                                     double state_error) {
  if (orbit.size() == 0) return {};
  Orbit all = orbit.whole();
  std::rotate(all.events.begin(), all.events.begin() + static_cast<std::ptrdiff_t>((begin.flight + 1) % all.size()),
              all.events.end());
  for (std::size_t i = 1; i < all.size(); ++i)
    while (all.events[i].phase < all.events[i - 1].phase) all.events[i].phase += all.advance();
  const OrbitEvent& first = all.events[0];
  const double nu = scene.oscillator.frequency;
  const double grown = state_error * (1 + all.advance() / nu);  // at the first event, in a flight that is no longer
  std::vector<EventError> errors(all.size());
  for (const std::array<double, 2>& change : {std::array{nu * grown / std::abs(first.before), 0.0}, {0.0, grown}}) {
    const auto spread = branches::spread(scene, all, change);
    for (std::size_t i = 0; i < errors.size(); ++i)
      errors[i].phase += std::abs(spread[i][0]), errors[i].velocity += std::abs(spread[i][1]);
  }
  return errors;
}

SceneSlopes slopes_along(const FollowedScene& scene, Parameter along) {
  const auto p = branches::numbers_along(scene, along);
  const auto force = p.force();
  const auto& o = p.oscillator;
  const auto slope = [](const branches::Along& number) { return number.slope[0]; };
  const auto of_stop = [&](Side side) {
    const bool upper = side == Side::upper, soft = is_soft(scene.stops, side);
    return SceneSlopes::Stop{slope(p.position(side)), soft ? 0.0 : slope(p.law(side).share_at_rest()),
                             soft ? slope(upper ? p.stops.stiffness_upper : p.stops.stiffness_lower) : 0.0,
                             soft ? slope(upper ? p.stops.damping_upper : p.stops.damping_lower) : 0.0};
  };
  SceneSlopes slopes{slope(o.damping), slope(o.stiffness), slope(force.amplitude), slope(o.frequency),
                     slope(o.load),    slope(force.lead),  of_stop(Side::lower),   of_stop(Side::upper)};
  if (!o.shape.has_orders()) return slopes;
  for (std::size_t i = 0; i < slopes.orders.size(); ++i) {
    const auto& [in_phase, quadrature] = o.shape.orders.of[i];
    slopes.orders[i] = {slope(force.amplitude * in_phase), slope(force.amplitude * quadrature)};
  }
  slopes.f = slopes.orders[0].in_phase;
  return slopes;
}

/// The name under which a special point is claimed; nothing: the format has none.
std::optional<std::string_view> claimed_kind(const SpecialPoint& special) {
  switch (special.kind) {
    case SpecialKind::impact_power:
      if (special.at.orbit.meets_soft_stop()) return std::nullopt;
      [[fallthrough]];
    case SpecialKind::fold:
    case SpecialKind::flip:
    case SpecialKind::symmetry_breaking:
    case SpecialKind::graze:
    case SpecialKind::impact_speed:
      return branches::name_of(special.kind);
    default:
      return std::nullopt;
  }
}

constexpr double of_special = 1e-12;  ///< error over the size, where the place along the branch is found to less

}  // namespace

CertifiedPoint certified(const BranchPoint& point, const StartProblem& start) {
  constexpr double rounding = 1e-9;  // which decides whether a run's impact rebounds
  if (branches::is_at_threshold(point.scene, point.orbit, rounding))
    return {.status = steady::Status::periodic, .without = Without::law_of_speed};
  const attractors::SectionState state = branches::state_at_phase_zero(point.scene, point.orbit);
  const observables::Extrema::Values range = branches::extrema_as_computed(point.scene, point.orbit);
  const Stops rigid = rigid_ones(point.scene.stops);
  const Problem problem = problem_from(start, point.scene, state, 0.0);
  point::PointResult result{};
  result.status = steady::Status::periodic, result.observed_turns = point.orbit.period_ratio();
  static_cast<Start&>(result.end) = problem.start;
  result.end.loose_place = state.z, result.end.loose_velocity = state.w;
  static_cast<observables::Extrema::Values&>(result) = range;
  result.x_min = std::max(range.x_min, rigid.lower), result.x_max = std::min(range.x_max, rigid.upper);
  std::ranges::copy(point.multiplier_re, result.multiplier_re.begin());
  std::ranges::copy(point.multiplier_im, result.multiplier_im.begin());
  result.impact_word = point.orbit.word({.walls = branches::tells_walls(point.scene)});
  result.symmetric = is_symmetric(point.scene) ? point.orbit.mirrored : std::nan("");
  return certified_period(problem, result);
}

CertifiedPoint certified(const SpecialPoint& special, Parameter along, const StartProblem& start) {
  CertifiedPoint found{.status = steady::Status::periodic, .without = Without::no_such_claim};
  if (!has_constant_restitution(branches::with_scene(start, special.at.scene))) {
    found.without = Without::law_of_speed;
    return found;
  }
  const auto kind = claimed_kind(special);
  const auto graze = grazing(special);
  const FollowedScene& scene = special.at.scene;
  const Orbit& kept = special.at.orbit;
  if (!kind || kept.rests() || has_friction(scene.friction) || has_loose_mass(scene.loose) ||
      (special.kind == SpecialKind::graze) != graze.has_value())
    return found;
  const Orbit orbit = graze ? kept.without(*graze) : kept;
  const Begin begin = begin_of(scene, orbit, graze ? std::optional(kept.events[*graze].phase) : std::nullopt);
  const Problem problem = problem_from(start, scene, begin.state, 0.0);
  const double nu = scene.oscillator.frequency, period = period_of(problem.oscillator);
  const observables::Extrema::Values range = branches::extrema(scene, kept);
  const double size = std::max({std::abs(range.x_min), std::abs(range.x_max), std::abs(range.v_min), range.v_max});
  const double state_error = of_special * size, time_error = of_special * period;
  const std::vector<EventError> errors = errors_after(scene, orbit, begin, state_error);
  Certificate certificate{.scene = problem, .time = begin.phase / nu, .x_error = state_error, .v_error = state_error};
  const Orbit whole = kept.whole();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    OrbitEvent event = whole.events[i];
    const double late = event.phase - begin.phase;
    event.phase = begin.phase + late - std::floor(late / whole.advance()) * whole.advance();
    ClaimedEvent claimed{event.kind, event.side, {event.phase / nu, time_error}, {event.before, state_error}};
    claimed.grazes = graze && i % kept.size() == *graze;
    certificate.events.push_back(claimed);
  }
  std::ranges::sort(certificate.events, {}, [](const ClaimedEvent& event) { return event.time.value; });
  for (std::size_t i = 0, n = 0; i < certificate.events.size(); ++i) {
    ClaimedEvent& event = certificate.events[i];
    const EventError& error = errors.empty() ? EventError{} : errors[std::min(n, errors.size() - 1)];
    event.time.error += error.phase / nu, event.then.error += error.velocity;
    if (!event.grazes) ++n;
  }
  if (!std::ranges::all_of(certificate.events, [](const ClaimedEvent& event) {
        return std::isfinite(event.time.error) && std::isfinite(event.then.error);
      })) {
    found.without = Without::rounding;
    return found;
  }
  certificate.period = ClaimedPeriod{.periods = static_cast<std::size_t>(std::llround(kept.period_ratio()))};
  if (kept.mirrored) certificate.period->symmetric = true;
  const double parameter = value_of(scene, along), unit = factor_of(scene.units, along.row().quantity);
  const Claimed value{parameter, of_special * std::max(std::abs(parameter), 1e-3 * unit)};
  certificate.special = ClaimedSpecial{std::string(*kind), value, slopes_along(scene, along)};
  found.certificate = certificate, found.without = Without::none;
  return found;
}

}  // namespace clatter::certificates
