#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "config/config.hpp"
#include "config/text_file.hpp"
#include "scratch.hpp"
#include "storage/error.hpp"
#include "sweep/sweep.hpp"

namespace clatter::fuzz {

/// A message has to be one line that begins with a position in the text, e.g. "/dev/shm/input.toml:7:6: ".
inline void require_place(const std::string& path, std::string_view text, const std::string& message) {
  require(message.starts_with(path + ':'), "a message without a position: " + message);
  require(std::ranges::none_of(message, [](unsigned char c) { return c < 0x20 || c == 0x7F; }),
          "a message with control characters: " + message);
  std::size_t line = 0, column = 0;
  const char* const end = message.data() + message.size();
  const auto [after_line, wrong] = std::from_chars(message.data() + path.size() + 1, end, line);
  require(wrong == std::errc{} && after_line != end && *after_line == ':', "no line in the position: " + message);
  require(std::from_chars(after_line + 1, end, column).ec == std::errc{}, "no column in the position: " + message);
  const auto lines = 1 + static_cast<std::size_t>(std::ranges::count(text, '\n'));
  require(line >= 1 && line <= lines, "a line that doesn't exist: " + message);
  for (std::size_t before = 1; before < line; ++before) text.remove_prefix(text.find('\n') + 1);
  const auto width = static_cast<std::size_t>(storage::characters(text.substr(0, text.find('\n'))));
  require(column >= 1 && column <= width + 1, "a column that doesn't exist: " + message);
}

/// Axes of up to ten million values each are made before errors behind them are found: many of them are slow and test
/// nothing new.
inline bool has_large_axes(std::string_view text) { return std::ranges::count(text, '(') > 3; }

/// Whether two dimensions have the same bits.
inline bool same_dimension(const sweep::Dimension& left, const sweep::Dimension& right) {
  return std::ranges::equal(left, right, [](const sweep::Axis& one, const sweep::Axis& other) {
    return one.parameter == other.parameter &&
           std::ranges::equal(std::as_bytes(std::span(one.values)), std::as_bytes(std::span(other.values)));
  });
}

/// Reads a configuration as the program does; the complete text of an accepted one has to read as the same again.
inline void check_configuration(const std::string& name, const std::string& text) {
  if (has_large_axes(text)) return;
  const std::string path = write(name, text);
  config::Config first;
  try {
    first = config::read_config(path, {});
  } catch (const config::ConfigError& error) {
    return require_place(path, text, error.what());
  } catch (const storage::IoError&) {  // not text
    return require(text.find('\0') != std::string::npos, "a file that can't be read");
  }
  const std::string complete = write("complete.toml", first.text);
  try {
    const config::Config second = config::read_config(complete, {});
    require(second.text == first.text, "the complete text gives another:\n" + first.text + "\n---\n" + second.text);
    require(second.title == first.title && second.source == first.source, "the complete text has other texts");
    require(size(second.sweep) == size(first.sweep), "the complete text has another number of points");
    require(second.sweep.follow == first.sweep.follow && second.compression == first.compression,
            "the complete text has other settings");
    require(second.warnings.size() <= first.warnings.size(),
            "the complete text has warnings that the text doesn't have");
    require(std::ranges::equal(first.sweep.dimensions, second.sweep.dimensions, same_dimension),
            "the complete text has other axes");
  } catch (const config::ConfigError& error) {
    finding(std::string("the complete text doesn't read again: ") + error.what() + '\n' + first.text);
  }
}

}  // namespace clatter::fuzz
