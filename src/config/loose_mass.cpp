#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "config/consistency.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"

namespace clatter::config {
namespace {

constexpr Parameter loose_mass("loose_mass");

/// Refuses a setting beside a loose mass; `way_out` says how to mend it.
[[noreturn]] void refuse(const SourceLocation& location, const std::string& what, const std::string& way_out) {
  fail(location, what + " conflicts with 'loose_mass'; " + way_out);
}

/// Keys of a loose mass need the mass.
void check_completeness(const Settings& settings) {
  for (const Parameter parameter : all_parameters) {
    const Setting* const given = parameter.is_loose() ? settings.given(parameter) : nullptr;
    if (given == nullptr || settings.given(loose_mass) != nullptr) continue;
    fail(given->key_location, in_quotes(given->key->name) + " without 'loose_mass'; give that, or leave it out");
  }
  for (const std::string key : {"along", "across"})
    if (const auto of = settings.followed(key); of && of->is_loose() && settings.given(loose_mass) == nullptr)
      fail(settings.find("branch", key)->location,
           key + " = " + in_quotes(of->key()) + " without 'loose_mass'; give that, or follow another key");
}

/// There is a wall at every point.
void check_walls(const Settings& settings, const AxisGroups& groups) {
  if (settings.given("loose_gap") != nullptr) return;
  const auto is_infinite = [](double value) { return std::isinf(value); };
  const std::array without{Condition{settings.given("loose_lower"), is_infinite},
                           Condition{settings.given("loose_upper"), is_infinite}};
  if (!point_with_all(settings, groups, without)) return;
  fail(settings.given(loose_mass)->key_location,
       "'loose_mass' without walls, so that it never strikes; give loose_gap, loose_lower or loose_upper");
}

/// The place of a stop of the main mass, or nullptr.
const SourceLocation* place_of_stop(const Settings& settings) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  for (const Parameter stop : std::array<Parameter, 4>{"xs", "gap", "stop_lower", "stop_upper"})
    if (const SourceLocation* const place = place_of(settings.given(stop), is_finite)) return place;
  return nullptr;
}

/// What the main mass has beside the loose one that some ways to use a scene don't know, and its place.
struct Own {
  const SourceLocation* place = nullptr;
  std::string name{};
};
Own friction_of(const Settings& settings) {
  for (const Parameter level : std::array<Parameter, 2>{"friction", "friction_static"})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(level)))
      return {place, "friction of the main mass"};
  return {};
}
Own own_of(const Settings& settings) {
  if (const SourceLocation* const place = place_of_stop(settings)) return {place, "a stop of the main mass"};
  if (const Own friction = friction_of(settings); friction.place != nullptr) return friction;
  if (const SourceLocation* const place =
          place_of(settings.given("stiffness"), [](double value) { return !(value > 0); }))
    return {place, "a stiffness that is not above 0"};
  return {};
}

/// The friction of the loose mass on its housing.
Own loose_friction_of(const Settings& settings) {
  for (const Parameter level : std::array<Parameter, 2>{"loose_friction", "loose_friction_static"})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(level)))
      return {place, "friction of the loose mass"};
  return {};
}

/// The stops of the main mass, and its friction, stand on the ground on which its motion is computed.
void check_main_mass(const Settings& settings) {
  if (const SourceLocation* const place = place_of_nonzero(settings.given("stop_amplitude")))
    refuse(*place, "'stop_amplitude'", "give base_amplitude, whose base carries the spring");
  if (const Setting* const start = settings.given("start_period"))
    refuse(start->key_location, "'start_period'", "give x0 and v0 instead");
  const Own own = own_of(settings);
  const SourceLocation* const shaken = place_of_nonzero(settings.given("base_amplitude"));
  if (own.place != nullptr && shaken != nullptr)
    fail(*own.place, own.name +
                         " conflicts with 'base_amplitude' beside 'loose_mass', since a frame that moves with "
                         "the base would push the loose mass, too; leave one of the three out");
}

/// Refuses a parameter that a scene with a loose mass doesn't have, or can't be followed along.
void check_followed(const Settings& settings, const std::string& key, const Setting* range) {
  if (!settings.followed(key)) return;
  const Parameter parameter = *settings.followed(key);
  const Setting& place = *settings.find("branch", key);
  const std::string asked = key + " = " + in_quotes(parameter.key());
  if (parameter.role() == Role::friction || parameter == "stop_amplitude")
    refuse(place.location, asked,
           "no branch beside a loose mass is followed along it; run a sweep of it, or follow another parameter");
  if (conflicts_with_loose_mass(parameter) && place_of_stop(settings) == nullptr)
    refuse(place.location, asked,
           "the main mass has no stop; follow loose_gap, loose_lower, loose_upper or loose_R, or give it stops");
  const bool is_stiffness = parameter == "stiffness";
  if (!(parameter == loose_mass || is_stiffness) || range == nullptr) return;
  const auto [low, high] = settings.interval("branch", range->key->name);
  if (!(low > 0) && !(is_stiffness && high < 0))
    fail(range->location, "range of " + in_quotes(parameter.key()) + " reaches 0, where there is no " +
                              (is_stiffness ? "spring, from whose equilibrium places count; keep it on one side of 0"
                                            : "loose mass; begin it above 0"));
}
/// Refuses a branch, or a curve, that isn't followed beside a loose mass.
void check_branch(const Settings& settings) {
  const std::optional<Parameter> along = settings.followed("along");
  if (!along) return;
  for (const Own& friction : {friction_of(settings), loose_friction_of(settings)})
    if (friction.place != nullptr)
      fail(*friction.place, friction.name +
                                " conflicts with [branch] beside 'loose_mass'; run a sweep, and give it follow = " +
                                in_quotes(along->key()));
  check_followed(settings, "along", settings.find("branch", "range"));
  check_followed(settings, "across", settings.find("branch", "across_range"));
}

}  // namespace

void check_loose_mass(const Settings& settings) {
  check_completeness(settings);
  if (settings.given(loose_mass) == nullptr) return;
  check_main_mass(settings);
  check_branch(settings);
}

void check_housing(const Settings& settings, const AxisGroups& groups) {
  if (settings.given(loose_mass) == nullptr) return;
  check_walls(settings, groups);
  if (settings.given("loose_friction_static") != nullptr)
    compare(
        placed(settings, groups, "loose_friction"), placed(settings, groups, "loose_friction_static"),
        [](double kinetic, double level) { return kinetic <= level; }, "loose_friction <= loose_friction_static");
  const bool symmetric = settings.given("loose_gap") != nullptr;
  const Placed gap = symmetric ? placed(settings, groups, "loose_gap") : Placed{};
  const Placed lower = symmetric ? mirrored(gap, -1, "loose_gap") : placed(settings, groups, "loose_lower"),
               upper = symmetric ? mirrored(gap, 1, "loose_gap") : placed(settings, groups, "loose_upper");
  if (!symmetric) compare(lower, upper, is_below, "loose_lower < loose_upper");
  const Placed start = placed(settings, groups, "loose_x0");
  const std::string rule = "a start between the walls, " + lower.name + " <= loose_x0 <= " + upper.name;
  if (!is_soft_wall_everywhere(settings, Side::lower)) compare(lower, start, is_not_above, rule);
  if (!is_soft_wall_everywhere(settings, Side::upper)) compare(start, upper, is_not_above, rule);
}

bool conflicts_with_loose_mass(Parameter parameter) {
  const bool is_of_stops = parameter.is_of_both() || parameter.side() != Side::none || parameter == "stop_amplitude";
  return !parameter.is_loose() && (is_of_stops || parameter.role() == Role::friction);
}

bool has_main_events(const Settings& settings) {
  return place_of_stop(settings) != nullptr || has_friction_somewhere(settings);
}

bool has_loose_friction(const Settings& settings) { return loose_friction_of(settings).place != nullptr; }

bool has_loose_mass(const Settings& settings) { return settings.given(loose_mass) != nullptr; }

}  // namespace clatter::config
