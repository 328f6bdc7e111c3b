#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "results/dataset_file.hpp"
#include "terminal/asked_units.hpp"

namespace clatter::app {

/// The shares of the points below each quantile that is told.
inline constexpr std::array<double, 5> told_shares{0.05, 0.25, 0.5, 0.75, 0.95};

/// The quantiles of a result over the points of a sample: the values that so large a share of them doesn't exceed, with
/// linear interpolation between neighbours (R's and NumPy's default; Hyndman & Fan 1996, definition 7).
struct Quantiles {
  std::string result;  ///< or its component, "v_before[-1]"
  std::string units;
  std::string per;     ///< "per forcing period", if the file has totals over another time; else empty
  std::size_t points;  ///< that have a value: failed points and NaN don't count
  std::array<double, told_shares.size()> values{};  ///< in the order of `told_shares`
};

/// The axes of a file whose values are a sample of a range, by `sobol(a, b, n)`.
[[nodiscard]] std::vector<std::string> sampled_axes(const results::FileSummary& summary);

/// The quantiles of each result of numbers in a file whose points are one sample; empty for any other file. Throws
/// IoError if it can't be read or contradicts itself.
[[nodiscard]] std::vector<Quantiles> quantiles_of(const results::FileSummary& summary, const std::string& path);

/// The quantiles as a table, a line a result: "Quantiles over R, gap"; why there are none if the file has a sample and
/// other axes; empty without a sample.
[[nodiscard]] std::string quantiles_text(const results::FileSummary& summary, const std::vector<Quantiles>& quantiles,
                                         const AskedUnits& asked);

}  // namespace clatter::app
