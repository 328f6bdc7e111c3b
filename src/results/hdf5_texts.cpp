#include "results/hdf5_texts.hpp"

#include <functional>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "results/hdf5_shape.hpp"

namespace clatter::results::detail {
namespace {

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

/// Calls `take` for each text; none is as much as a null pointer.
void each_text(hid_t dataset, const std::function<void(std::string_view)>& take) {
  TextMemory memory;
  const Handle type = text_type(), transfer{H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  checked(H5Pset_vlen_mem_manager(transfer, memory_for_text, &memory, keep_text, &memory));
  std::vector<char*> texts(largest_block / sizeof(char*));
  read_blocks(
      dataset, type, texts.data(),
      [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
          take(texts[i] != nullptr ? std::string_view(texts[i]) : std::string_view());
        memory.clear();
      },
      transfer);
}

}  // namespace

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
