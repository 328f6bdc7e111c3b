#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "config/force_table.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// Six digits.
std::string rough_text(double value) {
  std::ostringstream digits;
  digits << value;
  return digits.str();
}

/// By how much the period of a measured force is stretched to that of the frequency; empty: not at all.
std::string stretch_of_force(const Settings& settings) {
  const std::optional<MeasuredForce>& force = settings.measured_force;
  if (!force || force->period == 0) return {};
  const Parameter frequency = settings.is_si() ? Parameter("frequency") : Parameter("nu");
  const Setting* const given = settings.given(frequency);
  const auto stretch = [&](double value) {
    return (settings.is_si() ? 1 / value : 2 * std::numbers::pi / value) / force->period;
  };
  std::vector<double> stretches;
  if (given == nullptr)
    stretches.push_back(stretch(1.0));
  else
    for (const double value : given->numbers()) stretches.push_back(stretch(value));
  const auto [least, most] = std::ranges::minmax(stretches);
  if (std::abs(least - 1) < 1e-9 && std::abs(most - 1) < 1e-9) return {};
  return "a force measured over " + number_text(force->period) + (settings.is_si() ? " s" : " of tau") +
         ", stretched by " + rough_text(least) + (least == most ? "" : " to " + rough_text(most)) +
         " to the period of " + std::string(frequency.key());
}

/// The orders that are taken of a measured force, and what they leave out; empty if its lines are.
std::string orders_of_force(const Settings& settings) {
  const std::size_t count = harmonics_of_table(settings);
  if (!settings.measured_force || count == 0) return {};
  return "of the measured force its mean and " + (count == 1 ? "first order" : std::to_string(count) + " orders") +
         ", without " + rough_text(settings.measured_force->table.harmonics(count).left_out) + " of its mean square";
}

}  // namespace

std::string told_of_force_table(const Settings& settings) {
  const std::string stretch = stretch_of_force(settings), orders = orders_of_force(settings);
  return stretch + (stretch.empty() || orders.empty() ? "" : "; ") + orders;
}

}  // namespace clatter::config
