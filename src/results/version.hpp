#pragma once

#include <string_view>

namespace clatter::results {

/// The project's version, e.g. "0.3.0".
[[nodiscard]] std::string_view version();

/// The day of its release, e.g. "2026-11-24".
[[nodiscard]] std::string_view release_date();

/// The commit from which it was built, with "-dirty" if files had changed; that of the archive if there is no git, else
/// "unknown".
[[nodiscard]] std::string_view git_commit();

/// The compiler that built it, e.g. "GNU 12.2.0".
[[nodiscard]] std::string_view compiler();

}  // namespace clatter::results
