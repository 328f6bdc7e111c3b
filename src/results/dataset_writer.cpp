#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <map>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "results/checksum_trailer.hpp"
#include "results/dataset_file.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_image.hpp"
#include "results/hdf5_shape.hpp"
#include "results/hdf5_values.hpp"
#include "results/version.hpp"
#include "storage/error.hpp"

namespace clatter::results {
namespace {

using detail::checked;
using detail::Handle;
using detail::put;
using detail::Shape;
using detail::type_of;
using detail::ValueType;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The size from which on an array is deflated: below it, the index of the chunks takes as much as deflating saves.
constexpr std::size_t worth_compressing = 16UL * 1024;  // bytes

/// The least growth of the file in memory: few steps for a large file, and little to clear for a small one.
constexpr std::size_t growth = 64UL * 1024;  // bytes

bool is_coordinate(const Variable& variable) {
  return variable.dimensions.size() == 1 && variable.dimensions.front() == variable.name;
}

Shape shape_of(const Variable& variable, const Dataset& dataset) {
  Shape shape;
  for (const std::string& name : variable.dimensions) {
    const auto found = std::find_if(dataset.dimensions.begin(), dataset.dimensions.end(),
                                    [&](const NamedLength& dimension) { return dimension.name == name; });
    if (found == dataset.dimensions.end()) throw std::logic_error{variable.name + ": no dimension '" + name + "'"};
    shape.push_back(found->length);
  }
  return shape;
}

/// Creation order, so that readers list attributes as they were written; no times, or no two files would be equal.
Handle dataset_properties() {
  Handle properties{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
  checked(H5Pset_obj_track_times(properties, false));
  checked(H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return properties;
}

void compress(const Handle& properties, const Shape& shape, std::size_t value_size, int level) {
  if (level == 0 || detail::count(shape) * value_size < worth_compressing) return;
  const Shape chunks = detail::blocks_of(shape, value_size);
  checked(H5Pset_chunk(properties, static_cast<int>(chunks.size()), chunks.data()));
  checked(H5Pset_shuffle(properties));
  checked(H5Pset_deflate(properties, static_cast<unsigned>(level)));
}

Handle dataspace_of(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

/// Of a transfer of texts: they are converted in a buffer that HDF5 fills with zeros for each variable, 1 MiB by
/// default. Other values need none, and each list of properties costs as much as to write a small variable.
Handle text_transfer(std::size_t bytes) {
  constexpr std::size_t least = 4096, most = std::size_t{1} << 20;
  Handle properties{H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  checked(H5Pset_buffer(properties, std::clamp(bytes, least, most), nullptr, nullptr));
  return properties;
}

/// Writes the values, of `type`, in one call: the order in which deflated chunks are written changes the file.
template <typename Value>
Handle write_values(hid_t file, const Variable& variable, const Shape& shape, const std::vector<Value>& values,
                    const ValueType& type, int level) {
  if (values.size() != detail::count(shape))
    throw std::logic_error{variable.name + ": values don't fill its dimensions"};
  const Handle properties = dataset_properties();
  compress(properties, shape, H5Tget_size(type.file), level);
  const bool has_fill = std::is_same_v<Value, double> && !is_coordinate(variable);
  if (has_fill) checked(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &nan));
  Handle dataset{
      H5Dcreate2(file, variable.name.c_str(), type.file, dataspace_of(shape), H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose};
  const auto write = [&](hid_t transfer) {
    checked(H5Dwrite(dataset, type.memory, H5S_ALL, H5S_ALL, transfer, values.data()));
  };
  if (!values.empty() && H5Tget_class(type.file) == H5T_STRING) {
    write(text_transfer(values.size() * H5Tget_size(type.file)));
  } else if (!values.empty()) {
    write(H5P_DEFAULT);
  }
  if (has_fill) put(dataset, "_FillValue", nan);
  return dataset;
}

template <typename Value>
Handle write_values(hid_t file, const Variable& variable, const Shape& shape, const std::vector<Value>& values,
                    int level) {
  return write_values(file, variable, shape, values, type_of(Value{}), level);
}

Handle write_values(hid_t file, const Variable& variable, const Shape& shape, const std::vector<std::string>& texts,
                    int level) {
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Handle type = detail::text_type();
  return write_values(file, variable, shape, pointers, {type, type}, level);
}

void put(hid_t object, const std::vector<Attribute>& attributes) {
  for (const auto& [name, value] : attributes)
    std::visit([&, &key = name](const auto& held) { detail::put(object, key, held); }, value);
}

Handle write_variable(hid_t file, const Variable& variable, const Dataset& dataset, int level) {
  const Shape shape = shape_of(variable, dataset);
  Handle stored = std::visit([&](const auto& values) { return write_values(file, variable, shape, values, level); },
                             variable.values);
  put(stored, "long_name", variable.long_name);
  put(stored, "units", variable.units);
  put(stored, variable.attributes);
  return stored;
}

/// The scale of a dimension that no variable describes: without values, and with the name that netCDF expects.
Handle write_bare_scale(hid_t file, const NamedLength& dimension) {
  const Handle properties = dataset_properties();
  Handle scale{H5Dcreate2(file, dimension.name.c_str(), H5T_IEEE_F32LE, dataspace_of({dimension.length}), H5P_DEFAULT,
                          properties, H5P_DEFAULT),
               H5Dclose};
  std::array<char, 80> name{};
  std::snprintf(name.data(), name.size(), "This is a netCDF dimension but not a netCDF variable.%10zu",
                dimension.length);
  checked(H5DSset_scale(scale, name.data()));
  return scale;
}

/// Releases the memory of values, which clear() would keep.
void release(ValueArray& values) {
  std::visit(
      [](auto& held) {
        held = {};
        held.shrink_to_fit();
      },
      values);
}

/// Writes the scale of a dimension; takes the values of its coordinate out of the dataset.
Handle write_scale(hid_t file, const NamedLength& dimension, Dataset& dataset, int level) {
  const auto found = std::find_if(dataset.variables.begin(), dataset.variables.end(),
                                  [&](const Variable& variable) { return variable.name == dimension.name; });
  if (found == dataset.variables.end()) return write_bare_scale(file, dimension);
  if (!is_coordinate(*found)) throw std::logic_error{found->name + ": a variable with the name of a dimension"};
  Handle scale = write_variable(file, *found, dataset, level);
  checked(H5DSset_scale(scale, dimension.name.c_str()));
  release(found->values);
  return scale;
}

/// Writes scales first, since netCDF numbers dimensions in their order of creation. Takes the values out of the
/// dataset.
void write_dataset(hid_t file, Dataset& dataset, int level) {
  std::map<std::string, Handle> scales;
  for (const NamedLength& dimension : dataset.dimensions) {
    scales.emplace(dimension.name, write_scale(file, dimension, dataset, level));
  }
  for (Variable& variable : dataset.variables) {
    if (is_coordinate(variable)) continue;
    const Handle stored = write_variable(file, variable, dataset, level);
    release(variable.values);
    for (unsigned d = 0; d < variable.dimensions.size(); ++d) {
      checked(H5DSattach_scale(stored, scales.at(variable.dimensions[d]), d));
    }
  }
}

void write_origin(hid_t file, const FileHead& head) {
  put(file, "Conventions", std::string{"CF-1.10"});
  put(file, "title", head.title);
  put(file, "source", head.source);
  put(file, "clatter_schema", std::string{"clatter/1"});
  put(file, "clatter_version", std::string{version()});
  put(file, "git_commit", std::string{git_commit()});
  put(file, "config", head.text);
  put(file, "config_sha256", sha256(head.text));
  put(file, "compiler", std::string{compiler()});
}

/// Creates a file in memory only: HDF5 leaves a broken one on a disk that fills up, or if it is killed.
Handle create_in(detail::Image& image) {
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  checked(H5Pset_fapl_core(access, growth, false));
  checked(H5Pset_meta_block_size(access, 0));  // closing would cut blocks that are to be filled later
  checked(H5Pset_small_data_block_size(access, 0));
  image.receive_from(access);
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST));  // others gave images that don't open
  const Handle creation{H5Pcreate(H5P_FILE_CREATE), H5Pclose};
  checked(H5Pset_obj_track_times(creation, false));
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  checked(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return {H5Fcreate("clatter.h5", H5F_ACC_TRUNC, creation, access), H5Fclose};
}

/// Builds the file and closes it, which finishes it; returns its size.
std::size_t build(detail::Image& image, Dataset& dataset, const FileHead& head) {
  const Handle file = create_in(image);
  write_origin(file, head);
  put(file, dataset.attributes);
  write_dataset(file, dataset, head.compression);
  checked(H5Fflush(file, H5F_SCOPE_LOCAL));
  return static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0)));
}

/// Any failure is lack of memory, since nothing else is needed.
[[noreturn]] void refuse(const std::string& why) {
  throw storage::no_memory("the output file, which must fit into it, cannot be built (" + why + ')');
}

FileImage image_of(Dataset& dataset, const FileHead& head, bool with_trailer) try {
  const detail::QuietErrors quiet;
  const auto image = std::make_shared<detail::Image>();
  const std::size_t size = build(*image, dataset, head);
  if (!with_trailer) return {image, image->first(size)};
  const std::string trailer = checksum_trailer_of(image->first(size));
  return {image, image->append(size, std::as_bytes(std::span(trailer)))};
} catch (const detail::Failure& failure) {
  refuse(failure.what());
} catch (const std::bad_alloc&) {
  refuse("there is none left");
}

}  // namespace

FileImage file_image(Dataset dataset, const FileHead& head) { return image_of(dataset, head, false); }

FileImage image_with_checksum(Dataset dataset, const FileHead& head) { return image_of(dataset, head, true); }

}  // namespace clatter::results
