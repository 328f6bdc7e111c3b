#include "storage/free_name.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_directory.hpp"

namespace clatter::storage::free_name_test {
namespace {

TEST(FreeName, is_the_first_that_neither_a_file_nor_a_link_nor_a_journal_has) {
  const support::TemporaryDirectory directory;
  const std::string mine = directory.path("mine.h5"), second = directory.path("mine-2.h5");
  EXPECT_EQ(free_name(mine), second);
  std::ofstream{second} << 'x';
  std::filesystem::create_symlink("nothing", directory.path("mine-3.h5"));
  std::ofstream{directory.path("mine-4.h5.journal")} << 'x';
  EXPECT_EQ(free_name(mine), directory.path("mine-5.h5"));
}

TEST(FreeName, keeps_folder_and_ending) {
  EXPECT_EQ(free_name("none.h5"), "none-2.h5");
  EXPECT_EQ(free_name("of/none/a.branch.h5"), "of/none/a.branch-2.h5");
  EXPECT_EQ(free_name("none"), "none-2");
}

TEST(FreeName, is_offered_as_a_word_of_a_shell) {
  EXPECT_EQ(instead_of_replacing("none.h5"),
            "name another with -o, e.g. -o none-2.h5, move that one away, or replace it with --force");
  EXPECT_EQ(instead_of_replacing("my own.h5"),
            "name another with -o, e.g. -o 'my own-2.h5', move that one away, or replace it with --force");
}

}  // namespace
}  // namespace clatter::storage::free_name_test
