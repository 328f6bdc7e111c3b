#pragma once

#include <optional>
#include <string>

namespace clatter::results {

/// The command, shard and title of an output, which distinguish it from others.
struct Origin {
  std::string command = "run";  ///< that wrote it: run, accuracy or branch
  std::string shard{};          ///< "K/N"; empty: all points
  std::string title{};

  bool operator==(const Origin&) const = default;
};

/// The origin of a file; nothing if it is no output of clatter, damaged, or cannot be read. Reads little of it, however
/// large it is. Throws IoError if no process can be started to read it.
[[nodiscard]] std::optional<Origin> origin_of(const std::string& path);

}  // namespace clatter::results
