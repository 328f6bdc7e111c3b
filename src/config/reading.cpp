#include "config/reading.hpp"

#include <cstdint>

#include "config/suggestion.hpp"
#include "config/unit.hpp"

namespace clatter::config {
namespace {

/// The first quantity for which this holds; nothing has a unit beyond the last.
template <class Holds>
std::optional<Quantity> quantity_that(const Holds& holds) {
  for (std::uint8_t number = 0; !si_unit(static_cast<Quantity>(number)).empty(); ++number)
    if (holds(static_cast<Quantity>(number))) return static_cast<Quantity>(number);
  return std::nullopt;
}

}  // namespace

Reading parse_reading(const SourceText& source) {
  const auto [value, rest] = parse_leading_number(source);
  if (rest.empty()) return {value, Quantity::number, {}};
  const std::optional<Unit> unit = parse_unit(rest);
  if (!unit) {
    const std::string comma = comma_hint_within(source.text);
    fail(source.location,
         "unknown unit " + in_quotes(rest) + (comma.empty() ? "; `clatter help units` explains units" : comma));
  }
  const auto quantity = quantity_that([&](Quantity known) { return fits(*unit, known); });
  if (!quantity) fail(source.location, "the unit " + in_quotes(rest) + " is that of nothing that clatter computes");
  return {in_si(value, *unit, *quantity), *quantity, std::string(rest)};
}

std::optional<Quantity> quantity_in(std::string_view unit) {
  return quantity_that([&](Quantity known) { return si_unit(known) == unit; });
}

double in_unit_of_file(const Reading& reading, std::string_view unit, const SourceLocation& location,
                       const std::string& what) {
  if (reading.unit.empty() || si_unit(reading.quantity) == unit) return reading.value;
  const std::string has =
      unit == si_unit(Quantity::number) ? " has none; give the number alone" : " is in " + std::string(unit);
  fail(location, "the unit " + in_quotes(reading.unit) + " doesn't fit: " + what + has);
}

}  // namespace clatter::config
