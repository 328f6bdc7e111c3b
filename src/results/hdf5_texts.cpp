#include "results/hdf5_texts.hpp"

#include <cstdlib>
#include <functional>
#include <memory>
#include <string_view>

#include "results/hdf5_shape.hpp"

namespace clatter::results::detail {
namespace {

/// Memory for one text; without any for a longer one, the read fails.
void* memory_for_text(std::size_t bytes, void*) { return bytes <= longest_text + 1 ? std::malloc(bytes) : nullptr; }
void free_text(void* text, void*) { std::free(text); }

/// Calls `take` for each text; none is as much as a null pointer.
void each_text(hid_t dataset, const std::function<void(std::string_view)>& take) {
  const Handle type = text_type(), transfer{H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  checked(H5Pset_vlen_mem_manager(transfer, memory_for_text, nullptr, free_text, nullptr));
  std::vector<char*> texts(largest_block / sizeof(char*));
  read_blocks(
      dataset, type, texts.data(),
      [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
          const std::unique_ptr<char, void (*)(void*)> text(texts[i], std::free);
          take(text ? std::string_view(text.get()) : std::string_view());
        }
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
