#include "branches/start/resting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "attractors/exact_run.hpp"
#include "branches/start/start.hpp"
#include "sweep/sweep.hpp"

namespace clatter::branches {
namespace {

constexpr double turn = 2 * std::numbers::pi;

double position_of(const FollowedScene& scene, Side stop) {
  return stop == Side::upper ? scene.stops.upper : scene.stops.lower;
}

/// The first of the impacts of a chatter that ends in rest number i: they get slower from impact to impact.
std::size_t begin_of_chatter(const Orbit& orbit, std::size_t rest) {
  std::size_t first = rest;
  while (first > 0) {
    const OrbitEvent &before = orbit.events[first - 1], &after = orbit.events[first];
    if (before.side != after.side || before.rest > 0 || std::abs(before.before) < std::abs(after.before)) break;
    --first;
  }
  return first;
}

/// Calls `function(impact)` for impacts that are letters of their own, and `function(rest)` for each rest.
template <class Function>
void each_letter(const Orbit& orbit, Function&& function) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    if (orbit.events[i].rest == 0) continue;
    const std::size_t chatter = std::max(next, begin_of_chatter(orbit, i));
    for (; next < chatter; ++next)
      if (orbit.events[next].kind != Event::Kind::separation) function(orbit.events[next]);
    function(orbit.events[i]);
    next = i + 1;
  }
}

/// The events of a run over whole forcing periods; nothing if it fails.
std::optional<std::vector<OrbitEvent>> events_of(const point::Problem& start, std::int64_t periods) {
  const auto count = static_cast<std::size_t>(periods);
  if (has_soft_stop(start.stops)) {
    auto run = event_run(start, count);
    return run ? std::optional(std::move(run->events)) : std::nullopt;
  }
  const auto round = attractors::run_round(start, count);
  return round ? std::optional(orbit_of(*round, start.oscillator.frequency).events) : std::nullopt;
}

/// Whether a motion has come to rest on a stop and isn't released by then.
bool is_at_rest(const Orbit& orbit, Side side, double phase) {
  if (orbit.size() == 0) return false;
  const OrbitEvent& last = orbit.events.back();
  return last.side == side && last.rest > 0 && phase < last.phase + last.rest;
}

/// The phase, rad, at which the force has a maximum towards a side, of several the nearest to another phase.
double crest_beside(const SceneNumbers<Along>& p, Side side, double phase) {
  const auto [f, lead] = p.force();
  const double sign = f < 0 ? -sign_of(side) : sign_of(side);
  const BasicForceShape<Along>& shape = p.oscillator.shape;
  if (!shape.has_orders()) return sign * turn / 4 - lead.value;
  ForceOrders<double> orders;
  for (std::size_t i = 0; i < orders.of.size(); ++i)
    orders.of[i] = {shape.orders.of[i].in_phase.value, shape.orders.of[i].quadrature.value};
  const std::vector<double> crests = crests_of(orders, sign);
  return *std::ranges::min_element(crests, {}, [&](double at) { return std::abs(std::remainder(at - phase, turn)); });
}

/// The phases, rad, at which a stop may release a mass that rests on it, of one forcing period.
std::vector<double> release_phases(const FollowedScene& scene, Side stop) {
  constexpr double apart = 1e-9;
  std::vector<double> phases;
  for (auto next = release_phase(scene, stop); next && (phases.empty() || *next > phases.back() + apart);
       next = release_phase(scene, stop, *next + apart))
    phases.push_back(*next);
  return phases;
}

}  // namespace

std::optional<double> release_phase(const FollowedScene& scene, Side stop, double after) {
  const auto [f, lead] = numbers_of<double>(scene).force();
  const double needed = -constant_force(scene.oscillator, position_of(scene, stop));  // f s(phase) + load = k x
  if (const ForceShape& shape = scene.oscillator.shape; shape.has_orders()) {
    const auto turns = phase_of_orders(shape.orders, f, needed, stop == Side::lower, after / turn);
    return turns ? std::optional(*turns * turn) : std::nullopt;
  }
  const double sine = needed / f;
  if (!(std::abs(sine) < 1)) return std::nullopt;
  const double rising = std::asin(sine), falling = std::numbers::pi - rising;
  const double phase = (sign_of(stop) * f * std::cos(rising) < 0 ? rising : falling) - lead;
  return phase < 0 ? phase + turn : phase < turn ? phase : phase - turn;
}

std::optional<double> release_tangency(const FollowedScene& scene, Side stop, double release, Parameter parameter,
                                       double within) {
  const double at = value_of(scene, parameter);
  double value = at;
  for (int i = 0; i < 20; ++i) {  // Newton's method on the least pressure on the stop
    const SceneNumbers<Along> p = numbers_along(changed(scene, parameter, value), parameter);
    const Along pull = p.oscillator.load - p.oscillator.stiffness * p.position(stop);
    const Along pressure = sign_of(stop) * (pull + p.force_at(crest_beside(p, opposite(stop), release)).value);
    const double step = pressure.value / pressure.slope[0];
    value -= step;
    if (!(std::abs(value - at) <= within)) return std::nullopt;
    if (std::abs(step) <= 4e-16 * std::abs(value)) return value;
  }
  return value;
}

namespace {

/// Motion from a release of a stop that comes back to it; nothing if it doesn't within some forcing periods.
std::optional<Orbit> orbit_from_release(const point::Problem& problem, Side stop, double release,
                                        std::int64_t most_periods) {
  point::Problem in_frame = problem;
  sweep::enter_shaken_frame(in_frame);
  const point::Problem start = attractors::started(in_frame, {position_of(problem, stop), 0.0}, release);
  for (std::int64_t periods = 1; periods <= most_periods; ++periods) {
    const auto events = events_of(start, periods);
    if (!events) return std::nullopt;
    Orbit orbit{{}, static_cast<int>(2 * periods), false};
    for (OrbitEvent event : *events) {
      event.phase += release, event.rest = 0;
      const bool is_rest = event.before == 0 && event.kind == Event::Kind::impact;
      if (is_rest && is_at_rest(orbit, event.side, event.phase)) continue;  // a chatter's end, then the rest
      if (is_rest) {
        const std::optional<double> next = release_phase(problem, event.side, event.phase);
        if (!next) return std::nullopt;
        event.rest = std::max(*next + turn * std::ceil((event.phase - *next) / turn) - event.phase, 0.0);
      }
      if (!is_rest || event.rest > 1e-12) orbit.events.push_back(event);
    }
    if (orbit.size() == 0) continue;
    OrbitEvent& last = orbit.events.back();
    const double end = release + orbit.advance();
    if (last.side == stop && last.rest > 0 && std::abs(last.phase + last.rest - end) < 1e-6) return orbit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Orbit> resting_orbit(const point::Problem& problem, Side stop, std::int64_t most_periods) {
  if (is_soft(problem.stops, stop)) return std::nullopt;
  for (const double release : release_phases(problem, stop))
    if (auto orbit = orbit_from_release(problem, stop, release, most_periods)) return orbit;
  return std::nullopt;
}

Orbit half_of_resting(const Orbit& orbit, bool symmetric_scene) {
  const int half_turns = orbit.half_turns / 2;
  if (!symmetric_scene || half_turns % 2 == 0) return orbit;
  const OrbitEvent& last = orbit.events.back();
  const double release = last.phase + last.rest - orbit.advance() / 2;
  for (std::size_t i = 0; i + 1 < orbit.size(); ++i) {
    const OrbitEvent& rest = orbit.events[i];
    if (rest.rest > 0 && rest.side != last.side && std::abs(rest.phase + rest.rest - release) < 1e-6)
      return {{orbit.events.begin(), orbit.events.begin() + static_cast<std::ptrdiff_t>(i) + 1}, half_turns, true};
  }
  return orbit;
}

std::vector<bool> are_letters(const Orbit& orbit) {
  std::vector<bool> are(orbit.size(), false);
  each_letter(orbit,
              [&](const OrbitEvent& event) { are[static_cast<std::size_t>(&event - orbit.events.data())] = true; });
  return are;
}

std::string letters_of(const Orbit& orbit) {
  std::string letters;
  each_letter(orbit, [&](const OrbitEvent& event) {
    const bool renews = event.kind == Event::Kind::renewal;
    letters += event.side == Side::upper ? (renews ? 'u' : 'U') : (renews ? 'l' : 'L');
    if (event.rest > 0) letters += '*';
  });
  return letters;
}

double slowest_letter(const Orbit& orbit) {
  double slowest = std::numeric_limits<double>::infinity();
  each_letter(orbit, [&](const OrbitEvent& event) {
    if (event.rest == 0 && event.is_contact()) slowest = std::min(slowest, std::abs(event.before));
  });
  return slowest;
}

}  // namespace clatter::branches
