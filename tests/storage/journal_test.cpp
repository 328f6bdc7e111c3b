#include "storage/journal.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "storage/crc32.hpp"
#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::storage::journal_test {
namespace {

namespace fs = std::filesystem;

using Records = std::vector<std::string>;

const JournalKey key{"nu = 1\nxs = 2\n", "1.0", "avx2", "1/3"};
constexpr std::size_t most_bytes = 1'000'000;  // the most bytes of a record
constexpr RecordLimit usual{most_bytes};

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

/// The head of a block, with a valid checksum of its own.
std::string zeros_head(std::uint64_t length) {
  std::string head(reinterpret_cast<const char*>(&length), sizeof length);
  head.append(4, '\0');
  const std::uint32_t check = crc32_of(bytes_of(head));
  return head.append(reinterpret_cast<const char*>(&check), sizeof check);
}

class JournalFile : public testing::Test {
 protected:
  [[nodiscard]] std::string output() const { return directory_.path("a.h5"); }
  [[nodiscard]] std::string path() const { return output() + ".journal"; }
  [[nodiscard]] std::string content() const { return directory_.content("a.h5.journal"); }
  void overwrite(const std::string& text) const { directory_.write("a.h5.journal", text); }

  /// Writes records as a run that is then killed.
  void write(const Records& records, Journal::Begin begin = Journal::Begin::resume_if_any) const {
    Journal journal(output(), key, usual, begin, [](auto) {});
    for (const std::string& text : records) journal.append(bytes_of(text));
    journal.sync();
  }
  /// The records that the next run finds.
  [[nodiscard]] Records found(const JournalKey& by = key, Journal::Begin begin = Journal::Begin::resume_if_any) const {
    Records records;
    const Journal journal(output(), by, usual, begin,
                          [&](std::span<const std::byte> bytes) { records.push_back(text_of(bytes)); });
    EXPECT_EQ(journal.has_records(), !records.empty());
    return records;
  }
  [[nodiscard]] std::string refusal(const JournalKey& by = key,
                                    Journal::Begin begin = Journal::Begin::resume_if_any) const {
    try {
      (void)found(by, begin);
      return "";
    } catch (const IoError& error) {
      return error.what();
    }
  }

 private:
  support::TemporaryDirectory directory_;
};

const Records three{"seven", "", std::string(70000, 'x')};

TEST_F(JournalFile, holds_added_records_for_the_next_run) {
  write(three);
  EXPECT_EQ(found(), three);
  write({"nine"});
  Records four = three;
  four.push_back("nine");
  EXPECT_EQ(found(), four);
}

TEST_F(JournalFile, is_not_there_without_records_nor_after_remove) {
  write({});
  EXPECT_FALSE(fs::exists(path()));
  write(three);
  Journal(output(), key, usual, Journal::Begin::resume_if_any, [](auto) {}).remove();
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(JournalFile, begins_anew_on_request) {
  write(three);
  write({"one"}, Journal::Begin::restart);
  EXPECT_EQ(found(), (Records{"one"}));
  overwrite(content() + "torn");
  EXPECT_EQ(found(key, Journal::Begin::restart), Records{});
}

TEST_F(JournalFile, resumes_only_an_existing_file) {
  EXPECT_NE(refusal(key, Journal::Begin::resume).find("nothing to resume"), std::string::npos);
  EXPECT_FALSE(fs::exists(path()));
  write(three);
  EXPECT_EQ(found(key, Journal::Begin::resume), three);
}

TEST_F(JournalFile, refuses_each_other_key_and_tells_it) {
  write(three);
  const std::string before = content();
  for (const JournalKey& other :
       {JournalKey{"nu = 3\nxs = 2\n", key.program, key.rounding, key.shard},
        JournalKey{key.config, "1.1", key.rounding, key.shard}, JournalKey{key.config, key.program, "sse2", key.shard},
        JournalKey{key.config, key.program, key.rounding, ""}}) {
    try {
      (void)found(other);
      ADD_FAILURE() << "it was taken";
    } catch (const OtherRun& refused) {
      EXPECT_EQ(refused.key(), key);
      EXPECT_NE(std::string(refused.what()).find("--restart"), std::string::npos);
    }
  }
  EXPECT_EQ(content(), before);
}

TEST_F(JournalFile, of_two_runs_only_one_has_it) {
  Journal first(output(), key, usual, Journal::Begin::resume_if_any, [](auto) {});
  first.append(bytes_of("one"));
  EXPECT_THROW(Journal(output(), key, usual, Journal::Begin::restart, [](auto) {}), BusyError);
  first.append(bytes_of("two"));
  EXPECT_THROW((void)found(), BusyError);
}

TEST_F(JournalFile, tells_others_that_its_output_is_being_written) {
  require_idle(output());
  EXPECT_FALSE(fs::exists(path()));
  {
    const Journal journal(output(), key, usual, Journal::Begin::resume_if_any, [](auto) {});
    EXPECT_THROW(require_idle(output()), BusyError);
  }
  write(three);  // by a run that has ended
  require_idle(output());
  EXPECT_EQ(found(), three);
}

TEST_F(JournalFile, cut_anywhere_gives_its_whole_records) {
  const Records small{"one", "two", "three"};
  write(small);
  const std::string whole = content();
  std::size_t most = 0;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    overwrite(whole.substr(0, length));
    const Records left = found();
    ASSERT_LE(left.size(), small.size()) << length;
    EXPECT_TRUE(std::ranges::equal(left, std::span(small).first(left.size()))) << length;
    EXPECT_GE(left.size(), most) << length;
    most = left.size();
    overwrite(whole.substr(0, length));
    write({"four"});  // continues after the cut
    Records longer = left;
    longer.push_back("four");
    EXPECT_EQ(found(), longer) << length;
  }
  EXPECT_EQ(most, 3u);
}

TEST_F(JournalFile, with_zeros_at_its_end_gives_the_records_before_them) {
  write(three);
  overwrite(content() + std::string(5000, '\0'));
  EXPECT_EQ(found(), three);
  overwrite(content() + std::string(40, '\0') + 'x');
  EXPECT_NE(refusal().find("damaged"), std::string::npos);
}

TEST_F(JournalFile, with_a_flipped_bit_is_refused_and_left_alone) {
  write({"one", "two"});
  const std::string whole = content();
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
    overwrite(damaged);
    EXPECT_NE(refusal(), "") << bit;
    EXPECT_EQ(content(), damaged) << bit;
  }
}

TEST_F(JournalFile, of_something_else_is_refused_and_left_alone) {
  for (const std::string foreign : {"x", "clatter journal 2\n", "\x89HDF\r\n\x1a\n and so on"}) {
    overwrite(foreign);
    for (const Journal::Begin begin : {Journal::Begin::resume_if_any, Journal::Begin::restart})
      EXPECT_NE(refusal(key, begin).find("is not a journal"), std::string::npos) << foreign;
    EXPECT_EQ(content(), foreign);
  }
}

TEST_F(JournalFile, on_a_full_disk_keeps_its_records) {
  write(three);
  const std::string before = content();
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, SIG_IGN);  // as the program does: a write beyond the limit then gives EFBIG
  for (const rlim_t more : {0U, 1U, 15U, 16U, 17U, 60U, 5000U}) {
    const rlimit full{static_cast<rlim_t>(before.size()) + more, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
    {
      Journal journal(output(), key, usual, Journal::Begin::resume_if_any, [](auto) {});
      EXPECT_THROW(journal.append(bytes_of(std::string(100000, 'y'))), IoError) << more;
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(content(), before) << more;
  }
  EXPECT_EQ(found(), three);
}

TEST_F(JournalFile, of_a_tebibyte_of_zeros_is_not_read_to_its_end) {
  write(three);
  const std::uintmax_t size = fs::file_size(path());
  std::error_code error;
  fs::resize_file(path(), std::uintmax_t{1} << 40U, error);
  if (error) GTEST_SKIP() << "no sparse files here";
  EXPECT_EQ(found(), three);
  EXPECT_EQ(fs::file_size(path()), size);
}

TEST_F(JournalFile, with_a_longer_record_than_a_run_writes_is_damaged) {
  write({std::string(most_bytes, 'x')});
  EXPECT_EQ(found(), Records{std::string(most_bytes, 'x')});
  write({std::string(most_bytes + 1, 'x')}, Journal::Begin::restart);
  EXPECT_NE(refusal().find("damaged"), std::string::npos);
}

TEST_F(JournalFile, with_a_log_has_no_longer_record_than_it_can_hold) {
  constexpr RecordLimit with_log{most_bytes, true};
  Records records;
  const auto take = [&](std::span<const std::byte> bytes) { records.push_back(text_of(bytes)); };
  write({std::string(5 * most_bytes, 'x')});
  (void)Journal(output(), key, with_log, Journal::Begin::resume_if_any, take);
  EXPECT_EQ(records, Records{std::string(5 * most_bytes, 'x')});
  overwrite(content().substr(0, content().size() - 5 * most_bytes - 16) + zeros_head(std::uint64_t{1} << 36U));
  fs::resize_file(path(), fs::file_size(path()) + (std::uintmax_t{1} << 36U));
  EXPECT_THROW(Journal(output(), key, with_log, Journal::Begin::resume_if_any, take), IoError);
}

TEST_F(JournalFile, gives_the_room_of_its_last_records_back) {
  const std::string large(900'000, 'x');
  Journal journal(output(), key, usual, Journal::Begin::resume_if_any, [](auto) {});
  for (int i = 0; i < 5; ++i) journal.append(bytes_of(large));
  const std::uintmax_t size = fs::file_size(path());
  journal.give_back(size + 1);  // more bytes than there are: not even all would suffice
  EXPECT_EQ(fs::file_size(path()), size);
  journal.give_back(1'000'000);
  EXPECT_LE(fs::file_size(path()), size - 1'000'000);
  EXPECT_GT(fs::file_size(path()), 1'800'000U);
  EXPECT_NE(journal.leave().find("a part of the finished points"), std::string::npos);
  journal.give_back(fs::file_size(path()));
  EXPECT_EQ(fs::file_size(path()), 0U);
  EXPECT_NE(journal.leave().find("have to be run again"), std::string::npos);
}

TEST_F(JournalFile, is_as_private_as_its_output) {
  std::ofstream{output()} << "an older one";
  fs::permissions(output(), fs::perms::owner_read | fs::perms::owner_write);
  write(three);
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(JournalFile, that_cannot_be_looked_at_is_not_idle) {
  require_idle(output());
  fs::create_directory(path());
  EXPECT_THROW(require_idle(output()), IoError);
  fs::remove(path());
  fs::create_symlink("elsewhere", path());
  EXPECT_THROW(require_idle(output()), IoError);
}

}  // namespace
}  // namespace clatter::storage::journal_test
