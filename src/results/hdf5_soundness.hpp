#pragma once

#include <string>

namespace clatter::results::detail {

/// Throws Failure where a heap of texts in the file is damaged such that HDF5 1.10 would read it for ever: a block of
/// zeros, which a disk error or an interrupted copy leaves, is enough.
void require_sound_heaps(const std::string& path);

}  // namespace clatter::results::detail
