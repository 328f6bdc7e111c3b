#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "storage/error.hpp"
#include "storage/file_calls.hpp"

namespace clatter::storage {

/// Of the name of a journal, behind that of its output.
inline constexpr const char* journal_ending = ".journal";

/// Another run is writing the same output (exit code 75).
class BusyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws BusyError if a run is writing this output; for commands that write without a journal of their own.
void require_idle(const std::filesystem::path& output);

/// A run continues from a journal only if its key is the same.
struct JournalKey {
  std::string config;    ///< the complete configuration, as TOML
  std::string program;   ///< its version
  std::string rounding;  ///< all that its last bits depend on (`rounding_fingerprint`)
  std::string shard;     ///< "K/N"; empty: the whole sweep

  bool operator==(const JournalKey&) const = default;
};

/// A journal has the finished points of another run, one with another key.
class OtherRun : public IoError {
 public:
  OtherRun(const std::filesystem::path& output, JournalKey key);
  [[nodiscard]] const JournalKey& key() const { return key_; }

 private:
  JournalKey key_;
};

/// The most bytes that a record of a run can have.
struct RecordLimit {
  double bytes = 0.0;
  bool has_log = false;  ///< there is an impact log as well; only the size of the file bounds its length
};

/// The finished points of a run, kept in OUTPUT.journal until the output is written: a header with the key, then
/// records of bytes, all under CRC-32. The file grows only at its end. It is locked (`flock`) for the life of a
/// Journal, so that a second run on the same output is refused.
///
/// An incomplete last record, as a killed run leaves it, is cut. Anything else that doesn't fit is an error, and the
/// file stays as it is.
class Journal {
 public:
  enum class Begin : std::uint8_t {
    resume_if_any,  ///< from the records, if there are any
    resume,         ///< from the records; an error if there are none
    restart,        ///< anew
  };
  using ResultSink = std::function<void(std::span<const std::byte> record)>;

  /// Locks the journal of an output, and passes each of its records to `take`; one longer than `limit` is damaged.
  /// Throws BusyError, OtherRun, and IoError if the journal is damaged, or cannot be read or written.
  Journal(const std::filesystem::path& output, JournalKey key, const RecordLimit& limit, Begin begin,
          const ResultSink& take);
  /// Removes the file if it is empty.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Writes a record. Throws IoError; the records before are then still whole.
  void append(std::span<const std::byte> record);
  /// Waits until all records are on the disk. Throws IoError.
  void sync();
  [[nodiscard]] bool has_records() const { return size_ > 0; }
  /// Whether there are records, or were some whose space was given back.
  [[nodiscard]] bool had_records() const { return has_records() || gave_back_; }
  /// Whether the lock excludes other runs: some network file systems have no locks.
  [[nodiscard]] bool is_locked() const { return is_locked_; }
  /// Frees the space of the last records, at least so many bytes, if the file has as many. The records before stay.
  void give_back(std::uint64_t bytes);
  /// Removes the file, once its records are in the output.
  void remove();
  /// Ends without an output: removes an empty file, and returns a sentence on what the next run will find.
  [[nodiscard]] std::string leave();

 private:
  void lock();
  void unlink() const;
  void read(const ResultSink& take, const RecordLimit& limit, Begin begin);

  std::filesystem::path output_, path_;
  JournalKey key_;
  Descriptor file_{-1};
  std::uint64_t size_ = 0;              ///< of the file, in whole records
  std::uint64_t stored_ = 0;            ///< bytes that it took on its disk when it was opened
  std::vector<std::uint64_t> ends_;     ///< [record]: its end in the file
  bool synced_ = true, named_ = false;  ///< the data is on the disk; so is the name
  bool is_locked_ = true;
  bool gave_back_ = false;  ///< space of records was given back
};

}  // namespace clatter::storage
