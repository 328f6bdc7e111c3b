#pragma once

#include <string>
#include <vector>

#include "results/hdf5_handle.hpp"

namespace clatter::results::detail {

// Readers of files of any origin. Such a file may only hold objects as clatter writes them: variables at the root, of
// numbers, stored in the file itself, contiguous or in chunks, with no filters but shuffle and deflate. Anything else
// could make the library open other files or run foreign code. All throw Failure.

/// Opens a file for reading. Its attributes may be read; of its variables, only those of the functions below.
[[nodiscard]] Handle open_file(const std::string& path);

/// The names of all variables, in the order of their creation if the file keeps it; throws unless clatter may have
/// written each of them. No value is read for that, and no link followed.
[[nodiscard]] std::vector<std::string> variables_in(hid_t file);

/// Opens a variable, if clatter may have written it; checked once more, since the indexes of a file may disagree.
[[nodiscard]] Handle open_variable(hid_t file, const std::string& name);

/// Throws Failure if a heap of texts in the file is damaged such that HDF5 1.10 would read it for ever. A block of
/// zeros, as a disk error or an interrupted copy leaves it, is enough.
void require_sound_heaps(const std::string& path);

}  // namespace clatter::results::detail
