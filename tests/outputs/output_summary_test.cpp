#include "outputs/output_summary.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::outputs::output_summary_test {
namespace {

/// The summary of a file that claims so many points along nu, with a configuration of three.
results::FileSummary summary_of(std::size_t points, const std::string& shard = "") {
  const support::TemporaryDirectory directory;
  results::Dataset dataset{{{"nu", points}},
                           {{"nu", {"nu"}, std::vector<double>(points, 1.0), "frequency", "1"},
                            {"status",
                             {"nu"},
                             std::vector<std::uint8_t>(points, 0),
                             "outcome",
                             "1",
                             {{"flag_values", std::vector<std::uint8_t>{0}}, {"flag_meanings", "periodic"}}}}};
  if (!shard.empty()) dataset.attributes = {{"shard", shard}};
  results::FileHead head;
  head.text = "[scene]\nxs = -4.0\n[sweep]\nnu = [1, 2, 3]\n";
  return read_summary(directory.write("a.h5", results::file_image(std::move(dataset), head)));
}

TEST(OutputSummary, is_read_if_it_has_the_points_of_its_configuration) {
  EXPECT_EQ(summary_of(3).status_counts.front().second, 3U);
  EXPECT_EQ(summary_of(2, "0/2").status_counts.front().second, 2U);
}

TEST(OutputSummary, is_refused_with_other_points) {
  for (const std::size_t points : {1U, 2U, 4U, 1000U}) {
    try {
      (void)summary_of(points);
      ADD_FAILURE() << points;
    } catch (const storage::IoError& error) {
      EXPECT_NE(std::string(error.what()).find("have the 3 points of its configuration"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW((void)summary_of(3, "0/2"), storage::IoError);
}

}  // namespace
}  // namespace clatter::outputs::output_summary_test
