#include <algorithm>
#include <boost/program_options.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "config/keys.hpp"
#include "config/parsed_config.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr char stand_in = '\x01';  ///< for '#', a comment to Boost; a text that passes check_characters has none

/// A part of a line, with its columns.
struct Part {
  std::string_view line;
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::string_view text() const { return line.substr(begin, end - begin); }
};

Part trimmed(Part part) {
  while (part.begin < part.end && blanks.find(part.line[part.begin]) != std::string_view::npos) ++part.begin;
  while (part.end > part.begin && blanks.find(part.line[part.end - 1]) != std::string_view::npos) --part.end;
  return part;
}

bool is_blank_or_comment(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos || text[first] == ';' || text[first] == '#';
}

/// Scans INI text line by line: records every location, and leaves plain KEY = VALUE lines without comments to Boost.
class IniScanner {
 public:
  explicit IniScanner(const std::string& file) : parsed_{file, {}, {}} {}

  void scan(std::string_view line) {
    ++line_;
    const Part content = trimmed({line, 0, line.size()});
    if (is_blank_or_comment(content.text())) return;
    if (content.text().front() == '[') {
      scan_section(content);
    } else {
      scan_entry(content);
    }
  }

  /// Entries without values; Boost reads these from plain().
  [[nodiscard]] ParsedConfig& parsed() { return parsed_; }
  [[nodiscard]] const std::string& plain() const { return plain_; }

 private:
  [[nodiscard]] SourceLocation location(const Part& part) const {
    return {parsed_.file, line_, 1 + storage::characters(part.line.substr(0, part.begin))};
  }

  /// A part in the form passed to Boost.
  [[nodiscard]] static std::string plain(const Part& part) {
    std::string text(part.text());
    std::replace(text.begin(), text.end(), '#', stand_in);
    return text;
  }

  void scan_section(const Part& content) {
    const std::size_t close = content.line.find(']', content.begin);
    if (close == std::string_view::npos) fail(location(content), "the section's ']' is missing; write e.g. [scene]");
    const Part rest{content.line, close + 1, content.end};
    if (!is_blank_or_comment(rest.text()))
      fail(location(trimmed(rest)), "text after the section's ']'; begin a new line");
    const Part name = trimmed({content.line, content.begin + 1, close});
    if (name.text().empty()) fail(location(content), "a section without a name; write e.g. [scene]");
    const std::string section(name.text());
    if (const auto [first, is_new] = line_of_section_.try_emplace(section, line_); !is_new)
      fail(location(name), "section [" + section + "] again; it began at line " + std::to_string(first->second));
    parsed_.sections.push_back({section, location(name)});
    line_of_key_.clear();
    plain_ += '[' + plain(name) + "]\n";
  }

  void scan_entry(const Part& content) {
    const std::size_t sign = content.line.find_first_of("=;#", content.begin);
    if (sign == std::string_view::npos || content.line[sign] != '=') {
      fail(location(content), "expected KEY = VALUE or [section], found '" + std::string(content.text()) + "'");
    }
    const Part key = trimmed({content.line, content.begin, sign});
    if (key.text().empty()) fail(location(content), "a key is missing before '='");
    add_entry(key, value_part(key.text(), trimmed({content.line, sign + 1, content.end})));
  }

  /// The value without the comment that follows it.
  [[nodiscard]] Part value_part(std::string_view key, Part value) const {
    const std::string_view text = value.text();
    if (text.starts_with('"') || text.starts_with('\'')) {
      const std::size_t close = text.find(text.front(), 1);
      if (close == std::string_view::npos) fail(location(value), "the closing quote is missing");
      const Part rest{value.line, value.begin + close + 1, value.end};
      if (!is_blank_or_comment(rest.text()))
        fail(location(trimmed(rest)), "text after the closing quote; quote the whole value, or nothing");
      value.end = rest.begin;
      return value;
    }
    const bool free_text = is_free_text(parsed_.sections.empty() ? "" : parsed_.sections.back().name, key);
    for (std::size_t at = value.begin; at < value.end; ++at) {
      const bool after_blank = blanks.find(value.line[at - 1]) != std::string_view::npos;
      const bool parts_rows = value.line[at] == ';' && key == "force_table";
      const bool begins_comment = (value.line[at] == ';' && !parts_rows) || value.line[at] == '#';
      if (begins_comment && (after_blank || !free_text)) value.end = at;  // a title may hold "a;b"
    }
    return trimmed(value);
  }

  void add_entry(const Part& key, const Part& value) {
    const std::string section = parsed_.sections.empty() ? "" : parsed_.sections.back().name;
    const std::string name(key.text());
    if (const auto [first, is_new] = line_of_key_.try_emplace(name, line_); !is_new)
      fail(location(key), "key '" + name + "' again; it was given at line " + std::to_string(first->second));
    ParsedValue parsed_value{{}, location(value), true, value.text().find_first_of("\"'") == 0 ? 1 : 0};
    parsed_.entries.push_back({section, name, location(key), std::move(parsed_value)});
    plain_ += plain(key) + '=' + plain(value) + '\n';
  }

  ParsedConfig parsed_;
  std::string plain_;
  int line_ = 0;
  std::unordered_map<std::string, int> line_of_section_;
  std::unordered_map<std::string, int> line_of_key_;  ///< of the present section
};

/// The value as written, from Boost's reading of it.
std::string written(std::string value) {
  std::replace(value.begin(), value.end(), stand_in, '#');
  return unquoted(value);
}

}  // namespace

ParsedConfig read_ini(const std::string& file, std::string_view text) {
  check_characters(file, text);
  IniScanner scanner(file);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    scanner.scan(text.substr(begin, end - begin));
    begin = end + 1;
  }
  std::istringstream plain(scanner.plain());
  const boost::program_options::options_description none;
  const auto by_boost = boost::program_options::parse_config_file(plain, none, true);
  ParsedConfig parsed = std::move(scanner.parsed());
  if (by_boost.options.size() != parsed.entries.size())
    throw std::logic_error("the INI scanner and Boost's parser disagree");
  for (std::size_t i = 0; i < parsed.entries.size(); ++i)
    parsed.entries[i].value.data = written(by_boost.options[i].value.at(0));
  return parsed;
}

}  // namespace clatter::config
