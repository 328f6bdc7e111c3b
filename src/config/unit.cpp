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

std::string description_of(Quantity quantity) {
  constexpr std::array<std::pair<Quantity, std::string_view>, 10> names{
      {{Quantity::angle, "an angle in rad"},
       {Quantity::length, "a length in m"},
       {Quantity::time, "a time in s"},
       {Quantity::frequency, "a frequency in Hz or rad/s"},
       {Quantity::velocity, "a velocity in m/s"},
       {Quantity::mass, "a mass in kg"},
       {Quantity::force, "a force in N"},
       {Quantity::stiffness, "a stiffness in N/m"},
       {Quantity::damping, "a damping in N s/m"},
       {Quantity::number, "a number without unit"}}};
  for (const auto& [known, name] : names)
    if (known == quantity) return std::string(name);
  return std::string(si_unit(quantity));
}

}  // namespace clatter::config
