#include "io/shard_file.hpp"

#include <hdf5_hl.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/error.hpp"
#include "io/guarded.hpp"
#include "io/hdf5_attributes.hpp"
#include "io/hdf5_handle.hpp"
#include "io/seal.hpp"

namespace clatter {
namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::text_attribute;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw IoError("'" + path + "' cannot be read: " + why + "; run its shard again");
}

/// Passes on what a function of an open file gives; whatever stops HDF5 becomes an IoError.
template <typename Read>
auto read_file(const std::string& path, Read read) try {
  const hdf5::QuietErrors quiet;
  const Handle file{H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  return read(file);
} catch (const hdf5::Failure& failure) {
  refuse(path, failure.what());
}

Handle dataset_in(const Handle& file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
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

herr_t add_variable(hid_t file, const char* name, const H5L_info_t*, void* figure) try {
  const Handle dataset{H5Dopen2(file, name, H5P_DEFAULT), H5Dclose};
  if (length_of(dataset) > 0 && H5Dget_storage_size(dataset) == 0) return 0;  // a dimension's name alone
  static_cast<Figure*>(figure)->variables.push_back({name, {}, column_of(dataset), "", ""});
  return 0;
} catch (const std::exception&) {  // the library, which calls this, isn't made for them
  return -1;
}

ShardHead head_of(const std::string& path) {
  return read_file(path, [&](const Handle& file) {
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
                   .instruction_set = text_attribute(file, "instruction_set")};
    if (checked(H5Lexists(file, "impact_tau", H5P_DEFAULT)) > 0)
      head.impacts = length_of(dataset_in(file, "impact_tau"));
    return head;
  });
}

}  // namespace

/// A child process reads all of it first: the seal tells damage, but a file may be anyone's.
ShardHead read_shard_head(const std::string& path) try {
  require_sealed(path);
  (void)guarded(
      [&] {
        (void)head_of(path), (void)read_shard(path);
        return std::string();
      },
      limits_for(std::filesystem::file_size(path)));
  return head_of(path);
} catch (const GuardedDeath& death) {
  refuse(path, death.what());
}

Figure read_shard(const std::string& path) {
  return read_file(path, [](const Handle& file) {
    Figure figure;
    checked(H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_variable, &figure));
    return figure;
  });
}

}  // namespace clatter
