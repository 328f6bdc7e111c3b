#include "results/hdf5_values.hpp"

#include <functional>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_shape.hpp"

namespace clatter::results::detail {
namespace {

/// The values that are selected in the space of a variable.
template <typename Value>
ValueArray numbers_of(hid_t dataset, hid_t space) {
  std::vector<Value> values(static_cast<std::size_t>(checked(H5Sget_select_npoints(space))));
  if (!values.empty())
    checked(H5Dread(dataset, type_of(Value{}).memory, room_for(values.size()), space, H5P_DEFAULT, values.data()));
  return values;
}

ValueArray numbers_of(hid_t dataset, hid_t space) {
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const std::size_t bytes = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_INTEGER) return numbers_of<double>(dataset, space);
  if (bytes == sizeof(std::int32_t)) return numbers_of<std::int32_t>(dataset, space);
  if (bytes > 1) return numbers_of<std::int64_t>(dataset, space);
  return H5Tget_sign(type) == H5T_SGN_NONE ? numbers_of<std::uint8_t>(dataset, space)
                                           : numbers_of<std::int8_t>(dataset, space);
}

/// The memory of the texts of one block, which a read that fails leaves behind.
using TextMemory = std::vector<std::unique_ptr<char[]>>;

/// Memory for one text; without any for a longer one, the read fails.
void* memory_for_text(std::size_t bytes, void* memory) noexcept {
  if (bytes > longest_text + 1) return nullptr;
  try {
    return static_cast<TextMemory*>(memory)->emplace_back(std::make_unique_for_overwrite<char[]>(bytes)).get();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void keep_text(void*, void*) {}

/// Reads texts; none is as much as a null pointer.
class TextReader {
 public:
  TextReader() : type_(text_type()), transfer_{H5Pcreate(H5P_DATASET_XFER), H5Pclose} {
    checked(H5Pset_vlen_mem_manager(transfer_, memory_for_text, &memory_, keep_text, &memory_));
  }

  /// Calls `take` for each of the `count` texts that are selected in the space of a variable.
  void read(hid_t dataset, hid_t space, std::size_t count, const std::function<void(std::string_view)>& take) {
    std::vector<char*> texts(count);
    if (count > 0) checked(H5Dread(dataset, type_, room_for(count), space, transfer_, texts.data()));
    for (const char* const text : texts) take(text != nullptr ? std::string_view(text) : std::string_view());
    memory_.clear();
  }

 private:
  TextMemory memory_;
  Handle type_, transfer_;
};

/// Calls `take` for each text of a variable.
void each_text(hid_t dataset, const std::function<void(std::string_view)>& take) {
  TextReader reader;
  each_block(shape_of(dataset), sizeof(char*),
             [&](hid_t space, std::size_t count) { reader.read(dataset, space, count, take); });
}

}  // namespace

std::size_t length_of(hid_t dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
}

ValueArray values_of(hid_t dataset) {
  if (is_text(dataset)) return read_texts(dataset);
  const Handle space{H5Dget_space(dataset), H5Sclose};
  return numbers_of(dataset, space);
}

ValueArray rows_of(hid_t dataset, std::size_t first, std::size_t rows) {
  Shape begin(shape_of(dataset).size(), 0), size = shape_of(dataset);
  if (size.empty() || first + rows > size[0]) throw Failure("a variable is shorter than its points");
  begin[0] = first, size[0] = rows;
  const Handle space{H5Dget_space(dataset), H5Sclose};
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr));
  if (!is_text(dataset)) return numbers_of(dataset, space);
  std::vector<std::string> texts;
  TextReader reader;
  reader.read(dataset, space, count(size), [&](std::string_view text) { texts.emplace_back(text); });
  return texts;
}

void try_values(hid_t dataset) {
  if (is_text(dataset)) return try_texts(dataset);
  const Handle type{H5Dget_type(dataset), H5Tclose}, native{H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose};
  const std::size_t bytes = H5Tget_size(native);
  std::vector<std::byte> memory(values_in_block(dataset, bytes) * bytes);
  read_blocks(dataset, native, memory.data(), [](std::size_t) {});
}

Handle text_type() {
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  checked(H5Tset_size(type, H5T_VARIABLE));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

bool is_text(hid_t dataset) {
  const Handle type{H5Dget_type(dataset), H5Tclose};
  return H5Tget_class(type) == H5T_STRING && checked(H5Tis_variable_str(type)) > 0;
}

std::vector<std::string> read_texts(hid_t dataset) {
  std::vector<std::string> texts;
  texts.reserve(count(shape_of(dataset)));
  each_text(dataset, [&](std::string_view text) { texts.emplace_back(text); });
  return texts;
}

void try_texts(hid_t dataset) {
  each_text(dataset, [](std::string_view) {});
}

}  // namespace clatter::results::detail
