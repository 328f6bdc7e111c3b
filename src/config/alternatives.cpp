#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "config/consistency.hpp"
#include "config/force_shape.hpp"
#include "config/force_table.hpp"
#include "config/restitution.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// A stop that is not given does not exist; a scene without any was hardly meant.
void check_stops_given(const Settings& settings) {
  if (settings.given_symmetric_stops() || settings.given("stop_lower") || settings.given("stop_upper")) return;
  if (has_loose_mass(settings)) return;
  const std::string section(settings.scene_section), both = settings.is_si() ? "gap" : "xs";
  fail(settings.location_of_section(section), '\'' + both + "' is missing in [" + section + "]; give " + both +
                                                  ", or stop_lower, stop_upper or both (-inf and inf: no stop)");
}

bool is_zero(double value) { return value == 0; }

/// A key of a machine that isn't 0 at some point, or nullptr.
const Setting* not_zero(const Settings& settings, Parameter parameter) {
  const Setting* const given = settings.given(parameter);
  return given == nullptr || std::ranges::all_of(given->numbers(), is_zero) ? nullptr : given;
}

/// Whether a machine has no spring at some point.
bool lacks_spring(const Settings& settings) {
  const Setting* const given = settings.given("stiffness");
  return given == nullptr || std::ranges::any_of(given->numbers(), is_zero);
}

/// A machine needs a mass, a force its frequency, a damping ratio its spring.
void check_machine(const Settings& settings) {
  if (!settings.is_si()) return;
  if (settings.given("mass") == nullptr)
    fail(settings.location_of_section("machine"),
         "'mass' is missing in [machine]; give it in kg, or as e.g. \"250 g\"");
  for (const Parameter needs_frequency : std::array<Parameter, 5>{"force", "stop_amplitude", "base_amplitude",
                                                                  "stop_amplitude_lower", "stop_amplitude_upper"})
    if (const Setting* const given = not_zero(settings, needs_frequency);
        given != nullptr && settings.given("frequency") == nullptr)
      fail(given->key_location,
           in_quotes(given->key->name) + " without 'frequency'; add it to [machine] in Hz, or as e.g. \"25 Hz\"");
  for (const Parameter order : all_parameters)
    if (const Setting* const given = is_order_amplitude(order) ? not_zero(settings, order) : nullptr;
        given != nullptr && settings.given("frequency") == nullptr)
      fail(given->key_location, in_quotes(given->key->name) +
                                    " without 'frequency', of which it has a multiple; add it "
                                    "to [machine] in Hz, or as e.g. \"25 Hz\"");
  if (const Setting* const table = settings.find("machine", "force_table");
      table != nullptr && settings.given("frequency") == nullptr)
    fail(table->key_location,
         in_quotes("force_table") + " without 'frequency', to whose period it is stretched; add it to [machine] in Hz");
  for (const Parameter needs_spring : std::array<Parameter, 2>{"damping_ratio", "quality"})
    if (const Setting* const given = settings.given(needs_spring); given != nullptr && lacks_spring(settings))
      fail(given->key_location, in_quotes(given->key->name) +
                                    " where the stiffness is 0, to which it refers; give 'damping' in N s/m, or a "
                                    "stiffness everywhere");
}

/// start_period is the period of free motion without loss between symmetric stops (src/motion/README.md, eq. 36).
void check_start_period(const Settings& settings) {
  const Setting* const start = settings.given("start_period");
  if (start == nullptr) return;
  const auto demand = [&](Parameter parameter, double value) {
    const Setting* const given = settings.given(parameter);
    if (given == nullptr) return;
    for (std::size_t i = 0; i < given->numbers().size(); ++i) {
      if (given->numbers()[i] == value) continue;
      fail(given->location_of(i), std::string(given->key->name) + " = " + number_text(given->numbers()[i]) +
                                      " conflicts with 'start_period'; expected " + number_text(value) +
                                      ", or x0 and v0 in place of start_period");
    }
  };
  for (const Parameter parameter : std::array<Parameter, 3>{"h", "f", "load"}) demand(parameter, 0);
  for (const Parameter parameter : all_parameters)
    if (is_order_amplitude(parameter)) demand(parameter, 0);
  demand("stiffness", 1);
  for (const Parameter parameter : std::array<Parameter, 3>{"R", "R_lower", "R_upper"}) demand(parameter, 1);
  for (const Parameter parameter : std::array<Parameter, 3>{"R_below", "R_below_lower", "R_below_upper"})
    demand(parameter, 0);
  if (has_force_table(settings))
    fail(start->key_location,
         "'start_period' beside 'force_table'; it is of motion without a force: leave out one of them");
  if (has_speed_table(settings, "R"))
    fail(start->key_location, "'start_period' beside a restitution by speed; give x0 and v0 in its place");
  for (const Parameter parameter :
       std::array<Parameter, 3>{"stop_stiffness", "stop_stiffness_lower", "stop_stiffness_upper"})
    demand(parameter, std::numeric_limits<double>::infinity());
  if (!settings.given("xs"))
    fail(start->key_location,
         "'start_period' without 'xs'; give the stops by xs, or x0 and v0 in place of start_period");
}

void check_duration(const Settings& settings) {
  if (settings.text("time", "mode") != "transient" || settings.number("time", "duration") > 0) return;
  const Setting* const given = settings.find("time", "duration");
  if (given == nullptr)
    fail(settings.location_of_section("time"),
         "'duration' is missing in [time]; mode = transient needs a duration > 0");
  fail(given->location, "duration = 0 is out of range; expected > 0 with mode = transient");
}

/// The FFT of N samples gives the harmonics below N/2.
void check_harmonics(const Settings& settings) {
  const std::int64_t highest = settings.integer("observe", "harmonics");
  const std::int64_t samples = settings.integer("observe", "harmonics_samples");
  if (settings.text("observe", "harmonics_method") != "fft" || 2 * highest < samples) return;
  if (highest == 0) return;
  fail(settings.find("observe", "harmonics")->location,
       "harmonics = " + std::to_string(highest) + " from " + std::to_string(samples) +
           " samples; expected less than half of harmonics_samples, or harmonics_method = exact");
}

}  // namespace

void check_alternatives(const Settings& settings) {
  check_machine(settings);
  check_stops_given(settings);
  check_start_period(settings);
  check_duration(settings);
  check_harmonics(settings);
}

}  // namespace clatter::config
