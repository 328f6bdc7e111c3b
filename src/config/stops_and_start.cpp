#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "config/consistency.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// The lower (-1) or the upper (+1) one of symmetric stops.
Placed symmetric_stop(const Settings& settings, const AxisGroups& groups, double side) {
  return mirrored(placed(settings, groups, settings.is_si() ? Parameter("gap") : Parameter("xs")), side,
                  settings.is_si() ? "gap" : "|xs|");
}

bool is_infinite(double value) { return std::isinf(value); }
bool is_finite(double value) { return std::isfinite(value); }
bool is_not_zero(double value) { return value != 0; }

/// Throws ConfigError if at some point neither a spring nor a stop keeps the mass. One that carries a loose mass may
/// drift: it is the container of an impact damper.
void check_unsprung(const Settings& settings, const AxisGroups& groups) {
  if (has_loose_mass(settings)) return;
  const Setting* const given = settings.given("stiffness");
  if ((given == nullptr && !settings.is_si()) || settings.given_symmetric_stops() != nullptr) return;
  const std::array unbounded{Condition{given, [](double k) { return k <= 0; }},
                             Condition{settings.given("stop_lower"), is_infinite},
                             Condition{settings.given("stop_upper"), is_infinite}};
  const auto point = point_with_all(settings, groups, unbounded);
  if (!point) return;
  const std::string way_out = " without stops, so nothing bounds the motion; give " +
                              std::string(settings.is_si() ? "gap" : "xs") +
                              ", stop_lower or stop_upper, or a stiffness > 0";
  if (given == nullptr) fail(settings.location_of_section("machine"), "no stiffness" + way_out);
  fail(given->location_of(point->front()), "stiffness = " + number_text(given->numbers()[point->front()]) + way_out);
}

/// Throws ConfigError if both amplitudes, or an amplitude and start_period, are given, or there is no stop to move.
void check_shaking(const Settings& settings, const AxisGroups& groups) {
  const SourceLocation* const moved = place_of_nonzero(settings.given("stop_amplitude"));
  const SourceLocation* const carried = place_of_nonzero(settings.given("base_amplitude"));
  if (moved != nullptr && carried != nullptr) {
    const std::array both{Condition{settings.given("base_amplitude"), is_not_zero},
                          Condition{settings.given("stop_amplitude"), is_not_zero}};
    if (const auto point = point_with_all(settings, groups, both))
      fail(both[0].given->location_of(point->front()),
           "'base_amplitude' and 'stop_amplitude'; give one of them, as the base moves the stops, too");
  }
  const SourceLocation* const shaken = moved != nullptr ? moved : carried;
  if (shaken != nullptr && settings.given("start_period") != nullptr)
    fail(*shaken, "an amplitude conflicts with 'start_period', which is that of free motion; give x0 and v0 instead");
  if (moved != nullptr && settings.given_symmetric_stops() == nullptr && settings.given("stop_lower") == nullptr &&
      settings.given("stop_upper") == nullptr)
    fail(*moved, "'stop_amplitude' without stops; give " + std::string(settings.is_si() ? "gap" : "xs") +
                     ", stop_lower or stop_upper");
}

/// The place of a level of friction that isn't 0 at some point, or nullptr.
const SourceLocation* place_of_friction(const Settings& settings) {
  for (const Parameter level : {Parameter("friction"), Parameter("friction_static")})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(level))) return place;
  return nullptr;
}

/// Throws ConfigError if the static level of the friction is below the kinetic one, or the motion has no friction.
void check_friction(const Settings& settings, const AxisGroups& groups) {
  const SourceLocation* const place = place_of_friction(settings);
  if (place == nullptr) return;
  if (settings.given("friction_static") != nullptr)
    compare(
        placed(settings, groups, "friction"), placed(settings, groups, "friction_static"),
        [](double kinetic, double level) { return kinetic <= level; }, "friction <= friction_static");
  for (const Parameter level : {Parameter("friction"), Parameter("friction_static")}) {
    const std::array both{Condition{settings.given(level), is_not_zero},
                          Condition{settings.given("stop_amplitude"), is_not_zero}};
    if (both[0].given == nullptr || both[1].given == nullptr) continue;
    if (const auto point = point_with_all(settings, groups, both))
      fail(both[0].given->location_of(point->front()),
           "friction conflicts with 'stop_amplitude', since it acts against the ground, over which the mass moves "
           "otherwise than over the stops; give base_amplitude, whose base carries the friction, too");
  }
  if (settings.given("start_period") != nullptr)
    fail(*place,
         "friction conflicts with 'start_period', which is that of motion without loss; give x0 and v0 instead");
}

/// The stiffness given for a stop, alone or for both; nullptr: it is rigid.
const Setting* stiffness_of(const Settings& settings, Side side) {
  const Setting* const both = settings.given("stop_stiffness");
  return both != nullptr ? both
                         : settings.given(side == Side::lower ? Parameter("stop_stiffness_lower")
                                                              : Parameter("stop_stiffness_upper"));
}

/// Throws ConfigError if the spring pushes a mass away more strongly than a soft stop holds it.
void check_hold(const Settings& settings, Side side, const AxisGroups& groups) {
  const Setting *const spring = settings.given("stiffness"), *const stop = stiffness_of(settings, side);
  if (spring == nullptr || stop == nullptr) return;
  const auto kappas = stop->numbers(), springs = spring->numbers();
  const auto check = [&](std::size_t i, double k) {
    if (kappas[i] > -k) return;
    fail(stop->location_of(i), std::string(stop->key->name) + " = " + number_text(kappas[i]) +
                                   " holds no mass that stiffness = " + number_text(k) +
                                   " pushes away; expected more than " + number_text(-k));
  };
  const auto along = dimension_of(settings, spring, groups);
  if (along && along == dimension_of(settings, stop, groups)) {  // they vary together
    for (std::size_t i = 0; i < kappas.size(); ++i) check(i, springs[i]);
  } else {
    const auto weakest = std::ranges::min_element(kappas) - kappas.begin();
    check(static_cast<std::size_t>(weakest), *std::ranges::min_element(springs));
  }
}

/// The setting that places a stop, alone or both; nullptr: there is none.
const Setting* position_of(const Settings& settings, Side side) {
  const Setting* const both = settings.given_symmetric_stops();
  return both != nullptr ? both
                         : settings.given(side == Side::lower ? Parameter("stop_lower") : Parameter("stop_upper"));
}

/// Throws ConfigError if the restitution of a soft stop is given for a stop that is rigid at some point.
void check_soft_restitution(const Settings& settings, Side side, const AxisGroups& groups) {
  const bool is_lower = side == Side::lower;
  const Setting* given = settings.given("stop_R");
  if (given == nullptr) given = settings.given(is_lower ? Parameter("stop_R_lower") : Parameter("stop_R_upper"));
  const std::array rigid_stop{Condition{position_of(settings, side), is_finite},
                              Condition{stiffness_of(settings, side), is_infinite}};
  if (given == nullptr || rigid_stop[0].given == nullptr || !point_with_all(settings, groups, rigid_stop)) return;
  const std::string name(given->key->name), rigid = name.substr(name.find('R'));
  fail(given->key_location, in_quotes(name) + " is of a soft stop, and the " + (is_lower ? "lower" : "upper") +
                                " one is rigid" + (is_soft_somewhere(settings, side) ? " at some points" : "") +
                                "; give " + in_quotes(rigid) + ", or a finite stop_stiffness");
}

/// Lets a start lie beyond a stop at the points of a sweep at which that is soft: there the stop is moved away or, if
/// the start varies with its stiffness, the start.
void free_where_soft(const Settings& settings, Side side, const AxisGroups& groups, Placed& stop, Placed& start) {
  const Setting* const given = stiffness_of(settings, side);
  if (given == nullptr) return;
  const auto kappas = given->numbers();
  const auto dimension = is_soft_everywhere(settings, side) ? std::nullopt : dimension_of(settings, given, groups);
  const bool with_start = dimension && dimension == start.dimension,
             with_stop = !dimension || !stop.dimension || dimension == stop.dimension;
  if (!with_start && !with_stop) return;  // any place of the stop meets a rigid one
  Placed& moved = with_start ? start : stop;
  if (!moved.dimension && dimension)
    moved.values.assign(kappas.size(), moved.values.front()), moved.dimension = dimension;
  const double away = (with_start ? -1 : 1) * sign_of(side) * std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < moved.values.size(); ++i)
    if (is_finite(kappas[dimension ? i : 0])) moved.values[i] = away;
}

}  // namespace

void check_stops_and_start(const Settings& settings, const AxisGroups& groups) {
  check_unsprung(settings, groups);
  check_shaking(settings, groups);
  check_friction(settings, groups);
  const bool symmetric = settings.given_symmetric_stops() != nullptr;
  const Placed lower = symmetric ? symmetric_stop(settings, groups, -1) : placed(settings, groups, "stop_lower");
  const Placed upper = symmetric ? symmetric_stop(settings, groups, 1) : placed(settings, groups, "stop_upper");
  if (!symmetric) compare(lower, upper, is_below, "stop_lower < stop_upper");
  if (settings.given("start_period")) return;      // it starts on the lower stop
  if (stops_move_by_themselves(settings)) return;  // where they are at the start is known to `check_stop_motion`
  // along `follow` only the first point starts from [scene]; a later one beyond a rigid stop is moved onto it
  const auto followed = followed_dimension(settings, groups);
  const auto at_start = [&](Placed quantity) {
    if (followed && quantity.dimension == followed) quantity.values.resize(1);
    return quantity;
  };
  const Placed x0 = placed(settings, groups, "x0");
  const std::string rule = "a start between the stops, " + lower.name + " <= x0 <= " + upper.name;
  for (const Side side : {Side::lower, Side::upper}) {
    Placed stop = side == Side::lower ? lower : upper, start = x0;
    free_where_soft(settings, side, groups, stop, start);
    stop = at_start(stop), start = at_start(start);
    side == Side::lower ? compare(stop, start, is_not_above, rule) : compare(start, stop, is_not_above, rule);
  }
}

bool has_friction_somewhere(const Settings& settings) { return place_of_friction(settings) != nullptr; }

bool is_soft_somewhere(const Settings& settings, Side side) {
  const Setting* const given = stiffness_of(settings, side);
  return given != nullptr && std::ranges::any_of(given->numbers(), is_finite);
}

bool is_soft_everywhere(const Settings& settings, Side side) {
  const Setting* const given = stiffness_of(settings, side);
  return given != nullptr && std::ranges::all_of(given->numbers(), is_finite);
}

void check_soft_stops(const Settings& settings, const AxisGroups& groups) {
  for (const Side side : {Side::lower, Side::upper})
    check_soft_restitution(settings, side, groups), check_hold(settings, side, groups);
}

}  // namespace clatter::config
