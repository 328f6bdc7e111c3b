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

constexpr Unit degree{.angle = 1, .degrees = 1};

constexpr std::array all_symbols{
    Symbol{"m", true, {.exponents = {1, 0, 0}}},
    Symbol{"s", true, {.exponents = {0, 1, 0}}},
    Symbol{"N", true, {.exponents = {1, -2, 1}}},
    Symbol{"J", true, {.exponents = {2, -2, 1}}},
    Symbol{"W", true, {.exponents = {2, -3, 1}}},
    Symbol{"g", true, {.exponents = {0, 0, 1}, .ten = -3}},
    Symbol{"Hz", true, {.exponents = {0, -1, 0}, .angle = 1, .turns = 1}},
    Symbol{"rad", true, {.angle = 1}},
    Symbol{"min", false, {.exponents = {0, 1, 0}, .minutes = 1}},
    Symbol{"rpm", false, {.exponents = {0, -1, 0}, .angle = 1, .turns = 1, .minutes = -1}},
    Symbol{"deg", false, degree},
    Symbol{"\u00B0", false, degree},
    Symbol{"%", false, {.ten = -2}},
};

constexpr std::array prefixes{Prefix{"n", -9}, Prefix{"u", -6}, Prefix{"\u00B5", -6}, Prefix{"\u03BC", -6},
                              Prefix{"m", -3}, Prefix{"c", -2}, Prefix{"d", -1},      Prefix{"k", 3},
                              Prefix{"M", 6},  Prefix{"G", 9}};

const Symbol* symbol_named(std::string_view name) {
  const auto found = std::ranges::find(all_symbols, name, &Symbol::name);
  return found == all_symbols.end() ? nullptr : &*found;
}

void multiply(Unit& product, const Unit& unit, int power) {
  product.exponents.length += power * unit.exponents.length;
  product.exponents.time += power * unit.exponents.time;
  product.exponents.mass += power * unit.exponents.mass;
  product.angle += power * unit.angle, product.turns += power * unit.turns, product.degrees += power * unit.degrees;
  product.minutes += power * unit.minutes, product.ten += power * unit.ten;
}

/// Takes a name with its power, "s", "s2", "s^2" or "s-1", off the beginning of the text, and multiplies by it.
bool take_factor(std::string_view& text, bool divides, Unit& product) {
  constexpr int highest = 4;
  const std::size_t end = std::min(text.find_first_of(" */^-+0123456789"), text.size());
  const std::optional<Unit> unit = unit_of_word(text.substr(0, end));
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

/// A quantity in words, the unit of its numbers without one, and others that are no multiples of it.
struct Name {
  Quantity quantity;
  std::string_view noun, unit, others{};
};

constexpr std::array quantity_names{Name{Quantity::number, "a number without unit", ""},
                                    Name{Quantity::angle, "an angle", "rad", " or deg"},
                                    Name{Quantity::length, "a length", "m"},
                                    Name{Quantity::time, "a time", "s"},
                                    Name{Quantity::frequency, "a frequency", "Hz", ", rad/s, rpm or 1/min"},
                                    Name{Quantity::velocity, "a velocity", "m/s"},
                                    Name{Quantity::acceleration, "an acceleration", "m/s2"},
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

/// 1/min is a frequency in turns, as engines have; 1/s may be Hz or rad/s, and is none.
bool is_per_minute(const Unit& unit) { return unit.angle == 0 && unit.minutes == -1; }

double times_power(double value, double base, int power) {
  const double factor = std::pow(base, std::abs(power));  // of ten exact up to 22
  return power < 0 ? value / factor : value * factor;
}

}  // namespace

std::span<const Symbol> unit_symbols() { return all_symbols; }

std::span<const Prefix> unit_prefixes() { return prefixes; }

std::string unit_names() {
  std::string text;
  for (const Symbol& symbol : all_symbols) (text += text.empty() ? "" : ", ") += symbol.name;
  return text;
}

std::optional<Unit> unit_of_word(std::string_view word) {
  if (const Symbol* const plain = symbol_named(word)) return plain->unit;
  for (const auto& [prefix, ten] : prefixes) {
    if (!word.starts_with(prefix)) continue;
    const Symbol* const symbol = symbol_named(word.substr(prefix.size()));
    if (symbol == nullptr || !symbol->takes_prefix) continue;
    Unit unit = symbol->unit;
    unit.ten += ten;
    return unit;
  }
  return std::nullopt;
}

std::optional<Unit> parse_unit(std::string_view text) {
  constexpr std::size_t longest = 64;  // characters
  if (text.size() > longest) return std::nullopt;
  Unit unit;
  skip_blanks(text);
  bool divides = text.starts_with('1');  // one over a unit
  if (divides) {
    text.remove_prefix(1), skip_blanks(text);
    if (!text.starts_with('/')) return std::nullopt;
    text.remove_prefix(1);
  }
  for (;;) {
    skip_blanks(text);
    if (!take_factor(text, divides, unit)) return std::nullopt;
    skip_blanks(text);
    if (text.empty()) return unit;
    divides = text.starts_with('/');
    if (divides || text.starts_with('*')) text.remove_prefix(1);
  }
}

bool fits(const Unit& unit, Quantity quantity) {
  if (unit.exponents != exponents_of(quantity)) return false;
  return unit.angle == expected_angle(quantity) || (quantity == Quantity::frequency && is_per_minute(unit));
}

double in_si(double value, const Unit& unit, Quantity quantity) {
  const int cycles = quantity == Quantity::frequency && !is_per_minute(unit) ? 1 : 0;
  value = times_power(times_power(value, 10, unit.ten), 60, unit.minutes);
  value = times_power(value, 180, -unit.degrees);
  return times_power(value, std::numbers::pi, unit.degrees) * std::pow(2 * std::numbers::pi, unit.turns - cycles);
}

std::string_view unit_of_numbers(Quantity quantity) { return name_of(quantity).unit; }

std::string description_of(Quantity quantity) {
  const auto& [known, noun, unit, others] = name_of(quantity);
  return std::string(noun) + (unit.empty() ? "" : " in ") + std::string(unit) + std::string(others);
}

}  // namespace clatter::config
