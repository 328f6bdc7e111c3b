#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace clatter::app {
namespace {

constexpr std::size_t width = 30;
constexpr const char* erase_line = "\r\033[K";

/// Any value of NO_COLOR but the empty one switches colours off (no-color.org).
bool color_wanted() {
  const char* const no_color = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  if (no_color != nullptr && *no_color != '\0') return false;
  return stderr_is_terminal() && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 1e9)));
  char text[48];
  std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

Progress::Progress(bool shown, const char* counted, double before)
    : shown_(shown), counted_(counted), before_(before), color_(color_wanted()), finished_(before), pace_(before) {
  if (!shown_) return;
  try {
    ticker_ = std::thread([this] { tick(); });
  } catch (const std::system_error&) {  // then the bar moves only when points finish
  }
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_one();
  if (ticker_.joinable()) ticker_.join();
  if (shown_) std::fputs(stderr_is_terminal() ? erase_line : "\n", stderr);
}

void Progress::show(double finished, double total) {
  if (!shown_ || !(total > 0)) return;
  const std::lock_guard lock(mutex_);
  finished_ = finished, total_ = total;
  pace_.add(now(), finished);
  draw();
}

void Progress::show(double finished, double total, std::optional<double> seconds_left) {
  {
    const std::lock_guard lock(mutex_);
    is_told_ = true;
    told_end_ = seconds_left ? std::optional(now() + *seconds_left) : std::nullopt;
  }
  show(finished, total);
}

/// Keeps the clock of the bar going while nothing finishes.
void Progress::tick() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::seconds(1), [&] { return over_; }))
    if (total_ > 0) draw();
}

double Progress::now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::optional<double> Progress::seconds_left() const {
  if (!is_told_) return pace_.at(now(), total_);
  return told_end_ ? std::optional(std::abs(*told_end_ - now())) : std::nullopt;
}

void Progress::draw() const {
  const double share = finished_ / total_, seconds = now();
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
  const std::string bar = (color_ ? "\033[32m" : "") + std::string(filled, '#') + (color_ ? "\033[0m" : "") +
                          std::string(width - filled, '.');
  const std::optional<double> left = seconds_left();
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.0f/%.0f %s  %.0f %s/s  %s left", bar.c_str(), std::floor(100 * share),
               std::floor(finished_), total_, counted_, seconds > 0 ? (finished_ - before_) / seconds : 0.0, counted_,
               left ? clock_text(*left).c_str() : "-:--:--");
  std::fflush(stderr);
}

}  // namespace clatter::app
