#pragma once

// For fuzzers that read HDF5 files: defines functions that libFuzzer and the sanitizers call, so only one file includes
// it.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sanitizer/asan_interface.h>
#include <sys/mman.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <new>
#include <span>
#include <string>
#include <string_view>

#include "hdf5_damage.hpp"
#include "instrumented.hpp"
#include "results/dataset_file.hpp"
#include "scratch.hpp"
#include "storage/error.hpp"

namespace clatter::fuzz {

/// Memory that the reading child shares with this process: the report of the sanitizer that ended it.
struct Report {
  bool undefined = false;  ///< undefined behaviour, for which there is no text
  std::array<char, 16384> text{};
};

inline Report& report() {
  static Report* const shared =
      new (::mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Report;
  return *shared;
}

inline void keep_report(const char* text) {
  if (report().text.front() == '\0') std::strncpy(report().text.data(), text, report().text.size() - 1);
}

/// Called in the child: its end is no finding of its own. A longer time counts as an endless loop.
inline void become_reader() {
  constexpr itimerval soon{{0, 0}, {0, 300'000}};
  __asan_set_error_report_callback(keep_report);
  for (const int number : {SIGABRT, SIGALRM, SIGXCPU}) std::signal(number, SIG_DFL);
  ::setitimer(ITIMER_PROF, &soon, nullptr);
  if (std::getenv("CLATTER_FUZZ_LOUD") != nullptr) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
}

/// Whether the innermost frame of a report that belongs to clatter or the library belongs to clatter. Without a
/// symbolizer, which would take longer than everything else.
inline bool blames_us(std::string_view text) {
  if (text.find("out of memory") != text.npos || text.find("out-of-memory") != text.npos ||
      text.find("allocation-size-too-big") != text.npos)
    return false;  // without the sanitizer it is an exception
  for (std::size_t at = text.find("    #0 "); at != text.npos; at = text.find("\n    #", at + 1)) {
    const std::size_t number = text.find(" 0x", at) + 3;
    std::uintptr_t address = 0;
    std::from_chars(text.data() + number, text.data() + text.size(), address, 16);
    Dl_info found{};
    const bool named = ::dladdr(reinterpret_cast<const void*>(address), &found) != 0 && found.dli_sname != nullptr;
    if (named && std::string_view(found.dli_sname).starts_with("H5")) return false;
    if (is_instrumented(address)) return true;
  }
  return false;
}

/// Counters that libFuzzer takes for coverage besides clatter's own code, which runs in the child: one for each reason
/// for which the library, which isn't instrumented, refuses a file.
[[gnu::section("__libfuzzer_extra_counters")]] inline std::array<std::uint8_t, 4096> reasons;

/// Initialises the library before the first child, which inherits it: that takes longer than reading most files.
inline bool prepare() {
  (void)results::file_image({}, {});
  return ::pthread_atfork(nullptr, nullptr, become_reader) == 0;
}

/// Reads a file as a command does: it has to be read or refused, and nothing else may happen.
inline void check_reading(std::span<const std::uint8_t> bytes,
                          const std::function<void(const std::string& path)>& read) {
  static const bool prepared = prepare();
  require(prepared, "no child can be prepared");
  const std::string path = write("input.h5", std::as_bytes(bytes));
  report() = {};
  std::string reason = "read";
  try {
    read(path);
  } catch (const storage::IoError& error) {
    reason = error.what();
    require(reason.find(path) != reason.npos, "a message that doesn't name the file: " + reason);
  }
  const std::string where = " in the child; CLATTER_FUZZ_LOUD=1 ASAN_OPTIONS=symbolize=1 shows where\n";
  require(!report().undefined, "undefined behaviour" + where);
  require(!blames_us(report().text.data()), "an error of memory" + where + report().text.data());
  std::erase_if(reason, [](char c) { return c >= '0' && c <= '9'; });
  reasons[std::hash<std::string>{}(reason) % reasons.size()] = 1;
}

}  // namespace clatter::fuzz

/// Called by the sanitizer for undefined behaviour; only clatter's code was compiled with it.
extern "C" void __ubsan_on_report() { clatter::fuzz::report().undefined = true; }

extern "C" const char* __asan_default_options() {
  return "detect_leaks=0:symbolize=0:quarantine_size_mb=1:allocator_may_return_null=1:max_allocation_size_mb=2048";
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return clatter::fuzz::damage({data, most}, size, seed);
}
