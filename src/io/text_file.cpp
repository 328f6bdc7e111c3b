#include "io/text_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "io/error.hpp"
#include "io/file_calls.hpp"

namespace clatter {
namespace {

[[noreturn]] void unreadable(const std::string& path, const std::string& reason) {
  throw IoError(path + ": cannot be read: " + reason);
}

std::uint8_t byte(char character) { return static_cast<std::uint8_t>(character); }

bool is_continuation(char character) { return (byte(character) & 0xC0) == 0x80; }

/// Bytes of the UTF-8 character that begins the text, 0 where none does (RFC 3629: no overlong forms, no surrogates).
std::size_t utf8_length(std::string_view text) {
  const std::uint8_t lead = byte(text[0]);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), is_continuation)) return 0;
  const std::uint8_t second = byte(text[1]);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool beyond = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90);
  return overlong || beyond ? 0 : length;
}

bool is_control(std::string_view text) {
  const char first = text[0];
  if (first == '\t' || first == '\n') return false;
  if (first == '\r') return text.size() < 2 || text[1] != '\n';
  return byte(first) < 0x20 || byte(first) == 0x7F;
}

/// The controls of ISO 6429 beyond ASCII, U+0080 ... U+009F, which terminals obey as they do ESC.
bool is_c1(std::string_view text) { return text.size() > 1 && byte(text[0]) == 0xC2 && byte(text[1]) < 0xA0; }

void append_hexadecimal(std::string& text, std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  for (const char character : bytes) text += {'\\', 'x', digits[byte(character) / 16], digits[byte(character) % 16]};
}

/// Reads until there is more than is permitted; room for that much at once takes longer to clear than most files to
/// read.
std::string read_pieces(std::istream& stream) {
  std::string text;
  std::array<char, 16 * 1024> piece;
  while (stream && text.size() <= max_config_bytes) {
    stream.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

/// The bytes of a configuration as text, or an error.
std::string as_text(const std::string& name, std::string bytes) {
  if (bytes.find('\0') != std::string::npos)
    unreadable(name, "it holds NUL bytes, so it is no text; a configuration is UTF-8 text");
  if (bytes.size() > max_config_bytes)
    throw ConfigError(name + ":1:1: more than 1 MiB; write long lists as linspace, logspace or arange");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  return bytes;
}

}  // namespace

bool has_ending(std::string_view name, std::string_view ending) {
  if (name.size() < ending.size()) return false;
  return std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char left, char right) { return left == std::tolower(static_cast<unsigned char>(right)); });
}

std::string read_text(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) unreadable(path, "it is a directory; name a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) unreadable(path, reason_and_way_out(errno, ""));
  std::string text = read_pieces(stream);
  if (stream.bad()) unreadable(path, reason_and_way_out(errno, ""));
  return as_text(path, std::move(text));
}

std::string read_standard_input(const std::string& name) {
  std::string text;
  std::array<char, 16 * 1024> piece;
  while (text.size() <= max_config_bytes) {
    const ssize_t count = uninterrupted([&] { return ::read(STDIN_FILENO, piece.data(), piece.size()); });
    if (count < 0) unreadable(name, reason_and_way_out(errno, ""));
    if (count == 0) break;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  return as_text(name, std::move(text));
}

int characters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char character) { return !is_continuation(character); }));
}

Place place_of(const std::string& file, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return {file, static_cast<int>(line), 1 + characters(before.substr(line_begin))};
}

std::string unquoted(std::string_view text) {
  const bool pair = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return std::string(pair ? text.substr(1, text.size() - 2) : text);
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    const std::string_view character = text.substr(at, std::max<std::size_t>(length, 1));
    const bool obeyed = byte(character[0]) < 0x20 || byte(character[0]) == 0x7F || is_c1(character);
    if (length == 0 || obeyed) {
      append_hexadecimal(shown, character);
    } else {
      shown += character;
    }
    at += character.size();
  }
  return shown;
}

std::size_t find_not_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

void check_characters(const std::string& file, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) fail(place_of(file, text, at), "a byte that is not UTF-8; save the file as UTF-8");
    if (is_control(text.substr(at)))
      fail(place_of(file, text, at), "a control character; only tabs and line ends are permitted");
    at += length;
  }
}

}  // namespace clatter
