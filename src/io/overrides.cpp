#include <algorithm>

#include "io/raw_config.hpp"
#include "io/text_file.hpp"

namespace clatter {
namespace {

RawEntry entry_of(const Override& change) {
  const Place place{"--set " + change.key + '=' + change.value, 0, 0};
  const std::size_t dot = change.key.find('.');
  const bool top_level = dot == std::string::npos;
  RawEntry entry{
      top_level ? "" : change.key.substr(0, dot), top_level ? change.key : change.key.substr(dot + 1), place, {}};
  entry.value = {unquoted(change.value), place, true, 0};
  return entry;
}

}  // namespace

void apply_overrides(RawConfig& raw, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) {
    check_characters("--set", change.key + '=' + change.value);
    RawEntry entry = entry_of(change);
    const auto same = std::find_if(raw.entries.begin(), raw.entries.end(), [&](const RawEntry& other) {
      return other.section == entry.section && other.key == entry.key;
    });
    if (same == raw.entries.end()) {
      raw.entries.push_back(std::move(entry));
    } else {
      *same = std::move(entry);
    }
  }
}

}  // namespace clatter
