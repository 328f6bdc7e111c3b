#include "config/axis_functions.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "config/value_grammar.hpp"

namespace clatter::config {
namespace {

using Arguments = std::array<double, 3>;

/// Says what is wrong with a number of values; empty if nothing is.
std::string wrong_count(double count) {
  if (!(count >= 1) || count != std::floor(count)) {
    return "n = " + number_text(count) + " values; expected a whole number from 1 to " + number_text(max_axis_values);
  }
  if (count > max_axis_values) return number_text(count) + " values; expected at most " + number_text(max_axis_values);
  return {};
}

bool all_finite(const Arguments& arguments) {
  return std::all_of(arguments.begin(), arguments.end(), [](double argument) { return std::isfinite(argument); });
}

constexpr const char* not_finite = "an argument is not finite; expected finite numbers";

std::string linspace(const Arguments& arguments, std::vector<double>& values) {
  const auto [a, b, n] = arguments;
  if (!all_finite(arguments)) return not_finite;
  if (std::string mistake = wrong_count(n); !mistake.empty()) return mistake;
  if (!std::isfinite((b - a) * n))
    return "linspace spans more than double precision holds; expected ends closer together";
  values.resize(static_cast<std::size_t>(n), a);
  for (std::size_t i = 1; i < values.size(); ++i) values[i] = a + static_cast<double>(i) * (b - a) / (n - 1);
  if (n > 1) values.back() = b;
  return {};
}

std::string logspace(const Arguments& arguments, std::vector<double>& values) {
  const auto [a, b, n] = arguments;
  if (!all_finite(arguments)) return not_finite;
  if (a == 0 || b == 0 || std::signbit(a) != std::signbit(b)) {
    return "logspace from " + number_text(a) + " to " + number_text(b) +
           "; expected two ends of the same sign, neither of them 0";
  }
  if (std::string mistake = wrong_count(n); !mistake.empty()) return mistake;
  values.resize(static_cast<std::size_t>(n), a);
  // extended precision holds every ratio b/a and gives 1, 10, 100 without an error in the last digit
  const long double ratio = static_cast<long double>(b) / a;
  for (std::size_t i = 1; i < values.size(); ++i) {
    values[i] =
        static_cast<double>(a * std::pow(ratio, static_cast<long double>(i) / (static_cast<long double>(n) - 1)));
  }
  if (n > 1) values.back() = b;
  return {};
}

std::string arange(const Arguments& arguments, std::vector<double>& values) {
  const auto [a, b, step] = arguments;
  if (!all_finite(arguments)) return not_finite;
  if (step == 0) return "a step of 0; expected a step that leads from a to b";
  const double steps = (b - a) / step;
  // a value that differs from b by rounding alone is b, which is excluded
  const double tolerance = std::max(1e-9, 4 * std::numeric_limits<double>::epsilon() * std::abs(steps));
  const double count = std::ceil(steps - tolerance);
  if (!(count >= 1))
    return "an empty axis: no value from " + number_text(a) + " to " + number_text(b) +
           ", which is excluded, in steps of " + number_text(step);
  if (std::string mistake = wrong_count(count); !mistake.empty()) return mistake;
  values.resize(static_cast<std::size_t>(count), a);  // a itself, since -0 plus 0 would lose its sign
  for (std::size_t i = 1; i < values.size(); ++i) values[i] = a + static_cast<double>(i) * step;
  return {};
}

std::string sobol(const Arguments& arguments, std::vector<double>& values) {
  const auto [a, b, n] = arguments;
  if (!all_finite(arguments)) return not_finite;
  if (std::string mistake = wrong_count(n); !mistake.empty()) return mistake;
  if (!std::isfinite(b - a)) return "sobol spans more than double precision holds; expected ends closer together";
  values = sobol_values(a, b, static_cast<std::size_t>(n), 0, 1);
  return {};
}

constexpr std::array<std::string_view, 4> function_names{"linspace", "logspace", "arange", sobol_name};
constexpr std::array<AxisFunction, 4> functions{AxisFunction{function_names[0], "linspace(a, b, n)", true, linspace},
                                                AxisFunction{function_names[1], "logspace(a, b, n)", true, logspace},
                                                AxisFunction{function_names[2], "arange(a, b, step)", false, arange},
                                                AxisFunction{function_names[3], "sobol(a, b, n)", true, sobol}};

}  // namespace

std::optional<AxisFunction> axis_function(std::string_view name) {
  for (const AxisFunction& function : functions) {
    if (function.name == name) return function;
  }
  return std::nullopt;
}

std::vector<double> sobol_values(double a, double b, std::size_t n, std::size_t dimension, std::size_t dimensions) {
  boost::random::sobol sequence(dimensions);
  std::vector<double> values(n);
  for (double& value : values)
    for (std::size_t i = 0; i < dimensions; ++i) {
      const std::uint64_t digits = sequence();
      if (i == dimension) value = a + (b - a) * std::ldexp(static_cast<double>(digits >> 11), -53);
    }
  return values;
}

std::span<const std::string_view> axis_function_names() { return function_names; }

}  // namespace clatter::config
