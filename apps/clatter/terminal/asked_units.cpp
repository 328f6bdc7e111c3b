#include "terminal/asked_units.hpp"

#include <algorithm>

#include "config/config_error.hpp"
#include "config/reading.hpp"
#include "config/suggestion.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {

AskedUnits::AskedUnits(const std::vector<std::string>& words, const results::FileSummary& summary,
                       const std::string& path) {
  for (const std::string& word : words) {
    const std::string option = "--in " + config::in_quotes(word), one = "1 " + word;
    try {
      const config::Reading reading = config::parse_reading({one, {.source = option}});
      units_.push_back({word, reading.quantity, reading.value});
    } catch (const config::ConfigError& error) {
      throw ChoiceError(error.what());
    }
    const auto fits = [&](const results::FileSummary::Entry& entry) { return of(entry.units) == &units_.back(); };
    if (!std::ranges::any_of(summary.variables, fits))
      throw ChoiceError(option + ": " + storage::quoted_name(path) + " has no numbers in such a unit; leave it out");
  }
}

const AskedUnits::Unit* AskedUnits::of(std::string_view units) const {
  const std::optional<Quantity> quantity = config::quantity_in(units);
  if (!quantity || units == "1") return nullptr;
  const auto found = std::ranges::find(units_, *quantity, &Unit::quantity);
  return found == units_.end() ? nullptr : &*found;
}

}  // namespace clatter::app
