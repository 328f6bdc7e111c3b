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

/// The setting of a key of both walls, or of that of one; nullptr: it isn't given.
const Setting* of_wall(const Settings& settings, const std::string& both, Side side) {
  const Setting* const given = settings.given(Parameter::of(both).value());
  const std::string one = both + (side == Side::lower ? "_lower" : "_upper");
  return given != nullptr ? given : settings.given(Parameter::of(one).value());
}
const Setting* place_of_wall(const Settings& settings, Side side) {
  const Setting* const both = settings.given("loose_gap");
  return both != nullptr ? both
                         : settings.given(side == Side::lower ? Parameter("loose_lower") : Parameter("loose_upper"));
}

/// Throws ConfigError if the restitution of a soft wall is given for one that is rigid at some point.
void check_restitution(const Settings& settings, Side side, const AxisGroups& groups) {
  const Setting* const given = of_wall(settings, "loose_wall_R", side);
  const std::array rigid{
      Condition{place_of_wall(settings, side), [](double place) { return std::isfinite(place); }},
      Condition{of_wall(settings, "loose_wall_stiffness", side), [](double kappa) { return std::isinf(kappa); }}};
  if (given == nullptr || rigid[0].given == nullptr || !point_with_all(settings, groups, rigid)) return;
  const std::string name(given->key->name), of_rigid = "loose_" + name.substr(name.find("R"));
  fail(given->key_location, in_quotes(name) + " is of a soft wall, and the " +
                                (side == Side::lower ? "lower" : "upper") + " one is rigid" +
                                (is_soft_wall_somewhere(settings, side) ? " at some points" : "") + "; give " +
                                in_quotes(of_rigid) + ", or a finite loose_wall_stiffness");
}

}  // namespace

bool is_soft_wall_somewhere(const Settings& settings, Side side) {
  const Setting *const kappa = of_wall(settings, "loose_wall_stiffness", side), *const place =
                                                                                    place_of_wall(settings, side);
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return kappa != nullptr && place != nullptr && std::ranges::any_of(kappa->numbers(), is_finite) &&
         std::ranges::any_of(place->numbers(), is_finite);
}

bool is_soft_wall_everywhere(const Settings& settings, Side side) {
  const Setting* const kappa = of_wall(settings, "loose_wall_stiffness", side);
  return kappa != nullptr && std::ranges::all_of(kappa->numbers(), [](double value) { return std::isfinite(value); });
}

void check_soft_walls(const Settings& settings, const AxisGroups& groups) {
  for (const Side side : {Side::lower, Side::upper}) {
    check_restitution(settings, side, groups);
    if (!is_soft_wall_somewhere(settings, side)) continue;
    const Setting& kappa = *of_wall(settings, "loose_wall_stiffness", side);
    const auto refuse = [&](const std::string& what, const std::string& way_out) {
      fail(kappa.key_location, in_quotes(kappa.key->name) + " conflicts with " + what + "; " + way_out);
    };
    if (settings.find("branch", "along") != nullptr)
      refuse("[branch]", "run a sweep, and give it follow, or take rigid walls");
    if (!settings.text("observe", "sensitivity").empty())
      refuse("observe.sensitivity", "run a sweep of the key, or take rigid walls");
  }
}

}  // namespace clatter::config
