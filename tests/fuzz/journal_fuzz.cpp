// The journal of a run that was stopped: however it is damaged, a run never continues from records that it didn't have.
#include <algorithm>
#include <cstring>
#include <optional>

#include "journal_damage.hpp"
#include "storage/error.hpp"

namespace clatter::fuzz {
namespace {

/// The journal's records, or nothing if it is refused; then it has to be left as it is.
std::optional<Records> records_of(const std::string& bytes, storage::Journal::Begin begin) {
  (void)write("a.h5.journal", bytes);
  try {
    return open_journal(begin);
  } catch (const storage::IoError&) {
    if (!bytes.empty()) require(content(journal_path()) == bytes, "a journal that was refused has changed");
    return std::nullopt;
  }
}

/// A journal that wasn't refused can be appended to and gives all records again.
void require_goes_on(const Records& records) {
  const Records more{"nine", ""};
  require(open_journal(storage::Journal::Begin::resume_if_any, more) == records,
          "a journal gives other records the second time");
  Records all = records;
  all.insert(all.end(), more.begin(), more.end());
  require(open_journal(storage::Journal::Begin::resume) == all, "a journal lost records that were appended");
}

/// The header of a sound journal as a record: a copy of it among the records is as valid as they are.
std::string header_record(const std::string& sound) {
  constexpr std::size_t length_at = 18, block_at = length_at + 16;  // after the magic and the block's head
  std::uint64_t length = 0;
  std::memcpy(&length, &sound[length_at], sizeof length);
  return sound.substr(block_at, length);
}

/// Changes the bytes as the input says; true if that may have moved whole records.
bool damage_all(std::string& bytes, std::span<const std::uint8_t> input) {
  bool moved = false;
  for (; input.size() >= sizeof(Damage); input = input.subspan(sizeof(Damage))) {
    Damage damage{};
    std::memcpy(&damage, input.data(), sizeof damage);
    damage.apply(bytes);
    moved = moved || damage.moves_records();
  }
  return moved;
}

void check(std::span<const std::uint8_t> input) {
  static const std::string sound = sound_journal();
  const std::uint8_t first = input.empty() ? std::uint8_t{0} : input.front();
  const std::span<const std::uint8_t> rest = input.subspan(std::min<std::size_t>(1, input.size()));
  const auto begin = static_cast<storage::Journal::Begin>(first / 2 % 3);
  if ((first & raw_journal) != 0) {
    const auto records = records_of(std::string(rest.begin(), rest.end()), begin);
    if (records) require_goes_on(*records);
    return;
  }
  std::string bytes = sound;
  const bool moved = damage_all(bytes, rest);
  Records written = written_records();
  if (moved) written.push_back(header_record(sound));
  const auto records = records_of(bytes, begin);
  if (!records) return;
  require(begin != storage::Journal::Begin::restart || records->empty(), "records in spite of --restart");
  for (const std::string& record : *records)
    require(std::ranges::find(written, record) != written.end(), "a record that was never written");
  require(moved || (records->size() <= written.size() && std::equal(records->begin(), records->end(), written.begin())),
          "records in another order than they were written");
  require_goes_on(*records);
}

}  // namespace
}  // namespace clatter::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clatter::fuzz::check({data, size});
  return 0;
}
