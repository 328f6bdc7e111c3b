#include "failures.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "coordinates.hpp"
#include "dynamics/scene.hpp"

namespace clatter {
namespace {

std::span<const std::uint8_t> statuses_of(const Figure& figure) {
  const auto status = std::ranges::find(figure.variables, "status", &Variable::name);
  const auto* const values =
      status == figure.variables.end() ? nullptr : std::get_if<std::vector<std::uint8_t>>(&status->values);
  return values == nullptr ? std::span<const std::uint8_t>{} : *values;
}

/// The number in the sweep of the point that has a place in the results of a run.
std::size_t point_of(const Share& share, std::size_t slot) {
  for (std::size_t branch = 0; branch < share.count(); ++branch)
    for (std::size_t i = 0; i < share.length(); ++i)
      if (share.slot(branch, i) == slot) return share.point(branch, i);
  return slot;
}

std::string example_text(const Sweep& sweep, std::size_t point) {
  const std::string coordinates = coordinates_text(sweep, point);
  return ", e.g. point " + std::to_string(point) + (coordinates.empty() ? "" : " at " + coordinates);
}

}  // namespace

std::string failures_text(const Figure& figure, const Sweep& sweep, const std::optional<Shard>& shard) {
  const std::span<const std::uint8_t> statuses = statuses_of(figure);
  const Share share(sweep, shard);
  std::string text;
  std::ptrdiff_t failures = 0;
  for (const auto& [status, name] : status_names) {
    const auto value = static_cast<std::uint8_t>(status);
    const auto count = std::ranges::count(statuses, value);
    if (!failed(status) || count == 0) continue;
    const auto first = static_cast<std::size_t>(std::ranges::find(statuses, value) - statuses.begin());
    (text += text.empty() ? " (" : "; ") += std::string(name) + ": " + std::to_string(count);
    text += example_text(sweep, point_of(share, first));
    failures += count;
  }
  return std::to_string(failures) + " failed" + text + (failures > 0 ? ")" : "");
}

}  // namespace clatter
