#include "storage/file_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::storage::file_writer_test {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

void check_writing_and_reading(FileWriter& file) {
  const std::string text(3 * written_at_once + 1, 'x');
  file.write(10, bytes_of(text));
  file.write(2, bytes_of("yz"));
  std::string read(text.size() + 20, '?');
  file.read(0, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, std::string(2, '\0') + "yz" + std::string(6, '\0') + text + std::string(10, '\0'));
  file.set_size(3);
  file.read(0, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, std::string(2, '\0') + 'y' + std::string(read.size() - 3, '\0'));
}

TEST(FileWriter, writes_and_reads_anywhere) {
  MemoryWriter in_memory;
  check_writing_and_reading(in_memory);
  EXPECT_EQ(in_memory.take().size(), 3U);
  const support::TemporaryDirectory directory;
  const Descriptor file{::open(directory.path("a").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)};
  DiskWriter on_disk(file, "a file");
  check_writing_and_reading(on_disk);
  EXPECT_EQ(directory.content("a").size(), 3U);
}

/// The room that a writer asks for if its disk is full and so many bytes are still expected.
std::vector<std::uint64_t> asked_of_full_disk(std::uint64_t expected, std::string& message) {
  const Descriptor full{::open("/dev/full", O_RDWR | O_CLOEXEC)};
  std::vector<std::uint64_t> asked;
  DiskWriter file(full, "/dev/full", [&](std::uint64_t bytes) { asked.push_back(bytes); });
  file.expect(expected);
  try {
    file.write(0, bytes_of("some"));
  } catch (const IoError& error) {
    message = error.what();
  }
  return asked;
}

TEST(FileWriter, asks_once_for_the_room_that_a_full_disk_lacks_for_all_that_is_to_come) {
  std::string message;
  constexpr std::uint64_t huge = 1ULL << 50U;
  const std::vector<std::uint64_t> asked = asked_of_full_disk(huge, message);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_NEAR(static_cast<double>(asked[0]), static_cast<double>(huge) * (1 + 1.0 / 64), 1e14);
  EXPECT_EQ(message,
            "cannot write '/dev/full': No space left on device; free some space, or name a place that has more");
}

}  // namespace
}  // namespace clatter::storage::file_writer_test
