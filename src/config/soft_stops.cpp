#include <algorithm>
#include <cmath>
#include <string>

#include "config/consistency.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// The stiffness given for a stop, alone or for both; nullptr: it is rigid.
const Setting* stiffness_of(const Settings& settings, Side side) {
  const Setting* const both = settings.given("stop_stiffness");
  return both != nullptr ? both
                         : settings.given(side == Side::lower ? Parameter("stop_stiffness_lower")
                                                              : Parameter("stop_stiffness_upper"));
}

bool is_finite(double value) { return std::isfinite(value); }

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

}  // namespace

bool is_soft_somewhere(const Settings& settings, Side side) {
  const Setting* const given = stiffness_of(settings, side);
  return given != nullptr && std::ranges::any_of(given->numbers(), is_finite);
}

bool is_soft_everywhere(const Settings& settings, Side side) {
  const Setting* const given = stiffness_of(settings, side);
  return given != nullptr && std::ranges::all_of(given->numbers(), is_finite);
}

void check_soft_stops(const Settings& settings, const AxisGroups& groups) {
  for (const Side side : {Side::lower, Side::upper}) check_hold(settings, side, groups);
}

}  // namespace clatter::config
