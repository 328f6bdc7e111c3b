#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "results/origin.hpp"
#include "storage/atomic_write.hpp"

namespace clatter::results {

/// The path of an output. An older output of the same command, shard and title is replaced, as when a configuration is
/// run again; any other file there would be lost, so it is kept.
class OutputPlace {
 public:
  /// `force`: any file may be replaced. Throws IoError if the output can't be written, or would replace another file.
  OutputPlace(std::string path, Origin origin, bool force);

  [[nodiscard]] const std::string& path() const { return path_; }

  /// As `storage::write_atomically`; also throws IoError if a file has appeared meanwhile that must not be replaced.
  void write_atomically(const std::function<void(storage::FileWriter&)>& write,
                        const storage::MakeRoom& make_room = storage::no_room) const;

 private:
  /// Device, inode, size and times of a file, which tell whether it is another one or has changed.
  using State = std::array<std::int64_t, 7>;

  [[nodiscard]] std::optional<State> state() const;
  void require_replaceable() const;

  std::string path_;
  Origin origin_;
  bool force_;
  std::optional<State> seen_;  ///< state of the file that was there before the run
};

}  // namespace clatter::results
