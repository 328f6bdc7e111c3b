#include <hdf5_hl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/error.hpp"
#include "io/figure_file.hpp"
#include "io/guarded.hpp"
#include "io/hdf5_attributes.hpp"
#include "io/hdf5_handle.hpp"
#include "io/hdf5_soundness.hpp"
#include "io/summary_bytes.hpp"

namespace clatter {
namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::text_attribute;

[[noreturn]] void refuse(const std::string& path, const std::string& why, const std::string& way_out) {
  throw IoError{"'" + path + "': " + why + "; " + way_out};
}

[[noreturn]] void refuse_damaged(const std::string& path, const std::string& why) {
  refuse(path, "cannot be read: " + why, "copy it again, or run its configuration again");
}

/// The size of a file; says in plain words what HDF5 would call "unable to open file".
std::uint64_t size_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) refuse(path, std::strerror(errno), "check the name");
  if (S_ISDIR(status.st_mode)) refuse(path, "is a directory", "name a file in it");
  if (!S_ISREG(status.st_mode)) refuse(path, "is not a regular file", "name an output of clatter");
  return static_cast<std::uint64_t>(status.st_size);
}

Handle open(const std::string& path) {
  const htri_t is_hdf5 = H5Fis_hdf5(path.c_str());
  if (is_hdf5 == 0) refuse(path, "is not an HDF5 file", "name an output of clatter");
  if (is_hdf5 < 0) throw hdf5::Failure{};
  hdf5::require_sound_heaps(path);
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
}

/// The name of an object at the root, without its slash.
std::string object_name(hid_t object) {
  std::string path(static_cast<std::size_t>(checked(H5Iget_name(object, nullptr, 0))), '\0');
  checked(H5Iget_name(object, path.data(), path.size() + 1));
  return path.substr(path.rfind('/') + 1);
}

/// The order of creation, where the file keeps it: a tool that has copied the file may have dropped it.
H5_index_t order_of(hid_t file, herr_t (*get)(hid_t, unsigned*)) {
  const Handle root{H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose};
  const Handle properties{H5Gget_create_plist(root), H5Pclose};  // the file's own list forgets the order
  unsigned flags = 0;
  checked(get(properties, &flags));
  return (flags & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
}

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::pair<std::string, std::string>> root_attributes(hid_t file) {
  std::vector<std::string> names;
  checked(H5Aiterate2(file, order_of(file, H5Pget_attr_creation_order), H5_ITER_INC, nullptr, collect_name, &names));
  std::vector<std::pair<std::string, std::string>> attributes;
  attributes.reserve(names.size());
  for (const std::string& name : names) attributes.emplace_back(name, text_attribute(file, name));
  return attributes;
}

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  std::vector<hsize_t> shape(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
  if (!shape.empty()) checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
  return shape;
}

/// "float64" and the like, as numpy and xarray call them.
std::string type_name(hid_t dataset) {
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return "float" + bits;
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
    case H5T_STRING:
      return "string";
    default:
      return "other";
  }
}

herr_t keep_name(hid_t, unsigned, hid_t scale, void* name) try {
  *static_cast<std::string*>(name) = object_name(scale);
  return 1;  // the first scale is enough
} catch (const hdf5::Failure&) {
  return -1;
}

std::vector<NamedLength> dimensions_of(hid_t dataset, const std::string& variable) {
  const bool is_scale = checked(H5DSis_scale(dataset)) > 0;
  std::vector<NamedLength> dimensions;
  for (const hsize_t length : shape_of(dataset)) {
    std::string name = is_scale ? variable : "";
    const auto d = static_cast<unsigned>(dimensions.size());
    if (!is_scale) checked(H5DSiterate_scales(dataset, d, nullptr, keep_name, &name));
    dimensions.push_back({name, static_cast<std::size_t>(length)});
  }
  return dimensions;
}

/// A scale that only gives a dimension its name and length.
bool is_bare_scale(hid_t dataset) {
  if (checked(H5DSis_scale(dataset)) == 0) return false;
  return text_attribute(dataset, "NAME").starts_with("This is a netCDF dimension but not a netCDF variable.");
}

/// How many values of a variable have each of its flags, in the order of flag_values.
std::vector<std::pair<std::string, std::size_t>> flag_counts(hid_t dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  std::vector<std::uint8_t> values(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))));
  if (!values.empty()) checked(H5Dread(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t value : values) ++counts[value];
  std::istringstream meanings{text_attribute(dataset, "flag_meanings")};
  std::vector<std::pair<std::string, std::size_t>> result;
  for (const std::uint8_t flag : hdf5::byte_attribute(dataset, "flag_values")) {
    std::string meaning;
    if (meanings >> meaning) result.emplace_back(meaning, counts[flag]);
  }
  return result;
}

std::string link_name(hid_t file, H5_index_t order, hsize_t index) {
  const ssize_t length = checked(H5Lget_name_by_idx(file, ".", order, H5_ITER_INC, index, nullptr, 0, H5P_DEFAULT));
  std::string name(static_cast<std::size_t>(length), '\0');
  checked(H5Lget_name_by_idx(file, ".", order, H5_ITER_INC, index, name.data(), name.size() + 1, H5P_DEFAULT));
  return name;
}

void add_object(FileSummary& summary, hid_t file, const std::string& name) {
  const Handle object{H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose};
  if (H5Iget_type(object) != H5I_DATASET || is_bare_scale(object)) return;
  summary.variables.push_back({name, type_name(object), text_attribute(object, "units"),
                               text_attribute(object, "long_name"), dimensions_of(object, name)});
  if (name == "status") summary.status_counts = flag_counts(object);
}

FileSummary summary_of(const Handle& file, const std::string& path) {
  if (text_attribute(file, "clatter_schema") != "clatter/1") {
    refuse(path, "an HDF5 file, but not one of clatter's (no attribute clatter_schema = \"clatter/1\")",
           "name an output of clatter");
  }
  FileSummary summary;
  summary.attributes = root_attributes(file);
  H5G_info_t group;
  checked(H5Gget_info(file, &group));
  const H5_index_t order = order_of(file, H5Pget_link_creation_order);
  for (hsize_t i = 0; i < group.nlinks; ++i) add_object(summary, file, link_name(file, order, i));
  return summary;
}

/// Reads with the library, whatever may come of it.
FileSummary unguarded_summary(const std::string& path) try {
  const hdf5::QuietErrors quiet;
  return summary_of(open(path), path);
} catch (const hdf5::Failure& failure) {
  refuse_damaged(path, failure.what());
} catch (const std::length_error&) {
  refuse_damaged(path, "it holds an impossible length");
}

}  // namespace

FileSummary read_summary(const std::string& path) try {
  const GuardLimits limits = limits_for(size_of(path));
  auto summary = summary_from(guarded([&] { return bytes_of(unguarded_summary(path)); }, limits));
  if (!summary) refuse_damaged(path, "it disturbs the memory of the HDF5 library");
  return std::move(*summary);
} catch (const GuardedDeath& death) {
  refuse_damaged(path, death.what());
}

}  // namespace clatter
