#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "steady/status.hpp"

namespace clatter::sweep {

/// How many points have each status, and the first of them.
class StatusTally {
 public:
  struct Entry {
    std::size_t points = 0;
    std::size_t first = 0;  ///< local index (`Share`)
  };

  /// Adds the statuses of the points that follow those before.
  void add(std::span<const std::uint8_t> statuses) {
    for (const std::uint8_t status : statuses) {
      Entry& entry = entries_[status];
      if (entry.points++ == 0) entry.first = points_;
      ++points_;
    }
  }

  [[nodiscard]] const Entry& of(steady::Status status) const { return entries_[static_cast<std::uint8_t>(status)]; }
  [[nodiscard]] std::size_t failed() const {
    std::size_t points = 0;
    for (const auto& [status, name, meaning] : steady::status_names)
      if (steady::failed(status)) points += of(status).points;
    return points;
  }

 private:
  std::array<Entry, 256> entries_{};
  std::size_t points_ = 0;
};

}  // namespace clatter::sweep
