#include "io/shard_file.hpp"

#include <hdf5_hl.h>

#include <charconv>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
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

/// What a walk over the variables does with each, and what stopped it: the library isn't made for exceptions.
struct Walk {
  std::function<void(const std::string& name, const Handle& dataset)> visit;
  std::exception_ptr failure{};
};

herr_t visit(hid_t file, const char* name, const H5L_info_t*, void* data) {
  auto& walk = *static_cast<Walk*>(data);
  try {
    const Handle dataset{H5Dopen2(file, name, H5P_DEFAULT), H5Dclose};
    if (length_of(dataset) == 0 || H5Dget_storage_size(dataset) > 0) walk.visit(name, dataset);  // not a bare scale
    return 0;
  } catch (...) {
    walk.failure = std::current_exception();
    return -1;
  }
}

void walk_variables(const Handle& file, decltype(Walk::visit) action) {
  Walk walk{std::move(action)};
  const herr_t result = H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, visit, &walk);
  if (walk.failure) std::rethrow_exception(walk.failure);
  checked(result);
}

/// Bytes of all values once they are read.
std::uint64_t bytes_of_values(const std::string& path) {
  return read_file(path, [](const Handle& file) {
    double bytes = 0;
    walk_variables(file, [&](const std::string&, const Handle& dataset) {
      bytes += sizeof(double) * static_cast<double>(length_of(dataset));
    });
    if (bytes > 1e18) throw hdf5::Failure("it holds an impossible length");
    return static_cast<std::uint64_t>(bytes);
  });
}

void try_values(const std::string& path) {
  read_file(path, [](const Handle& file) {
    walk_variables(file, [](const std::string&, const Handle& dataset) { (void)column_of(dataset); });
  });
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
                   .rounding = text_attribute(file, "rounding")};
    if (checked(H5Lexists(file, "impact_tau", H5P_DEFAULT)) > 0)
      head.impacts = length_of(dataset_in(file, "impact_tau"));
    return head;
  });
}

}  // namespace

/// A child process reads all of it first: the seal tells damage, but a file may be anyone's.
ShardHead read_shard_head(const std::string& path) try {
  require_sealed(path);
  const std::uint64_t file_size = std::filesystem::file_size(path);
  const std::string bytes = guarded(
      [&] {
        (void)head_of(path);
        return std::to_string(bytes_of_values(path));
      },
      limits_for(file_size));
  std::uint64_t value_bytes = 0;
  if (std::from_chars(bytes.data(), bytes.data() + bytes.size(), value_bytes).ec != std::errc{})
    refuse(path, "it disturbs the memory of the HDF5 library");
  (void)guarded([&] { return try_values(path), std::string(); }, limits_for(file_size + value_bytes));
  return head_of(path);
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
