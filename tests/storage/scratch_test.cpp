#include "storage/scratch.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::storage::scratch_test {
namespace {

class ScratchTest : public testing::Test {
 protected:
  [[nodiscard]] std::string output() const { return directory_.path("out.h5"); }
  [[nodiscard]] std::size_t entries() const { return directory_.entries(); }

 private:
  support::TemporaryDirectory directory_;
};

/// Bytes of the pages of files that are resident.
std::size_t resident_of_files() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0, of_files = 0;
  statm >> all >> resident >> of_files;
  return of_files * 4096;
}

TEST_F(ScratchTest, keeps_values_in_memory_and_in_files_without_a_name) {
  for (const std::size_t in_memory : {std::size_t{0}, Scratch::most_in_memory}) {
    Scratch scratch(output(), in_memory);
    const auto region = scratch.region(1000 * sizeof(double));
    const std::span<double> values = region->as<double>();
    ASSERT_EQ(values.size(), 1000U);
    EXPECT_TRUE(std::ranges::all_of(values, [](double value) { return value == 0; }));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
    EXPECT_EQ(values[999], 999.0);
    EXPECT_EQ(entries(), 0U);
  }
}

TEST_F(ScratchTest, lets_go_of_pages_and_finds_them_again) {
  constexpr std::size_t bytes = Scratch::most_resident + 2 * Scratch::between_checks;
  Scratch scratch(output(), 0);
  const auto region = scratch.region(bytes);
  const std::span<std::uint64_t> values = region->as<std::uint64_t>();
  const std::size_t before = resident_of_files();
  std::size_t most = 0;
  for (std::size_t i = 0; i < values.size(); i += 512) {
    values[i] = i;
    scratch.touched(1);
    if (i % (1UL << 20U) == 0) most = std::max(most, resident_of_files());
  }
  EXPECT_GT(most, before);
  EXPECT_LE(most, before + Scratch::most_resident + Scratch::between_checks);
  bool same = true;
  for (std::size_t i = 0; i < values.size(); i += 512) same = same && values[i] == i;
  EXPECT_TRUE(same);
}

TEST_F(ScratchTest, goes_to_files_from_the_first_on_if_more_is_expected_than_fits) {
  const std::size_t before = resident_of_files();
  constexpr std::size_t bytes = 16UL << 20U;
  Scratch scratch(output(), 2 * bytes);
  scratch.expect(3.0 * bytes);
  const auto region = scratch.region(bytes);
  std::ranges::fill(region->as<char>(), 'x');
  EXPECT_GE(resident_of_files(), before + bytes);
  Scratch unlimited(std::nullopt, bytes);
  unlimited.expect(3.0 * bytes);
  const std::size_t now = resident_of_files();
  const auto in_memory = unlimited.region(2 * bytes);
  std::ranges::fill(in_memory->as<char>(), 'x');
  EXPECT_LT(resident_of_files(), now + bytes);
}

TEST_F(ScratchTest, tells_a_full_disk_before_anything_is_stored) {
  std::signal(SIGXFSZ, SIG_IGN);  // as the program does: a file beyond the limit then gives EFBIG
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{100'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::string message;
  try {
    Scratch scratch(output(), 0);
    static_cast<void>(scratch.region(1'000'000));
  } catch (const IoError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(message, "cannot write '" + output() + "': File too large; free some space, or name a place that has more");
  EXPECT_EQ(entries(), 0U);
}

TEST_F(ScratchTest, an_arena_has_room_for_any_length_from_any_thread) {
  for (const std::size_t in_memory : {std::size_t{0}, Scratch::most_in_memory}) {
    Scratch scratch(output(), in_memory);
    Arena arena(scratch);
    constexpr std::size_t of_thread = 2000;
    std::vector<std::vector<std::span<std::byte>>> rooms(3);
    {
      std::vector<std::jthread> threads;
      for (std::size_t t = 0; t < rooms.size(); ++t)
        threads.emplace_back([&, t] {
          for (std::size_t i = 0; i < of_thread; ++i) {
            const std::size_t bytes = i % 500 == 0 ? 300'000 : 1 + i % 100;
            rooms[t].push_back({arena.room_for(bytes), bytes});
            std::ranges::fill(rooms[t].back(), static_cast<std::byte>(t + i));
          }
        });
    }
    for (std::size_t t = 0; t < rooms.size(); ++t)
      for (std::size_t i = 0; i < of_thread; ++i) {
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(rooms[t][i].data()) % alignof(double), 0U);
        ASSERT_TRUE(
            std::ranges::all_of(rooms[t][i], [&](std::byte byte) { return byte == static_cast<std::byte>(t + i); }));
      }
  }
}

}  // namespace
}  // namespace clatter::storage::scratch_test
