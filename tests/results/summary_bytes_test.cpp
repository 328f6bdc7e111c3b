#include "results/summary_bytes.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clatter::results::summary_bytes_test {
namespace {

TEST(SummaryBytes, give_the_summary_again_and_nothing_if_some_are_missing) {
  const FileSummary summary{{{"title", "Größe"}, {"config", std::string(5000, '#')}},
                            {{"x", "float64", "1", "displacement", {{"nu", 5}, {"sample", 7}}}},
                            {{"periodic", 4}, {"aperiodic", std::size_t{1} << 40U}}};
  const std::string bytes = bytes_of(summary);
  const auto again = summary_from(bytes);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->attributes, summary.attributes);
  EXPECT_EQ(again->status_counts, summary.status_counts);
  EXPECT_EQ(again->variables.at(0).long_name, "displacement");
  EXPECT_EQ(again->variables.at(0).dimensions.at(1).length, 7U);
  for (std::size_t length = 0; length < bytes.size(); ++length) EXPECT_FALSE(summary_from(bytes.substr(0, length)));
  EXPECT_FALSE(summary_from(bytes + '\0'));
}

}  // namespace
}  // namespace clatter::results::summary_bytes_test
