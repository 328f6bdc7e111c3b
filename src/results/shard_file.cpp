#include "results/shard_file.hpp"

#include <hdf5.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/checksum_trailer.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_plain.hpp"
#include "results/hdf5_shape.hpp"
#include "results/hdf5_values.hpp"
#include "storage/error.hpp"
#include "storage/input_file.hpp"
#include "storage/packed.hpp"
#include "storage/run_in_child.hpp"
#include "storage/utf8.hpp"

namespace clatter::results {
namespace {

using detail::checked;
using detail::Handle;
using detail::text_attribute;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw storage::IoError(storage::quoted_name(path) + " cannot be read: " + why + "; run its shard again");
}

/// Returns the result of a function of the open file; any failure of HDF5 becomes an IoError.
template <typename Read>
auto read_file(const std::string& path, Read read) try {
  const detail::QuietErrors quiet;
  const Handle file = detail::open_file(path);
  return read(file);
} catch (const detail::Failure& failure) {
  refuse(path, failure.what());
}

void walk_variables(const Handle& file,
                    const std::function<void(const std::string& name, const Handle& dataset)>& visit) {
  for (const std::string& name : detail::variables_in(file)) {
    const Handle dataset = detail::open_variable(file, name);
    if (detail::length_of(dataset) == 0 || H5Dget_storage_size(dataset) > 0) visit(name, dataset);  // not a bare scale
  }
}

/// The number of values, without reading them.
std::uint64_t values_in(const Handle& file) {
  double values = 0;
  walk_variables(file, [&](const std::string&, const Handle& dataset) {
    double product = 1;
    for (const hsize_t length : detail::shape_of(dataset)) product *= static_cast<double>(length);
    values += product;
  });
  if (values > 1e18) throw detail::Failure("it holds an impossible length");
  return static_cast<std::uint64_t>(values);
}

/// Reads all values as `ShardReader` does, and keeps none.
void try_values(const Handle& file) {
  walk_variables(file, [](const std::string&, const Handle& dataset) { detail::try_values(dataset); });
}

ShardHeader header_of(const Handle& file, const std::string& path) {
  const std::optional<Shard> shard = shard_named(text_attribute(file, "shard"));
  if (!shard) throw detail::Failure("it doesn't say which shard it has");
  ShardHeader header{.path = path,
                     .shard = *shard,
                     .schema = text_attribute(file, "clatter_schema"),
                     .version = text_attribute(file, "clatter_version"),
                     .git_commit = text_attribute(file, "git_commit"),
                     .compiler = text_attribute(file, "compiler"),
                     .config = text_attribute(file, "config"),
                     .config_sha256 = text_attribute(file, "config_sha256"),
                     .instruction_set = text_attribute(file, "instruction_set"),
                     .rounding = text_attribute(file, "rounding"),
                     .values = values_in(file)};
  if (checked(H5Lexists(file, "impact_tau", H5P_DEFAULT)) > 0)
    header.impacts = detail::length_of(detail::open_variable(file, "impact_tau"));
  return header;
}

/// All fields of a header in one order, to pack and to unpack.
template <typename Pass, typename Header>
void pass_header(Pass& pass, Header& header) {
  pass(header.shard.number), pass(header.shard.of), pass(header.impacts), pass(header.values);
  for (auto* const text : {&header.schema, &header.version, &header.git_commit, &header.compiler, &header.config,
                           &header.config_sha256, &header.instruction_set, &header.rounding})
    pass(*text);
}

/// Throws if a shard claims more values than its size can hold or a run of its configuration writes, since a run of
/// its configuration has to have all of them.
void require_possible(const ShardHeader& header, std::uint64_t stored_bytes, const MostValues& most_values) {
  const auto values = static_cast<double>(header.values);
  if (values > detail::most_deflated * static_cast<double>(stored_bytes))
    throw detail::Failure("it holds more values than its size can hold");
  const std::optional<double> most = most_values(header);
  if (most && values > *most) throw detail::Failure("it holds more values than a run of its configuration writes");
}

std::string packed(const ShardHeader& header) {
  storage::Packer packer;
  pass_header(packer, header);
  return std::move(packer).bytes();
}

}  // namespace

/// A child process reads all of it first: the checksum shows damage, but the file may be of any origin.
ShardHeader read_shard_header(const std::string& path, const MostValues& most_values) try {
  const std::uint64_t stored = storage::open_input(path, shards_of_clatter).stored_bytes;
  const std::string bytes = storage::run_in_child(
      [&] {
        require_checksum(path);
        return read_file(path, [&](const Handle& file) {
          const ShardHeader header = header_of(file, path);
          require_possible(header, stored, most_values);
          try_values(file);
          return packed(header);
        });
      },
      storage::limits_for(stored));
  ShardHeader header{};
  header.path = path;
  storage::Unpacker unpacker(bytes);
  pass_header(unpacker, header);
  if (!unpacker.complete() || header.shard.number >= header.shard.of || header.shard.of > Shard::most)
    refuse(path, "it makes the HDF5 library corrupt its memory");
  return header;
} catch (const storage::ChildFailed& death) {
  refuse(path, death.what());
}

/// The file, and of its variables the one that is read.
struct ShardReader::Open {
  explicit Open(const std::string& path) : file(detail::open_file(path)) {}

  detail::QuietErrors quiet;
  Handle file;
  std::string name;
  std::optional<Handle> variable;
};

ShardReader::ShardReader(std::string path) : path_(std::move(path)) {}
ShardReader::ShardReader(ShardReader&&) noexcept = default;
ShardReader& ShardReader::operator=(ShardReader&&) noexcept = default;
ShardReader::~ShardReader() = default;

ShardReader::Open& ShardReader::open(const std::string& variable) {
  if (!open_) open_ = std::make_unique<Open>(path_);
  if (open_->variable && open_->name == variable) return *open_;
  open_->variable.reset(), open_->name = variable;
  if (checked(H5Lexists(open_->file, variable.c_str(), H5P_DEFAULT)) > 0)
    open_->variable.emplace(detail::open_variable(open_->file, variable));
  return *open_;
}

std::optional<std::size_t> ShardReader::rows(const std::string& variable) try {
  const Open& there = open(variable);
  if (!there.variable) return std::nullopt;
  const detail::Shape shape = detail::shape_of(*there.variable);
  return shape.empty() ? 1 : static_cast<std::size_t>(shape.front());
} catch (const detail::Failure& failure) {
  refuse(path_, failure.what());
}

ValueArray ShardReader::values(const std::string& variable, std::size_t first, std::size_t rows) try {
  const Open& there = open(variable);
  if (!there.variable) throw detail::Failure("it has no '" + variable + "'");
  return detail::rows_of(*there.variable, first, rows);
} catch (const detail::Failure& failure) {
  refuse(path_, failure.what());
}

void ShardReader::close() { open_.reset(); }

}  // namespace clatter::results
