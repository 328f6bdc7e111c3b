#pragma once

#include <string>

namespace clatter::storage {

/// The first of mine-2.h5, mine-3.h5, ... for mine.h5 that no file has, nor a journal; the path itself if none is free.
[[nodiscard]] std::string free_name(const std::string& path);

/// The remedy for an output whose name can't be used, with one that no file has: "name another with -o, e.g. -o
/// mine-2.h5".
[[nodiscard]] std::string name_another(const std::string& path);

/// The remedies for an output that would replace another file, that one first.
[[nodiscard]] std::string instead_of_replacing(const std::string& path);

}  // namespace clatter::storage
