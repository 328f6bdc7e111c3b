#include "storage/atomic_write.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::storage::atomic_write_test {
namespace {

namespace fs = std::filesystem;

class AtomicWrite : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return directory_.path(name); }
  [[nodiscard]] std::size_t entries() const { return directory_.entries(); }
  [[nodiscard]] std::string content(const std::string& name) const { return directory_.content(name); }
  void write(const std::string& name, const std::string& text) const { directory_.write(name, text); }
  [[nodiscard]] struct stat status_of(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::stat(path(name).c_str(), &status), 0);
    return status;
  }

  /// The error of writing a text, or nothing if that succeeds.
  [[nodiscard]] static std::string refusal(const std::string& file, const std::string& text = "new") {
    try {
      write_atomically(file, text);
      return "";
    } catch (const IoError& error) {
      return error.what();
    }
  }

 private:
  support::TemporaryDirectory directory_;
};

TEST_F(AtomicWrite, replaces_an_older_file_and_leaves_nothing_else) {
  EXPECT_EQ(refusal(path("out.h5"), "old"), "");
  EXPECT_EQ(refusal(path("out.h5"), std::string(3'000'000, 'x')), "");
  EXPECT_EQ(content("out.h5"), std::string(3'000'000, 'x'));
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicWrite, gives_the_permissions_of_any_new_file) {
  const mode_t before = ::umask(027);
  EXPECT_EQ(refusal(path("out.h5")), "");
  ::umask(before);
  EXPECT_EQ(status_of("out.h5").st_mode & 0777U, 0640U);
}

/// Limits the size of files, which has the same effect on a writer as a full disk.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);  // as the program does: a write beyond the limit then gives EFBIG
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(AtomicWrite, a_full_disk_leaves_the_older_file_and_no_temporary_one) {
  EXPECT_EQ(refusal(path("out.h5"), "old"), "");
  std::string message;
  {
    const SizeLimit limit{100'000};
    message = refusal(path("out.h5"), std::string(1'000'000, 'x'));
  }
  EXPECT_EQ(message,
            "cannot write '" + path("out.h5") + "': File too large; free some space, or name a place that has more");
  EXPECT_EQ(content("out.h5"), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicWrite, refuses_names_that_cannot_become_a_file) {
  fs::create_directories(path("taken.h5"));
  const std::string missing = path("none/out.h5");
  EXPECT_EQ(refusal(missing), "cannot write '" + missing + "': there is no directory '" + path("none") +
                                  "'; make it with mkdir -p, or name another");
  EXPECT_NE(refusal(path("taken.h5")).find("is a directory"), std::string::npos);
  EXPECT_NE(refusal("/dev/null").find("not a regular file"), std::string::npos);
  EXPECT_NE(refusal("").find("empty name"), std::string::npos);
  EXPECT_NE(refusal(path(std::string(300, 'x'))).find("use a shorter name"), std::string::npos);
  EXPECT_THROW(check_writable(path("taken.h5")), IoError);
  EXPECT_THROW(check_writable(missing), IoError);
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicWrite, a_file_is_no_directory) {
  EXPECT_EQ(refusal(path("plain")), "");
  EXPECT_NE(refusal(path("plain/out.h5")).find("Not a directory"), std::string::npos);
}

TEST_F(AtomicWrite, permission_is_checked_as_the_kernel_would) {
  EXPECT_EQ(refusal(path("out.h5"), "old"), "");
  fs::permissions(path("out.h5"), fs::perms::owner_read);
  fs::create_directories(path("closed"));
  fs::permissions(path("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  if (::geteuid() == 0) {  // root may write everywhere
    EXPECT_EQ(refusal(path("out.h5")), "");
    EXPECT_EQ(refusal(path("closed/out.h5")), "");
  } else {
    EXPECT_NE(refusal(path("out.h5")).find("write-protected"), std::string::npos);
    EXPECT_NE(refusal(path("closed/out.h5")).find("Permission denied"), std::string::npos);
  }
  fs::permissions(path("closed"), fs::perms::owner_all);
}

TEST_F(AtomicWrite, checking_changes_nothing) {
  check_writable(path("out.h5"));
  EXPECT_EQ(entries(), 0U);
}

TEST_F(AtomicWrite, a_symbolic_link_stays_and_its_target_is_replaced) {
  fs::create_directories(path("scratch"));
  fs::create_symlink("scratch/far.h5", path("out.h5"));  // relative, and its target doesn't exist yet
  EXPECT_EQ(refusal(path("out.h5"), "first"), "");
  EXPECT_EQ(refusal(path("out.h5"), "second"), "");
  EXPECT_TRUE(fs::is_symlink(path("out.h5")));
  EXPECT_EQ(content("scratch/far.h5"), "second");
  fs::create_symlink("loop.h5", path("loop.h5"));
  EXPECT_NE(refusal(path("loop.h5")).find("symbolic links"), std::string::npos);
}

TEST_F(AtomicWrite, names_may_be_as_long_as_the_file_system_permits) {
  const std::string name(255, 'x');
  EXPECT_EQ(refusal(path(name)), "");
  EXPECT_EQ(content(name), "new");
}

TEST_F(AtomicWrite, keeps_mode_and_group_of_the_file_it_replaces) {
  EXPECT_EQ(refusal(path("out.h5")), "");
  const mode_t before = ::umask(077);
  for (const mode_t mode : {0600U, 0640U, 0664U}) {
    ASSERT_EQ(::chmod(path("out.h5").c_str(), mode), 0);
    EXPECT_EQ(refusal(path("out.h5")), "");
    EXPECT_EQ(status_of("out.h5").st_mode & 0777U, mode);
  }
  ::umask(before);
  if (::chown(path("out.h5").c_str(), 12, 34) != 0) GTEST_SKIP() << "only root may give files away";
  EXPECT_EQ(refusal(path("out.h5")), "");
  EXPECT_EQ(status_of("out.h5").st_uid, 12U);
  EXPECT_EQ(status_of("out.h5").st_gid, 34U);
}

TEST_F(AtomicWrite, removes_the_leftovers_of_a_killed_run) {
  const std::string begun = "\x89HDF\r\n\x1a\n and so on";
  for (const std::string& text : {std::string(), begun.substr(0, 3), begun}) {
    write(".out.h5.clatter-0123abcd.tmp", text);
    EXPECT_EQ(refusal(path("out.h5")), "");
    EXPECT_EQ(entries(), 1U);
  }
}

TEST_F(AtomicWrite, touches_nothing_that_it_has_not_written) {
  for (const char* const name : {".out.h5.backup.tmp", ".out.h5.clatter-notes.tmp", ".out.h5.clatter-mynotes1.tmp"})
    write(name, "a letter");
  write(".other.h5.clatter-0123abcd.tmp", "");
  ASSERT_EQ(::mkfifo(path(".out.h5.clatter-0123abcd.tmp").c_str(), 0666), 0);
  ASSERT_EQ(::mkfifo(path(".out.h5.abcdef.tmp").c_str(), 0666), 0);
  fs::create_symlink(".other.h5.clatter-0123abcd.tmp", path(".out.h5.clatter-abcdefgh.tmp"));
  EXPECT_EQ(refusal(path("out.h5")), "");
  EXPECT_EQ(entries(), 8U);
}

TEST_F(AtomicWrite, of_two_at_once_neither_takes_the_file_of_the_other) {
  const std::string same(220, 'x');  // only the beginning of a long name is in that of the temporary file
  for (const std::string& other : {path("out.h5"), path(same + "2")}) {
    const std::string first = "first", second = "second", target = other == path("out.h5") ? other : path(same + "1");
    const auto meanwhile = [&] { write_atomically(other, second); };
    write_atomically(target, first, {.before_rename = meanwhile});
    EXPECT_EQ(content(fs::path(target).filename()), "first");
  }
  EXPECT_EQ(content(same + "2"), "second");
  EXPECT_EQ(entries(), 3U);
}

TEST_F(AtomicWrite, asks_for_room_only_if_there_is_too_little) {
  std::uint64_t asked = 0;
  const std::string text = "new";
  write_atomically(path("out.h5"), text, {.make_room = [&](std::uint64_t bytes) { asked = bytes; }});
  EXPECT_EQ(asked, 0U);
}

}  // namespace
}  // namespace clatter::storage::atomic_write_test
