#include "results/hdf5_handle.hpp"

#include <string>

#include "storage/utf8.hpp"

namespace clatter::results::detail {
namespace {

/// Keeps the description of the record that was pushed first: the failure itself, not the calls that failed with it.
herr_t keep_first(unsigned depth, const H5E_error2_t* record, void* text) {
  if (depth == 0 && record->desc != nullptr) *static_cast<std::string*>(text) = record->desc;
  return 0;
}

std::string reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  H5Eclear2(H5E_DEFAULT);
  return text.empty() ? "the HDF5 library gives no reason"
                      : storage::printable(text);  // it may quote names of the file
}

}  // namespace

Failure::Failure() : std::runtime_error{reason()} {}

}  // namespace clatter::results::detail
