#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "results/origin.hpp"
#include "storage/atomic_write.hpp"

namespace clatter::results {

/// Where an output goes. It takes the place of an older one of the same command, shard and title, as when a
/// configuration is run again; any other file that is there would be lost, and is kept.
class OutputPlace {
 public:
  /// `force`: any file may be replaced. Throws IoError where the output couldn't be written, or must not be.
  OutputPlace(std::string path, Origin origin, bool force);

  [[nodiscard]] const std::string& path() const { return path_; }

  /// As `publish` does. Throws IoError, too, where meanwhile a file has come that must not be replaced.
  void write_atomically(std::span<const std::byte> bytes, const storage::MakeRoom& make_room = storage::no_room) const;

 private:
  /// By what a file is told from another one, and from itself once it has changed: device, inode, size and times.
  using State = std::array<std::int64_t, 7>;

  [[nodiscard]] std::optional<State> state() const;
  void require_replaceable() const;

  std::string path_;
  Origin origin_;
  bool force_;
  std::optional<State> seen_;  ///< of the file that was there before the run
};

}  // namespace clatter::results
