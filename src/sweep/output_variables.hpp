#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "point/point.hpp"
#include "results/dataset.hpp"
#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// A variable of the results, and how to extract it from a PointResult.
using OutputVariable = observables::Column<point::PointResult>;

/// The variables of a point's observables, except the impact log and the integer ones; for steady motion also the
/// estimate of its settling time.
[[nodiscard]] std::vector<OutputVariable> outputs_of(const point::RunSettings& settings);

/// Attributes that give the meanings of the values of a variable.
[[nodiscard]] std::vector<results::Attribute> flag_attributes(
    std::span<const std::pair<std::uint8_t, std::string_view>> meanings);

/// Those of `status`.
[[nodiscard]] std::vector<results::Attribute> status_flags();

/// Upper bound of the number of values in all variables of a sweep or a shard, except its impact log; an impact there
/// has `logged_values`.
[[nodiscard]] double most_values(const Sweep& sweep, const std::optional<results::Shard>& shard);
[[nodiscard]] double logged_values(const Sweep& sweep);

}  // namespace clatter::sweep
