#pragma once

#include <string>

namespace clatter::results::detail {

/// Throws Failure if a heap of texts in the file is damaged such that HDF5 1.10 would read it for ever. A block of
/// zeros, as a disk error or an interrupted copy leaves it, is enough.
void require_sound_heaps(const std::string& path);

}  // namespace clatter::results::detail
