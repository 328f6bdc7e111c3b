#pragma once

#include <optional>
#include <string>

namespace clatter::results {

/// By what an output is told from others.
struct Origin {
  bool is_study = false;  ///< of `clatter accuracy`, else of `clatter run`
  std::string shard{};    ///< "K/N"; empty: all points
  std::string title{};

  bool operator==(const Origin&) const = default;
};

/// The origin of a file; nothing where it is no output of clatter, damaged, or cannot be read. Looks at little of it,
/// however large it is. Throws IoError where no process can be started to read it.
[[nodiscard]] std::optional<Origin> origin_of(const std::string& path);

}  // namespace clatter::results
