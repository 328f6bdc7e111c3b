#include "config/config_diff.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clatter::config::config_diff_test {
namespace {

const std::string ours = "title = \"a\"\n[scene]\nxs = 2\n[sweep]\nnu = 1\nR = 0.5\n";

std::string diff_to(const std::string& theirs) { return config_diff({"that: ", theirs}, {"this: ", ours}); }

TEST(ConfigDiff, shows_the_lines_that_only_one_has_with_their_sections) {
  EXPECT_EQ(diff_to("title = \"a\"\n[scene]\nxs = 3\n[sweep]\nnu = 1\nR = 0.5\n"),
            "\n  that: [scene] xs = 3\n  this: [scene] xs = 2");
  EXPECT_EQ(diff_to("title = \"b\"\n[scene]\nxs = 2\n[sweep]\nnu = 1\nR = 0.5\n"),
            "\n  that: title = \"b\"\n  this: title = \"a\"");
}

TEST(ConfigDiff, tells_an_order_that_differs_and_the_number_of_further_lines) {
  EXPECT_EQ(diff_to("title = \"a\"\n[scene]\nxs = 2\n[sweep]\nR = 0.5\nnu = 1\n"),
            "\n  the same lines in another order: the first axis varies slowest");
  const std::string many = diff_to("[observe]\na = 1\nb = 1\nc = 1\nd = 1\n");  // 4 and 4
  EXPECT_TRUE(many.ends_with("\n  and 2 more lines")) << many;
}

}  // namespace
}  // namespace clatter::config::config_diff_test
