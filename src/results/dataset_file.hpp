#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "storage/file_writer.hpp"

namespace clatter::results {

/// The attributes of a file that its user gives, and how it is stored.
struct FileHead {
  std::string title;
  std::string source;
  std::string text;       ///< the complete configuration, as TOML that runs again (root attribute `config`)
  std::string comment{};  ///< on the configuration; empty: none
  int compression = 0;    ///< deflate level, 0 ... 9
};

/// Writes an HDF5 file that is netCDF-4 too: dimension scales, attributes, the whole configuration
/// (src/results/README.md). The same dataset and head give the same bytes, whether its values are in memory or made
/// meanwhile. Takes the values out of the dataset: the memory of a variable is released once it is written. Throws
/// IoError.
void write_file(storage::FileWriter& file, Dataset dataset, const FileHead& head);

/// Writes such a file with a checksum trailer (`require_checksum`), for a file that another run of clatter will read.
void write_file_with_checksum(storage::FileWriter& file, Dataset dataset, const FileHead& head);

/// The bytes of such a file.
[[nodiscard]] std::vector<std::byte> file_image(Dataset dataset, const FileHead& head);

/// The contents of a file that `clatter info` prints; shapes are dimension names with their lengths.
struct FileSummary {
  struct Entry {
    std::string name, type, units, long_name;
    std::vector<NamedLength> dimensions;
    std::string frame{};  ///< of displacements and velocities, if something is shaken

    /// The long name, and the frame, if there is one.
    [[nodiscard]] std::string meaning() const { return frame.empty() ? long_name : long_name + ", " + frame; }
  };
  std::vector<std::pair<std::string, std::string>> attributes;  ///< root attributes in their order, `config` among them
  std::vector<Entry> variables;
  std::vector<std::pair<std::string, std::size_t>> status_counts;  ///< flag meaning and number of points that have it
};

/// Throws the IoError of a file that is damaged.
[[noreturn]] void refuse_damaged(const std::string& path, const std::string& why);

/// Reads a clatter file. Throws IoError if it cannot be read, is no HDF5 file, or was not written by clatter.
[[nodiscard]] FileSummary read_summary(const std::string& path);

/// Reads the values of some variables of such a file, in this order, with the meanings of flags. Throws IoError.
[[nodiscard]] Dataset read_variables(const std::string& path, const std::vector<std::string>& names);

/// Reads all values of such a file, and keeps none, in a process that the HDF5 library may crash. Throws IoError.
void require_readable(const FileSummary& summary, const std::string& path);

}  // namespace clatter::results
