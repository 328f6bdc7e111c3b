#include "plan/available_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/temporary_directory.hpp"

namespace clatter::plan::available_memory_test {
namespace {

/// A made-up root of a file system.
class Groups : public testing::Test {
 protected:
  void put(const std::string& path, const std::string& text) const { root_.write(path, text); }
  void mounts(const std::string& lines) const { put("proc/self/mountinfo", lines); }
  void groups(const std::string& lines) const { put("proc/self/cgroup", lines); }

  /// The least limit; infinity: there is none.
  [[nodiscard]] double least() const {
    double bytes = MemoryLimit{}.bytes;
    for (const MemoryLimit& limit : group_limits(root_.path())) bytes = std::min(bytes, limit.bytes);
    return bytes;
  }

  support::TemporaryDirectory root_;
};

constexpr const char* version_1 =
    "24 1 8:1 / / rw - ext4 /dev/root rw\n"
    "34 31 0:31 / /sys/fs/cgroup/cpuset rw,relatime - cgroup cgroup rw,cpuset\n"
    "35 31 0:32 / /sys/fs/cgroup/memory rw,relatime shared:9 - cgroup cgroup rw,memory\n";
constexpr const char* version_2 = "30 24 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw\n";

TEST_F(Groups, of_version_1_limit_by_limit_in_bytes) {
  mounts(version_1), groups("4:memory:/batch/job1\n3:cpuset:/\n");
  put("sys/fs/cgroup/memory/batch/job1/memory.limit_in_bytes", "2000000000\n");
  put("sys/fs/cgroup/memory/batch/memory.limit_in_bytes", "3000000000\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");  // none
  EXPECT_EQ(least(), 2e9);
  EXPECT_EQ(group_limits(root_.path()).size(), 2U);
  EXPECT_EQ(group_limits(root_.path())[0].name, "its control group '/batch/job1' permits");
}

TEST_F(Groups, of_version_1_may_share_a_hierarchy) {
  mounts("35 31 0:32 / /cg/all rw - cgroup cgroup rw,cpuset,memory\n"), groups("4:cpuset,memory:/a\n");
  put("cg/all/a/memory.limit_in_bytes", "5000");
  EXPECT_EQ(least(), 5000);
}

TEST_F(Groups, of_version_2_limit_by_memory_max) {
  mounts(version_2), groups("0::/user/session\n");
  put("sys/fs/cgroup/user/session/memory.max", "max\n");
  put("sys/fs/cgroup/user/memory.max", "4000000000\n");
  EXPECT_EQ(least(), 4e9);
  put("sys/fs/cgroup/user/session/memory.max", "1000000000\n");
  EXPECT_EQ(least(), 1e9);
}

TEST_F(Groups, of_both_versions_count_together) {
  std::string both = version_1;
  both += "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n";
  mounts(both);
  groups("4:memory:/one\n0::/two\n");
  put("sys/fs/cgroup/memory/one/memory.limit_in_bytes", "7000");
  EXPECT_EQ(least(), 7000);
  put("sys/fs/cgroup/unified/two/memory.max", "6000");
  EXPECT_EQ(least(), 6000);
  put("sys/fs/cgroup/unified/one/memory.max", "5");  // not a group of this process
  put("sys/fs/cgroup/cpuset/one/memory.limit_in_bytes", "5");
  EXPECT_EQ(least(), 6000);
}

TEST_F(Groups, of_a_container_are_seen_from_its_own_downwards) {
  mounts("35 31 0:32 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "8000");
  put("sys/fs/cgroup/memory/inner/memory.limit_in_bytes", "3000");
  groups("4:memory:/docker/abc\n");
  EXPECT_EQ(least(), 8000);
  groups("4:memory:/docker/abc/inner\n");
  EXPECT_EQ(least(), 3000);
  for (const char* const elsewhere : {"/docker/abcdef", "/process/xyz", "/../other", "/"}) {  // the shown one counts
    groups("4:memory:" + std::string(elsewhere) + "\n");
    EXPECT_EQ(least(), 8000) << elsewhere;
  }
}

TEST_F(Groups, may_have_blanks_and_colons_in_their_names) {
  mounts("30 24 0:26 / /sys/fs/my\\040groups rw - cgroup2 cgroup2 rw\n"), groups("0::/a b:c\n");
  put("sys/fs/my groups/a b:c/memory.max", "1234");
  EXPECT_EQ(least(), 1234);
}

TEST_F(Groups, without_a_limit_give_none) {
  EXPECT_TRUE(group_limits(root_.path()).empty());
  mounts(version_2), groups("0::/\n");
  EXPECT_TRUE(group_limits(root_.path()).empty());
  put("sys/fs/cgroup/memory.max", "max\n");
  EXPECT_TRUE(group_limits(root_.path()).empty());
  for (const char* const damaged : {"", "\n", "memory", "4:memory", "0:", "::::\n"}) groups(damaged), (void)least();
  mounts("1 2\n35 31 0:32 / - - -\n"), groups("0::/\n");
  EXPECT_TRUE(group_limits(root_.path()).empty());
}

TEST(AddressLimits, leave_the_memory_that_neither_the_process_nor_its_threads_take) {
  const ProcessSize now{.addresses = 3e8, .resident = 1e8, .data = 1.5e8};
  const double none = MemoryLimit{}.bytes;
  const auto alone = address_limits(1e9, 5e8, now, 0), with_threads = address_limits(1e9, 5e8, now, 2);
  EXPECT_EQ(alone[0].bytes, 1e9 - 2e8);
  EXPECT_EQ(alone[1].bytes, 5e8 - 0.5e8);
  EXPECT_LT(with_threads[0].bytes, alone[0].bytes);
  EXPECT_LT(with_threads[1].bytes, alone[1].bytes);
  for (const MemoryLimit& limit : address_limits(none, none, now, 4)) EXPECT_TRUE(std::isinf(limit.bytes));
  for (const MemoryLimit& limit : address_limits(1, 1, now, 4)) EXPECT_EQ(limit.bytes, 0);
}

TEST(PeakBytes, is_known_here) { EXPECT_GT(peak_bytes(), 1e6); }

TEST(MemoryLimits, are_those_of_the_machine_at_least) {
  EXPECT_GT(memory_limit(1).bytes, 0);
  EXPECT_TRUE(std::isfinite(memory_limit(1).bytes));
}

}  // namespace
}  // namespace clatter::plan::available_memory_test
