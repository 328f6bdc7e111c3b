#include "failures.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "coordinates.hpp"
#include "steady/status.hpp"

namespace clatter::app {
namespace {

std::span<const std::uint8_t> statuses_of(const sweep::Dataset& dataset) {
  const auto status = std::ranges::find(dataset.variables, "status", &sweep::Variable::name);
  const auto* const values =
      status == dataset.variables.end() ? nullptr : std::get_if<std::vector<std::uint8_t>>(&status->values);
  return values == nullptr ? std::span<const std::uint8_t>{} : *values;
}

/// The index in the sweep of the point with a local index in a run.
std::size_t point_of(const sweep::Share& share, std::size_t local_index) {
  for (std::size_t chain = 0; chain < share.count(); ++chain)
    for (std::size_t i = 0; i < share.length(); ++i)
      if (share.local_index(chain, i) == local_index) return share.point(chain, i);
  return local_index;
}

std::string example_text(const sweep::Sweep& sweep, std::size_t point) {
  const std::string coordinates = coordinates_text(sweep, point);
  return ", e.g. point " + std::to_string(point) + (coordinates.empty() ? "" : " at " + coordinates);
}

}  // namespace

std::string failures_text(const sweep::Dataset& dataset, const sweep::Sweep& sweep,
                          const std::optional<sweep::Shard>& shard) {
  const std::span<const std::uint8_t> statuses = statuses_of(dataset);
  const sweep::Share share(sweep, shard);
  std::string text;
  std::ptrdiff_t failures = 0;
  for (const auto& [status, name] : steady::status_names) {
    const auto value = static_cast<std::uint8_t>(status);
    const auto count = std::ranges::count(statuses, value);
    if (!steady::failed(status) || count == 0) continue;
    const auto first = static_cast<std::size_t>(std::ranges::find(statuses, value) - statuses.begin());
    (text += text.empty() ? " (" : "; ") += std::string(name) + ": " + std::to_string(count);
    text += example_text(sweep, point_of(share, first));
    failures += count;
  }
  return std::to_string(failures) + " failed" + text + (failures > 0 ? ")" : "");
}

}  // namespace clatter::app
