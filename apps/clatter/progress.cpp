#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace clatter {
namespace {

constexpr std::size_t width = 30;
constexpr const char* erase_line = "\r\033[K";

/// no-color.org: any value that isn't empty switches colours off.
bool color_wanted() {
  const char* const no_color = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  if (no_color != nullptr && *no_color != '\0') return false;
  return stderr_is_terminal() && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::min(seconds, 1e9));
  char text[48];
  std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

Progress::Progress(bool shown, const char* counted, std::size_t before)
    : shown_(shown), counted_(counted), before_(before), color_(color_wanted()) {}

Progress::~Progress() {
  if (shown_) std::fputs(stderr_is_terminal() ? erase_line : "\n", stderr);
}

void Progress::show(std::size_t finished, std::size_t total) const {
  if (!shown_ || total == 0) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double rate = seconds > 0 ? static_cast<double>(finished - before_) / seconds : 0;
  const std::size_t filled = width * finished / total;
  const std::string bar = (color_ ? "\033[32m" : "") + std::string(filled, '#') + (color_ ? "\033[0m" : "") +
                          std::string(width - filled, '.');
  const std::string left = rate > 0 ? clock_text(static_cast<double>(total - finished) / rate) : "-:--:--";
  std::fprintf(stderr, "\r[%s] %3zu %%  %zu/%zu %s  %.0f %s/s  %s left", bar.c_str(), 100 * finished / total, finished,
               total, counted_, rate, counted_, left.c_str());
  std::fflush(stderr);
}

}  // namespace clatter
