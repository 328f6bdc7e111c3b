#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <future>
#include <limits>
#include <map>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "results/checksum_trailer.hpp"
#include "results/dataset_file.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_file.hpp"
#include "results/hdf5_handle.hpp"
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

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The size from which on an array is deflated: below it, the index of the chunks takes as much as deflating saves.
constexpr std::size_t worth_compressing = 16UL * 1024;  // bytes

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

/// Returns whether the array will be deflated.
bool compress(const Handle& properties, const Shape& shape, std::size_t value_size, int level) {
  if (level == 0 || detail::count(shape) * value_size < worth_compressing) return false;
  const Shape chunks = detail::blocks_of(shape, value_size);
  checked(H5Pset_chunk(properties, static_cast<int>(chunks.size()), chunks.data()));
  checked(H5Pset_shuffle(properties));
  checked(H5Pset_deflate(properties, static_cast<unsigned>(level)));
  return true;
}

/// Of a transfer of texts: they are converted in a buffer that HDF5 fills with zeros for each variable, 1 MiB by
/// default. Other values need none, and each list of properties costs as much as to write a small variable.
Handle text_transfer(std::size_t bytes) {
  constexpr std::size_t least = 4096, most = std::size_t{1} << 20;
  Handle properties{H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  checked(H5Pset_buffer(properties, std::clamp(bytes, least, most), nullptr, nullptr));
  return properties;
}

/// The values of a variable, from the first to the last, whether they are in memory or made meanwhile. A piece stays
/// until the one after the next is asked for.
template <typename Value>
class Pieces {
 public:
  Pieces(const Variable& variable, const std::vector<Value>& held) : variable_(variable), left_(held) {}

  [[nodiscard]] std::span<const Value> next(std::size_t count) {
    if (!variable_.next) {
      const auto piece = left_.first(count);
      left_ = left_.subspan(count);
      return piece;
    }
    before_ = std::exchange(made_, {});
    made_ = std::get<std::vector<Value>>(variable_.next(count));
    if (made_.size() != count) throw std::logic_error{variable_.name + ": values don't fill its dimensions"};
    return made_;
  }
  [[nodiscard]] std::size_t at_once() const { return variable_.at_once / sizeof(Value); }

 private:
  const Variable& variable_;
  std::span<const Value> left_;
  std::vector<Value> made_, before_;
};

/// Writes a deflated variable chunk by chunk, in their order, since another one would make another file; texts
/// likewise, as many at a time.
template <typename Value, typename Write>
void write_blocks(const Shape& shape, std::size_t value_size, Pieces<Value>& pieces, const Write& write) {
  detail::each_block(shape, value_size, [&](hid_t space, std::size_t count) {
    write(pieces.next(count), detail::room_for(count), space);
  });
}

void write_values(hid_t dataset, const Shape& shape, Pieces<std::string>& texts, bool, detail::FileInPages&) {
  const Handle type = detail::text_type();
  const std::size_t size = H5Tget_size(type), block = std::min(detail::count(shape), detail::largest_block / size);
  const Handle transfer = text_transfer(block * size);
  std::vector<const char*> pointers;
  write_blocks(shape, size, texts, [&](std::span<const std::string> some, hid_t room, hid_t space) {
    pointers.clear();
    for (const std::string& text : some) pointers.push_back(text.c_str());
    checked(H5Dwrite(dataset, type, room, space, transfer, pointers.data()));
  });
}

/// HDF5 would write a part of an array that isn't deflated only after filling all of it. So it gives a large one its
/// place, and the values are put there without it, each piece while the next one is made.
template <typename Value>
void write_values(hid_t dataset, const Shape& shape, Pieces<Value>& values, bool is_deflated,
                  detail::FileInPages& file) {
  const hid_t type = type_of(Value{}).memory;
  const std::size_t count = detail::count(shape);
  if (is_deflated)
    return write_blocks(shape, sizeof(Value), values, [&](std::span<const Value> some, hid_t room, hid_t space) {
      checked(H5Dwrite(dataset, type, room, space, H5P_DEFAULT, some.data()));
    });
  const bool is_placed = count * sizeof(Value) >= detail::FileInPages::least_placed;
  const auto small = is_placed ? std::span<const Value>() : values.next(count);
  const void* const bytes = is_placed ? detail::FileInPages::place_only() : small.data();
  if (count > 0) checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes));
  if (!is_placed) return;
  std::uint64_t at = H5Dget_offset(dataset);
  std::future<void> written;  // by a thread of its own, or here if none can be started
  for (std::size_t left = count, some = 0; left > 0; left -= some, at += some * sizeof(Value)) {
    some = std::min(left, values.at_once());
    const auto piece = std::as_bytes(values.next(some));
    if (written.valid()) written.get();
    written = std::async([&file, at, piece] { file.write(at, piece); });
  }
  if (written.valid()) written.get();
  file.rethrow();
}

/// A file that is being made: HDF5's view of it, and that of the disk.
struct NewFile {
  detail::FileInPages& pages;
  hid_t hdf5;
  int level;  ///< of deflate
};

template <typename Value>
Handle write_variable(const NewFile& file, const Variable& variable, const Shape& shape,
                      const std::vector<Value>& held) {
  if (!variable.next && held.size() != detail::count(shape))
    throw std::logic_error{variable.name + ": values don't fill its dimensions"};
  const Handle properties = dataset_properties(), text = detail::text_type();
  constexpr bool is_number = !std::is_same_v<Value, std::string>;
  hid_t type = text;
  if constexpr (is_number) type = type_of(Value{}).file;
  const bool is_deflated = compress(properties, shape, H5Tget_size(type), file.level);
  const bool has_fill = std::is_same_v<Value, double> && !is_coordinate(variable);
  if (has_fill) checked(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &nan));
  Handle dataset{
      H5Dcreate2(file.hdf5, variable.name.c_str(), type, detail::space_of(shape), H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose};
  Pieces<Value> pieces(variable, held);
  write_values(dataset, shape, pieces, is_deflated, file.pages);
  if (has_fill) put(dataset, "_FillValue", nan);
  return dataset;
}

void put(hid_t object, const std::vector<Attribute>& attributes) {
  for (const auto& [name, value] : attributes)
    std::visit([&, &key = name](const auto& held) { detail::put(object, key, held); }, value);
}

Handle write_variable(const NewFile& file, const Variable& variable, const Dataset& dataset) {
  const Shape shape = shape_of(variable, dataset);
  Handle stored =
      std::visit([&](const auto& held) { return write_variable(file, variable, shape, held); }, variable.values);
  put(stored, "long_name", variable.long_name);
  put(stored, "units", variable.units);
  put(stored, variable.attributes);
  return stored;
}

/// The scale of a dimension that no variable describes: without values, and with the name that netCDF expects.
Handle write_bare_scale(hid_t file, const NamedLength& dimension) {
  const Handle properties = dataset_properties();
  Handle scale{H5Dcreate2(file, dimension.name.c_str(), H5T_IEEE_F32LE, detail::space_of({dimension.length}),
                          H5P_DEFAULT, properties, H5P_DEFAULT),
               H5Dclose};
  std::array<char, 80> name{};
  std::snprintf(name.data(), name.size(), "This is a netCDF dimension but not a netCDF variable.%10zu",
                dimension.length);
  checked(H5DSset_scale(scale, name.data()));
  return scale;
}

/// Releases the memory of a variable's values, which clear() would keep.
void release(Variable& variable) {
  std::visit(
      [](auto& held) {
        held = {};
        held.shrink_to_fit();
      },
      variable.values);
  variable.next = {};
}

/// Writes the scale of a dimension; takes the values of its coordinate out of the dataset.
Handle write_scale(const NewFile& file, const NamedLength& dimension, Dataset& dataset) {
  const auto found = std::find_if(dataset.variables.begin(), dataset.variables.end(),
                                  [&](const Variable& variable) { return variable.name == dimension.name; });
  if (found == dataset.variables.end()) return write_bare_scale(file.hdf5, dimension);
  if (!is_coordinate(*found)) throw std::logic_error{found->name + ": a variable with the name of a dimension"};
  Handle scale = write_variable(file, *found, dataset);
  checked(H5DSset_scale(scale, dimension.name.c_str()));
  release(*found);
  return scale;
}

/// Upper bound of the bytes of a variable before compression.
double bytes_of(const Variable& variable, const Dataset& dataset) {
  constexpr double of_text = 48, of_head = 2048;  // a reference, a header and the letters; an object's head
  double values = 1;
  for (const hsize_t length : shape_of(variable, dataset)) values *= static_cast<double>(length);
  const auto size = [](const auto& held) {
    using Value = typename std::remove_reference_t<decltype(held)>::value_type;
    return std::is_same_v<Value, std::string> ? of_text : static_cast<double>(sizeof(Value));
  };
  return of_head + values * std::visit(size, variable.values);
}

/// Writes scales first, since netCDF numbers dimensions in their order of creation. Takes the values out of the
/// dataset.
void write_dataset(const NewFile& file, Dataset& dataset) {
  double left = 0;
  for (const Variable& variable : dataset.variables) left += bytes_of(variable, dataset);
  const auto expect_less = [&](const Variable& variable) {
    file.pages.expect(static_cast<std::uint64_t>(std::max(0.0, left -= bytes_of(variable, dataset))));
  };
  file.pages.expect(static_cast<std::uint64_t>(left));
  std::map<std::string, Handle> scales;
  for (const NamedLength& dimension : dataset.dimensions) {
    scales.emplace(dimension.name, write_scale(file, dimension, dataset));
  }
  for (Variable& variable : dataset.variables) {
    if (!is_coordinate(variable)) {
      const Handle stored = write_variable(file, variable, dataset);
      release(variable);
      for (unsigned d = 0; d < variable.dimensions.size(); ++d) {
        checked(H5DSattach_scale(stored, scales.at(variable.dimensions[d]), d));
      }
    }
    expect_less(variable);
  }
}

void write_origin(hid_t file, const FileHead& head) {
  put(file, "Conventions", std::string{"CF-1.10"});
  put(file, "title", head.title);
  put(file, "source", head.source);
  if (!head.comment.empty()) put(file, "comment", head.comment);
  put(file, "clatter_schema", std::string{"clatter/1"});
  put(file, "clatter_version", std::string{version()});
  put(file, "git_commit", std::string{git_commit()});
  put(file, "config", head.text);
  put(file, "config_sha256", sha256(head.text));
  put(file, "compiler", std::string{compiler()});
}

Handle create(detail::FileInPages& pages) {
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  checked(H5Pset_meta_block_size(access, 0));  // closing would cut blocks that are to be filled later
  checked(H5Pset_small_data_block_size(access, 0));
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST));  // as of all files before
  const Handle creation{H5Pcreate(H5P_FILE_CREATE), H5Pclose};
  checked(H5Pset_obj_track_times(creation, false));
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  checked(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return pages.create(creation, access);
}

/// Writes the file and closes it, which finishes it; returns its size.
std::uint64_t build(storage::FileWriter& file, Dataset& dataset, const FileHead& head) {
  detail::FileInPages pages(file);
  try {
    const detail::QuietErrors quiet;
    const Handle hdf5 = create(pages);
    write_origin(hdf5, head);
    put(hdf5, dataset.attributes);
    write_dataset({pages, hdf5, head.compression}, dataset);
  } catch (const detail::Failure& failure) {
    pages.rethrow();
    throw storage::no_memory(std::string("the output file cannot be built (") + failure.what() + ')');
  }
  pages.finish();
  return pages.size();
}

}  // namespace

void write_file(storage::FileWriter& file, Dataset dataset, const FileHead& head) {
  static_cast<void>(build(file, dataset, head));
}

void write_file_with_checksum(storage::FileWriter& file, Dataset dataset, const FileHead& head) {
  add_checksum(file, build(file, dataset, head));
}

std::vector<std::byte> file_image(Dataset dataset, const FileHead& head) {
  storage::MemoryWriter file;
  static_cast<void>(build(file, dataset, head));
  return file.take();
}

void collect(Dataset& dataset) {
  for (Variable& variable : dataset.variables) {
    if (!variable.next) continue;
    variable.values = variable.next(detail::count(shape_of(variable, dataset)));
    variable.next = {};
  }
}

}  // namespace clatter::results
