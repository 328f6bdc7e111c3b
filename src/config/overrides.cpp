#include <algorithm>

#include "config/config.hpp"
#include "config/parsed_config.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

std::string words_of(const Override& change) { return "--set " + change.key + '=' + change.value; }

/// The command line has the encoding of the terminal or script, which need not be UTF-8.
void check_words(const Override& change) {
  const std::string words = words_of(change);
  const std::size_t wrong = storage::find_not_utf8(words);
  if (wrong != std::string::npos) {
    fail({storage::printable(words), 0, 0},
         "the byte " + storage::printable(words.substr(wrong, 1)) +
             " is not UTF-8; use a terminal (or a script) in UTF-8, or put the text in a file");
  }
  check_characters("--set", change.key + '=' + change.value);
}

ParsedEntry entry_of(const Override& change) {
  const SourceLocation location{words_of(change), 0, 0};
  const std::string key(without_blanks(change.key));
  const std::size_t dot = key.find('.');
  const bool top_level = dot == std::string::npos;
  ParsedEntry entry{top_level ? "" : key.substr(0, dot), top_level ? key : key.substr(dot + 1), location, {}};
  entry.value = {unquoted(without_blanks(change.value)), location, true, 0};
  return entry;
}

}  // namespace

void apply_overrides(ParsedConfig& parsed, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) {
    check_words(change);
    ParsedEntry entry = entry_of(change);
    const auto same = std::find_if(parsed.entries.begin(), parsed.entries.end(), [&](const ParsedEntry& other) {
      return other.section == entry.section && other.key == entry.key;
    });
    if (same == parsed.entries.end()) {
      parsed.entries.push_back(std::move(entry));
    } else {
      *same = std::move(entry);
    }
  }
}

}  // namespace clatter::config
