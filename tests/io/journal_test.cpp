#include "io/journal.hpp"

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

#include "io/error.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

using Records = std::vector<std::string>;

const JournalKey key{"nu = 1\nxs = 2\n", "1.0", "avx2", "1/3"};

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

/// A directory of its own for each test, since ctest runs them side by side.
class JournalFile : public testing::Test {
 protected:
  JournalFile() { fs::create_directories(directory_); }
  ~JournalFile() override { fs::remove_all(directory_); }

  [[nodiscard]] std::string output() const { return (directory_ / "a.h5").string(); }
  [[nodiscard]] std::string path() const { return output() + ".journal"; }
  [[nodiscard]] std::string content() const {
    std::ifstream file{path(), std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
  }
  void overwrite(const std::string& text) const { std::ofstream{path(), std::ios::binary} << text; }

  /// Keeps records as a run does that is then killed.
  void write(const Records& records, Journal::Begin begin = Journal::Begin::anyhow) const {
    Journal journal(output(), key, begin, [](auto) {});
    for (const std::string& text : records) journal.append(bytes_of(text));
    journal.sync();
  }
  /// What the next run finds.
  [[nodiscard]] Records found(const JournalKey& by = key, Journal::Begin begin = Journal::Begin::anyhow) const {
    Records records;
    const Journal journal(output(), by, begin,
                          [&](std::span<const std::byte> bytes) { records.push_back(text_of(bytes)); });
    EXPECT_EQ(journal.has_records(), !records.empty());
    return records;
  }
  [[nodiscard]] std::string refusal(const JournalKey& by = key, Journal::Begin begin = Journal::Begin::anyhow) const {
    try {
      (void)found(by, begin);
      return "";
    } catch (const IoError& error) {
      return error.what();
    }
  }

 private:
  fs::path directory_ = fs::path{testing::TempDir()} / ("clatter_journal_" + std::to_string(::getpid()) + "_" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
};

const Records three{"seven", "", std::string(70000, 'x')};

TEST_F(JournalFile, holds_what_was_added_for_the_next_run) {
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
  Journal(output(), key, Journal::Begin::anyhow, [](auto) {}).remove();
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(JournalFile, begins_anew_where_that_is_asked_for) {
  write(three);
  write({"one"}, Journal::Begin::restart);
  EXPECT_EQ(found(), (Records{"one"}));
  overwrite(content() + "torn");
  EXPECT_EQ(found(key, Journal::Begin::restart), Records{});
}

TEST_F(JournalFile, resumes_only_what_there_is) {
  EXPECT_NE(refusal(key, Journal::Begin::resume).find("nothing to resume"), std::string::npos);
  EXPECT_FALSE(fs::exists(path()));
  write(three);
  EXPECT_EQ(found(key, Journal::Begin::resume), three);
}

TEST_F(JournalFile, refuses_another_key_and_says_what_differs) {
  write(three);
  const std::string before = content();
  const std::string config = refusal({"nu = 3\nxs = 2\n", "1.0", "avx2", "1/3"});
  EXPECT_NE(config.find("nu = 1"), std::string::npos) << config;
  EXPECT_NE(config.find("nu = 3"), std::string::npos) << config;
  EXPECT_EQ(config.find("xs = 2"), std::string::npos) << config;
  EXPECT_NE(config.find("--restart"), std::string::npos) << config;
  EXPECT_NE(refusal({key.config, "1.1", key.rounding, key.shard}).find("1.1"), std::string::npos);
  EXPECT_NE(refusal({key.config, key.program, "sse2", key.shard}).find("sse2"), std::string::npos);
  EXPECT_NE(refusal({key.config, key.program, key.rounding, ""}).find("whole sweep"), std::string::npos);
  EXPECT_NE(refusal({key.config, key.program, key.rounding, "2/3"}).find("shard 2/3"), std::string::npos);
  EXPECT_EQ(content(), before);
}

TEST_F(JournalFile, of_two_runs_only_one_has_it) {
  Journal first(output(), key, Journal::Begin::anyhow, [](auto) {});
  first.append(bytes_of("one"));
  EXPECT_THROW(Journal(output(), key, Journal::Begin::restart, [](auto) {}), BusyError);
  first.append(bytes_of("two"));
  EXPECT_THROW((void)found(), BusyError);
}

TEST_F(JournalFile, tells_others_that_its_output_is_being_written) {
  require_idle(output());
  EXPECT_FALSE(fs::exists(path()));
  {
    const Journal journal(output(), key, Journal::Begin::anyhow, [](auto) {});
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
    write({"four"});  // goes on after the cut
    Records longer = left;
    longer.push_back("four");
    EXPECT_EQ(found(), longer) << length;
  }
  EXPECT_EQ(most, 3u);
}

TEST_F(JournalFile, with_zeros_at_its_end_gives_what_is_before_them) {
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
    for (const Journal::Begin begin : {Journal::Begin::anyhow, Journal::Begin::restart})
      EXPECT_NE(refusal(key, begin).find("no journal"), std::string::npos) << foreign;
    EXPECT_EQ(content(), foreign);
  }
}

TEST_F(JournalFile, on_a_full_disk_keeps_what_it_had) {
  write(three);
  const std::string before = content();
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, SIG_IGN);  // as the program does: a write beyond the limit then gives EFBIG
  for (const rlim_t more : {0U, 1U, 15U, 16U, 17U, 60U, 5000U}) {
    const rlimit full{static_cast<rlim_t>(before.size()) + more, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
    {
      Journal journal(output(), key, Journal::Begin::anyhow, [](auto) {});
      EXPECT_THROW(journal.append(bytes_of(std::string(100000, 'y'))), IoError) << more;
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(content(), before) << more;
  }
  EXPECT_EQ(found(), three);
}

}  // namespace
}  // namespace clatter
