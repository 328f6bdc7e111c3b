#include <limits>
#include <string>

#include "config/consistency.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

using enum sweep::Parameter;

/// A stop that is not given does not exist; a scene without any was hardly meant.
void check_stops_given(const Settings& settings) {
  if (settings.given(xs) || settings.given(stop_lower) || settings.given(stop_upper)) return;
  fail(settings.location_of_section("scene"),
       "'xs' is missing in [scene]; give xs, or stop_lower, stop_upper or both (-inf and inf: no stop)");
}

/// start_period is the period of free motion without loss between symmetric stops (src/motion/README.md, eq. 36).
void check_start_period(const Settings& settings) {
  const Setting* const start = settings.given(start_period);
  if (start == nullptr) return;
  const auto demand = [&](sweep::Parameter parameter, double value) {
    const Setting* const given = settings.given(parameter);
    if (given == nullptr) return;
    for (std::size_t i = 0; i < given->numbers().size(); ++i) {
      if (given->numbers()[i] == value) continue;
      fail(given->location_of(i), std::string(given->key->name) + " = " + number_text(given->numbers()[i]) +
                                      " conflicts with 'start_period'; expected " + number_text(value) +
                                      ", or x0 and v0 in place of start_period");
    }
  };
  for (const sweep::Parameter parameter : {h, f, load}) demand(parameter, 0);
  demand(stiffness, 1);
  for (const sweep::Parameter parameter : {R, R_lower, R_upper}) demand(parameter, 1);
  for (const sweep::Parameter parameter : {stop_stiffness, stop_stiffness_lower, stop_stiffness_upper})
    demand(parameter, std::numeric_limits<double>::infinity());
  if (!settings.given(xs))
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
  check_stops_given(settings);
  check_start_period(settings);
  check_duration(settings);
  check_harmonics(settings);
}

}  // namespace clatter::config
