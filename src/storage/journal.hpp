#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Another run is writing the same output (exit code 75).
class BusyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws BusyError where a run is writing this output, for what writes it without a journal of its own.
void require_idle(const std::filesystem::path& output);

/// What has to be the same for a run to go on from a journal.
struct JournalKey {
  std::string config;    ///< the complete configuration, as TOML
  std::string program;   ///< its version
  std::string rounding;  ///< what its last bits depend on (`rounding_of`)
  std::string shard;     ///< "K/N"; empty: the whole sweep

  bool operator==(const JournalKey&) const = default;
};

/// The bytes that a run's record has at most.
struct RecordLimit {
  double bytes = 0.0;
  bool has_log = false;  ///< beside an impact log, which is as long as it is: only the file's size bounds it
};

/// What a run has finished, kept beside its output until that is written, in OUTPUT.journal: a header with the key,
/// then records of bytes, all under CRC-32. It grows only at its end. As long as there is a Journal, the file is locked
/// (`flock`), by which a second run on the same output is told.
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
  using ResultSink = std::function<void(std::span<const std::byte> record)>;

  /// Locks the journal of an output, and lets `take` have each record that is there; a longer one than `limit` is
  /// damaged. Throws BusyError, and IoError: where another configuration, shard, program or rounding has left it, it is
  /// damaged, or cannot be read or written.
  Journal(const std::filesystem::path& output, JournalKey key, const RecordLimit& limit, Begin begin,
          const ResultSink& take);
  /// An empty file is removed.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Writes a record. Throws IoError: what was there before is whole.
  void append(std::span<const std::byte> record);
  /// Waits until all records are on the disk. Throws IoError.
  void sync();
  [[nodiscard]] bool has_records() const { return size_ > 0; }
  /// Whether there is something to say of them: there are some, or their room was given back.
  [[nodiscard]] bool had_records() const { return has_records() || gave_back_; }
  /// Whether others are kept from this output: some network file systems have no locks.
  [[nodiscard]] bool is_locked() const { return is_locked_; }
  /// Gives the room of its last records back, at least so many bytes, if it has as many. The records before stay.
  void give_back(std::uint64_t bytes);
  /// Removes the file, once its records are in the output.
  void remove();
  /// Ends without an output: says what the next run will find. An empty file is removed.
  [[nodiscard]] std::string leave();

 private:
  void lock();
  void unlink() const;
  void read(const ResultSink& take, const RecordLimit& limit, Begin begin);
  [[noreturn]] void refuse_other(const JournalKey& key) const;

  std::filesystem::path output_, path_;
  JournalKey key_;
  Descriptor file_{-1};
  std::uint64_t size_ = 0;              ///< of the file, in whole records
  std::uint64_t stored_ = 0;            ///< bytes that it took on its disk when it was opened
  std::vector<std::uint64_t> ends_;     ///< of the records in the file
  bool synced_ = true, named_ = false;  ///< is on the disk; so is its name
  bool is_locked_ = true;
  bool gave_back_ = false;  ///< records that were finished
};

}  // namespace clatter::storage
