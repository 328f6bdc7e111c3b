#pragma once

#include <string>

#include "io/hdf5_handle.hpp"

namespace clatter::hdf5 {

/// Opens a file of whatever origin for reading, if it holds nothing but what clatter writes: variables at the root, of
/// numbers, stored in the file itself, contiguous or in chunks, with no filters but shuffle and deflate. Anything else
/// could make the library open other files or run foreign code; no value is read and no link followed before that is
/// known. Throws Failure.
[[nodiscard]] Handle open_plain(const std::string& path);

}  // namespace clatter::hdf5
