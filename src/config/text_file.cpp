#include "config/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <filesystem>

#include "storage/error.hpp"
#include "storage/file_calls.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

[[noreturn]] void unreadable(const std::string& path, const std::string& reason) {
  throw storage::IoError(storage::printable(path) + ": cannot be read: " + reason);
}

bool is_control(std::string_view text) {
  const char first = text[0];
  if (first == '\t' || first == '\n') return false;
  if (first == '\r') return text.size() < 2 || text[1] != '\n';
  return static_cast<unsigned char>(first) < 0x20 || first == 0x7F;
}

/// Reads piece by piece up to the limit: clearing a buffer of that size would take longer than reading most files.
std::string read_pieces(int file, const std::string& name) {
  std::string text;
  std::array<char, std::size_t{16} * 1024> piece;
  while (text.size() <= max_table_bytes + max_config_bytes) {
    const ssize_t count = storage::uninterrupted([&] { return ::read(file, piece.data(), piece.size()); });
    if (count < 0) unreadable(name, storage::reason_and_way_out(errno, ""));
    if (count == 0) break;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  return text;
}

std::string bytes_of(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) unreadable(path, "it is a directory; name a file");
  const storage::Descriptor file{storage::uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })};
  if (file.number() < 0) unreadable(path, storage::reason_and_way_out(errno, ""));
  return read_pieces(file.number(), path);
}

/// Checks that the bytes of a file are text, and returns it.
std::string as_text(const std::string& name, std::string bytes, std::size_t max_bytes) {
  if (bytes.starts_with("\x89HDF"))
    unreadable(name, "it is an HDF5 file; `clatter info --config` prints the configuration of an output");
  if (bytes.find('\0') != std::string::npos) unreadable(name, "it holds NUL bytes; expected UTF-8 text");
  if (bytes.size() > max_bytes)
    fail({name, 1, 1}, max_bytes == max_config_bytes
                           ? "more than 1 MiB; write long lists as functions, e.g. linspace(a, b, n)"
                           : "more than 8 MiB; a force is measured well with fewer rows, or fewer digits");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  return bytes;
}

/// The same of a configuration, which is longer with a table in it.
std::string as_configuration(const std::string& name, std::string bytes) {
  const bool has_table = bytes.find("force_table") != std::string::npos;
  return as_text(name, std::move(bytes), has_table ? max_table_bytes + max_config_bytes : max_config_bytes);
}

}  // namespace

bool has_ending(std::string_view name, std::string_view ending) {
  if (name.size() < ending.size()) return false;
  return std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char left, char right) { return left == std::tolower(static_cast<unsigned char>(right)); });
}

std::string read_text(const std::string& path) { return as_configuration(path, bytes_of(path)); }

std::string read_table(const std::string& path) { return as_text(path, bytes_of(path), max_table_bytes); }

std::string read_standard_input(const std::string& name) {
  return as_configuration(name, read_pieces(STDIN_FILENO, name));
}

SourceLocation location_of(const std::string& file, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0, the first line
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return {file, static_cast<int>(line), 1 + storage::characters(before.substr(line_begin))};
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

void check_characters(const std::string& file, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = storage::utf8_length(text.substr(at));
    if (length == 0) fail(location_of(file, text, at), "a byte that is not UTF-8; save the file as UTF-8");
    if (is_control(text.substr(at)))
      fail(location_of(file, text, at), "a control character; only tabs and line ends are allowed");
    at += length;
  }
}

}  // namespace clatter::config
