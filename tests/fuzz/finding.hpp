#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace clatter::fuzz {

/// Ends the process with a finding, which libFuzzer reports with the input.
[[noreturn]] inline void finding(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

inline void require(bool holds, const std::string& what) {
  if (!holds) finding(what);
}

}  // namespace clatter::fuzz
