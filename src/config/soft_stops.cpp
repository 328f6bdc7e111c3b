#include <algorithm>
#include <cmath>
#include <string>

#include "config/consistency.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

using enum sweep::Parameter;

/// The stiffness given for a stop, alone or for both; nullptr: it is rigid.
const Setting* stiffness_of(const Settings& settings, Side side) {
  const Setting* const both = settings.given(stop_stiffness);
  return both != nullptr ? both : settings.given(side == Side::lower ? stop_stiffness_lower : stop_stiffness_upper);
}

bool is_finite(double value) { return std::isfinite(value); }

/// Throws ConfigError if the spring pushes a mass away more strongly than a soft stop holds it.
void check_hold(const Settings& settings, Side side) {
  const Setting *const spring = settings.given(stiffness), *const stop = stiffness_of(settings, side);
  if (spring == nullptr || stop == nullptr) return;
  const double push = -*std::ranges::min_element(spring->numbers());
  const auto kappas = stop->numbers();
  const auto weakest = std::ranges::min_element(kappas);
  if (*weakest > push) return;
  fail(stop->location_of(static_cast<std::size_t>(weakest - kappas.begin())),
       std::string(stop->key->name) + " = " + number_text(*weakest) + " holds no mass that stiffness = " +
           number_text(-push) + " pushes away; expected more than " + number_text(push));
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

void check_soft_stops(const Settings& settings) {
  for (const Side side : {Side::lower, Side::upper}) check_hold(settings, side);
}

}  // namespace clatter::config
