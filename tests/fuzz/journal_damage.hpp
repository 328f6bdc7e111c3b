#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scratch.hpp"
#include "storage/journal.hpp"

namespace clatter::fuzz {

using Records = std::vector<std::string>;

inline const storage::JournalKey journal_key{"[scene]\nxs = -4.0\n", "0.1.0", "avx2", ""};

/// Records of no bytes, few, more, and again few, so that damage hits heads as well as blocks.
inline Records written_records() { return {"seven", "", std::string(300, 'x'), "three", std::string(40, '\0')}; }

inline std::string journal_path() { return scratch().path("a.h5.journal"); }

/// Opens the journal as a run does, and adds some records; returns those that were in it.
inline Records open_journal(storage::Journal::Begin begin, const Records& more = {}) {
  Records records;
  storage::Journal journal(scratch().path("a.h5"), journal_key, {1e6}, begin, [&](std::span<const std::byte> bytes) {
    records.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
  require(journal.has_records() == !records.empty(), "has_records() is wrong");
  for (const std::string& record : more) journal.append(std::as_bytes(std::span(record)));
  return records;
}

/// The bytes of a sound journal.
inline std::string sound_journal() {
  (void)open_journal(storage::Journal::Begin::restart, written_records());
  return content(journal_path());
}

/// A change of the bytes of a journal: its kind, position and length.
struct Damage {
  enum Kind : std::uint8_t { cut, flip, zeros, append, append_zeros, repeat, remove, kinds };

  std::uint8_t kind;
  std::array<std::uint8_t, 2> place;
  std::uint8_t amount;

  /// Whether it may repeat or remove whole records, which no checksum shows.
  [[nodiscard]] bool moves_records() const { return kind % kinds == repeat || kind % kinds == remove; }

  void apply(std::string& bytes) const {
    const std::size_t at = (std::size_t{place[0]} << 8U | place[1]) % (bytes.size() + 1);
    switch (kind % kinds) {
      case cut:
        return bytes.resize(at);
      case flip:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << amount % 8);
        return;
      case zeros:
        bytes.replace(at, amount, std::min<std::size_t>(amount, bytes.size() - at), '\0');
        return;
      case append:
        bytes.append(amount, static_cast<char>(place[0]));
        return;
      case append_zeros:
        bytes.append(std::size_t{amount} * 16, '\0');
        return;
      case repeat:
        bytes.insert(at, bytes.substr(at, std::size_t{amount} * 4));
        return;
      default:
        bytes.erase(at, std::size_t{amount} * 4);
        return;
    }
  }
};

/// The first byte of an input says whether the rest is the journal or changes of a sound one, and how it is opened.
inline constexpr std::uint8_t raw_journal = 1;

inline std::vector<std::pair<std::string, std::string>> journal_seeds() {
  const std::string sound = sound_journal();
  const auto seed = [](std::uint8_t first, const std::string& rest) { return static_cast<char>(first) + rest; };
  return {{"raw", seed(raw_journal, sound)},
          {"raw_torn", seed(raw_journal, sound.substr(0, sound.size() - 30))},
          {"sound", seed(0, "")},
          {"resumed", seed(2, "")},
          {"restarted", seed(4, "")},
          {"torn", seed(0, {0, 1, 0, 0})},
          {"flipped", seed(0, {1, 0, 99, 3})},
          {"zeros_at_its_end", seed(0, {4, 0, 0, 9})}};
}

}  // namespace clatter::fuzz
