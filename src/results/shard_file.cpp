#include "results/shard_file.hpp"

#include <hdf5_hl.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_plain.hpp"
#include "results/hdf5_shape.hpp"
#include "results/seal.hpp"
#include "storage/error.hpp"
#include "storage/guarded.hpp"
#include "storage/input_file.hpp"
#include "storage/packed.hpp"
#include "storage/utf8.hpp"
#include "sweep/columns.hpp"

namespace clatter {
namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::text_attribute;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw IoError(quoted_name(path) + " cannot be read: " + why + "; run its shard again");
}

/// Passes on what a function of an open file gives; whatever stops HDF5 becomes an IoError.
template <typename Read>
auto read_file(const std::string& path, Read read) try {
  const hdf5::QuietErrors quiet;
  const Handle file = hdf5::open_file(path);
  return read(file);
} catch (const hdf5::Failure& failure) {
  refuse(path, failure.what());
}

std::size_t length_of(const Handle& dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
}

template <typename Value>
Column values_of(const Handle& dataset) {
  std::vector<Value> values(length_of(dataset));
  if (!values.empty())
    checked(H5Dread(dataset, hdf5::type_of(Value{}).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

Column column_of(const Handle& dataset) {
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const bool is_integer = H5Tget_class(type) == H5T_INTEGER, is_wide = H5Tget_size(type) > 1;
  if (!is_integer) return values_of<double>(dataset);
  if (is_wide) return values_of<std::int64_t>(dataset);
  return H5Tget_sign(type) == H5T_SGN_NONE ? values_of<std::uint8_t>(dataset) : values_of<std::int8_t>(dataset);
}

void walk_variables(const Handle& file,
                    const std::function<void(const std::string& name, const Handle& dataset)>& visit) {
  for (const std::string& name : hdf5::variables_in(file)) {
    const Handle dataset = hdf5::open_variable(file, name);
    if (length_of(dataset) == 0 || H5Dget_storage_size(dataset) > 0) visit(name, dataset);  // not a bare scale
  }
}

/// How many values there are, without reading them.
std::uint64_t values_in(const Handle& file) {
  double values = 0;
  walk_variables(file, [&](const std::string&, const Handle& dataset) {
    double product = 1;
    for (const hsize_t length : hdf5::shape_of(dataset)) product *= static_cast<double>(length);
    values += product;
  });
  if (values > 1e18) throw hdf5::Failure("it holds an impossible length");
  return static_cast<std::uint64_t>(values);
}

/// Reads all values as `read_shard` does, and keeps none.
void try_values(const Handle& file) {
  std::vector<std::byte> memory(hdf5::largest_block);
  walk_variables(file, [&](const std::string&, const Handle& dataset) {
    const Handle type{H5Dget_type(dataset), H5Tclose}, native{H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose};
    hdf5::read_blocks(dataset, native, memory.data(), [](std::size_t) {});
  });
}

ShardHead head_of(const Handle& file, const std::string& path) {
  const std::optional<Shard> shard = shard_named(text_attribute(file, "shard"));
  if (!shard) throw hdf5::Failure("it doesn't say which shard it is");
  ShardHead head{.path = path,
                 .shard = *shard,
                 .schema = text_attribute(file, "clatter_schema"),
                 .version = text_attribute(file, "clatter_version"),
                 .git_commit = text_attribute(file, "git_commit"),
                 .compiler = text_attribute(file, "compiler"),
                 .config = text_attribute(file, "config"),
                 .config_sha256 = text_attribute(file, "config_sha256"),
                 .rounding = text_attribute(file, "rounding"),
                 .values = values_in(file)};
  if (checked(H5Lexists(file, "impact_tau", H5P_DEFAULT)) > 0)
    head.impacts = length_of(hdf5::open_variable(file, "impact_tau"));
  return head;
}

/// All of a head in one order, for both directions.
template <typename Pass, typename Head>
void pass_all(Pass& pass, Head& head) {
  pass(head.shard.number), pass(head.shard.of), pass(head.impacts), pass(head.values);
  for (auto* const text : {&head.schema, &head.version, &head.git_commit, &head.compiler, &head.config,
                           &head.config_sha256, &head.rounding})
    pass(*text);
}

/// What a shard claims to have is read into memory, so it must be no more than its size can hold and a run of its
/// configuration writes. One that this program cannot read is of another version, which the merge will say.
void require_possible(const ShardHead& head, std::uint64_t stored_bytes) try {
  const auto values = static_cast<double>(head.values);
  if (values > hdf5::most_deflated * static_cast<double>(stored_bytes))
    throw hdf5::Failure("it holds more values than its size can hold");
  const Sweep sweep = parse_config(head.config, head.path).sweep;
  const double logged = sweep.scene.observe.impact_log ? logged_values * static_cast<double>(head.impacts) : 0.0;
  if (values > most_values(sweep, head.shard) + logged)
    throw hdf5::Failure("it holds more values than a run of its configuration writes");
} catch (const ConfigError&) {
}

std::string packed(const ShardHead& head) {
  Packer packer;
  pass_all(packer, head);
  return std::move(packer).bytes();
}

}  // namespace

/// A child process reads all of it first: the seal tells damage, but a file may be anyone's.
ShardHead read_shard_head(const std::string& path) try {
  const std::uint64_t stored = open_input(path, shards_of_clatter).stored_bytes;
  const std::string bytes = guarded(
      [&] {
        require_sealed(path);
        return read_file(path, [&](const Handle& file) {
          const ShardHead head = head_of(file, path);
          require_possible(head, stored);
          try_values(file);
          return packed(head);
        });
      },
      limits_for(stored));
  ShardHead head{};
  head.path = path;
  Unpacker unpacker(bytes);
  pass_all(unpacker, head);
  if (!unpacker.complete() || head.shard.number >= head.shard.of || head.shard.of > Shard::most)
    refuse(path, "it disturbs the memory of the HDF5 library");
  return head;
} catch (const GuardedDeath& death) {
  refuse(path, death.what());
}

Figure read_shard(const std::string& path) {
  return read_file(path, [](const Handle& file) {
    Figure figure;
    walk_variables(file, [&](const std::string& name, const Handle& dataset) {
      figure.variables.push_back({name, {}, column_of(dataset), "", ""});
    });
    return figure;
  });
}

}  // namespace clatter
