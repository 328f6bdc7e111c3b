#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sweep/sweep.hpp"

namespace clatter::app {

/// A number in a printf format for one double.
[[nodiscard]] std::string formatted(const char* format, double value);

/// "1 point", "2 points".
[[nodiscard]] std::string counted(double count, const char* noun);

/// "12.5 KiB", "1.25 GiB".
[[nodiscard]] std::string bytes_text(double bytes);

/// "nu = 0.5, xs = -3"; empty if nothing is swept.
[[nodiscard]] std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point);

/// A unit of a file as people write it: "m/s" for "m s-1", "1/s" for "s-1"; empty for "1".
[[nodiscard]] std::string unit_text(std::string_view units);

}  // namespace clatter::app
