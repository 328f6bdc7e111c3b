#include "terminal/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "terminal/format.hpp"

namespace clatter::app {
namespace {

constexpr const char* erase_line = "\r\033[K";
constexpr double worth_a_line = 30, between_lines = 60;  ///< seconds

/// Columns of the terminal that stderr is; 80 if it doesn't tell.
std::size_t columns_of_stderr() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

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

Progress::Progress(ProgressKind kind, const char* counted, double before)
    : kind_(kind), counted_(counted), before_(before), color_(color_wanted()), finished_(before), pace_(before) {
  if (kind_ == ProgressKind::none) return;
  try {
    ticker_ = std::thread([this] { tick(); });
  } catch (const std::system_error&) {  // then it moves only when points finish
  }
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_one();
  if (ticker_.joinable()) ticker_.join();
  if (kind_ == ProgressKind::bar) std::fputs(stderr_is_terminal() ? erase_line : "\n", stderr);
}

void Progress::show(double finished, double total) {
  if (kind_ == ProgressKind::none || !(total > 0)) return;
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

/// Keeps the clock going while nothing finishes.
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

void Progress::draw() {
  if (kind_ == ProgressKind::lines) return print_line();
  std::fprintf(stderr, "%s%s", stderr_is_terminal() ? erase_line : "\r", bar(columns_of_stderr()).c_str());
  std::fflush(stderr);
}

void Progress::print_line() {
  const std::optional<double> left = seconds_left();
  const double seconds = now();
  if (!left || seconds < 1 || (next_line_ ? seconds < *next_line_ : *left < worth_a_line)) return;
  next_line_ = seconds + between_lines;
  std::fprintf(stderr, "%.0f of %.0f %s, about %s left\n", std::floor(finished_), total_, counted_,
               clock_text(*left).c_str());
  std::fflush(stderr);
}

/// The line that fits, one column left free for the cursor: of bar, counts and speed the speed goes first, then counts.
std::string Progress::bar(std::size_t columns) const {
  constexpr std::size_t longest = 30, shortest = 8, brackets = 3;
  const double share = finished_ / total_, seconds = now();
  const std::optional<double> left = seconds_left();
  const std::string percent = formatted("%3.0f %%", std::floor(100 * share));
  const std::string counts =
      "  " + formatted("%.0f", std::floor(finished_)) + '/' + formatted("%.0f", total_) + ' ' + counted_;
  const std::string speed =
      "  " + formatted("%.0f", seconds > 0 ? (finished_ - before_) / seconds : 0.0) + ' ' + counted_ + "/s";
  const std::string clock = "  " + (left ? clock_text(*left) : "-:--:--") + " left";
  for (const std::string& middle : {counts + speed, counts, std::string()}) {
    const std::size_t taken = percent.size() + middle.size() + clock.size() + brackets;
    if (taken + shortest >= columns) continue;
    const std::size_t width = std::min(longest, columns - 1 - taken);
    const auto filled = static_cast<std::size_t>(share * static_cast<double>(width));
    return '[' + std::string(color_ ? "\033[32m" : "") + std::string(filled, '#') + (color_ ? "\033[0m" : "") +
           std::string(width - filled, '.') + "] " + percent + middle + clock;
  }
  return (percent + clock).substr(0, columns - 1);
}

}  // namespace clatter::app
