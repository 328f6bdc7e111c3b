#include "config/unit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

namespace clatter::config {
namespace {

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr std::array symbols{
    Symbol{"m", {.exponents = {1, 0, 0}}},
    Symbol{"s", {.exponents = {0, 1, 0}}},
    Symbol{"N", {.exponents = {1, -2, 1}}},
    Symbol{"g", {.exponents = {0, 0, 1}, .ten = -3}},
    Symbol{"Hz", {.exponents = {0, -1, 0}, .angle = 1, .turns = 1}},
    Symbol{"rad", {.exponents = {}, .angle = 1}},
};

constexpr std::array<std::pair<std::string_view, int>, 10> prefixes{{{"n", -9},
                                                                     {"u", -6},
                                                                     {"\u00B5", -6},
                                                                     {"\u03BC", -6},
                                                                     {"m", -3},
                                                                     {"c", -2},
                                                                     {"d", -1},
                                                                     {"k", 3},
                                                                     {"M", 6},
                                                                     {"G", 9}}};

std::optional<Unit> symbol_named(std::string_view name) {
  for (const Symbol& symbol : symbols)
    if (symbol.name == name) return symbol.unit;
  return std::nullopt;
}

std::optional<Unit> prefixed(std::string_view name) {
  if (const auto plain = symbol_named(name)) return plain;
  for (const auto& [prefix, ten] : prefixes) {
    if (!name.starts_with(prefix)) continue;
    if (auto unit = symbol_named(name.substr(prefix.size()))) {
      unit->ten += ten;
      return unit;
    }
  }
  return std::nullopt;
}

void multiply(Unit& product, const Unit& unit, int power) {
  product.exponents.length += power * unit.exponents.length;
  product.exponents.time += power * unit.exponents.time;
  product.exponents.mass += power * unit.exponents.mass;
  product.angle += power * unit.angle, product.turns += power * unit.turns, product.ten += power * unit.ten;
}

/// Takes a name with its power, "s", "s2", "s^2" or "s-1", off the beginning of the text, and multiplies by it.
bool take_factor(std::string_view& text, bool divides, Unit& product) {
  constexpr int highest = 4;
  const std::size_t end = std::min(text.find_first_of(" */^-+0123456789"), text.size());
  const std::optional<Unit> unit = prefixed(text.substr(0, end));
  if (!unit) return false;
  text.remove_prefix(end);
  const bool caret = text.starts_with('^');
  if (caret) text.remove_prefix(1);
  int power = 1;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), power);
  const bool has_power = error == std::errc{};
  if ((caret && !has_power) || power == 0 || std::abs(power) > highest) return false;
  if (has_power) text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  multiply(product, *unit, divides ? -power : power);
  return true;
}

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(' '), text.size())); }

/// A quantity in words, and the unit of its numbers without one.
struct Name {
  Quantity quantity;
  std::string_view noun, unit;
};

constexpr std::array quantity_names{Name{Quantity::number, "a number without unit", ""},
                                    Name{Quantity::angle, "an angle", "rad"},
                                    Name{Quantity::length, "a length", "m"},
                                    Name{Quantity::time, "a time", "s"},
                                    Name{Quantity::frequency, "a frequency", "Hz"},
                                    Name{Quantity::velocity, "a velocity", "m/s"},
                                    Name{Quantity::mass, "a mass", "kg"},
                                    Name{Quantity::force, "a force", "N"},
                                    Name{Quantity::stiffness, "a stiffness", "N/m"},
                                    Name{Quantity::damping, "a damping", "N s/m"}};

/// Of the quantities that keys have.
const Name& name_of(Quantity quantity) {
  const auto found = std::ranges::find(quantity_names, quantity, &Name::quantity);
  return found == quantity_names.end() ? quantity_names.front() : *found;
}

int expected_angle(Quantity quantity) { return quantity == Quantity::angle || quantity == Quantity::frequency ? 1 : 0; }

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  constexpr std::size_t longest = 64;  // characters
  if (text.size() > longest) return std::nullopt;
  Unit unit;
  skip_blanks(text);
  for (bool divides = false;; skip_blanks(text)) {
    if (!take_factor(text, divides, unit)) return std::nullopt;
    skip_blanks(text);
    if (text.empty()) return unit;
    divides = text.starts_with('/');
    if (divides || text.starts_with('*')) text.remove_prefix(1);
  }
}

bool fits(const Unit& unit, Quantity quantity) {
  return unit.exponents == exponents_of(quantity) && unit.angle == expected_angle(quantity);
}

double in_si(double value, const Unit& unit, Quantity quantity) {
  const double ten = std::pow(10.0, std::abs(unit.ten));  // exact up to 22
  value = unit.ten < 0 ? value / ten : value * ten;
  const int turns = unit.turns - (quantity == Quantity::frequency ? 1 : 0);
  if (turns == 0) return value;
  return value * std::pow(2 * std::numbers::pi, turns);
}

std::string_view unit_of_numbers(Quantity quantity) { return name_of(quantity).unit; }

std::string description_of(Quantity quantity) {
  const auto& [known, noun, unit] = name_of(quantity);
  const std::string other = quantity == Quantity::frequency ? " or rad/s" : "";
  return std::string(noun) + (unit.empty() ? "" : " in ") + std::string(unit) + other;
}

}  // namespace clatter::config
