#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "results/dataset.hpp"
#include "results/shard.hpp"

namespace clatter::results {

/// The header of a shard's file.
struct ShardHeader {
  std::string path;
  Shard shard;
  std::string schema, version, git_commit, compiler;
  std::string config, config_sha256;
  std::string instruction_set{};  ///< of its lanes
  std::string rounding;           ///< all that its last bits depend on (`rounding_fingerprint`)
  std::uint64_t impacts = 0;      ///< number in its log
  std::uint64_t values = 0;       ///< number in all variables
};

/// The most values that a run writes by a shard's configuration; nothing if that can't be read.
using MostValues = std::function<std::optional<double>(const ShardHeader&)>;

/// Reads the header of a shard's file, if its checksum is right and it holds no more values than it can have. Throws
/// IoError.
[[nodiscard]] ShardHeader read_shard_header(const std::string& path, const MostValues& most_values);

/// Files of shards that are open at once, at most.
inline constexpr std::size_t most_open_shards = 128;

/// Reads parts of a shard's file whose header has been read. Throws IoError.
class ShardReader {
 public:
  explicit ShardReader(std::string path);
  ShardReader(ShardReader&&) noexcept;
  ShardReader& operator=(ShardReader&&) noexcept;
  ~ShardReader();

  /// The number of rows of a variable, the length of its first dimension; nothing if the file has none of this name.
  [[nodiscard]] std::optional<std::size_t> rows(const std::string& variable);
  /// The values of so many of its rows, from `first` on.
  [[nodiscard]] ValueArray values(const std::string& variable, std::size_t first, std::size_t rows);
  /// Closes the file until it is read again.
  void close();

 private:
  struct Open;
  [[nodiscard]] Open& open(const std::string& variable);

  std::string path_;
  std::unique_ptr<Open> open_;
};

}  // namespace clatter::results
