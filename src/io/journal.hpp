#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/file_calls.hpp"

namespace clatter {

/// Another run is writing the same output (exit code 75).
class BusyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What has to be the same for a run to go on from a journal.
struct JournalKey {
  std::string config;   ///< the complete configuration, as TOML
  std::string program;  ///< its version
  std::string arch;     ///< the instruction set, on which the last bits depend

  bool operator==(const JournalKey&) const = default;
};

/// The finished parts of a run, kept beside its output until that is written, in OUTPUT.journal: a header with the key,
/// then a record for each part, its number and bytes, all under CRC-32. It grows only at its end. As long as there is a
/// Journal, the file is locked (`flock`), by which a second run on the same output is told.
///
/// What a killed run has left of a last record is cut. Anything else that doesn't fit is an error, and the file stays
/// as it is.
class Journal {
 public:
  enum class Begin : std::uint8_t {
    anyhow,   ///< from the records, where there are any
    resume,   ///< from the records; an error where there are none
    restart,  ///< anew
  };
  using Take = std::function<void(std::uint64_t number, std::span<const std::byte> bytes)>;

  /// Locks the journal of an output, and lets `take` have each record that is there. Throws BusyError, and IoError:
  /// where another configuration, program or instruction set has left it, it is damaged, or cannot be read or written.
  Journal(const std::filesystem::path& output, JournalKey key, Begin begin, const Take& take);
  /// Saves what it can, for a run that has failed; an empty file is removed.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Adds a record; any thread may, at any time. It is written by the next `save`.
  void add(std::uint64_t number, std::span<const std::byte> bytes);
  /// Writes what was added since the last time, as far as the disk. Throws IoError: what was there before is whole.
  void save();
  /// Removes the file, once its records are in the output.
  void remove();
  /// Ends without an output: says what the next run will find. An empty file is removed.
  [[nodiscard]] std::string leave();

  [[nodiscard]] std::uint64_t records() const { return records_; }  ///< that are in the file

 private:
  void lock();
  void read(const Take& take, Begin begin);

  std::filesystem::path output_, path_;
  JournalKey key_;
  Descriptor file_{-1};
  std::uint64_t size_ = 0;  ///< of the file, in whole records
  std::uint64_t records_ = 0;
  std::mutex adding_, saving_;
  std::vector<std::byte> added_;
  std::uint64_t adds_ = 0;  ///< records in it
};

}  // namespace clatter
